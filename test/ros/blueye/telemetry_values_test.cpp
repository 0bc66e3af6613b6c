#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "blueye/messages.h"

// Signs, units and words of what has a topic of its own and is no navigation.

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using testing::ElementsAre;
using State = sensor_msgs::BatteryState;

constexpr double kClose = 1e-6;

class Values : public testing::Test {
 protected:
  Context context() const { return {ros::Time(100, 0), how_, deviations_}; }
  Conventions how_;
  Deviations deviations_;
};

TEST_F(Values, DeclinationIsInRadiansEastPositive) {
  pb::MagneticDeclinationTel told;
  auto& in = *told.mutable_magnetic_declination();
  in.set_declination(4.5F);
  auto out = toDeclination(told, context());
  EXPECT_FALSE(out->applied);
  EXPECT_NEAR(out->declination, 0.0785398, kClose);
  EXPECT_TRUE(std::isnan(out->latitude));
  in.set_location_source(pb::LOCATION_SOURCE_USER);
  in.mutable_location()->set_latitude(63.5);
  in.mutable_location()->set_longitude(10.25);
  out = toDeclination(told, context());
  EXPECT_TRUE(out->applied);
  EXPECT_EQ(out->latitude, 63.5);
  EXPECT_EQ(out->longitude, 10.25);
}

TEST_F(Values, ErrorsOfTheControllersAreUpAndCounterClockwise) {
  pb::ControllerHealthTel told;
  auto& in = *told.mutable_controller_health();
  in.set_depth_error(0.5F);
  in.set_depth_health(0.25F);
  in.set_heading_error(90.0F);
  in.set_heading_health(0.75F);
  const auto out = toHealth(told, context());
  EXPECT_EQ(out->z_error, -0.5);
  EXPECT_EQ(out->depth_load, 0.25);
  EXPECT_NEAR(out->heading_error, -M_PI_2, kClose);
  EXPECT_EQ(out->heading_load, 0.75);
}

TEST_F(Values, DetailsOfTheBatteryTakeTheSignOfTheCurrentFromTheConvention) {
  pb::BatteryBQ40Z50 in;
  in.set_average_current(-2.5F);
  in.mutable_status()->set_over_temperature_alarm(true);
  in.mutable_status()->set_fully_discharged(true);
  in.set_runtime_to_empty(60);
  auto out = toBatteryDetails(in, 1, context());
  EXPECT_EQ(out.location, "battery_1");
  EXPECT_EQ(out.average_current, -2.5);
  EXPECT_EQ(out.runtime_to_empty.toSec(), 60.0);
  EXPECT_THAT(out.alarms, ElementsAre("over_temperature", "fully_discharged"));
  how_.battery_discharge_negative = false;
  EXPECT_EQ(toBatteryDetails(in, 1, context()).average_current, 2.5);
}

TEST_F(Values, TheSurfaceUnitTellsAShareAndNoVoltage) {
  pb::SurfaceUnitTel told;
  auto& in = *told.mutable_battery_info();
  in.set_level(0.5F);
  const std::pair<pb::SurfaceUnitBatteryInfo::ChargeStatus, int> rows[] = {
      {pb::SurfaceUnitBatteryInfo::CHARGE_STATUS_CHARGE, State::POWER_SUPPLY_STATUS_CHARGING},
      {pb::SurfaceUnitBatteryInfo::CHARGE_STATUS_DISCHARGE, State::POWER_SUPPLY_STATUS_DISCHARGING},
      {pb::SurfaceUnitBatteryInfo::CHARGE_STATUS_CHARGE_ERROR, State::POWER_SUPPLY_STATUS_UNKNOWN},
  };
  for (const auto& [status, expected] : rows) {
    in.set_status(status);
    const auto out = toSurfaceUnit(told, context());
    EXPECT_EQ(out->power_supply_status, expected);
    EXPECT_EQ(out->percentage, 0.5F);
    EXPECT_TRUE(std::isnan(out->voltage));
  }
}

TEST_F(Values, HumidityIsAShareAndTemperaturesAreAsTheyAre) {
  pb::CanisterBottomHumidityTel humidity;
  humidity.mutable_humidity()->set_humidity(45.0F);
  EXPECT_NEAR(toHumidity(humidity, context())->relative_humidity, 0.45, kClose);
  pb::CanisterBottomTemperatureTel canister;
  canister.mutable_temperature()->set_temperature(31.5F);
  EXPECT_EQ(toCanisterTemperature(canister, context())->temperature, 31.5);
  pb::WaterTemperatureTel water;
  water.mutable_temperature()->set_value(-1.5F);
  EXPECT_EQ(toWaterTemperature(water, context())->temperature, -1.5);
  pb::CPUTemperatureTel cpu;
  cpu.mutable_temperature()->set_value(60.5F);
  EXPECT_EQ(toCpuTemperature(cpu, context())->temperature, 60.5);
  pb::CalibratedImuTel imu;
  imu.mutable_imu()->set_temperature(25.5F);
  EXPECT_EQ(toImuTemperature(imu, context())->temperature, 25.5);
  EXPECT_EQ(toImuTemperature(imu, context())->header.frame_id, "imu_link");
  water.mutable_temperature()->set_value(NAN);
  EXPECT_FALSE(toWaterTemperature(water, context()));
}

TEST_F(Values, LightsModesAndTimesAreAsTheyAre) {
  pb::LightsTel lights;
  lights.mutable_lights()->set_value(0.25F);
  EXPECT_EQ(toLights(lights, context())->data, 0.25);
  pb::GuestPortLightsTel port_lights;
  port_lights.mutable_lights()->set_value(0.75F);
  EXPECT_EQ(toGuestPortLights(port_lights, context())->data, 0.75);
  pb::TiltStabilizationTel stabilized;
  stabilized.mutable_state()->set_enabled(true);
  EXPECT_TRUE(toTiltStabilization(stabilized, context())->data);
  pb::DiveTimeTel dive;
  dive.mutable_dive_time()->set_value(90);
  EXPECT_EQ(toDiveTime(dive, context())->data.toSec(), 90.0);
  pb::ForwardDistanceTel ahead;
  ahead.mutable_forward_distance()->set_value(3.5F);
  EXPECT_FALSE(toForwardDistance(ahead, context()));
  ahead.mutable_forward_distance()->set_is_valid(true);
  EXPECT_EQ(toForwardDistance(ahead, context())->range, 3.5F);
  EXPECT_EQ(toForwardDistance(ahead, context())->header.frame_id, "pinger_link");
}

TEST_F(Values, TheMissionIsInWordsAndSeconds) {
  pb::MissionStatusTel told;
  auto& in = *told.mutable_mission_status();
  in.set_state(pb::MISSION_STATE_FAILED_TO_LOAD_MISSION);
  in.set_id(7);
  in.set_time_elapsed(30);
  in.set_estimated_time_to_complete(90);
  in.set_distance_to_complete(12);
  in.set_total_number_of_instructions(3);
  in.add_completed_instruction_ids(5);
  in.set_total_number_of_path_segments(4);
  in.add_completed_path_segment_ids(6);
  const auto out = toMission(told, context());
  EXPECT_EQ(out->status, "failed to load mission");
  EXPECT_EQ(out->state, 7);
  EXPECT_EQ(out->id, 7u);
  EXPECT_EQ(out->elapsed.toSec(), 30.0);
  EXPECT_EQ(out->remaining.toSec(), 90.0);
  EXPECT_EQ(out->distance_remaining, 12.0);
  EXPECT_EQ(out->instructions, 3u);
  EXPECT_THAT(out->completed_instructions, ElementsAre(5u));
  EXPECT_EQ(out->path_segments, 4u);
  EXPECT_THAT(out->completed_path_segments, ElementsAre(6u));
}

TEST_F(Values, ACalibrationTellsEachAxis) {
  pb::CalibrationStateTel told;
  auto& in = *told.mutable_calibration_state();
  in.set_status(pb::CalibrationState::STATUS_CALIBRATING_Y_NEGATIVE);
  in.set_progress_x_positive(0.125F);
  in.set_progress_x_negative(0.25F);
  in.set_progress_y_positive(0.375F);
  in.set_progress_y_negative(0.5F);
  in.set_progress_z_positive(0.625F);
  in.set_progress_z_negative(0.75F);
  in.set_progress_thruster(0.875F);
  const auto out = toCalibration(told, context());
  EXPECT_EQ(out->status, 6);
  EXPECT_EQ(out->name, "CALIBRATING_Y_NEGATIVE");
  EXPECT_EQ(out->x_positive, 0.125);
  EXPECT_EQ(out->x_negative, 0.25);
  EXPECT_EQ(out->y_positive, 0.375);
  EXPECT_EQ(out->y_negative, 0.5);
  EXPECT_EQ(out->z_positive, 0.625);
  EXPECT_EQ(out->z_negative, 0.75);
  EXPECT_EQ(out->thruster, 0.875);
}

TEST_F(Values, InfoPrintsWhatIsPrintableAndNamesEachPort) {
  pb::DroneInfoTel told;
  auto& in = *told.mutable_drone_info();
  in.set_blunux_version("4.4.2");
  in.set_serial_number("BYEDP123");
  in.set_hardware_id(std::string{"\x01\xAB", 2});
  in.set_model(pb::MODEL_X3);
  auto& dvl = *in.mutable_gp()->mutable_gp2()->mutable_device_list()->add_devices();
  dvl.set_device_id(pb::GUEST_PORT_DEVICE_ID_WATERLINKED_DVL_A50);
  dvl.set_name("DVL A50");
  dvl.set_depth_rating(300.0F);
  in.mutable_gp()->mutable_gp3()->set_error(pb::GUEST_PORT_ERROR_NOT_CONNECTED);
  const auto out = toInfo(told, context());
  EXPECT_EQ(out->serial_number, "BYEDP123");
  EXPECT_EQ(out->hardware_id, "01ab");
  EXPECT_EQ(out->model, "X3");
  ASSERT_EQ(out->guest_ports.size(), 2u);
  EXPECT_EQ(out->guest_ports[0].port, 2);
  EXPECT_EQ(out->guest_ports[0].device, "WATERLINKED_DVL_A50");
  EXPECT_EQ(out->guest_ports[0].depth_rating, 300.0);
  EXPECT_EQ(out->guest_ports[0].error, "");
  EXPECT_EQ(out->guest_ports[1].port, 3);
  EXPECT_EQ(out->guest_ports[1].device_id, 0u);
  EXPECT_EQ(out->guest_ports[1].error, "NOT_CONNECTED");
}

TEST_F(Values, ANotificationKeepsItsLevelNameAndTime) {
  pb::Notification in;
  in.set_type(pb::NOTIFICATION_TYPE_WAYPOINT_REACHED);
  in.set_level(pb::NOTIFICATION_LEVEL_ERROR);
  in.mutable_timestamp()->set_seconds(1700000000);
  in.mutable_timestamp()->set_nanos(5000);
  const auto out = toNotification(in, context());
  EXPECT_EQ(out.level, BlueyeNotification::ERROR);
  EXPECT_EQ(out.name, "WAYPOINT_REACHED");
  EXPECT_EQ(out.type, static_cast<std::uint32_t>(pb::NOTIFICATION_TYPE_WAYPOINT_REACHED));
  EXPECT_EQ(out.raised, ros::Time(1700000000, 5000));
  EXPECT_EQ(out.header.stamp, ros::Time(100, 0));
}

TEST_F(Values, TheAutopilotsDepthCountsFromWhatItNames) {
  pb::ReferenceAutoPilotTel told;
  auto& in = *told.mutable_reference_auto_pilot();
  in.set_depth_set_point(3.0F);
  in.set_heave_velocity(0.25F);
  in.set_course_to_target(0.0F);
  in.set_depth_zero_reference(pb::DEPTH_ZERO_REFERENCE_SURFACE);
  auto out = toAutoPilot(told, context());
  EXPECT_FALSE(out->above_bottom);
  EXPECT_EQ(out->z, -3.0);
  EXPECT_EQ(out->heave_velocity, -0.25);
  EXPECT_NEAR(out->course, M_PI_2, kClose);
  in.set_depth_zero_reference(pb::DEPTH_ZERO_REFERENCE_SEABED);
  how_.heave_velocity_down = false;
  out = toAutoPilot(told, context());
  EXPECT_TRUE(out->above_bottom);
  EXPECT_EQ(out->z, 3.0);
  EXPECT_EQ(out->heave_velocity, 0.25);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
