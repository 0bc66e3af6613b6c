// Stick to telemetry, axis by axis: the numbers on the wire are those of the document.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "deck.h"
#include "frontseat_driver/sim/angles.h"
#include "pilot.h"

namespace frontseat_driver::sim {
namespace {

void publishAt(Deck& deck, const std::string& message, float hz) {
  bp::SetPubFrequencyReq request;
  request.set_message_type(message);
  request.set_frequency(hz);
  const auto reply = deck.ask<bp::SetPubFrequencyRep>(request);
  ASSERT_TRUE(reply && reply->success()) << message;
}

/// Under water, with somebody in control.
Deck& dived(Deck& deck) {
  deck.connect();
  deck.push(0, 0, 1, 0);
  deck.run(8.0);
  deck.push(0, 0, 0, 0);
  deck.run(20.0);
  return deck;
}

struct Stick {
  const char* name;
  float surge, sway, heave, yaw;
  double heading_deg;
  // Signs of what is reported: 1, -1, or 0 for none.
  int northing, easting, depth, heading, surge_rate, sway_rate, dvl_x, dvl_y, dvl_z, gyro_z;
};

const Stick kSticks[] = {{"forward", 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0},
                         {"astern", -1, 0, 0, 0, 0, -1, 0, 0, 0, -1, 0, -1, 0, 0, 0},
                         {"right", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0},
                         {"left", 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, -1, 0, -1, 0, 0},
                         {"down", 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0},
                         {"clockwise", 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1},
                         {"counter_clockwise", 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1},
                         {"forward_bow_east", 1, 0, 0, 0, 90, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0},
                         {"right_bow_east", 0, 1, 0, 0, 90, -1, 0, 0, 0, 0, 1, 0, 1, 0, 0},
                         {"forward_bow_west", 1, 0, 0, 0, 270, 0, -1, 0, 0, 1, 0, 1, 0, 0, 0}};

class Sticks : public testing::TestWithParam<Stick> {};

int sign(double value, double threshold) {
  if (std::abs(value) < threshold) return 0;
  return value > 0.0 ? 1 : -1;
}

TEST_P(Sticks, ShowInTelemetryAsTheDocumentSays) {
  const Stick& stick = GetParam();
  BlueyeConfig config = quietDrone();
  config.start.heading_deg = stick.heading_deg;
  Deck deck{config};
  deck.connect();
  publishAt(deck, "CalibratedImuTel", 20.0F);
  publishAt(deck, "DvlVelocityTel", 20.0F);
  deck.run(1.0);
  const double heading = deck.latest<bp::PositionEstimateTel>().position_estimate().heading();
  deck.push(stick.surge, stick.sway, stick.heave, stick.yaw);
  deck.run(3.0);
  const auto estimate = deck.latest<bp::PositionEstimateTel>().position_estimate();
  const auto dvl = deck.latest<bp::DvlVelocityTel>().dvl_velocity().velocity();
  ASSERT_TRUE(estimate.is_valid());
  EXPECT_EQ(sign(estimate.northing(), 0.05), stick.northing);
  EXPECT_EQ(sign(estimate.easting(), 0.05), stick.easting);
  EXPECT_EQ(sign(deck.latest<bp::DepthTel>().depth().value(), 0.05), stick.depth);
  EXPECT_EQ(sign(estimate.heading() - heading, 0.05), stick.heading);
  EXPECT_EQ(sign(estimate.surge_rate(), 0.05), stick.surge_rate);
  EXPECT_EQ(sign(estimate.sway_rate(), 0.05), stick.sway_rate);
  EXPECT_EQ(sign(estimate.yaw_rate(), 0.05), stick.gyro_z);
  EXPECT_EQ(sign(dvl.x(), 0.05), stick.dvl_x);
  EXPECT_EQ(sign(dvl.y(), 0.05), stick.dvl_y);
  EXPECT_EQ(sign(dvl.z(), 0.05), stick.dvl_z);
  const auto gyroscope = deck.latest<bp::CalibratedImuTel>().imu().gyroscope();
  EXPECT_EQ(sign(gyroscope.z(), 0.05), stick.gyro_z);
}

INSTANTIATE_TEST_SUITE_P(Table, Sticks, testing::ValuesIn(kSticks),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(BlueyeMotion, AttitudeIsInDegreesAndTheEstimateInRadiansThatGoOn) {
  BlueyeConfig config = quietDrone();
  config.start.heading_deg = 170.0;
  Deck deck{config};
  deck.connect();
  deck.push(0, 0, 0, 0.5F);
  deck.run(20.0);
  const double heading = deck.latest<bp::PositionEstimateTel>().position_estimate().heading();
  EXPECT_GT(heading, 2.0 * kPi);  // it has gone round more than once
  const double yaw = deck.latest<bp::AttitudeTel>().attitude().yaw();
  EXPECT_LE(std::abs(yaw), 180.0);
  EXPECT_NEAR(wrapPi(radians(yaw) - heading), 0.0, 0.1);  // two messages, two instants
}

TEST(BlueyeMotion, RollIsToStarboardAndPitchIsUp) {
  Deck deck;
  deck.connect();
  bp::MotionInputCtrl message;
  message.mutable_motion_input()->set_roll(1.0F);
  deck.tell(message);
  deck.run(10.0);
  EXPECT_NEAR(deck.latest<bp::AttitudeTel>().attitude().roll(),
              degrees(BlueyePilot::kGain * Rov::kLean_rad), 0.2);
  message.mutable_motion_input()->set_roll(0.0F);
  message.mutable_motion_input()->set_pitch(1.0F);
  deck.tell(message);
  deck.run(10.0);
  EXPECT_NEAR(deck.latest<bp::AttitudeTel>().attitude().roll(), 0.0, 0.2);
  EXPECT_NEAR(deck.latest<bp::AttitudeTel>().attitude().pitch(),
              degrees(BlueyePilot::kGain * Rov::kLean_rad), 0.2);
}

struct AtRest {
  const char* name;
  bool gravity;
  double z;
};
class Accelerometer : public testing::TestWithParam<AtRest> {};

TEST_P(Accelerometer, AtRestAndLevel) {
  BlueyeConfig config = quietDrone();
  config.conventions.gravity_positive = GetParam().gravity;
  Deck deck{config};
  publishAt(deck, "CalibratedImuTel", 10.0F);
  deck.run(1.0);
  const auto imu = deck.latest<bp::CalibratedImuTel>().imu();
  EXPECT_NEAR(imu.accelerometer().x(), 0.0, 1e-6);
  EXPECT_NEAR(imu.accelerometer().y(), 0.0, 1e-6);
  EXPECT_NEAR(imu.accelerometer().z(), GetParam().z, 1e-6);
  // The bow is north: the field lies ahead and down.
  EXPECT_NEAR(imu.magnetometer().x(), 13.7, 1e-6);
  EXPECT_NEAR(imu.magnetometer().y(), 0.0, 1e-6);
  EXPECT_NEAR(imu.magnetometer().z(), 50.2, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Table, Accelerometer,
                         testing::Values(AtRest{"specific_force", false, -1.0},
                                         AtRest{"gravity", true, 1.0}),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(BlueyeMotion, FieldTurnsAgainstTheHull) {
  BlueyeConfig config = quietDrone();
  config.start.heading_deg = 90.0;
  Deck deck{config};
  publishAt(deck, "Imu1Tel", 10.0F);
  deck.run(1.0);
  const auto field = deck.latest<bp::Imu1Tel>().imu().magnetometer();
  EXPECT_NEAR(field.x(), 0.0, 1e-6);
  EXPECT_NEAR(field.y(), -13.7, 1e-6);  // bow east: north is to port
}

TEST(BlueyeMotion, YawTurnsTheOtherWayWhereTheTextIsObeyed) {
  BlueyeConfig config = quietDrone();
  config.conventions.yaw_clockwise = false;
  Deck deck{config};
  deck.connect();
  deck.push(0, 0, 0, 1);
  deck.run(2.0);
  EXPECT_LT(deck.drone.model().yawRate(), -0.1);
  deck.run(0.5);
  EXPECT_EQ(deck.latest<bp::ReferenceTel>().reference().yaw(), 1.0F);  // as it was sent
}

TEST(BlueyeMotion, DvlCountsToPortWhereToldSo) {
  BlueyeConfig config = quietDrone();
  config.conventions.dvl_y_right = false;
  Deck deck{config};
  deck.connect();
  deck.push(0, 1, 0, 0);
  deck.run(3.0);
  EXPECT_LT(deck.latest<bp::DvlVelocityTel>().dvl_velocity().velocity().y(), -0.1);
  EXPECT_GT(deck.latest<bp::PositionEstimateTel>().position_estimate().sway_rate(), 0.1);
}

TEST(BlueyeMotion, SlowReducesBoostRaisesAndBothCancel) {
  double speed[4];
  const float modifiers[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  for (int i = 0; i < 4; ++i) {
    Deck deck;
    deck.connect();
    bp::MotionInputCtrl message;
    message.mutable_motion_input()->set_surge(1.0F);
    message.mutable_motion_input()->set_slow(modifiers[i][0]);
    message.mutable_motion_input()->set_boost(modifiers[i][1]);
    deck.tell(message);
    deck.run(20.0);
    speed[i] = deck.state().surge_m_s;
  }
  EXPECT_LT(speed[1], 0.7 * speed[0]);
  EXPECT_GT(speed[2], 1.1 * speed[0]);
  EXPECT_NEAR(speed[2], 1.5, 0.01);
  EXPECT_NEAR(speed[3], speed[0], 1e-9);
}

TEST(BlueyeMotion, StickStaysAsItWasPut) {
  Deck deck;
  deck.connect();
  deck.push(0.5F, 0, 0, 0);
  deck.run(60.0);
  EXPECT_GT(deck.state().surge_m_s, 0.5);
}

TEST(BlueyeMotion, DepthFollowsTheDensityItIsTold) {
  Deck deck;
  dived(deck);
  const double deep = deck.state().depth_m;
  ASSERT_GT(deep, 2.0);
  EXPECT_NEAR(deck.latest<bp::DepthTel>().depth().value(), deep, 0.01);
  bp::WaterDensityCtrl fresh;
  fresh.mutable_density()->set_value(997.0F);
  deck.tell(fresh);
  deck.run(0.5);
  EXPECT_NEAR(deck.latest<bp::DepthTel>().depth().value(), deep * 1025.0 / 997.0, 0.02);
}

TEST(BlueyeMotion, HeadingIsMagneticUntilItIsLocated) {
  BlueyeConfig config = quietDrone();
  config.magnetic_declination_deg = 5.0;
  config.devices = {BlueyeDevice::Dvl};
  Deck deck{config};
  deck.run(1.0);
  EXPECT_NEAR(deck.latest<bp::AttitudeTel>().attitude().yaw(), -5.0, 1e-3);
  bp::ResetPositionCtrl reset;
  reset.mutable_settings()->set_reset_coordinate_source(bp::RESET_COORDINATE_SOURCE_MANUAL);
  reset.mutable_settings()->mutable_reset_coordinate()->set_latitude(63.4);
  reset.mutable_settings()->mutable_reset_coordinate()->set_longitude(10.4);
  deck.tell(reset);
  deck.run(1.0);
  EXPECT_NEAR(deck.latest<bp::AttitudeTel>().attitude().yaw(), 0.0, 1e-3);
  const auto declination = deck.latest<bp::MagneticDeclinationTel>().magnetic_declination();
  EXPECT_NEAR(declination.declination(), 5.0, 1e-6);
  EXPECT_EQ(declination.location_source(), bp::LOCATION_SOURCE_USER);
}

TEST(BlueyeMotion, ResetStartsTheEstimateAnewAndTellsItsPlaceOnTheGlobe) {
  Deck deck;
  deck.connect();
  deck.push(1, 0, 0, 0);
  deck.run(20.0);
  auto estimate = deck.latest<bp::PositionEstimateTel>().position_estimate();
  EXPECT_NEAR(estimate.northing(), deck.state().north_m, 0.2);
  EXPECT_GT(estimate.northing(), 10.0);
  EXPECT_GT(estimate.time_since_reset_sec(), 15);
  bp::ResetPositionCtrl reset;
  reset.mutable_settings()->set_heading_source_during_reset(bp::HEADING_SOURCE_MANUAL_INPUT);
  reset.mutable_settings()->set_manual_heading(90.0F);
  reset.mutable_settings()->set_reset_coordinate_source(bp::RESET_COORDINATE_SOURCE_MANUAL);
  reset.mutable_settings()->mutable_reset_coordinate()->set_latitude(10.0);
  reset.mutable_settings()->mutable_reset_coordinate()->set_longitude(20.0);
  deck.tell(reset);
  deck.run(10.0);
  estimate = deck.latest<bp::PositionEstimateTel>().position_estimate();
  EXPECT_NEAR(estimate.heading(), kPi / 2.0, 1e-3);  // it was told so, whatever the compass says
  EXPECT_GT(estimate.easting(), 5.0);
  EXPECT_NEAR(estimate.northing(), 0.0, 0.1);
  EXPECT_NEAR(estimate.global_position().latitude(), 10.0, 1e-4);
  // A degree of longitude is 109.64 km at 10 degrees of latitude.
  EXPECT_NEAR(estimate.global_position().longitude(), 20.0 + estimate.easting() / 109639.0, 2e-6);
  EXPECT_LE(estimate.time_since_reset_sec(), 10);
}

TEST(BlueyeMotion, ResetTakesThePilotsPlaceOrSaysThatThereIsNone) {
  BlueyeConfig config = quietDrone();
  config.devices = {BlueyeDevice::Dvl};
  Deck deck{config};
  bp::ResetPositionCtrl reset;
  reset.mutable_settings()->set_reset_coordinate_source(bp::RESET_COORDINATE_SOURCE_DEVICE_GPS);
  deck.tell(reset);
  deck.run(1.0);
  EXPECT_THAT(deck.notifications(),
              testing::Contains(bp::NOTIFICATION_TYPE_USER_POSITION_IS_UNKNOWN));
  for (const auto source :
       {bp::RESET_COORDINATE_SOURCE_MANUAL, bp::RESET_COORDINATE_SOURCE_UNSPECIFIED}) {
    reset.mutable_settings()->set_reset_coordinate_source(source);
    deck.tell(reset);
  }
  deck.run(1.0);
  EXPECT_THAT(deck.notifications(),
              testing::Contains(bp::NOTIFICATION_TYPE_DRONE_POSITION_IS_UNKNOWN));
  bp::PilotGPSPositionCtrl pilot;
  pilot.mutable_position()->set_latitude(10.0);
  pilot.mutable_position()->set_longitude(20.0);
  deck.tell(pilot);
  reset.mutable_settings()->set_reset_coordinate_source(bp::RESET_COORDINATE_SOURCE_DEVICE_GPS);
  deck.tell(reset);
  deck.run(1.0);
  const auto estimate = deck.latest<bp::PositionEstimateTel>().position_estimate();
  EXPECT_NEAR(estimate.global_position().latitude(), 10.0, 1e-5);
  EXPECT_NEAR(estimate.global_position().longitude(), 20.0, 1e-5);
}

TEST(BlueyeMotion, WithoutDvlThereIsNeitherEstimateNorAltitude) {
  BlueyeConfig config = quietDrone();
  config.devices = {};
  Deck deck{config};
  deck.run(3.0);
  EXPECT_EQ(deck.count<bp::PositionEstimateTel>(), 0U);
  EXPECT_EQ(deck.count<bp::DvlVelocityTel>(), 0U);
  ASSERT_GT(deck.count<bp::AltitudeTel>(), 0U);
  EXPECT_FALSE(deck.latest<bp::AltitudeTel>().altitude().is_valid());
}

TEST(BlueyeMotion, BottomTooFarDownIsSaidToBeInvalid) {
  BlueyeConfig config = quietDrone();
  config.environment.bottom_depth_m = 100.0;
  Deck deck{config};
  deck.run(2.0);
  EXPECT_FALSE(deck.latest<bp::AltitudeTel>().altitude().is_valid());
  EXPECT_FALSE(deck.latest<bp::PositionEstimateTel>().position_estimate().is_valid());
  const auto dvl = deck.latest<bp::DvlVelocityTel>().dvl_velocity();
  ASSERT_EQ(dvl.transducers_size(), 4);
  for (const auto& transducer : dvl.transducers()) EXPECT_FALSE(transducer.beam_valid());
  EXPECT_FALSE(dvl.has_velocity());
}

TEST(BlueyeMotion, ControlForceIsInNewtons) {
  Deck deck;
  deck.connect();
  deck.push(1, -1, 0, 0.5F);
  deck.run(5.0);
  const auto force = deck.latest<bp::ControlForceTel>().control_force();
  EXPECT_NEAR(force.surge(), 0.7 * 45.0, 0.01);
  EXPECT_NEAR(force.sway(), -0.7 * 30.0, 0.01);
  EXPECT_NEAR(force.yaw(), 0.35 * 8.0, 0.01);
}

}  // namespace
}  // namespace frontseat_driver::sim
