// Every field of what a drone tells from the field of its own name, with signs, units and limits.

#include "blueye/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kClose = 1e-6;

class Messages : public testing::Test {
 protected:
  Context context() const { return {ros::Time(100, 0), how_, deviations_}; }
  Conventions how_;
  Deviations deviations_;
};

void place(pb::LatLongPosition& out, double latitude, double longitude) {
  out.set_latitude(latitude);
  out.set_longitude(longitude);
}

TEST_F(Messages, AnEstimateKeepsItsPositions) {
  pb::PositionEstimateTel told;
  auto& in = *told.mutable_position_estimate();
  place(*in.mutable_global_position(), 63.5, 10.25);
  in.set_accuracy(2.5F);
  in.set_time_since_reset_sec(7);
  auto& sensor = *in.add_navigation_sensors();
  sensor.set_northing(3.0F);
  sensor.set_easting(4.0F);
  sensor.set_heading(0.0F);
  sensor.set_fom(0.5F);
  sensor.set_std(0.25F);
  place(*sensor.mutable_global_position(), 64.5, 11.25);
  in.add_navigation_sensors();
  const auto out = toEstimate(told, context());
  EXPECT_EQ(out->latitude, 63.5);
  EXPECT_EQ(out->longitude, 10.25);
  EXPECT_EQ(out->accuracy, 2.5);
  EXPECT_EQ(out->since_reset, ros::Duration(7, 0));
  const BlueyeNavigationSensor& one = out->sensors[0];
  EXPECT_EQ(one.x, 4.0);
  EXPECT_EQ(one.y, 3.0);
  EXPECT_NEAR(one.yaw, M_PI_2, kClose);
  EXPECT_EQ(one.figure_of_merit, 0.5);
  EXPECT_EQ(one.standard_deviation, 0.25);
  EXPECT_EQ(one.latitude, 64.5);
  EXPECT_EQ(one.longitude, 11.25);
  EXPECT_TRUE(std::isnan(out->sensors[1].latitude));
  EXPECT_TRUE(std::isnan(out->sensors[1].longitude));
}

TEST_F(Messages, FixesKeepTheirPositions) {
  pb::PilotGPSPositionTel pilot;
  place(*pilot.mutable_position(), 63.5, 10.25);
  const auto fix = toPilotFix(pilot, context());
  EXPECT_EQ(fix->status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
  EXPECT_EQ(fix->latitude, 63.5);
  EXPECT_EQ(fix->longitude, 10.25);
  EXPECT_EQ(fix->header.frame_id, "pilot");
  // A latitude beyond the pole is none, a longitude of as much is one.
  place(*pilot.mutable_position(), 100.0, 0.0);
  EXPECT_EQ(toPilotFix(pilot, context())->status.status, sensor_msgs::NavSatStatus::STATUS_NO_FIX);
  place(*pilot.mutable_position(), 0.0, 100.0);
  EXPECT_EQ(toPilotFix(pilot, context())->status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
  place(*pilot.mutable_position(), 10.0, 0.0);
  EXPECT_EQ(toPilotFix(pilot, context())->status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
}

TEST_F(Messages, ADeclinationKeepsItsPlaceAndSaysWhetherItIsApplied) {
  pb::MagneticDeclinationTel told;
  auto& in = *told.mutable_magnetic_declination();
  in.set_declination(4.5F);
  EXPECT_FALSE(toDeclination(told, context())->applied);
  in.set_location_source(pb::LOCATION_SOURCE_USER);
  place(*in.mutable_location(), 63.5, 10.25);
  const auto out = toDeclination(told, context());
  EXPECT_TRUE(out->applied);
  EXPECT_NEAR(out->declination, 4.5 * M_PI / 180.0, kClose);
  EXPECT_EQ(out->latitude, 63.5);
  EXPECT_EQ(out->longitude, 10.25);
}

TEST_F(Messages, EachAxisOfAVectorHasToBeFinite) {
  for (const int wrong : {0, 1, 2}) {
    pb::Imu imu;
    auto& field = *imu.mutable_magnetometer();
    field.set_x(wrong == 0 ? HUGE_VAL : 1.0);
    field.set_y(wrong == 1 ? HUGE_VAL : 1.0);
    field.set_z(wrong == 2 ? HUGE_VAL : 1.0);
    EXPECT_FALSE(toMagneticField(imu, context())) << wrong;
  }
}

TEST_F(Messages, VelocityOfADvlIsLinearAndUnknownWithoutABeam) {
  pb::DvlVelocityTel told;
  auto& in = *told.mutable_dvl_velocity();
  in.mutable_velocity()->set_x(1.0);
  auto out = toDvl(told, context());
  EXPECT_TRUE(std::isnan(out->velocity.x));
  EXPECT_TRUE(std::isnan(out->velocity.y));
  EXPECT_TRUE(std::isnan(out->velocity.z));
  in.add_transducers()->set_beam_valid(true);
  const auto twist = toDvlTwist(told, context());
  EXPECT_EQ(twist->twist.twist.angular.x, 0.0);
  EXPECT_EQ(twist->twist.twist.linear.x, 1.0);
  EXPECT_NEAR(twist->twist.covariance[0], 0.01, kClose);
}

TEST_F(Messages, DepthAndPressureKeepTheirPlaceAndTheirDoubt) {
  pb::DepthTel told;
  told.mutable_depth()->set_value(10.0F);
  const auto depth = toDepth(told, context());
  EXPECT_EQ(depth->pose.pose.position.x, 0.0);
  EXPECT_EQ(depth->pose.pose.position.y, 0.0);
  EXPECT_NEAR(depth->pose.covariance[14], 0.01, kClose);
  // 0.1 m of water: 0.1 * 1025 * 9.80665 Pa.
  EXPECT_NEAR(toPressure(told, context())->variance, 1005.181625 * 1005.181625, 1e-3);
}

TEST_F(Messages, RangesTellTheirLimits) {
  pb::AltitudeTel below;
  below.mutable_altitude()->set_is_valid(true);
  pb::ForwardDistanceTel ahead;
  ahead.mutable_forward_distance()->set_is_valid(true);
  ahead.mutable_forward_distance()->set_value(3.5F);
  EXPECT_EQ(toAltitude(below, context())->max_range, 100.0F);
  EXPECT_EQ(toAltitude(below, context())->field_of_view, 0.5F);
  EXPECT_EQ(toForwardDistance(ahead, context())->max_range, 100.0F);
  EXPECT_EQ(toForwardDistance(ahead, context())->range, 3.5F);
  EXPECT_EQ(toForwardDistance(ahead, context())->header.frame_id, "pinger_link");
}

TEST_F(Messages, DurationsAreKeptToWhatAClockHolds) {
  pb::DvlVelocityTel told;
  told.mutable_dvl_velocity()->set_delta_time(3e38F);
  EXPECT_EQ(toDvl(told, context())->interval, ros::Duration(2000000000, 0));
  told.mutable_dvl_velocity()->set_delta_time(-3e38F);
  EXPECT_EQ(toDvl(told, context())->interval, ros::Duration(-2000000000, 0));
}

struct CurrentRow {
  float current;
  bool discharge_negative;
  bool full;
  float out;
  std::uint8_t status;
};

TEST_F(Messages, ABatteryIsChargingWhenItsCurrentIsPositive) {
  using State = sensor_msgs::BatteryState;
  for (const CurrentRow& row :
       {CurrentRow{-2.0F, true, false, -2.0F, State::POWER_SUPPLY_STATUS_DISCHARGING},
        CurrentRow{0.5F, true, false, 0.5F, State::POWER_SUPPLY_STATUS_CHARGING},
        CurrentRow{0.0F, true, false, 0.0F, State::POWER_SUPPLY_STATUS_NOT_CHARGING},
        CurrentRow{2.0F, false, false, -2.0F, State::POWER_SUPPLY_STATUS_DISCHARGING},
        CurrentRow{-2.0F, false, false, 2.0F, State::POWER_SUPPLY_STATUS_CHARGING},
        CurrentRow{0.5F, true, true, 0.5F, State::POWER_SUPPLY_STATUS_FULL}}) {
    how_.battery_discharge_negative = row.discharge_negative;
    pb::BatteryBQ40Z50 in;
    EXPECT_FALSE(toBattery(in, 0, context()));
    in.mutable_voltage()->set_total(0.5F);
    in.set_current(row.current);
    in.set_average_current(row.current);
    in.mutable_status()->set_fully_charged(row.full);
    const auto out = toBattery(in, 0, context());
    EXPECT_EQ(out->current, row.out);
    EXPECT_EQ(out->power_supply_status, row.status);
    EXPECT_EQ(toBatteryDetails(in, 0, context()).average_current, row.out);
  }
  pb::Battery simple;
  simple.set_voltage(0.5F);
  EXPECT_TRUE(toBattery(simple, 0, context()));
}

TEST_F(Messages, ABatteryKeepsTheNamesOfItsFields) {
  pb::BatteryBQ40Z50 in;
  auto& volts = *in.mutable_voltage();
  volts.set_total(16.0F);
  volts.set_cell_1(4.1F);
  volts.set_cell_2(4.2F);
  volts.set_cell_3(4.3F);
  volts.set_cell_4(4.4F);
  in.set_remaining_capacity(5.0F);
  in.set_full_charge_capacity(6.0F);
  in.set_design_capacity(7.0F);
  in.set_relative_state_of_charge(0.75F);
  const auto out = toBattery(in, 2, context());
  EXPECT_EQ(out->voltage, 16.0F);
  EXPECT_THAT(out->cell_voltage, ElementsAre(4.1F, 4.2F, 4.3F, 4.4F));
  EXPECT_EQ(out->charge, 5.0F);
  EXPECT_EQ(out->capacity, 6.0F);
  EXPECT_EQ(out->design_capacity, 7.0F);
  EXPECT_EQ(out->percentage, 0.75F);
  EXPECT_EQ(out->location, "battery_2");
}

TEST_F(Messages, ASurfaceUnitTellsWhetherItCharges) {
  using State = sensor_msgs::BatteryState;
  using In = pb::SurfaceUnitBatteryInfo;
  const std::pair<In::ChargeStatus, std::uint8_t> rows[] = {
      {In::CHARGE_STATUS_CHARGE, State::POWER_SUPPLY_STATUS_CHARGING},
      {In::CHARGE_STATUS_DISCHARGE, State::POWER_SUPPLY_STATUS_DISCHARGING},
      {In::CHARGE_STATUS_CHARGE_ERROR, State::POWER_SUPPLY_STATUS_UNKNOWN}};
  for (const auto& [status, expected] : rows) {
    pb::SurfaceUnitTel told;
    told.mutable_battery_info()->set_status(status);
    told.mutable_battery_info()->set_level(0.25F);
    EXPECT_EQ(toSurfaceUnit(told, context())->power_supply_status, expected);
    EXPECT_EQ(toSurfaceUnit(told, context())->percentage, 0.25F);
  }
}

TEST_F(Messages, GuestPortsTellTheirNumberAndWhatIsDetached) {
  pb::DroneInfoTel told;
  auto& ports = *told.mutable_drone_info()->mutable_gp();
  auto& devices = *ports.mutable_gp2()->mutable_device_list();
  devices.add_devices()->set_detach_status(pb::GUEST_PORT_DETACH_STATUS_DETACHED);
  devices.add_devices()->set_depth_rating(300.0F);
  ports.mutable_gp3()->set_error(pb::GUEST_PORT_ERROR_NOT_CONNECTED);
  const auto out = toInfo(told, context());
  ASSERT_EQ(out->guest_ports.size(), 3u);
  EXPECT_EQ(out->guest_ports[0].port, 2);
  EXPECT_TRUE(out->guest_ports[0].detached);
  EXPECT_FALSE(out->guest_ports[1].detached);
  EXPECT_EQ(out->guest_ports[1].depth_rating, 300.0F);
  EXPECT_EQ(out->guest_ports[2].port, 3);
  EXPECT_EQ(out->guest_ports[2].error, "NOT_CONNECTED");
}

TEST_F(Messages, SetPointsErrorsAndForcesKeepTheirAxes) {
  pb::ReferenceTel told;
  auto& in = *told.mutable_reference();
  in.set_surge(0.1F);
  in.set_sway(0.2F);
  in.set_heave(0.3F);
  in.set_yaw(0.4F);
  in.set_altitude(1.5F);
  const auto out = toReference(told, context());
  EXPECT_NEAR(out->surge, 0.1, kClose);
  EXPECT_NEAR(out->sway, -0.2, kClose);
  EXPECT_NEAR(out->heave, -0.3, kClose);
  EXPECT_NEAR(out->yaw, -0.4, kClose);
  EXPECT_EQ(out->altitude, 1.5);
  pb::ControllerHealthTel health;
  health.mutable_controller_health()->set_depth_error(0.5F);
  health.mutable_controller_health()->set_heading_error(90.0F);
  EXPECT_EQ(toHealth(health, context())->z_error, -0.5);
  EXPECT_NEAR(toHealth(health, context())->heading_error, -M_PI_2, kClose);
  pb::ControlForceTel force;
  force.mutable_control_force()->set_yaw(4.0F);
  EXPECT_EQ(toWrench(force, context())->wrench.torque.x, 0.0);
  force.mutable_control_force()->set_heave(NAN);
  EXPECT_FALSE(toWrench(force, context()));
  force.mutable_control_force()->set_heave(1.0F);
  force.mutable_control_force()->set_yaw(INFINITY);
  EXPECT_FALSE(toWrench(force, context()));
}

TEST_F(Messages, AnAutoPilotTellsWhereToAndHowFarAboveOrBelow) {
  pb::ReferenceAutoPilotTel told;
  auto& in = *told.mutable_reference_auto_pilot();
  in.set_active_path_segment_id(3);
  in.set_course_to_target(0.0F);
  in.set_horizontal_distance_to_target(20.0F);
  in.set_vertical_distance_to_target(2.0F);
  in.set_circle_of_acceptance(1.5F);
  in.set_depth_set_point(5.0F);
  in.set_heave_velocity(0.25F);
  in.set_depth_zero_reference(pb::DEPTH_ZERO_REFERENCE_SURFACE);
  auto out = toAutoPilot(told, context());
  EXPECT_EQ(out->path_segment_id, 3);
  EXPECT_NEAR(out->course, M_PI_2, kClose);
  EXPECT_EQ(out->horizontal_distance, 20.0);
  EXPECT_EQ(out->vertical_distance, 2.0);
  EXPECT_EQ(out->acceptance_radius, 1.5);
  EXPECT_FALSE(out->above_bottom);
  EXPECT_EQ(out->z, -5.0);
  EXPECT_EQ(out->heave_velocity, -0.25);
  in.set_depth_zero_reference(pb::DEPTH_ZERO_REFERENCE_SEABED);
  in.set_active_path_segment_id(4294967295U);
  how_.heave_velocity_down = false;
  out = toAutoPilot(told, context());
  EXPECT_EQ(out->path_segment_id, -1);
  EXPECT_TRUE(out->above_bottom);
  EXPECT_EQ(out->z, 5.0);
  EXPECT_EQ(out->heave_velocity, 0.25);
}

TEST_F(Messages, AMissionTellsItsStateInWords) {
  pb::MissionStatusTel told;
  told.mutable_mission_status()->set_state(pb::MISSION_STATE_FAILED_TO_LOAD_MISSION);
  EXPECT_EQ(toMission(told, context())->status, "failed to load mission");
}

TEST_F(Messages, HumidityIsAShareAndCalibrationKeepsItsAxes) {
  pb::CanisterBottomHumidityTel humidity;
  humidity.mutable_humidity()->set_humidity(40.0F);
  EXPECT_NEAR(toHumidity(humidity, context())->relative_humidity, 0.4, kClose);
  pb::CalibrationStateTel told;
  auto& in = *told.mutable_calibration_state();
  in.set_progress_x_positive(0.1F);
  in.set_progress_x_negative(0.2F);
  in.set_progress_y_positive(0.3F);
  in.set_progress_y_negative(0.4F);
  in.set_progress_z_positive(0.5F);
  in.set_progress_z_negative(0.6F);
  in.set_progress_thruster(0.7F);
  const auto out = toCalibration(told, context());
  EXPECT_EQ(out->x_positive, 0.1F);
  EXPECT_EQ(out->x_negative, 0.2F);
  EXPECT_EQ(out->y_positive, 0.3F);
  EXPECT_EQ(out->y_negative, 0.4F);
  EXPECT_EQ(out->z_positive, 0.5F);
  EXPECT_EQ(out->z_negative, 0.6F);
  EXPECT_EQ(out->thruster, 0.7F);
}

TEST_F(Messages, JointsTurnAsTheConventionsSay) {
  pb::GenericServoTel servo;
  servo.mutable_servo()->set_value(0.75F);
  how_.servo_min_rad = -1.0;
  how_.servo_max_rad = 2.0;
  EXPECT_NEAR(toServo(servo, context())->position[0], 1.25, kClose);
  pb::MultibeamServoTel tilt;
  tilt.mutable_servo()->set_angle(30.0F);
  EXPECT_NEAR(toMultibeamTilt(tilt, context())->position[0], -M_PI / 6.0, kClose);
  how_.multibeam_tilt_up = false;
  EXPECT_NEAR(toMultibeamTilt(tilt, context())->position[0], M_PI / 6.0, kClose);
}

TEST_F(Messages, BearingsTurnAsTheConventionsSay) {
  pb::MultibeamPingTel told;
  auto& ping = *told.mutable_ping();
  ping.add_bearings(-60.0F);
  ping.add_bearings(180.0F);
  EXPECT_NEAR(toPing(told, context())->bearings[1], -M_PI, kClose);
  how_.bearings_clockwise = false;
  EXPECT_NEAR(toPing(told, context())->bearings[0], -M_PI / 3.0, kClose);
  ping.set_bearings(1, 190.0F);  // hundredths, then
  EXPECT_NEAR(toPing(told, context())->bearings[1], 1.9 * M_PI / 180.0, kClose);
}

struct LimitRow {
  const char* name;
  double MotionInput::*field;
  double low;
};

TEST_F(Messages, EachPartOfAMotionIsRefusedBeyondItsLimitsByItsName) {
  const LimitRow rows[] = {
      {"x is", &MotionInput::x, -1.0},         {"y is", &MotionInput::y, -1.0},
      {"z is", &MotionInput::z, -1.0},         {"roll is", &MotionInput::roll, -1.0},
      {"pitch is", &MotionInput::pitch, -1.0}, {"yaw is", &MotionInput::yaw, -1.0},
      {"slow is", &MotionInput::slow, 0.0},    {"boost is", &MotionInput::boost, 0.0}};
  for (const LimitRow& row : rows) {
    for (const double good : {row.low, 0.5, 1.0}) {
      MotionInput in;
      in.*row.field = good;
      EXPECT_TRUE(std::holds_alternative<vehicle::DroneCommand>(toCommand(in))) << row.name << good;
    }
    for (const double wrong : {row.low - 0.01, 1.01}) {
      MotionInput in;
      in.*row.field = wrong;
      const auto refused = toCommand(in);
      ASSERT_TRUE(std::holds_alternative<std::string>(refused)) << row.name << wrong;
      EXPECT_EQ(std::get<std::string>(refused).rfind(row.name, 0), 0u);
    }
  }
}

TEST_F(Messages, EachPartOfAVelocityHasToBeFinite) {
  const std::pair<const char*, double geometry_msgs::Vector3::*> axes[] = {
      {"x", &geometry_msgs::Vector3::x},
      {"y", &geometry_msgs::Vector3::y},
      {"z", &geometry_msgs::Vector3::z}};
  for (const auto& [axis, field] : axes) {
    for (const bool turn : {false, true}) {
      geometry_msgs::Twist in;
      geometry_msgs::Vector3& part = turn ? in.angular : in.linear;
      part.*field = HUGE_VAL;
      const auto refused = toCommand(in, FullSpeed{});
      ASSERT_TRUE(std::holds_alternative<std::string>(refused)) << axis << turn;
      EXPECT_THAT(std::get<std::string>(refused),
                  HasSubstr(std::string{turn ? "angular." : "linear."} + axis + " is"));
    }
  }
}

TEST_F(Messages, EachPartOfAVelocityIsAShareOfItsOwnFullSpeed) {
  geometry_msgs::Twist in;
  in.linear.x = -9.0;
  in.linear.y = 0.2;
  in.linear.z = 0.3;
  in.angular.x = 0.05;
  in.angular.y = 0.06;
  in.angular.z = 0.8;
  const auto converted = toCommand(in, FullSpeed{1.0, 0.4, 2.0, 8.0});
  const auto& out = std::get<vehicle::MotionCommand>(std::get<vehicle::DroneCommand>(converted));
  EXPECT_EQ(out.surge, -1.0);
  EXPECT_NEAR(out.sway, -0.5, kClose);
  EXPECT_NEAR(out.heave, -0.15, kClose);
  EXPECT_NEAR(out.yaw, -0.1, kClose);
  EXPECT_EQ(out.roll, 0.0);
  EXPECT_EQ(out.pitch, 0.0);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
