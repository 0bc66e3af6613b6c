// Lights, cameras, sonar and what hangs on the guest ports.
#include <gtest/gtest.h>

#include <cmath>

#include "deck.h"

namespace frontseat_driver::sim {
namespace {

std::size_t devices(const bp::GuestPortConnectorInfo& port) {
  return static_cast<std::size_t>(port.device_list().devices_size());
}

TEST(GuestPorts, TellWhatIsFitted) {
  BlueyeConfig config = quietDrone();
  config.devices = {BlueyeDevice::Dvl, BlueyeDevice::Gripper};
  Deck deck{config};
  deck.run(1.5);
  const auto ports = deck.latest<bp::DroneInfoTel>().drone_info().gp();
  ASSERT_EQ(devices(ports.gp1()), 1U);
  EXPECT_EQ(ports.gp1().device_list().devices(0).device_id(),
            bp::GUEST_PORT_DEVICE_ID_WATERLINKED_DVL_A50);
  EXPECT_EQ(devices(ports.gp2()), 1U);
  EXPECT_EQ(ports.gp3().error(), bp::GUEST_PORT_ERROR_NOT_CONNECTED);
  EXPECT_EQ(ports.gp3().guest_port_number(), bp::GUEST_PORT_NUMBER_PORT_3);
}

TEST(GuestPorts, GoOffOnAndOnAgainByThemselves) {
  Deck deck;
  deck.run(2.0);
  ASSERT_GT(deck.latest<bp::GuestPortCurrentTel>().current().gp1_bat(), 0.0);
  deck.tell(bp::DeactivateGuestPortsCtrl{});
  deck.run(0.1);
  EXPECT_EQ(deck.latest<bp::GuestPortCurrentTel>().current().gp1_bat(), 0.0);
  deck.published.clear();
  deck.run(2.0);
  EXPECT_EQ(deck.count<bp::DvlVelocityTel>(), 0U);
  bp::RestartGuestPortsCtrl restart;
  restart.mutable_restart_info()->set_power_off_duration(3.0);
  deck.tell(restart);
  deck.run(2.5);
  EXPECT_EQ(deck.count<bp::DvlVelocityTel>(), 0U);
  deck.run(2.0);
  EXPECT_GT(deck.count<bp::DvlVelocityTel>(), 2U);
}

TEST(Payload, TiltMovesAsLongAsItIsTold) {
  Deck deck;
  bp::TiltVelocityCtrl tilt;
  tilt.mutable_velocity()->set_value(0.5F);
  deck.tell(tilt);
  deck.run(1.0);
  EXPECT_NEAR(deck.latest<bp::TiltAngleTel>().angle().value(), 10.0, 1.5);  // up
  tilt.mutable_velocity()->set_value(0.0F);
  deck.tell(tilt);
  deck.run(1.0);
  const float stopped = deck.latest<bp::TiltAngleTel>().angle().value();
  deck.run(1.0);
  EXPECT_EQ(deck.latest<bp::TiltAngleTel>().angle().value(), stopped);
  tilt.mutable_velocity()->set_value(-1.0F);
  deck.tell(tilt);
  deck.run(10.0);
  EXPECT_EQ(deck.latest<bp::TiltAngleTel>().angle().value(), -30.0F);
}

TEST(Payload, RecordsWhatItIsToldAndPhotographs) {
  Deck deck;
  deck.run(2.5);
  const auto before = deck.latest<bp::VideoStorageSpaceTel>().storage_space().free_space();
  bp::RecordCtrl record;
  record.mutable_record_on()->set_main(true);
  record.mutable_record_on()->set_guestport(true);
  deck.tell(record);
  deck.run(10.0);
  EXPECT_NEAR(deck.latest<bp::RecordStateTel>().record_state().guestport_seconds(), 10.0, 1.0);
  record.mutable_record_on()->set_guestport(false);
  deck.tell(record);
  deck.run(10.0);
  const auto state = deck.latest<bp::RecordStateTel>().record_state();
  EXPECT_TRUE(state.main_is_recording());
  EXPECT_FALSE(state.guestport_is_recording());
  EXPECT_NEAR(state.main_seconds(), 20.0, 1.0);
  EXPECT_EQ(state.guestport_seconds(), -1);
  deck.tell(bp::TakePictureCtrl{});
  deck.run(2.5);
  EXPECT_EQ(deck.drone.pictures(), 1U);
  EXPECT_LT(deck.latest<bp::VideoStorageSpaceTel>().storage_space().free_space(), before - 4000000);
}

TEST(Payload, ServosGoWhereTheyAreSent) {
  Deck deck;
  bp::GenericServoCtrl servo;
  servo.mutable_servo()->set_value(1.0F);
  deck.tell(servo);
  bp::MultibeamServoCtrl multibeam;
  multibeam.mutable_servo()->set_angle(-90.0F);
  deck.tell(multibeam);
  deck.run(0.6);
  const float on_the_way = deck.latest<bp::GenericServoTel>().servo().value();
  EXPECT_GT(on_the_way, 0.5F);
  EXPECT_LT(on_the_way, 1.0F);
  deck.run(5.0);
  EXPECT_EQ(deck.latest<bp::GenericServoTel>().servo().value(), 1.0F);
  EXPECT_EQ(deck.latest<bp::MultibeamServoTel>().servo().angle(), -30.0F);
}

TEST(Calibration, GoesThroughItsAxesAndEnds) {
  Deck deck;
  deck.run(1.0);
  EXPECT_EQ(deck.latest<bp::CalibrationStateTel>().calibration_state().status(),
            bp::CalibrationState::STATUS_NOT_CALIBRATING);
  deck.tell(bp::StartCalibrationCtrl{});
  deck.run(1.0);
  auto state = deck.latest<bp::CalibrationStateTel>().calibration_state();
  EXPECT_EQ(state.status(), bp::CalibrationState::STATUS_CALIBRATING_X_POSITIVE);
  EXPECT_GT(state.progress_x_positive(), 0.1F);
  deck.run(25.0);
  state = deck.latest<bp::CalibrationStateTel>().calibration_state();
  EXPECT_EQ(state.progress_thruster(), 1.0F);
  deck.tell(bp::FinishCalibrationCtrl{});
  deck.run(0.1);
  EXPECT_EQ(deck.latest<bp::CalibrationStateTel>().calibration_state().status(),
            bp::CalibrationState::STATUS_NOT_CALIBRATING);
}

TEST(Multibeam, PingsWhenActivatedAsItIsConfigured) {
  BlueyeConfig config = quietDrone();
  config.multibeam.beams = 64;
  config.multibeam.ranges = 50;
  Deck deck{config};
  deck.run(2.0);
  EXPECT_EQ(deck.count<bp::MultibeamPingTel>(), 0U);
  bp::ActivateMultibeamCtrl activate;
  activate.mutable_config()->set_ping_rate(bp::MultibeamConfig::PING_RATE_HIGH);
  activate.mutable_config()->set_range(30.0);
  deck.tell(activate);
  deck.run(2.0);
  EXPECT_NEAR(static_cast<double>(deck.count<bp::MultibeamPingTel>()), 30.0, 2.0);
  const auto ping = deck.latest<bp::MultibeamPingTel>().ping();
  EXPECT_EQ(ping.ping_data().size(), 64U * 50U);
  EXPECT_EQ(ping.bearings_size(), 64);
  EXPECT_EQ(ping.range(), 30.0);
  EXPECT_LT(ping.bearings(0), -6000.0F);  // hundredths of a degree, from port to starboard
  EXPECT_GT(ping.bearings(63), 6000.0F);
  deck.tell(bp::DeactivateMultibeamCtrl{});
  deck.published.clear();
  deck.run(1.0);
  EXPECT_EQ(deck.count<bp::MultibeamPingTel>(), 0U);
}

struct Resolution {
  bp::MultibeamConfig::MaximumNumberOfBeams most;
  std::uint32_t beams;
};
class MultibeamResolution : public testing::TestWithParam<Resolution> {};

TEST_P(MultibeamResolution, IsTheOneAskedFor) {
  BlueyeConfig config = quietDrone();
  config.multibeam.beams = 1024;
  config.multibeam.ranges = 10;
  Deck deck{config};
  bp::ActivateMultibeamCtrl activate;
  activate.mutable_config()->set_maximum_number_of_beams(GetParam().most);
  deck.tell(activate);
  deck.run(0.5);
  const auto ping = deck.latest<bp::MultibeamPingTel>().ping();
  EXPECT_EQ(ping.number_of_beams(), GetParam().beams);
  EXPECT_EQ(ping.ping_data().size(), GetParam().beams * 10U);
}

INSTANTIATE_TEST_SUITE_P(
    Table, MultibeamResolution,
    testing::Values(Resolution{bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_128, 128},
                    Resolution{bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_256, 256},
                    Resolution{bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_512, 512},
                    Resolution{bp::MultibeamConfig::MAXIMUM_NUMBER_OF_BEAMS_MAX_1024, 1024}));

TEST(Multibeam, SendsAMegabyteTwentyTimesASecondIfItIsToldSo) {
  BlueyeConfig config = quietDrone();
  config.multibeam = {1024, 1024, 20.0, true};
  config.conventions.bearings_in_degrees = true;
  Deck deck{config};
  deck.run(1.0);
  EXPECT_NEAR(static_cast<double>(deck.count<bp::MultibeamPingTel>()), 20.0, 1.0);
  const auto ping = deck.latest<bp::MultibeamPingTel>().ping();
  EXPECT_EQ(ping.ping_data().size(), 1U << 20);
  EXPECT_LT(std::abs(ping.bearings(0)), 90.0F);
}

TEST(AquaTroll, ConvertsItsUnitsAndCanBeDisconnected) {
  Deck deck;
  deck.connect();
  deck.push(0, 0, 1, 0);
  deck.run(12.0);
  const auto depth_of = [&] {
    const auto message = deck.latest<bp::AquaTrollSensorParametersTel>();
    for (const auto& sensor : message.sensors().sensors()) {
      for (const auto& block : sensor.parameter_blocks()) {
        if (block.parameter_id() == bp::AQUA_TROLL_PARAMETER_DEPTH) return block;
      }
    }
    return bp::AquaTrollParameterBlock{};
  };
  deck.push(0, 0, 0, 0);
  deck.run(20.0);
  EXPECT_EQ(depth_of().units_id(), bp::AQUA_TROLL_UNIT_METERS);
  EXPECT_NEAR(depth_of().measured_value(), deck.state().depth_m, 0.05);
  bp::SetAquaTrollParameterUnitCtrl unit;
  const auto sensors = deck.latest<bp::AquaTrollSensorParametersTel>().sensors();
  unit.mutable_parameter_info()->set_sensor_id(sensors.sensors(1).sensor_id());
  unit.mutable_parameter_info()->set_parameter_id(bp::AQUA_TROLL_PARAMETER_DEPTH);
  unit.mutable_parameter_info()->set_unit_id(bp::AQUA_TROLL_UNIT_FEET);
  deck.tell(unit);
  deck.run(0.1);
  EXPECT_NEAR(depth_of().measured_value(), deck.state().depth_m / 0.3048, 0.1);
  bp::SetAquaTrollConnectionStatusCtrl off;
  deck.tell(off);
  deck.run(0.1);
  EXPECT_FALSE(deck.latest<bp::AquaTrollProbeMetadataTel>().probe().status());
  deck.published.clear();
  deck.run(5.0);
  EXPECT_EQ(deck.count<bp::AquaTrollSensorParametersTel>(), 0U);
}

TEST(ErrorFlags, CanBeRaised) {
  Deck deck;
  EXPECT_TRUE(deck.drone.setErrorFlag("depth_read", true));
  EXPECT_FALSE(deck.drone.setErrorFlag("no_such_flag", true));
  deck.run(0.1);
  EXPECT_TRUE(deck.latest<bp::ErrorFlagsTel>().error_flags().depth_read());
  EXPECT_TRUE(deck.drone.setErrorFlag("depth_read", false));
  deck.run(0.1);
  EXPECT_FALSE(deck.latest<bp::ErrorFlagsTel>().error_flags().depth_read());
}

}  // namespace
}  // namespace frontseat_driver::sim
