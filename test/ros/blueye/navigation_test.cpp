// What several messages together tell: odometry, resets, freshness.

#include "blueye/navigation.h"

#include <gtest/gtest.h>
#include <tf2/LinearMath/Quaternion.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using namespace std::chrono_literals;

constexpr double kClose = 1e-5;
constexpr double kUnknown = 1e6;

class Together : public testing::Test {
 protected:
  Together() { now_.steady += 1h; }

  void attitude(float roll_deg, float pitch_deg, float yaw_deg) {
    pb::AttitudeTel told;
    told.mutable_attitude()->set_roll(roll_deg);
    told.mutable_attitude()->set_pitch(pitch_deg);
    told.mutable_attitude()->set_yaw(yaw_deg);
    navigation_.take(told, now_);
  }
  void depth(float depth_m) {
    pb::DepthTel told;
    told.mutable_depth()->set_value(depth_m);
    navigation_.take(told, now_);
  }
  pb::PositionEstimate& estimate() { return *estimate_.mutable_position_estimate(); }
  nav_msgs::Odometry odometry() {
    navigation_.take(estimate_, now_);
    return navigation_.odometry(now_, ros::Time(1)).value();
  }
  void at(float easting_m, float northing_m, int since_reset_s) {
    estimate().set_is_valid(true);
    estimate().set_easting(easting_m);
    estimate().set_northing(northing_m);
    estimate().set_time_since_reset_sec(since_reset_s);
  }

  vehicle::Now now_;
  Navigation navigation_{NavigationOptions{}};
  pb::PositionEstimateTel estimate_;
};

TEST_F(Together, NothingComesOfNothing) { EXPECT_FALSE(navigation_.odometry(now_, ros::Time(1))); }

TEST_F(Together, OdometryHasPositionDepthHeadingAndRates) {
  attitude(0.0F, 0.0F, 10.0F);
  depth(7.0F);
  at(4.0F, 3.0F, 1);
  estimate().set_heading(static_cast<float>(M_PI_2));  // east, by the gyro
  estimate().set_surge_rate(0.5F);
  estimate().set_sway_rate(0.25F);
  estimate().set_yaw_rate(0.125F);
  estimate().set_accuracy(2.4477F);
  const auto out = odometry();
  EXPECT_EQ(out.header.frame_id, "odom");
  EXPECT_EQ(out.child_frame_id, "base_link");
  EXPECT_NEAR(out.pose.pose.position.x, 4.0, kClose);
  EXPECT_NEAR(out.pose.pose.position.y, 3.0, kClose);
  EXPECT_NEAR(out.pose.pose.position.z, -7.0, kClose);
  EXPECT_NEAR(out.pose.covariance[0], 1.0, 1e-4);
  // The position was reckoned with the estimate's heading, so it is the one that fits.
  EXPECT_NEAR(out.pose.pose.orientation.w, 1.0, kClose);
  EXPECT_NEAR(out.twist.twist.linear.x, 0.5, kClose);
  EXPECT_NEAR(out.twist.twist.linear.y, -0.25, kClose);
  EXPECT_NEAR(out.twist.twist.angular.z, -0.125, kClose);
  EXPECT_EQ(out.twist.covariance[21], kUnknown);  // no gyro: roll rate not known
  ASSERT_TRUE(navigation_.transform(out));
}

tf2::Vector3 turned(const nav_msgs::Odometry& odometry, const tf2::Vector3& axis) {
  const geometry_msgs::Quaternion& q = odometry.pose.pose.orientation;
  return tf2::quatRotate({q.x, q.y, q.z, q.w}, axis);
}

/// The axes to the bow and to port of a vehicle with roll 10, pitch 20 and this heading, in
/// degrees, east, north and up, by their geometry.
void expectTilted(const nav_msgs::Odometry& odometry, double heading_deg) {
  const double roll = M_PI / 18.0;
  const double pitch = M_PI / 9.0;
  const double heading = heading_deg * M_PI / 180.0;
  const tf2::Vector3 bow = turned(odometry, {1.0, 0.0, 0.0});
  EXPECT_NEAR(bow.x(), std::sin(heading) * std::cos(pitch), kClose);
  EXPECT_NEAR(bow.y(), std::cos(heading) * std::cos(pitch), kClose);
  EXPECT_NEAR(bow.z(), std::sin(pitch), kClose);
  EXPECT_NEAR(turned(odometry, {0.0, 1.0, 0.0}).z(), std::sin(roll) * std::cos(pitch), kClose);
}

TEST_F(Together, OdometryIsTiltedAsTheAttitudeAndHeadsAsTheEstimate) {
  attitude(10.0F, 20.0F, 150.0F);
  at(4.0F, 3.0F, 1);
  estimate().set_heading(static_cast<float>(M_PI / 6.0));
  expectTilted(odometry(), 30.0);
  now_.steady += 3s;  // the attitude is not fresh any more
  const auto out = odometry();
  EXPECT_NEAR(turned(out, {1.0, 0.0, 0.0}).z(), 0.0, kClose);
  EXPECT_NEAR(turned(out, {0.0, 1.0, 0.0}).z(), 0.0, kClose);
  EXPECT_EQ(out.pose.pose.position.z, 0.0);
}

TEST_F(Together, WithoutAValidEstimateOdometryHeadsAsTheAttitudeWithTheDeclination) {
  NavigationOptions options;
  options.conventions.add_declination_rad = M_PI / 36.0;  // 5 degrees to the east
  navigation_ = Navigation{options};
  attitude(10.0F, 20.0F, 150.0F);
  estimate().set_is_valid(false);
  expectTilted(odometry(), 155.0);
}

TEST_F(Together, AnEstimateThatIsNotValidGivesAttitudeAndDepthAlone) {
  attitude(0.0F, 0.0F, 90.0F);
  depth(2.0F);
  estimate().set_easting(50.0F);
  estimate().set_surge_rate(1.0F);
  const auto out = odometry();
  EXPECT_EQ(out.pose.pose.position.x, 0.0);
  EXPECT_EQ(out.pose.covariance[0], kUnknown);
  EXPECT_NEAR(out.pose.pose.position.z, -2.0, kClose);
  EXPECT_NEAR(out.pose.pose.orientation.w, 1.0, kClose);
  EXPECT_EQ(out.twist.twist.linear.x, 0.0);
  EXPECT_EQ(out.twist.covariance[0], kUnknown);
  EXPECT_FALSE(navigation_.transform(out));
}

TEST_F(Together, WhatIsOldIsNotFresh) {
  attitude(5.0F, 5.0F, 5.0F);
  depth(2.0F);
  now_.steady += 3s;
  at(0.0F, 0.0F, 1);
  const auto out = odometry();
  EXPECT_EQ(out.pose.covariance[14], kUnknown);
  EXPECT_EQ(out.pose.covariance[21], kUnknown);
  EXPECT_LT(out.pose.covariance[35], 1.0);  // the estimate's own heading
}

TEST_F(Together, VerticalSpeedComesFromDepthWhereThereIsNoDvl) {
  depth(1.0F);
  now_.steady += 500ms;
  depth(1.25F);
  at(0.0F, 0.0F, 1);
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.5, kClose);
  pb::DvlVelocityTel dvl;
  dvl.mutable_dvl_velocity()->mutable_velocity()->set_z(0.2);
  dvl.mutable_dvl_velocity()->add_transducers()->set_beam_valid(true);
  navigation_.take(dvl, now_);
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.2, kClose);
  dvl.mutable_dvl_velocity()->set_is_water_tracking(true);
  navigation_.take(dvl, now_);
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.5, kClose);
}

TEST_F(Together, VerticalSpeedIsNotMadeOfTheJitterOfArrival) {
  at(0.0F, 0.0F, 1);
  depth(1.0F);
  now_.steady += 30us;
  depth(1.005F);
  EXPECT_EQ(odometry().twist.covariance[14], kUnknown);
  EXPECT_EQ(odometry().twist.twist.linear.z, 0.0);
  now_.steady += 100ms;
  depth(1.055F);  // 0.05 m in 0.1 s
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.5, 1e-3);
  now_.steady += 30us;
  depth(1.06F);
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.5, 1e-3);
  EXPECT_LT(odometry().twist.covariance[14], 1.0);
  // Ten that were held up and come at once: the next counts from the last of them.
  now_.steady += 1s;
  for (int i = 1; i <= 10; ++i) {
    now_.steady += 10us;
    depth(1.06F + 0.05F * static_cast<float>(i));
  }
  now_.steady += 100ms;
  depth(1.61F);
  EXPECT_NEAR(odometry().twist.twist.linear.z, -0.5, 1e-3);
}

TEST_F(Together, WhatComesWithinFiveMillisecondsCameAtOnce) {
  for (const auto apart : {4ms, 6ms}) {
    navigation_.forget();
    at(0.0F, 0.0F, 1);
    depth(1.0F);
    now_.steady += apart;
    depth(1.005F);
    now_.steady += 100ms;
    depth(1.055F);
    const double since_the_second = 0.05 / 0.1;
    const double since_the_first = 0.055 / 0.106;
    EXPECT_NEAR(odometry().twist.twist.linear.z,
                apart == 4ms ? -since_the_second : -since_the_first, 1e-3);
  }
}

TEST_F(Together, VerticalSpeedOfAFastDepthIsCountedOverFiftyMilliseconds) {
  at(0.0F, 0.0F, 1);
  for (int i = 0; i <= 5; ++i) {
    depth(1.0F + 0.01F * static_cast<float>(i));  // 1 m/s at 100 Hz
    const auto out = odometry();
    EXPECT_EQ(out.twist.covariance[14] < 1.0, i == 5) << i;
    EXPECT_NEAR(out.twist.twist.linear.z, i == 5 ? -1.0 : 0.0, 1e-3) << i;
    now_.steady += 10ms;
  }
}

TEST_F(Together, AnEstimateThatSaysNothingGivesNothing) {
  EXPECT_FALSE(navigation_.take(estimate_, now_));  // no sub-message
  at(1.0F, 2.0F, 1);
  EXPECT_TRUE(navigation_.take(estimate_, now_));
  for (const auto set : {&pb::PositionEstimate::set_easting, &pb::PositionEstimate::set_northing,
                         &pb::PositionEstimate::set_heading}) {
    auto wrong = estimate_;
    (wrong.mutable_position_estimate()->*set)(NAN);
    EXPECT_FALSE(navigation_.take(wrong, now_));
    // Without is_valid no number counts: depth and attitude are told as ever.
    wrong.mutable_position_estimate()->set_is_valid(false);
    EXPECT_TRUE(navigation_.take(wrong, now_));
    const auto out = navigation_.odometry(now_, ros::Time(1)).value();
    EXPECT_EQ(out.pose.pose.position.x, 0.0);
    EXPECT_EQ(out.pose.covariance[0], kUnknown);
    EXPECT_EQ(out.pose.pose.orientation.w, 1.0);
    EXPECT_EQ(out.pose.covariance[35], kUnknown);
  }
}

TEST_F(Together, RatesThatAreNoNumbersAreUnknown) {
  at(1.0F, 2.0F, 1);
  estimate().set_surge_rate(NAN);
  estimate().set_sway_rate(0.25F);
  estimate().set_yaw_rate(HUGE_VALF);
  estimate().set_accuracy(HUGE_VALF);
  auto out = odometry();
  EXPECT_EQ(out.twist.twist.linear.x, 0.0);
  EXPECT_EQ(out.twist.covariance[0], kUnknown);
  EXPECT_NEAR(out.twist.twist.linear.y, -0.25, kClose);
  EXPECT_LT(out.twist.covariance[7], 1.0);
  EXPECT_EQ(out.twist.twist.angular.z, 0.0);
  EXPECT_EQ(out.twist.covariance[35], kUnknown);
  EXPECT_EQ(out.pose.covariance[0], kUnknown);
  pb::CalibratedImuTel imu;
  imu.mutable_imu()->mutable_gyroscope()->set_z(0.5);
  navigation_.take(imu, now_);
  estimate().set_surge_rate(0.5F);
  estimate().set_sway_rate(-HUGE_VALF);
  out = odometry();
  EXPECT_NEAR(out.twist.twist.angular.z, -0.5, kClose);  // the gyro's
  EXPECT_LT(out.twist.covariance[35], 1.0);
  EXPECT_NEAR(out.twist.twist.linear.x, 0.5, kClose);
  EXPECT_EQ(out.twist.twist.linear.y, 0.0);
  EXPECT_EQ(out.twist.covariance[7], kUnknown);
}

TEST_F(Together, PressureFollowsADensityThatIsSetLater) {
  pb::DepthTel told;
  told.mutable_depth()->set_value(10.0F);
  navigation_.setWaterDensity(1000.0);
  const auto pressure = toPressure(told, navigation_.context(ros::Time(1)));
  EXPECT_NEAR(pressure->fluid_pressure, 98066.5, 1e-3);
}

TEST_F(Together, OdometryNeverJumpsWhenTheEstimateIsReset) {
  at(10.0F, 20.0F, 100);
  EXPECT_NEAR(odometry().pose.pose.position.x, 10.0, kClose);
  now_.steady += 100ms;
  at(0.0F, 0.0F, 0);
  const auto after = odometry();
  EXPECT_NEAR(after.pose.pose.position.x, 10.0, kClose);
  EXPECT_NEAR(after.pose.pose.position.y, 20.0, kClose);
  now_.steady += 1s;
  at(1.0F, 0.0F, 1);
  EXPECT_NEAR(odometry().pose.pose.position.x, 11.0, kClose);
}

TEST_F(Together, OdometryNeverJumpsHoweverOftenTheEstimateIsReset) {
  at(10.0F, 20.0F, 100);
  odometry();
  for (const float x : {1.0F, 3.0F}) {
    now_.steady += 100ms;
    at(x, 2.0F * x + 1.0F, 0);
    odometry();
    now_.steady += 100ms;
    at(x, 2.0F * x + 1.0F, 50);
    const auto out = odometry();
    EXPECT_NEAR(out.pose.pose.position.x, 10.0, kClose);
    EXPECT_NEAR(out.pose.pose.position.y, 20.0, kClose);
  }
}

TEST_F(Together, StepsTooLargeAddUpInTheMap) {
  at(0.0F, 0.0F, 1);
  estimate().mutable_global_position()->set_latitude(63.0);
  estimate().mutable_global_position()->set_longitude(10.0);
  odometry();
  estimate().clear_global_position();
  for (const auto& [easting_m, northing_m] :
       {std::pair{30.0F, 40.0F}, {80.0F, 40.0F}, {80.0F, 100.0F}}) {
    now_.steady += 100ms;
    at(easting_m, northing_m, 1);
    odometry();
    const auto map = navigation_.mapTransform(ros::Time(1))->transform.translation;
    EXPECT_NEAR(map.x, easting_m, kClose);
    EXPECT_NEAR(map.y, northing_m, kClose);
  }
}

TEST_F(Together, AStepTooLargeGoesIntoTheMap) {
  at(0.0F, 0.0F, 1);
  estimate().mutable_global_position()->set_latitude(63.0);
  estimate().mutable_global_position()->set_longitude(10.0);
  odometry();
  EXPECT_TRUE(navigation_.mapMoved());
  EXPECT_FALSE(navigation_.mapMoved());
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.x, 0.0, kClose);
  now_.steady += 100ms;
  at(30.0F, 0.0F, 1);
  estimate().clear_global_position();
  EXPECT_NEAR(odometry().pose.pose.position.x, 0.0, kClose);
  EXPECT_TRUE(navigation_.mapMoved());
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.x, 30.0, kClose);
}

TEST_F(Together, AStepTooLargeNorthwardGoesIntoTheMapToo) {
  at(0.0F, 0.0F, 1);
  estimate().mutable_global_position()->set_latitude(63.0);
  estimate().mutable_global_position()->set_longitude(10.0);
  odometry();
  now_.steady += 100ms;
  at(0.0F, 30.0F, 1);
  estimate().clear_global_position();
  EXPECT_NEAR(odometry().pose.pose.position.y, 0.0, kClose);
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.x, 0.0, kClose);
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.y, 30.0, kClose);
}

TEST_F(Together, ASmallStepFarFromTheOriginIsNone) {
  at(10.0F, 20.0F, 1);
  odometry();
  now_.steady += 100ms;
  at(10.25F, 19.75F, 1);
  const auto out = odometry();
  EXPECT_NEAR(out.pose.pose.position.x, 10.25, kClose);
  EXPECT_NEAR(out.pose.pose.position.y, 19.75, kClose);
}

// 5 m/s for a second and a metre of rounding are no step.
TEST_F(Together, AStepIsTooLargeWhereNoDroneIsSoFast) {
  at(0.0F, 0.0F, 1);
  odometry();
  now_.steady += 1s;
  at(3.5625F, 4.75F, 2);  // 5.9375 m
  EXPECT_NEAR(odometry().pose.pose.position.x, 3.5625, kClose);
  now_.steady += 1s;
  at(3.5625F, 10.8125F, 3);  // 6.0625 m
  EXPECT_NEAR(odometry().pose.pose.position.y, 4.75, kClose);
}

// At 60 N a degree of latitude is 111412.2 m and one of longitude 55800.0 m (series of WGS-84).
TEST_F(Together, TheMapIsEastAndNorthOfTheDatum) {
  NavigationOptions options;
  options.datum = vehicle::Position{60.0, 10.0};
  navigation_ = Navigation{options};
  at(4.0F, 3.0F, 1);
  estimate().mutable_global_position()->set_latitude(60.001);
  estimate().mutable_global_position()->set_longitude(10.002);
  odometry();
  const auto map = navigation_.mapTransform(ros::Time(1));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->header.frame_id, "map");
  EXPECT_EQ(map->child_frame_id, "odom");
  EXPECT_NEAR(map->transform.translation.x, 111.600 - 4.0, 0.01);
  EXPECT_NEAR(map->transform.translation.y, 111.412 - 3.0, 0.01);
  EXPECT_EQ(map->transform.translation.z, 0.0);
  EXPECT_EQ(map->transform.rotation.w, 1.0);
}

TEST_F(Together, TheMapBeginsAtTheFirstGlobalPositionOfNoDatum) {
  at(4.0F, 3.0F, 1);
  estimate().mutable_global_position()->set_latitude(60.0);
  estimate().mutable_global_position()->set_longitude(10.0);
  odometry();
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.x, -4.0, kClose);
  EXPECT_NEAR(navigation_.mapTransform(ros::Time(1))->transform.translation.y, -3.0, kClose);
  // After a restart of the estimate the map is that of the first position still.
  now_.steady += 1s;
  at(0.0F, 0.0F, 0);
  estimate().mutable_global_position()->set_latitude(60.001);
  estimate().mutable_global_position()->set_longitude(10.002);
  const auto out = odometry();
  const auto map = navigation_.mapTransform(ros::Time(1))->transform.translation;
  EXPECT_NEAR(map.x + out.pose.pose.position.x, 111.600, 0.01);
  EXPECT_NEAR(map.y + out.pose.pose.position.y, 111.412, 0.01);
}

TEST_F(Together, TheTransformIsThePoseOfTheOdometry) {
  attitude(10.0F, 20.0F, 30.0F);
  depth(7.0F);
  at(4.0F, 3.0F, 1);
  const auto out = odometry();
  const auto transform = navigation_.transform(out);
  ASSERT_TRUE(transform);
  EXPECT_EQ(transform->header.frame_id, "odom");
  EXPECT_EQ(transform->child_frame_id, "base_link");
  EXPECT_EQ(transform->transform.translation.x, 4.0);
  EXPECT_EQ(transform->transform.translation.y, 3.0);
  EXPECT_EQ(transform->transform.translation.z, -7.0);
  EXPECT_EQ(transform->transform.rotation.x, out.pose.pose.orientation.x);
  EXPECT_EQ(transform->transform.rotation.w, out.pose.pose.orientation.w);
}

TEST_F(Together, WhatIsNoNumberIsNoEstimateAndNoAttitude) {
  const float nan = std::nanf("");
  at(nan, 3.0F, 1);
  EXPECT_FALSE(navigation_.take(estimate_, now_));
  at(4.0F, nan, 1);
  EXPECT_FALSE(navigation_.take(estimate_, now_));
  at(4.0F, 3.0F, 1);
  estimate().set_heading(nan);
  EXPECT_FALSE(navigation_.take(estimate_, now_));
  estimate().set_heading(0.0F);
  for (const auto& angles :
       {std::array<float, 3>{nan, 0.0F, 0.0F}, {0.0F, nan, 0.0F}, {0.0F, 0.0F, nan}}) {
    attitude(angles[0], angles[1], angles[2]);
    EXPECT_EQ(odometry().pose.covariance[21], kUnknown);
  }
  attitude(0.0F, 0.0F, 0.0F);
  EXPECT_LT(odometry().pose.covariance[21], kUnknown);
}

TEST_F(Together, SwayOfDvlAndEstimateToStarboardAgree) {
  for (const float sway_m_s : {0.5F, -0.5F}) {
    navigation_ = Navigation{NavigationOptions{}};
    at(0.0F, 0.0F, 1);
    estimate().set_sway_rate(sway_m_s);
    odometry();
    pb::DvlVelocityTel dvl;
    dvl.mutable_dvl_velocity()->mutable_velocity()->set_y(0.5);
    dvl.mutable_dvl_velocity()->add_transducers()->set_beam_valid(true);
    for (int i = 0; i < 200; ++i) navigation_.take(dvl, now_);
    EXPECT_EQ(navigation_.dvlDisagrees(), sway_m_s < 0.0F);
  }
}

struct Rest {
  const char* name;
  std::array<double, 3> sensed_g;
  std::array<float, 3> attitude_deg;
  bool counts;
};

const Rest kRests[] = {
    {"level", {0.1, 0.2, -1.0}, {0.0F, 0.0F, 0.0F}, true},
    {"any_heading", {0.1, 0.2, -1.0}, {0.0F, 0.0F, 150.0F}, true},
    {"hardly_rolled", {0.0, 0.0, -1.0}, {15.0F, 0.0F, 0.0F}, true},
    {"hardly_pitched", {0.0, 0.0, -1.0}, {0.0F, 15.0F, 0.0F}, true},
    {"rolled", {0.0, 0.0, -1.0}, {30.0F, 0.0F, 0.0F}, false},
    {"pitched", {0.0, 0.0, -1.0}, {0.0F, 30.0F, 0.0F}, false},
    {"a_g_in_all_ahead", {0.8, 0.0, -0.6}, {0.0F, 0.0F, 0.0F}, true},
    {"a_g_in_all_to_starboard", {0.0, 0.8, -0.6}, {0.0F, 0.0F, 0.0F}, true},
    {"pushed_ahead", {1.5, 0.0, -1.0}, {0.0F, 0.0F, 0.0F}, false},
    {"pushed_to_starboard", {0.0, 1.5, -1.0}, {0.0F, 0.0F, 0.0F}, false},
    {"pushed_up", {0.0, 0.0, -1.5}, {0.0F, 0.0F, 0.0F}, false},
};

class AccelerometerAtRest : public Together, public testing::WithParamInterface<Rest> {};

TEST_P(AccelerometerAtRest, TellsTheSignOfItsAxes) {
  const Rest& rest = GetParam();
  attitude(rest.attitude_deg[0], rest.attitude_deg[1], rest.attitude_deg[2]);
  pb::CalibratedImuTel told;
  told.mutable_imu()->mutable_accelerometer()->set_x(rest.sensed_g[0]);
  told.mutable_imu()->mutable_accelerometer()->set_y(rest.sensed_g[1]);
  told.mutable_imu()->mutable_accelerometer()->set_z(rest.sensed_g[2]);
  for (int i = 0; i < 20; ++i) navigation_.take(told, now_);
  const auto out = navigation_.imu(now_, ros::Time(1));
  EXPECT_EQ(out.linear_acceleration_covariance[0] != -1.0, rest.counts);
  if (!rest.counts) return;
  EXPECT_NEAR(out.linear_acceleration.x, rest.sensed_g[0] * 9.80665, 1e-4);
  EXPECT_NEAR(out.linear_acceleration.y, -rest.sensed_g[1] * 9.80665, 1e-4);
  EXPECT_NEAR(out.linear_acceleration.z, -rest.sensed_g[2] * 9.80665, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Table, AccelerometerAtRest, testing::ValuesIn(kRests),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Together, AnAccelerationBeyondNumbersIsNoneAtAll) {
  pb::CalibratedImuTel told;
  told.mutable_imu()->mutable_accelerometer()->set_z(-1.7e308);
  sensor_msgs::Imu out;
  const Conventions conventions;
  const Deviations deviations;
  fill(out, told.imu(), 1.0, Context{ros::Time(1), conventions, deviations});
  EXPECT_EQ(out.linear_acceleration.z, 0.0);
  EXPECT_EQ(out.linear_acceleration_covariance[0], -1.0);
}

TEST_F(Together, ImuHasTheFreshAttitudeOrNone) {
  pb::CalibratedImuTel told;
  told.mutable_imu()->mutable_gyroscope()->set_z(0.5);
  navigation_.take(told, now_);
  EXPECT_EQ(navigation_.imu(now_, ros::Time(1)).orientation_covariance[0], -1.0);
  attitude(0.0F, 0.0F, 90.0F);
  const auto out = navigation_.imu(now_, ros::Time(1));
  EXPECT_NEAR(out.orientation.w, 1.0, kClose);
  EXPECT_GT(out.orientation_covariance[0], 0.0);
  EXPECT_NEAR(out.angular_velocity.z, -0.5, kClose);
  EXPECT_EQ(out.linear_acceleration_covariance[0], -1.0);
  EXPECT_TRUE(navigation_.hasImu(now_));
  navigation_.forget();
  EXPECT_FALSE(navigation_.hasImu(now_));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
