// Frames and units, one axis at a time, with numbers worked out by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "blueye/messages.h"
#include "blueye/senses.h"

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kClose = 1e-6;
constexpr double kHalf = 0.70710678118654752;

class Frames : public testing::Test {
 protected:
  Context context() const { return {ros::Time(100, 0), how_, deviations_}; }
  Conventions how_;
  Deviations deviations_;
};

struct AttitudeRow {
  const char* name;
  float roll_deg, pitch_deg, yaw_deg;
  double x, y, z, w;  ///< of the quaternion in ENU and FLU
};

// q = yaw about up, then pitch about port, then roll about the bow; -q is the same attitude.
const AttitudeRow kAttitudes[] = {{"bow_east", 0, 0, 90, 0, 0, 0, 1},
                                  {"bow_north", 0, 0, 0, 0, 0, kHalf, kHalf},
                                  {"bow_west", 0, 0, -90, 0, 0, 1, 0},
                                  {"bow_south", 0, 0, 180, 0, 0, -kHalf, kHalf},
                                  // To starboard, bow east: a positive turn about the bow.
                                  {"roll_90_bow_east", 90, 0, 90, kHalf, 0, 0, kHalf},
                                  // Nose up is a negative turn about the axis to port.
                                  {"pitch_90_bow_east", 0, 90, 90, 0, -kHalf, 0, kHalf}};

class OneAttitude : public testing::TestWithParam<AttitudeRow> {};

TEST_P(OneAttitude, IsTheBodyInEnu) {
  const AttitudeRow& row = GetParam();
  pb::Attitude attitude;
  attitude.set_roll(row.roll_deg);
  attitude.set_pitch(row.pitch_deg);
  attitude.set_yaw(row.yaw_deg);
  const auto q = orientationOf(attitude, Conventions{});
  const double same = std::copysign(1.0, q.x * row.x + q.y * row.y + q.z * row.z + q.w * row.w);
  EXPECT_NEAR(q.x * same, row.x, kClose);
  EXPECT_NEAR(q.y * same, row.y, kClose);
  EXPECT_NEAR(q.z * same, row.z, kClose);
  EXPECT_NEAR(q.w * same, row.w, kClose);
}

INSTANTIATE_TEST_SUITE_P(Table, OneAttitude, testing::ValuesIn(kAttitudes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Frames, ADeclinationIsAddedOnlyWhenItIsAskedFor) {
  pb::Attitude attitude;
  attitude.set_yaw(80.0F);
  how_.add_declination_rad = 10.0 * M_PI / 180.0;
  EXPECT_NEAR(orientationOf(attitude, how_).z, 0.0, kClose);  // bow east
}

TEST_F(Frames, HeadingsWrapIntoYaws) {
  EXPECT_NEAR(yawOf(0.0), M_PI_2, kClose);
  EXPECT_NEAR(yawOf(M_PI_2), 0.0, kClose);
  EXPECT_NEAR(yawOf(M_PI), -M_PI_2, kClose);
  EXPECT_NEAR(yawOf(-M_PI_2), M_PI, kClose);
  EXPECT_NEAR(yawOf(3.0 * M_PI_2), M_PI, kClose);        // west, too
  EXPECT_NEAR(yawOf(M_PI_2 + 6.0 * M_PI), 0.0, kClose);  // continuous: three turns on
  EXPECT_NEAR(headingOf_deg(0.0), 90.0, kClose);
  EXPECT_NEAR(headingOf_deg(M_PI_2), 0.0, kClose);
  EXPECT_NEAR(headingOf_deg(M_PI), 270.0, kClose);
}

TEST_F(Frames, TheImuTurnsIntoFluSiUnits) {
  pb::Imu imu;
  imu.mutable_gyroscope()->set_x(0.1);
  imu.mutable_gyroscope()->set_y(0.2);
  imu.mutable_gyroscope()->set_z(0.3);
  imu.mutable_accelerometer()->set_x(0.5);
  imu.mutable_accelerometer()->set_y(0.25);
  imu.mutable_accelerometer()->set_z(-1.0);
  imu.mutable_magnetometer()->set_x(20.0);
  imu.mutable_magnetometer()->set_y(-5.0);
  imu.mutable_magnetometer()->set_z(45.0);
  sensor_msgs::Imu out;
  fill(out, imu, 1.0, context());
  EXPECT_NEAR(out.angular_velocity.x, 0.1, kClose);
  EXPECT_NEAR(out.angular_velocity.y, -0.2, kClose);
  EXPECT_NEAR(out.angular_velocity.z, -0.3, kClose);
  EXPECT_NEAR(out.linear_acceleration.x, 4.903325, kClose);
  EXPECT_NEAR(out.linear_acceleration.y, -2.4516625, kClose);
  EXPECT_NEAR(out.linear_acceleration.z, 9.80665, kClose);
  const auto field = toMagneticField(imu, context());
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->magnetic_field.x, 20e-6, 1e-12);
  EXPECT_NEAR(field->magnetic_field.y, 5e-6, 1e-12);
  EXPECT_NEAR(field->magnetic_field.z, -45e-6, 1e-12);
}

TEST_F(Frames, WhatAnImuHasNotIsNotZero) {
  pb::Imu imu;
  imu.mutable_accelerometer()->set_z(1.0);
  sensor_msgs::Imu out;
  fill(out, imu, std::nullopt, context());  // the sign is not known yet
  EXPECT_EQ(out.linear_acceleration_covariance[0], -1.0);
  EXPECT_EQ(out.angular_velocity_covariance[0], -1.0);
  EXPECT_FALSE(toMagneticField(imu, context()));
  imu.mutable_gyroscope()->set_x(NAN);
  fill(out, imu, -1.0, context());
  EXPECT_EQ(out.angular_velocity_covariance[0], -1.0);
  EXPECT_NEAR(out.linear_acceleration.z, 9.80665, kClose);  // gravity convention
}

TEST_F(Frames, TheAccelerometersSignIsToldByADroneThatLiesLevel) {
  for (const double z_g : {-1.0, 1.0}) {
    AccelerometerSense sense(AccelerometerSign::Auto);
    for (int i = 0; i < 100; ++i) sense.take(z_g, 1.0, 1.0);           // on its side
    for (int i = 0; i < 100; ++i) sense.take(z_g, 1.5, 0.0);           // bumping about
    for (int i = 0; i < 100; ++i) sense.take(z_g, 1.0, std::nullopt);  // attitude not known
    EXPECT_FALSE(sense.factor());
    for (int i = 0; i < 20; ++i) sense.take(z_g, 1.0, 0.05);
    ASSERT_TRUE(sense.factor());
    EXPECT_EQ(*sense.factor(), z_g < 0.0 ? 1.0 : -1.0);
  }
  EXPECT_EQ(AccelerometerSense(AccelerometerSign::SpecificForce).factor(), 1.0);
  EXPECT_EQ(AccelerometerSense(AccelerometerSign::Gravity).factor(), -1.0);
}

struct Reading {
  double norm_g, tilt_rad;
  bool counts;
};

TEST_F(Frames, TheAccelerometersSignIsToldByTenReadingsOfAboutOneG) {
  const Reading kReadings[] = {{1.0, 0.34, true},   {1.0, -0.34, true}, {1.0, 0.36, false},
                               {1.0, -0.36, false}, {1.19, 0.0, true},  {1.21, 0.0, false},
                               {0.81, 0.0, true},   {0.79, 0.0, false}};
  for (const Reading& one : kReadings) {
    AccelerometerSense sense(AccelerometerSign::Auto);
    for (int i = 0; i < 9; ++i) sense.take(-1.0, one.norm_g, one.tilt_rad);
    EXPECT_FALSE(sense.factor()) << one.norm_g << " " << one.tilt_rad;
    sense.take(-1.0, one.norm_g, one.tilt_rad);
    EXPECT_EQ(sense.factor().has_value(), one.counts) << one.norm_g << " " << one.tilt_rad;
  }
}

TEST_F(Frames, TheAccelerometersSignIsThatOfTheLastReadings) {
  AccelerometerSense sense(AccelerometerSign::Auto);
  for (int i = 0; i < 1000; ++i) sense.take(-1.0, 1.0, 0.0);
  for (int i = 0; i < 10; ++i) sense.take(1.0, 1.0, 0.0);
  EXPECT_EQ(sense.factor(), 1.0);
  for (int i = 0; i < 40; ++i) sense.take(1.0, 1.0, 0.0);
  EXPECT_EQ(sense.factor(), -1.0);
}

TEST_F(Frames, AReadingThatIsNoNumberDoesNotSpoilTheAccelerometersSign) {
  AccelerometerSense sense(AccelerometerSign::Auto);
  for (int i = 0; i < 5; ++i) sense.take(1.0, 1.0, 0.05);
  sense.take(NAN, NAN, 0.05);
  sense.take(1.0, 1.0, NAN);
  for (int i = 0; i < 5; ++i) sense.take(1.0, 1.0, 0.05);
  EXPECT_EQ(sense.factor(), -1.0);
  AccelerometerSense other(AccelerometerSign::Auto);
  other.take(NAN, NAN, 0.05);
  for (int i = 0; i < 20; ++i) other.take(-1.0, 1.0, 0.05);
  EXPECT_EQ(other.factor(), 1.0);
}

pb::DvlVelocityTel dvl(double x, double y, double z) {
  pb::DvlVelocityTel told;
  auto& in = *told.mutable_dvl_velocity();
  in.mutable_velocity()->set_x(x);
  in.mutable_velocity()->set_y(y);
  in.mutable_velocity()->set_z(z);
  in.set_fom(0.5F);
  in.set_delta_time(250.0F);
  in.add_transducers()->set_beam_valid(true);
  return told;
}

TEST_F(Frames, TheDvlTurnsIntoFluWhereverItsYPoints) {
  auto twist = toDvlTwist(dvl(1.0, 2.0, 3.0), context());
  ASSERT_TRUE(twist);
  EXPECT_EQ(twist->header.frame_id, "dvl_link");
  EXPECT_NEAR(twist->twist.twist.linear.x, 1.0, kClose);
  EXPECT_NEAR(twist->twist.twist.linear.y, -2.0, kClose);
  EXPECT_NEAR(twist->twist.twist.linear.z, -3.0, kClose);
  EXPECT_NEAR(twist->twist.covariance[0], 0.25, kClose);
  how_.dvl_y_right = false;
  twist = toDvlTwist(dvl(1.0, 2.0, 3.0), context());
  EXPECT_NEAR(twist->twist.twist.linear.y, 2.0, kClose);
  EXPECT_NEAR(toDvl(dvl(1.0, 2.0, 3.0), context())->interval.toSec(), 0.25, kClose);
}

TEST_F(Frames, ADvlWithoutAValidBeamHasNoVelocity) {
  auto told = dvl(1.0, 2.0, 3.0);
  told.mutable_dvl_velocity()->mutable_transducers(0)->set_beam_valid(false);
  EXPECT_FALSE(toDvlTwist(told, context()));
  EXPECT_TRUE(std::isnan(toDvl(told, context())->velocity.x));
}

TEST_F(Frames, DurationsThatAreNoneAreZeroAndThrowNothing) {
  for (const double wrong : {static_cast<double>(NAN), HUGE_VAL, -HUGE_VAL}) {
    auto told = dvl(1.0, 2.0, 3.0);
    told.mutable_dvl_velocity()->set_delta_time(static_cast<float>(wrong));
    EXPECT_EQ(toDvl(told, context())->interval, ros::Duration());
    pb::ReferenceAutoPilotTel pilot;
    pilot.mutable_reference_auto_pilot()->set_time_to_complete(static_cast<float>(wrong));
    EXPECT_EQ(toAutoPilot(pilot, context())->remaining, ros::Duration());
  }
  auto far = dvl(1.0, 2.0, 3.0);
  far.mutable_dvl_velocity()->set_delta_time(3e38F);
  EXPECT_NO_THROW(toDvl(far, context()));
}

TEST_F(Frames, TimesThatNoClockTellsAreTheNearestThatThereIs) {
  pb::DroneTimeTel told;
  auto& time = *told.mutable_real_time_clock()->mutable_unix_timestamp();
  time.set_seconds(std::numeric_limits<std::int64_t>::max());
  EXPECT_GT(toTimeReference(told, context())->time_ref.toSec(), 4e9);
  time.set_seconds(std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(toTimeReference(told, context())->time_ref, ros::Time());
  time.set_seconds(1700000000);
  time.set_nanos(500000000);
  EXPECT_EQ(toTimeReference(told, context())->time_ref, ros::Time(1700000000, 500000000));
}

TEST_F(Frames, ADvlThatKeepsDisagreeingIsReportedOnce) {
  DvlSense sense;
  int reports = 0;
  for (int i = 0; i < 300; ++i) reports += sense.disagrees(0.3, -0.3) ? 1 : 0;
  EXPECT_EQ(reports, 1);
  DvlSense other;
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(other.disagrees(0.3, i % 50 == 0 ? 0.3 : -0.3));
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(other.disagrees(-0.3, NAN));
}

TEST_F(Frames, ADvlDisagreesWithTheHundredthReadingOfATenthOfAMeterASecond) {
  DvlSense sense;
  for (int i = 0; i < 99; ++i) EXPECT_FALSE(sense.disagrees(0.105, -0.105));
  EXPECT_TRUE(sense.disagrees(-0.105, 0.105));
  DvlSense slow;
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(slow.disagrees(0.3, -0.095));
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(slow.disagrees(0.095, -0.3));
}

TEST_F(Frames, AnAccuracyThatIsNoNumberIsUnknown) {
  pb::PositionEstimateTel told;
  auto& in = *told.mutable_position_estimate();
  in.set_is_valid(true);
  in.mutable_global_position()->set_latitude(63.4);
  in.mutable_global_position()->set_longitude(10.4);
  auto fast = dvl(1.0, 2.0, 3.0);
  for (const float none : {HUGE_VALF, NAN, -1.0F, 0.0F}) {
    in.set_accuracy(none);
    EXPECT_TRUE(std::isnan(toEstimate(told, context())->accuracy)) << none;
    EXPECT_EQ(toNavFix(told, 1.0, context())->position_covariance[0], 1e6) << none;
    fast.mutable_dvl_velocity()->set_fom(none);
    EXPECT_NEAR(toDvlTwist(fast, context())->twist.covariance[0], 0.01, kClose) << none;
  }
}

TEST_F(Frames, TheEstimateIsInEastAndNorth) {
  pb::PositionEstimateTel told;
  auto& in = *told.mutable_position_estimate();
  in.set_northing(3.0F);
  in.set_easting(4.0F);
  in.set_heading(0.0F);
  in.set_surge_rate(0.5F);
  in.set_sway_rate(0.25F);
  in.set_yaw_rate(0.125F);
  in.set_course_over_ground(90.0F);
  in.set_is_valid(true);
  const auto out = toEstimate(told, context());
  ASSERT_TRUE(out);
  EXPECT_EQ(out->x, 4.0);
  EXPECT_EQ(out->y, 3.0);
  EXPECT_NEAR(out->yaw, M_PI_2, kClose);
  EXPECT_EQ(out->surge_rate, 0.5);
  EXPECT_EQ(out->sway_rate, -0.25);
  EXPECT_EQ(out->yaw_rate, -0.125);
  EXPECT_NEAR(out->course_over_ground, 0.0, kClose);
  EXPECT_TRUE(std::isnan(out->latitude));
  EXPECT_TRUE(std::isnan(out->accuracy));
}

TEST_F(Frames, NavFixNeedsAValidPositionThatIsNotZero) {
  pb::PositionEstimateTel told;
  auto& in = *told.mutable_position_estimate();
  in.set_is_valid(true);
  in.set_accuracy(4.8954F);  // two sigma of each axis, times 2.4477 / 2
  in.mutable_global_position()->set_latitude(63.4);
  in.mutable_global_position()->set_longitude(10.4);
  auto out = toNavFix(told, 12.0, context());
  EXPECT_EQ(out->status.status, 0);
  EXPECT_EQ(out->altitude, -12.0);
  EXPECT_NEAR(out->position_covariance[0], 4.0, 1e-4);
  in.mutable_global_position()->Clear();
  out = toNavFix(told, std::nullopt, context());
  EXPECT_EQ(out->status.status, -1);
  EXPECT_TRUE(std::isnan(out->latitude));
}

TEST_F(Frames, DepthIsDownAndPressureFollowsTheDensity) {
  pb::DepthTel told;
  EXPECT_FALSE(toDepth(told, context()));
  told.mutable_depth()->set_value(10.0F);
  EXPECT_NEAR(toDepth(told, context())->pose.pose.position.z, -10.0, kClose);
  EXPECT_NEAR(toPressure(told, context())->fluid_pressure, 100518.1625, 1e-3);
  told.mutable_depth()->set_value(NAN);
  EXPECT_FALSE(toDepth(told, context()));
}

TEST_F(Frames, RangesThatAreNotValidAreNotPublished) {
  pb::AltitudeTel told;
  told.mutable_altitude()->set_value(2.5F);
  EXPECT_FALSE(toAltitude(told, context()));
  told.mutable_altitude()->set_is_valid(true);
  EXPECT_EQ(toAltitude(told, context())->range, 2.5F);
  EXPECT_EQ(toAltitude(told, context())->header.frame_id, "altimeter_link");
}

TEST_F(Frames, ForcesAndSetPointsTurnIntoFlu) {
  pb::ControlForceTel force;
  force.mutable_control_force()->set_surge(1.0F);
  force.mutable_control_force()->set_sway(2.0F);
  force.mutable_control_force()->set_heave(3.0F);
  force.mutable_control_force()->set_yaw(4.0F);
  const auto wrench = toWrench(force, context());
  EXPECT_EQ(wrench->wrench.force.x, 1.0);
  EXPECT_EQ(wrench->wrench.force.y, -2.0);
  EXPECT_EQ(wrench->wrench.force.z, -3.0);
  EXPECT_EQ(wrench->wrench.torque.z, -4.0);
  pb::ReferenceTel reference;
  reference.mutable_reference()->set_depth(5.0F);
  reference.mutable_reference()->set_heading(90.0F);
  reference.mutable_reference()->set_sway(0.5F);
  const auto out = toReference(reference, context());
  EXPECT_EQ(out->z, -5.0);
  EXPECT_NEAR(out->heading, -M_PI_2, kClose);
  EXPECT_EQ(out->sway, -0.5);
}

// The drone tells the stick as it was sent to it.
TEST_F(Frames, TheSticksYawIsCounterClockwiseWhicheverWayTheDroneTakesIt) {
  pb::ReferenceTel told;
  told.mutable_reference()->set_yaw(0.5F);
  EXPECT_EQ(toReference(told, context())->yaw, -0.5);
  how_.yaw_clockwise = false;
  EXPECT_EQ(toReference(told, context())->yaw, 0.5);
}

TEST_F(Frames, TheCamerasTiltUpIsANegativeTurnAboutPort) {
  pb::TiltAngleTel told;
  told.mutable_angle()->set_value(30.0F);
  const auto out = toCameraTilt(told, context());
  EXPECT_THAT(out->name, ElementsAre("camera_tilt"));
  EXPECT_NEAR(out->position[0], -M_PI / 6.0, kClose);
}

TEST_F(Frames, TheSonarsTiltTakesItsSignFromTheConvention) {
  pb::MultibeamServoTel told;
  told.mutable_servo()->set_angle(30.0F);
  auto out = toMultibeamTilt(told, context());
  EXPECT_THAT(out->name, ElementsAre("multibeam_tilt"));
  EXPECT_NEAR(out->position[0], -M_PI / 6.0, kClose);
  how_.multibeam_tilt_up = false;
  out = toMultibeamTilt(told, context());
  EXPECT_NEAR(out->position[0], M_PI / 6.0, kClose);
}

TEST_F(Frames, AServoStandsBetweenItsEndsWhateverIsTold) {
  how_.servo_min_rad = -0.5;
  how_.servo_max_rad = 1.5;
  pb::GenericServoTel told;
  told.mutable_servo()->set_guest_port_number(pb::GUEST_PORT_NUMBER_PORT_3);
  const std::pair<float, double> rows[] = {
      {0.0F, -0.5}, {0.25F, 0.0}, {1.0F, 1.5}, {-90.0F, -0.5}, {90.0F, 1.5}};
  for (const auto& [value, position] : rows) {
    told.mutable_servo()->set_value(value);
    const auto out = toServo(told, context());
    EXPECT_THAT(out->name, ElementsAre("guest_port_3_servo"));
    EXPECT_NEAR(out->position[0], position, kClose) << value;
  }
  told.mutable_servo()->set_value(NAN);
  EXPECT_FALSE(toServo(told, context()));
}

TEST_F(Frames, BearingsAreToldFromHundredthsByTheirSize) {
  pb::MultibeamPingTel told;
  auto& ping = *told.mutable_ping();
  ping.add_bearings(-6000.0F);
  ping.add_bearings(6000.0F);
  auto out = toPing(told, context());
  EXPECT_NEAR(out->bearings[0], M_PI / 3.0, 1e-6);
  EXPECT_NEAR(out->bearings[1], -M_PI / 3.0, 1e-6);
  ping.clear_bearings();
  ping.add_bearings(60.0F);
  EXPECT_NEAR(toPing(told, context())->bearings[0], -M_PI / 3.0, 1e-6);
}

TEST_F(Frames, ASonarImageIsStampedWithItsArrivalWhateverTheDronesClockShows) {
  pb::MultibeamPingTel told;
  auto out = toPing(told, context());
  EXPECT_FALSE(out);
  told.mutable_ping();
  out = toPing(told, context());
  EXPECT_EQ(out->header.stamp, ros::Time(100, 0));
  EXPECT_EQ(out->frame_time, ros::Time());
  told.mutable_ping()->mutable_frame_generation_timestamp()->set_seconds(1700000000);
  out = toPing(told, context());
  EXPECT_EQ(out->header.stamp, ros::Time(100, 0));
  EXPECT_EQ(out->frame_time, ros::Time(1700000000, 0));
}

// What the wire leaves out is no 0, no closed state and no level.
TEST_F(Frames, AMessageWithoutItsContentGivesNothing) {
  EXPECT_FALSE(toDepth({}, context()));
  EXPECT_FALSE(toPressure({}, context()));
  EXPECT_FALSE(toAltitude({}, context()));
  EXPECT_FALSE(toForwardDistance({}, context()));
  EXPECT_FALSE(toEstimate({}, context()));
  EXPECT_FALSE(toNavFix({}, 1.0, context()));
  EXPECT_FALSE(toDvlTwist({}, context()));
  EXPECT_FALSE(toDvl({}, context()));
  EXPECT_FALSE(toMagneticField({}, context()));
  EXPECT_FALSE(toImuTemperature({}, context()));
  EXPECT_FALSE(toControlMode({}, context()));
  EXPECT_FALSE(toInfo({}, context()));
  EXPECT_FALSE(toTimeReference({}, context()));
  EXPECT_FALSE(toReference({}, context()));
  EXPECT_FALSE(toHealth({}, context()));
  EXPECT_FALSE(toWrench({}, context()));
  EXPECT_FALSE(toDeclination({}, context()));
  EXPECT_FALSE(toMission({}, context()));
  EXPECT_FALSE(toAutoPilot({}, context()));
  EXPECT_FALSE(toWaterTemperature({}, context()));
  EXPECT_FALSE(toCpuTemperature({}, context()));
  EXPECT_FALSE(toCanisterTemperature({}, context()));
  EXPECT_FALSE(toHumidity({}, context()));
  EXPECT_FALSE(toLights({}, context()));
  EXPECT_FALSE(toGuestPortLights({}, context()));
  EXPECT_FALSE(toLaser({}, context()));
  EXPECT_FALSE(toCameraTilt({}, context()));
  EXPECT_FALSE(toServo({}, context()));
  EXPECT_FALSE(toMultibeamTilt({}, context()));
  EXPECT_FALSE(toTiltStabilization({}, context()));
  EXPECT_FALSE(toRecordState({}, context()));
  EXPECT_FALSE(toCalibration({}, context()));
  EXPECT_FALSE(toDiveTime({}, context()));
  EXPECT_FALSE(toSurfaceUnit({}, context()));
  EXPECT_EQ(toPilotFix({}, context())->status.status, sensor_msgs::NavSatStatus::STATUS_NO_FIX);
}

// The wire leaves out a 0 inside the content, which is a value all the same.
TEST_F(Frames, AZeroInsideTheContentIsAValue) {
  pb::LaserTel laser;
  laser.mutable_laser();
  EXPECT_EQ(toLaser(laser, context())->data, 0.0);
  pb::TiltAngleTel tilt;
  tilt.mutable_angle();
  EXPECT_EQ(toCameraTilt(tilt, context())->position[0], 0.0);
  pb::ControlModeTel mode;
  mode.mutable_state();
  EXPECT_FALSE(toControlMode(mode, context())->auto_depth);
}

TEST_F(Frames, ACameraThatIsNotRecordedHasBeenForNoTime) {
  pb::RecordStateTel told;
  told.mutable_record_state()->set_main_is_recording(true);
  told.mutable_record_state()->set_main_seconds(12);
  told.mutable_record_state()->set_guestport_seconds(-1);
  const auto out = toRecordState(told, context());
  EXPECT_TRUE(out->main);
  EXPECT_EQ(out->main_duration.toSec(), 12.0);
  EXPECT_FALSE(out->guestport);
  EXPECT_EQ(out->guestport_duration.toSec(), 0.0);
}

TEST_F(Frames, ABatteryWithoutVoltageIsNoBattery) {
  pb::Battery told;
  EXPECT_FALSE(toBattery(told, 0, context()));
  told.set_voltage(15.5F);
  told.set_level(0.75F);
  const auto out = toBattery(told, 1, context());
  EXPECT_EQ(out->percentage, 0.75F);
  EXPECT_EQ(out->location, "battery_1");
  EXPECT_TRUE(std::isnan(out->current));
}

struct MotionRow {
  const char* name;
  double MotionInput::*ros;
  double vehicle::MotionCommand::*drone;
  double sign;
};

using In = MotionInput;
using Out = vehicle::MotionCommand;
const MotionRow kMotion[] = {
    {"surge", &In::x, &Out::surge, 1.0},      {"sway", &In::y, &Out::sway, -1.0},
    {"heave", &In::z, &Out::heave, -1.0},     {"roll", &In::roll, &Out::roll, 1.0},
    {"pitch", &In::pitch, &Out::pitch, -1.0}, {"yaw", &In::yaw, &Out::yaw, -1.0}};

class OneMotion : public testing::TestWithParam<MotionRow> {};

TEST_P(OneMotion, TurnsItsAxisAndNoOther) {
  MotionInput in;
  in.*GetParam().ros = 0.5;
  const auto converted = toCommand(in);
  const auto& out = std::get<vehicle::MotionCommand>(std::get<vehicle::DroneCommand>(converted));
  for (const MotionRow& row : kMotion) {
    const bool this_one = std::string{row.name} == GetParam().name;
    EXPECT_EQ(out.*row.drone, this_one ? 0.5 * row.sign : 0.0) << row.name;
  }
}

TEST_P(OneMotion, RefusesWhatIsOutOfRange) {
  for (const double wrong : {1.01, -1.01, static_cast<double>(NAN), HUGE_VAL}) {
    MotionInput in;
    in.*GetParam().ros = wrong;
    const auto converted = toCommand(in);
    ASSERT_TRUE(std::holds_alternative<std::string>(converted)) << wrong;
    EXPECT_THAT(std::get<std::string>(converted), HasSubstr("-1..1 is accepted"));
  }
}

INSTANTIATE_TEST_SUITE_P(Table, OneMotion, testing::ValuesIn(kMotion),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Frames, VelocitiesAreSharesOfFullSpeedClamped) {
  geometry_msgs::Twist in;
  in.linear.x = 0.5;
  in.linear.y = 0.25;
  in.linear.z = 9.0;
  in.angular.z = -0.25;
  const FullSpeed full{1.0, 0.5, 0.5, 1.0};
  const auto converted = toCommand(in, full);
  const auto& out = std::get<vehicle::MotionCommand>(std::get<vehicle::DroneCommand>(converted));
  EXPECT_EQ(out.surge, 0.5);
  EXPECT_EQ(out.sway, -0.5);
  EXPECT_EQ(out.heave, -1.0);
  EXPECT_EQ(out.yaw, 0.25);
  in.angular.x = NAN;
  EXPECT_TRUE(std::holds_alternative<std::string>(toCommand(in, full)));
}

TEST_F(Frames, SerialNumbersThatAreNoTextAreHexadecimal) {
  EXPECT_EQ(printable("0123-X3"), "0123-X3");
  EXPECT_EQ(printable(std::string{"\x01\xff", 2}), "01ff");
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
