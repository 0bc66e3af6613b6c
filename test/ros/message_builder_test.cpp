#include "message_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "convert.h"
#include "frontseat_driver/nmea/field_reader.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using sensor_msgs::NavSatStatus;
using vehicle::Now;
using vehicle::Position;

constexpr double kUnknown = 1e6;

// Not the defaults, so that every variance in a message tells where it came from.
constexpr double kGpsVariance = 4.0;             // 2 m
constexpr double kDeadReckoningVariance = 81.0;  // 9 m
constexpr double kDepthVariance = 0.25;          // 0.5 m
constexpr double kOrientationVariance = 0.0625;  // 0.25 rad
constexpr double kVelocityVariance = 0.015625;   // 0.125 m/s
constexpr double kRateVariance = 0.5625;         // 0.75 rad/s
constexpr double kAccelerationVariance = 2.25;   // 1.5 m/s^2

Parameters parametersFor(std::optional<Dialect> dialect) {
  Parameters out;
  out.session.dialect = dialect;
  out.stamp = StampMode::Receive;
  out.position_stddev_gps_m = 2.0;
  out.position_stddev_dead_reckoning_m = 9.0;
  out.depth_stddev_m = 0.5;
  out.orientation_stddev_rad = 0.25;
  out.velocity_stddev_m_s = 0.125;
  out.angular_rate_stddev_rad_s = 0.75;
  out.acceleration_stddev_m_s2 = 1.5;
  return out;
}

// 2014-12-31 12:00 UTC, `date -u -d '2014-12-31 12:00' +%s`; ROS time runs 500 s ahead of it.
constexpr std::chrono::seconds kNoon{1420027200};
constexpr std::chrono::seconds kRosAhead{500};

Now at(std::chrono::nanoseconds since_noon) {
  Now now;
  now.steady += std::chrono::duration_cast<vehicle::SteadyTime::duration>(since_noon);
  now.utc = kNoon + since_noon;
  now.stamp = now.utc + kRosAhead;
  return now;
}

ros::Time stampAt(std::chrono::nanoseconds since_noon) {
  return toRosTime(kNoon + kRosAhead + since_noon);
}

constexpr Position kHarbor{42.36, -71.11};

vehicle::Navigation navigationAt(const Position& position) {
  vehicle::Navigation out;
  out.position = position;
  out.from_gps = true;
  out.altitude_m = 7.5;
  out.depth_m = 3.0;
  out.heading_deg = 90.0;
  out.roll_deg = 0.0;
  out.pitch_deg = 0.0;
  return out;
}

vehicle::Velocity someVelocity() {
  vehicle::Velocity out;
  out.east_m_s = 1.0;
  out.north_m_s = 2.0;
  out.down_m_s = 0.5;
  out.roll_rate_deg_s = 1.0;
  out.pitch_rate_deg_s = 2.0;
  out.yaw_rate_deg_s = 3.0;
  return out;
}

constexpr double kOneDegree = 0.0174532925199433;  // rad

vehicle::RawImu someRawImu() {
  vehicle::RawImu out;
  out.rate_x_deg_s = 1.0;
  out.rate_y_deg_s = 2.0;
  out.rate_z_deg_s = 3.0;
  out.acceleration_x = 0.5;
  out.acceleration_y = 0.25;
  out.acceleration_z = -9.75;
  return out;
}

template <class Matrix>
void expectDiagonal(const Matrix& covariance, std::initializer_list<double> diagonal) {
  const std::size_t size = diagonal.size();
  ASSERT_EQ(covariance.size(), size * size);
  std::size_t row = 0;
  for (const double value : diagonal) {
    for (std::size_t column = 0; column < size; ++column) {
      EXPECT_EQ(covariance[row * size + column], row == column ? value : 0.0) << row << column;
    }
    ++row;
  }
}

template <class Matrix>
void expectNotMeasured(const Matrix& covariance) {
  EXPECT_EQ(covariance[0], -1.0);
}

void expectNear(const geometry_msgs::Vector3& actual, double x, double y, double z) {
  EXPECT_NEAR(actual.x, x, 1e-14);
  EXPECT_NEAR(actual.y, y, 1e-14);
  EXPECT_NEAR(actual.z, z, 1e-14);
}

void expectIdentity(const geometry_msgs::Quaternion& actual) {
  EXPECT_EQ(actual, identityOrientation());
  EXPECT_EQ(actual.w, 1.0);
}

/// Yaw of a level vehicle.
double yaw_deg(const geometry_msgs::Quaternion& q) {
  return 2.0 * std::atan2(q.z, q.w) * 180.0 / M_PI;
}

class Builder : public testing::Test {
 protected:
  nav_msgs::Odometry odometryOf(MessageBuilder& builder, const vehicle::Navigation& navigation,
                                const Now& now) {
    builder.take(navigation, now);
    const auto out = builder.odometry();
    EXPECT_TRUE(out);
    return out.value_or(nav_msgs::Odometry{});
  }

  MessageBuilder shark_{parametersFor(Dialect::Sandshark)};
  MessageBuilder boat_{parametersFor(Dialect::Kingfisher)};
};

TEST_F(Builder, HasNothingToSayAtFirst) {
  EXPECT_FALSE(boat_.odometry());
  EXPECT_FALSE(boat_.navFix());
  EXPECT_FALSE(boat_.depth());
  EXPECT_FALSE(boat_.altitude());
  EXPECT_FALSE(boat_.imu());
  EXPECT_FALSE(boat_.navVelocity());
  EXPECT_FALSE(boat_.rawImu());
  EXPECT_FALSE(boat_.datum());
}

TEST_F(Builder, KeepsItsDatumOnlyWhileItsDriverIsTheSame) {
  boat_.take(navigationAt(kHarbor), at(0s));
  ASSERT_TRUE(boat_.datum());
  boat_.reset();
  EXPECT_TRUE(boat_.datum());
  boat_.startAfresh();
  EXPECT_FALSE(boat_.datum());

  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.datum = kHarbor;
  MessageBuilder given{parameters};
  given.setDatum({1.0, 2.0});
  given.startAfresh();
  ASSERT_TRUE(given.datum());
  EXPECT_EQ(given.datum()->latitude_deg, kHarbor.latitude_deg);
}

// Odometry

TEST_F(Builder, OdometryIsWholeWithFreshVelocity) {
  boat_.take(someVelocity(), at(0s));
  const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(1s));
  EXPECT_EQ(odom.header.frame_id, "odom");
  EXPECT_EQ(odom.child_frame_id, "base_link");
  EXPECT_EQ(odom.header.stamp, stampAt(1s));
  EXPECT_EQ(odom.pose.pose.position.x, 0.0);
  EXPECT_EQ(odom.pose.pose.position.y, 0.0);
  EXPECT_EQ(odom.pose.pose.position.z, -3.0);
  expectIdentity(odom.pose.pose.orientation);  // heading 90 is east
  expectNear(odom.twist.twist.linear, 1.0, 2.0, -0.5);
  expectNear(odom.twist.twist.angular, kOneDegree, -2.0 * kOneDegree, -3.0 * kOneDegree);
  expectDiagonal(odom.pose.covariance,
                 {kGpsVariance, kGpsVariance, kDepthVariance, kOrientationVariance,
                  kOrientationVariance, kOrientationVariance});
  expectDiagonal(odom.twist.covariance, {kVelocityVariance, kVelocityVariance, kVelocityVariance,
                                         kRateVariance, kRateVariance, kRateVariance});
}

TEST_F(Builder, OdometryUsesTheFramesOfTheParameters) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.odom_frame = "boat/odom";
  parameters.base_frame = "boat/base";
  MessageBuilder builder(parameters);
  const auto odom = odometryOf(builder, navigationAt(kHarbor), at(0s));
  EXPECT_EQ(odom.header.frame_id, "boat/odom");
  EXPECT_EQ(odom.child_frame_id, "boat/base");
}

TEST_F(Builder, OdometryByDeadReckoningIsLessSure) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.from_gps = false;
  const auto odom = odometryOf(boat_, navigation, at(0s));
  EXPECT_EQ(odom.pose.covariance[0], kDeadReckoningVariance);
  EXPECT_EQ(odom.pose.covariance[7], kDeadReckoningVariance);
}

// Its positions come through 32-bit floats, in steps of up to 0.85 m (field notes, NVG).
TEST_F(Builder, ASandsharksPositionIsNoSurerThanItsSteps) {
  struct Row {
    std::optional<Dialect> dialect;
    double gps_m, dead_reckoning_m;
    double gps_m2, dead_reckoning_m2;
  };
  const Row rows[] = {{Dialect::Sandshark, 0.125, 0.25, 0.25, 0.25},
                      {Dialect::Sandshark, 0.5, 0.75, 0.25, 0.5625},
                      {Dialect::Kingfisher, 0.125, 0.25, 0.015625, 0.0625}};
  for (const Row& row : rows) {
    Parameters parameters = parametersFor(row.dialect);
    parameters.position_stddev_gps_m = row.gps_m;
    parameters.position_stddev_dead_reckoning_m = row.dead_reckoning_m;
    MessageBuilder builder{parameters};
    vehicle::Navigation navigation = navigationAt(kHarbor);
    EXPECT_EQ(odometryOf(builder, navigation, at(0s)).pose.covariance[0], row.gps_m2);
    EXPECT_EQ(builder.navFix()->position_covariance[4], row.gps_m2);
    navigation.from_gps = false;
    EXPECT_EQ(odometryOf(builder, navigation, at(1s)).pose.covariance[7], row.dead_reckoning_m2);
  }
}

TEST_F(Builder, TwistIsUnknownWithoutVelocity) {
  const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(0s));
  expectNear(odom.twist.twist.linear, 0.0, 0.0, 0.0);
  expectNear(odom.twist.twist.angular, 0.0, 0.0, 0.0);
  expectDiagonal(odom.twist.covariance,
                 {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown});
  EXPECT_EQ(odom.pose.covariance[21], kOrientationVariance);
}

TEST_F(Builder, VelocityIsFreshUpToItsGreatestAge) {
  boat_.take(someVelocity(), at(0s));
  EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), at(2s)).twist.covariance[0],
            kVelocityVariance);
  EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), at(2001ms)).twist.covariance[0], kUnknown);
}

// A replay has nothing else, and must come to the same messages.
TEST_F(Builder, FreshnessIsOfTheStamps) {
  boat_.take(someVelocity(), at(0s));
  Now later = at(3s);
  later.steady = at(0s).steady;
  EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), later).twist.covariance[0], kUnknown);
}

TEST_F(Builder, FreshnessIsOfTheSteadyClockWhileStampsStandStill) {
  for (const std::chrono::seconds stamp :
       {0s, -18000s}) {  // as without /clock, and after a step back
    boat_ = MessageBuilder{parametersFor(Dialect::Kingfisher)};
    boat_.take(someVelocity(), at(0s));
    Now now = at(1s);
    now.stamp = at(0s).stamp + stamp;
    EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), now).twist.covariance[0], kVelocityVariance);
    now.steady += 1500ms;
    EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), now).twist.covariance[0], kUnknown);
  }
}

TEST_F(Builder, BlankHeadingMakesOrientationAndTwistUnknown) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.heading_deg.reset();
  navigation.roll_deg = 10.0;
  boat_.take(someVelocity(), at(0s));
  const auto odom = odometryOf(boat_, navigation, at(0s));
  expectIdentity(odom.pose.pose.orientation);
  expectNear(odom.twist.twist.linear, 0.0, 0.0, 0.0);
  expectNear(odom.twist.twist.angular, 0.0, 0.0, 0.0);
  expectDiagonal(odom.pose.covariance,
                 {kGpsVariance, kGpsVariance, kDepthVariance, kUnknown, kUnknown, kUnknown});
  expectDiagonal(odom.twist.covariance,
                 {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown});
}

TEST_F(Builder, BlankRollOrPitchIsZeroAndUnknownAboutItsAxis) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.roll_deg.reset();
  auto odom = odometryOf(boat_, navigation, at(0s));
  expectIdentity(odom.pose.pose.orientation);
  EXPECT_EQ(odom.pose.covariance[21], kUnknown);
  EXPECT_EQ(odom.pose.covariance[28], kOrientationVariance);
  EXPECT_EQ(odom.pose.covariance[35], kOrientationVariance);
  navigation.roll_deg = 0.0;
  navigation.pitch_deg.reset();
  odom = odometryOf(boat_, navigation, at(0s));
  EXPECT_EQ(odom.pose.covariance[21], kOrientationVariance);
  EXPECT_EQ(odom.pose.covariance[28], kUnknown);
  EXPECT_EQ(odom.pose.covariance[35], kOrientationVariance);
}

TEST_F(Builder, BlankDepthIsZeroAndUnknownExceptOnWhatFloats) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.depth_m.reset();
  const auto of_shark = odometryOf(shark_, navigation, at(0s));
  EXPECT_EQ(of_shark.pose.pose.position.z, 0.0);
  EXPECT_EQ(of_shark.pose.covariance[14], kUnknown);
  const auto of_boat = odometryOf(boat_, navigation, at(0s));
  EXPECT_EQ(of_boat.pose.pose.position.z, 0.0);
  EXPECT_EQ(of_boat.pose.covariance[14], kDepthVariance);
}

TEST_F(Builder, DepthZeroIsNotNegative) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.depth_m = 0.0;
  EXPECT_FALSE(std::signbit(odometryOf(boat_, navigation, at(0s)).pose.pose.position.z));
  EXPECT_FALSE(std::signbit(boat_.depth()->pose.pose.position.z));
}

TEST_F(Builder, BlankEastOrNorthMakesLinearVelocityUnknown) {
  for (auto blank : {&vehicle::Velocity::east_m_s, &vehicle::Velocity::north_m_s}) {
    vehicle::Velocity velocity = someVelocity();
    (velocity.*blank).reset();
    boat_.take(velocity, at(0s));
    const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(0s));
    expectNear(odom.twist.twist.linear, 0.0, 0.0, 0.0);
    expectDiagonal(odom.twist.covariance,
                   {kUnknown, kUnknown, kUnknown, kRateVariance, kRateVariance, kRateVariance});
  }
}

TEST_F(Builder, BlankDownIsZeroAndUnknown) {
  vehicle::Velocity velocity = someVelocity();
  velocity.down_m_s.reset();
  boat_.take(velocity, at(0s));
  const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(0s));
  expectNear(odom.twist.twist.linear, 1.0, 2.0, 0.0);
  EXPECT_EQ(odom.twist.covariance[0], kVelocityVariance);
  EXPECT_EQ(odom.twist.covariance[7], kVelocityVariance);
  EXPECT_EQ(odom.twist.covariance[14], kUnknown);
}

TEST_F(Builder, ABlankRateIsZeroAndUnknown) {
  struct Row {
    std::optional<double> vehicle::Velocity::*blank;
    double x, y, z;
    std::size_t unknown;  ///< in the covariance
  };
  const Row kRows[] = {
      {&vehicle::Velocity::roll_rate_deg_s, 0.0, -2.0 * kOneDegree, -3.0 * kOneDegree, 21},
      {&vehicle::Velocity::pitch_rate_deg_s, kOneDegree, 0.0, -3.0 * kOneDegree, 28},
      {&vehicle::Velocity::yaw_rate_deg_s, kOneDegree, -2.0 * kOneDegree, 0.0, 35}};
  for (const Row& row : kRows) {
    vehicle::Velocity velocity = someVelocity();
    (velocity.*row.blank).reset();
    boat_.take(velocity, at(0s));
    const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(0s));
    expectNear(odom.twist.twist.angular, row.x, row.y, row.z);
    for (const std::size_t i : {21U, 28U, 35U}) {
      EXPECT_EQ(odom.twist.covariance[i], i == row.unknown ? kUnknown : kRateVariance) << i;
    }
  }
}

TEST_F(Builder, TellsHowFarStampsAreHeldBack) {
  boat_.take(navigationAt(kHarbor), at(100s));
  EXPECT_TRUE(boat_.depth());
  EXPECT_EQ(boat_.takeHeldBack(), 0s);
  boat_.take(navigationAt(kHarbor), at(93s));
  ASSERT_TRUE(boat_.depth());
  EXPECT_EQ(boat_.depth()->header.stamp, stampAt(100s));
  EXPECT_EQ(boat_.takeHeldBack(), 7s);
  EXPECT_EQ(boat_.takeHeldBack(), 0s);
}

TEST_F(Builder, NoPositionMeansNoOdometryAndNoFix) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  for (const std::optional<Position>& position :
       {std::optional<Position>{}, std::optional<Position>{{0.0, 0.0}}}) {
    navigation.position = position;
    boat_.take(navigation, at(0s));
    EXPECT_FALSE(boat_.odometry());
    EXPECT_FALSE(boat_.navFix());
    EXPECT_TRUE(boat_.depth());
    EXPECT_TRUE(boat_.altitude());
    EXPECT_FALSE(boat_.datum());
  }
}

TEST_F(Builder, AJumpIsLeftOutAndCounted) {
  boat_.take(navigationAt(kHarbor), at(0s));
  for (int i = 1; i <= 4; ++i) {
    boat_.take(navigationAt({42.37, -71.11}), at(i * 200ms));
    EXPECT_FALSE(boat_.odometry());
    EXPECT_FALSE(boat_.navFix());
    EXPECT_TRUE(boat_.depth());
    EXPECT_TRUE(boat_.altitude());
  }
  EXPECT_EQ(boat_.jumps(), 4U);
  EXPECT_NEAR(boat_.latestJump_m(), 1110.8, 0.5);  // 0.01 degrees of latitude
  boat_.take(navigationAt({42.37, -71.11}), at(1s));
  EXPECT_TRUE(boat_.odometry());
  EXPECT_TRUE(boat_.navFix());
}

TEST_F(Builder, OrientationGoesOnDuringAJump) {
  boat_.take(navigationAt(kHarbor), at(0s));
  vehicle::Navigation jump = navigationAt({42.37, -71.11});
  jump.heading_deg = 0.0;
  boat_.take(jump, at(200ms));
  boat_.take(someVelocity(), at(200ms));
  EXPECT_NEAR(yaw_deg(boat_.imu()->orientation), 90.0, 1e-12);
}

// The tangent plane, worked out anew: WGS84 to Earth-centred coordinates and their difference along
// east and north at the datum.
struct Plane {
  const char* name;
  Position datum, position;
  double x_m, y_m;  ///< to the millimeter, to see sign and size
};

const Plane kPlanes[] = {
    {"boston", {42.36, -71.11}, {42.37, -71.10}, 823.691, 1110.852},
    {"sydney", {-33.86, 151.21}, {-33.87, 151.20}, -925.253, -1109.244},
    {"over_the_date_line", {-17.0, 179.999}, {-17.0, -179.999}, 212.972, -0.001},
};

struct Earth {
  double x, y, z;
};

Earth earthCentred(const Position& position) {
  const double a = 6378137.0;
  const double f = 1.0 / 298.257223563;
  const double e2 = f * (2.0 - f);
  const double lat = position.latitude_deg * M_PI / 180.0;
  const double lon = position.longitude_deg * M_PI / 180.0;
  const double n = a / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
  return {n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon),
          n * (1.0 - e2) * std::sin(lat)};
}

class PlaneTest : public testing::TestWithParam<Plane> {};

TEST_P(PlaneTest, IsTangentAtTheDatum) {
  const Plane& row = GetParam();
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.datum = row.datum;
  MessageBuilder builder(parameters);
  builder.take(navigationAt(row.position), at(0s));
  const auto odom = builder.odometry();
  ASSERT_TRUE(odom);

  const Earth from = earthCentred(row.datum);
  const Earth to = earthCentred(row.position);
  const Earth d{to.x - from.x, to.y - from.y, to.z - from.z};
  const double lat = row.datum.latitude_deg * M_PI / 180.0;
  const double lon = row.datum.longitude_deg * M_PI / 180.0;
  const double east = -std::sin(lon) * d.x + std::cos(lon) * d.y;
  const double north =
      std::cos(lat) * d.z - std::sin(lat) * (std::cos(lon) * d.x + std::sin(lon) * d.y);
  EXPECT_NEAR(odom->pose.pose.position.x, east, 1e-6);
  EXPECT_NEAR(odom->pose.pose.position.y, north, 1e-6);
  EXPECT_NEAR(odom->pose.pose.position.x, row.x_m, 5e-4);
  EXPECT_NEAR(odom->pose.pose.position.y, row.y_m, 5e-4);
  EXPECT_EQ(odom->pose.pose.position.z, -3.0);  // depth alone, not the curve of the Earth
}

INSTANTIATE_TEST_SUITE_P(Table, PlaneTest, testing::ValuesIn(kPlanes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Builder, DatumIsTheFirstValidPosition) {
  boat_.take(navigationAt({0.0, 0.0}), at(0s));
  boat_.take(navigationAt(kHarbor), at(1s));
  boat_.take(navigationAt({42.3601, -71.11}), at(2s));
  ASSERT_TRUE(boat_.datum());
  EXPECT_EQ(boat_.datum()->latitude_deg, 42.36);
  EXPECT_NEAR(boat_.odometry()->pose.pose.position.y, 11.108, 1e-3);
}

TEST_F(Builder, DatumCanBeMoved) {
  boat_.take(navigationAt({42.37, -71.10}), at(0s));
  boat_.setDatum(kHarbor);
  boat_.take(navigationAt({42.37, -71.10}), at(1s));
  EXPECT_NEAR(boat_.odometry()->pose.pose.position.x, 823.691, 1e-3);
}

TEST_F(Builder, TransformIsThePoseOfTheOdometry) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.heading_deg = 0.0;
  boat_.take(navigationAt(kHarbor), at(0s));
  navigation.position = Position{42.3601, -71.11};
  const auto odom = odometryOf(boat_, navigation, at(1s));
  const auto transform = boat_.transform(odom);
  ASSERT_TRUE(transform);
  EXPECT_EQ(transform->header, odom.header);
  EXPECT_EQ(transform->child_frame_id, "base_link");
  EXPECT_EQ(transform->transform.translation.x, odom.pose.pose.position.x);
  EXPECT_EQ(transform->transform.translation.y, odom.pose.pose.position.y);
  EXPECT_EQ(transform->transform.translation.z, -3.0);
  EXPECT_EQ(transform->transform.rotation, odom.pose.pose.orientation);
}

TEST_F(Builder, TransformNeverRepeatsAStamp) {
  EXPECT_TRUE(boat_.transform(odometryOf(boat_, navigationAt(kHarbor), at(0s))));
  EXPECT_FALSE(boat_.transform(odometryOf(boat_, navigationAt(kHarbor), at(0s))));
  EXPECT_TRUE(boat_.transform(odometryOf(boat_, navigationAt(kHarbor), at(1ns))));
}

// A point 1 m ahead, 2 m to starboard and 3 m down, and one 1 m north, 2 m east and 3 m down.
TEST_F(Builder, HelperFramesAreNautical) {
  const auto frames = boat_.helperFrames(at(0s));
  EXPECT_EQ(frames[0].header.frame_id, "base_link");
  EXPECT_EQ(frames[0].child_frame_id, "base_link_frd");
  EXPECT_EQ(frames[1].header.frame_id, "odom");
  EXPECT_EQ(frames[1].child_frame_id, "odom_ned");
  geometry_msgs::Vector3 point;
  point.x = 1.0;
  point.y = 2.0;
  point.z = 3.0;
  // bodyFromEnu() turns from parent to child; half a turn is its own way back.
  expectNear(bodyFromEnu(point, frames[0].transform.rotation), 1.0, -2.0, -3.0);
  expectNear(bodyFromEnu(point, frames[1].transform.rotation), 2.0, 1.0, -3.0);
  for (const auto& frame : frames) {
    EXPECT_EQ(frame.header.stamp, stampAt(0s));
    expectNear(frame.transform.translation, 0.0, 0.0, 0.0);
  }
}

// North reference. The convergence at the harbor is -1.42204476543 deg (Redfearn's series at
// 42.36 N, 2.11 degrees west of the central meridian of zone 19): grid 90 is true 88.578 and yaw
// 1.42204.

TEST_F(Builder, ASandsharksHeadingIsGrid) {
  const auto odom = odometryOf(shark_, navigationAt(kHarbor), at(0s));
  EXPECT_NEAR(yaw_deg(odom.pose.pose.orientation), 1.42204476543, 1e-7);
}

TEST_F(Builder, AKingfishersHeadingIsTrue) {
  const auto odom = odometryOf(boat_, navigationAt(kHarbor), at(0s));
  EXPECT_EQ(yaw_deg(odom.pose.pose.orientation), 0.0);
}

TEST_F(Builder, TheParameterOverridesTheDialect) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.heading_reference = HeadingReference::Grid;
  MessageBuilder grid(parameters);
  EXPECT_NEAR(yaw_deg(odometryOf(grid, navigationAt(kHarbor), at(0s)).pose.pose.orientation),
              1.42204476543, 1e-7);
  parameters = parametersFor(Dialect::Sandshark);
  parameters.heading_reference = HeadingReference::True;
  MessageBuilder truth(parameters);
  EXPECT_EQ(yaw_deg(odometryOf(truth, navigationAt(kHarbor), at(0s)).pose.pose.orientation), 0.0);
}

TEST_F(Builder, TheDialectMayBecomeKnownLater) {
  MessageBuilder builder(parametersFor(std::nullopt));
  builder.setDialect(Dialect::Sandshark);
  EXPECT_NEAR(yaw_deg(odometryOf(builder, navigationAt(kHarbor), at(0s)).pose.pose.orientation),
              1.42204476543, 1e-7);
}

TEST_F(Builder, AGridHeadingUsesTheLastPosition) {
  shark_.take(navigationAt(kHarbor), at(0s));
  vehicle::Navigation blank = navigationAt(kHarbor);
  blank.position.reset();
  shark_.take(blank, at(1s));
  shark_.take(someVelocity(), at(1s));
  EXPECT_NEAR(yaw_deg(shark_.imu()->orientation), 1.42204476543, 1e-7);
}

// A datum on the central meridian, where the convergence is 0, is not where the vehicle is.
TEST_F(Builder, AGridHeadingUsesThePositionRatherThanTheDatum) {
  Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.datum = Position{42.36, -69.0};
  MessageBuilder builder(parameters);
  EXPECT_NEAR(yaw_deg(odometryOf(builder, navigationAt(kHarbor), at(0s)).pose.pose.orientation),
              1.42204476543, 1e-7);
}

TEST_F(Builder, AGridHeadingUsesTheDatumBeforeAnyPosition) {
  Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.datum = kHarbor;
  MessageBuilder builder(parameters);
  builder.take(navigationAt({0.0, 0.0}), at(0s));
  builder.take(someVelocity(), at(0s));
  EXPECT_NEAR(yaw_deg(builder.imu()->orientation), 1.42204476543, 1e-7);
}

TEST_F(Builder, AGridHeadingIsMissingWhereTheConvergenceIsUnknown) {
  shark_.take(navigationAt({0.0, 0.0}), at(0s));
  shark_.take(someVelocity(), at(0s));
  const auto imu = shark_.imu();
  expectNotMeasured(imu->orientation_covariance);
  expectIdentity(imu->orientation);
}

// What a command has to be turned back by needs a position of the vehicle, not a datum somewhere.
TEST_F(Builder, NorthOffsetIsTheConvergenceOfAPosition) {
  Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.datum = Position{42.36, -69.0};
  MessageBuilder builder(parameters);
  builder.take(navigationAt({0.0, 0.0}), at(0s));
  EXPECT_FALSE(builder.northOffset_deg());
  builder.take(navigationAt(kHarbor), at(1s));
  ASSERT_TRUE(builder.northOffset_deg());
  EXPECT_NEAR(*builder.northOffset_deg(), -1.42204476543, 1e-7);
}

TEST_F(Builder, NorthOffsetIsNoneWhereHeadingsAreTrue) {
  ASSERT_TRUE(boat_.northOffset_deg());
  EXPECT_EQ(*boat_.northOffset_deg(), 0.0);
}

// Fix, depth, altitude, velocity

TEST_F(Builder, NavFixIsThePositionAsTold) {
  boat_.take(navigationAt(kHarbor), at(0s));
  const auto fix = boat_.navFix();
  ASSERT_TRUE(fix);
  EXPECT_EQ(fix->header.frame_id, "base_link");
  EXPECT_EQ(fix->header.stamp, stampAt(0s));
  EXPECT_EQ(fix->status.status, NavSatStatus::STATUS_FIX);
  EXPECT_EQ(fix->status.service, NavSatStatus::SERVICE_GPS);
  EXPECT_EQ(fix->latitude, 42.36);
  EXPECT_EQ(fix->longitude, -71.11);
  EXPECT_TRUE(std::isnan(fix->altitude));
  expectDiagonal(fix->position_covariance, {kGpsVariance, kGpsVariance, kUnknown});
  EXPECT_EQ(fix->position_covariance_type, sensor_msgs::NavSatFix::COVARIANCE_TYPE_APPROXIMATED);
}

TEST_F(Builder, NavFixByDeadReckoningHasNoFixButAPosition) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.from_gps = false;
  boat_.take(navigation, at(0s));
  const auto fix = boat_.navFix();
  ASSERT_TRUE(fix);
  EXPECT_EQ(fix->status.status, NavSatStatus::STATUS_NO_FIX);
  EXPECT_EQ(fix->latitude, 42.36);
  expectDiagonal(fix->position_covariance,
                 {kDeadReckoningVariance, kDeadReckoningVariance, kUnknown});
}

TEST_F(Builder, DepthIsDownwards) {
  boat_.take(navigationAt(kHarbor), at(0s));
  const auto depth = boat_.depth();
  ASSERT_TRUE(depth);
  EXPECT_EQ(depth->header.frame_id, "odom");
  EXPECT_EQ(depth->header.stamp, stampAt(0s));
  EXPECT_EQ(depth->pose.pose.position.z, -3.0);
  EXPECT_EQ(depth->pose.pose.position.x, 0.0);
  expectIdentity(depth->pose.pose.orientation);
  expectDiagonal(depth->pose.covariance,
                 {kUnknown, kUnknown, kDepthVariance, kUnknown, kUnknown, kUnknown});
}

TEST_F(Builder, BlankDepthIsNotPublished) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.depth_m.reset();
  boat_.take(navigation, at(0s));
  EXPECT_FALSE(boat_.depth());
}

TEST_F(Builder, AltitudeIsARange) {
  boat_.take(navigationAt(kHarbor), at(0s));
  const auto altitude = boat_.altitude();
  ASSERT_TRUE(altitude);
  EXPECT_EQ(altitude->header.frame_id, "altimeter_link");
  EXPECT_EQ(altitude->header.stamp, stampAt(0s));
  EXPECT_EQ(altitude->radiation_type, sensor_msgs::Range::ULTRASOUND);
  EXPECT_EQ(altitude->range, 7.5F);
  EXPECT_LE(altitude->min_range, altitude->range);
  EXPECT_GE(altitude->max_range, altitude->range);
}

TEST_F(Builder, NoBottomIsNotPublished) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  for (const std::optional<double>& altitude_m :
       {std::optional<double>{}, std::optional<double>{0.0}}) {
    navigation.altitude_m = altitude_m;
    shark_.take(navigation, at(0s));
    boat_.take(navigation, at(0s));
    EXPECT_FALSE(shark_.altitude());
    EXPECT_FALSE(boat_.altitude());
  }
  navigation.altitude_m = 0.125;
  boat_.take(navigation, at(0s));
  EXPECT_TRUE(boat_.altitude());
}

TEST_F(Builder, NavVelocityIsEnu) {
  boat_.take(someVelocity(), at(0s));
  const auto velocity = boat_.navVelocity();
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->header.frame_id, "odom");
  EXPECT_EQ(velocity->header.stamp, stampAt(0s));
  expectNear(velocity->twist.linear, 1.0, 2.0, -0.5);
  expectNear(velocity->twist.angular, 0.0, 0.0, 0.0);
}

TEST_F(Builder, NavVelocityNeedsEastAndNorth) {
  vehicle::Velocity velocity = someVelocity();
  velocity.down_m_s.reset();
  boat_.take(velocity, at(0s));
  EXPECT_EQ(boat_.navVelocity()->twist.linear.x, 1.0);
  EXPECT_TRUE(std::isnan(boat_.navVelocity()->twist.linear.z));
  velocity.east_m_s.reset();
  boat_.take(velocity, at(0s));
  EXPECT_FALSE(boat_.navVelocity());
  velocity.east_m_s = 1.0;
  velocity.north_m_s.reset();
  boat_.take(velocity, at(0s));
  EXPECT_FALSE(boat_.navVelocity());
}

// IMUs

TEST_F(Builder, ImuIsWholeWithFreshNavigationAndRawImu) {
  vehicle::Navigation north = navigationAt(kHarbor);
  north.heading_deg = 0.0;
  boat_.take(north, at(0s));
  boat_.take(someRawImu(), at(1s));
  boat_.take(someVelocity(), at(2s));
  const auto imu = boat_.imu();
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->header.frame_id, "base_link");
  EXPECT_EQ(imu->header.stamp, stampAt(2s));
  EXPECT_NEAR(yaw_deg(imu->orientation), 90.0, 1e-12);
  expectNear(imu->angular_velocity, kOneDegree, -2.0 * kOneDegree, -3.0 * kOneDegree);
  expectNear(imu->linear_acceleration, 0.5, -0.25, 9.75);
  expectDiagonal(imu->orientation_covariance,
                 {kOrientationVariance, kOrientationVariance, kOrientationVariance});
  expectDiagonal(imu->angular_velocity_covariance, {kRateVariance, kRateVariance, kRateVariance});
  expectDiagonal(imu->linear_acceleration_covariance,
                 {kAccelerationVariance, kAccelerationVariance, kAccelerationVariance});
}

TEST_F(Builder, ImuSaysWhatIsMissing) {
  vehicle::Velocity velocity;
  velocity.east_m_s = 1.0;
  boat_.take(velocity, at(0s));
  const auto imu = boat_.imu();
  ASSERT_TRUE(imu);
  expectNotMeasured(imu->orientation_covariance);
  expectNotMeasured(imu->angular_velocity_covariance);
  expectNotMeasured(imu->linear_acceleration_covariance);
  expectIdentity(imu->orientation);
  expectNear(imu->angular_velocity, 0.0, 0.0, 0.0);
  expectNear(imu->linear_acceleration, 0.0, 0.0, 0.0);
}

TEST_F(Builder, ImuLeavesOutWhatIsNotFresh) {
  boat_.take(navigationAt(kHarbor), at(0s));
  boat_.take(someRawImu(), at(0s));
  boat_.take(someVelocity(), at(2001ms));
  expectNotMeasured(boat_.imu()->orientation_covariance);
  expectNotMeasured(boat_.imu()->linear_acceleration_covariance);
  EXPECT_EQ(boat_.imu()->angular_velocity_covariance[0], kRateVariance);
}

TEST_F(Builder, ImuWithoutHeadingHasNoOrientation) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.heading_deg.reset();
  boat_.take(navigation, at(0s));
  boat_.take(someVelocity(), at(0s));
  expectNotMeasured(boat_.imu()->orientation_covariance);
}

TEST_F(Builder, ImuWithoutRollOrPitchIsUnknownAboutThatAxis) {
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.roll_deg.reset();
  boat_.take(navigation, at(0s));
  boat_.take(someVelocity(), at(0s));
  expectDiagonal(boat_.imu()->orientation_covariance,
                 {kUnknown, kOrientationVariance, kOrientationVariance});
  navigation.pitch_deg.reset();
  boat_.take(navigation, at(0s));
  expectDiagonal(boat_.imu()->orientation_covariance, {kUnknown, kUnknown, kOrientationVariance});
  EXPECT_EQ(boat_.imu()->orientation.w, 1.0);  // east, level
}

TEST_F(Builder, ImuWithoutARateIsUnknownAboutThatAxis) {
  vehicle::Velocity velocity = someVelocity();
  velocity.yaw_rate_deg_s.reset();
  boat_.take(velocity, at(0s));
  expectDiagonal(boat_.imu()->angular_velocity_covariance,
                 {kRateVariance, kRateVariance, kUnknown});
  EXPECT_EQ(boat_.imu()->angular_velocity.z, 0.0);
}

TEST_F(Builder, RawImuIsFlu) {
  boat_.take(someRawImu(), at(0s));
  const auto imu = boat_.rawImu();
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->header.frame_id, "imu_link");
  EXPECT_EQ(imu->header.stamp, stampAt(0s));
  expectNotMeasured(imu->orientation_covariance);
  expectNear(imu->angular_velocity, kOneDegree, -2.0 * kOneDegree, -3.0 * kOneDegree);
  expectNear(imu->linear_acceleration, 0.5, -0.25, 9.75);
}

TEST_F(Builder, RawImuInGIsScaled) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.acceleration_unit = AccelerationUnit::StandardGravity;
  MessageBuilder builder(parameters);
  vehicle::RawImu raw = someRawImu();
  raw.acceleration_z = -1.0;
  builder.take(raw, at(0s));
  EXPECT_DOUBLE_EQ(builder.rawImu()->linear_acceleration.x, 4.903325);  // half of 9.80665
  EXPECT_DOUBLE_EQ(builder.rawImu()->linear_acceleration.y, -2.4516625);
  EXPECT_DOUBLE_EQ(builder.rawImu()->linear_acceleration.z, 9.80665);
}

bool isFinite(const geometry_msgs::Vector3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

TEST_F(Builder, TheLargestNumbersOfAVehicleStayNumbers) {
  constexpr double kLargest = nmea::FieldReader::kLargest;
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.acceleration_unit = AccelerationUnit::StandardGravity;
  MessageBuilder builder(parameters);
  builder.take(vehicle::RawImu{{}, kLargest, -kLargest, kLargest, -kLargest, kLargest, -kLargest},
               at(0s));
  EXPECT_TRUE(isFinite(builder.rawImu()->angular_velocity));
  EXPECT_TRUE(isFinite(builder.rawImu()->linear_acceleration));
  vehicle::Velocity velocity;
  velocity.east_m_s = velocity.north_m_s = velocity.down_m_s = kLargest;
  velocity.roll_rate_deg_s = velocity.pitch_rate_deg_s = velocity.yaw_rate_deg_s = -kLargest;
  builder.take(velocity, at(0s));
  vehicle::Navigation navigation = navigationAt(kHarbor);
  navigation.heading_deg = 45.0;
  navigation.altitude_m = kLargest;
  navigation.depth_m = -kLargest;
  const auto odom = odometryOf(builder, navigation, at(0s));
  EXPECT_TRUE(isFinite(odom.twist.twist.linear));
  EXPECT_TRUE(isFinite(odom.twist.twist.angular));
  EXPECT_TRUE(std::isfinite(odom.pose.pose.position.z));
  EXPECT_TRUE(std::isfinite(builder.altitude()->range));
}

TEST_F(Builder, RawImuWithoutAnAxisIsZeroAndUnknownThere) {
  vehicle::RawImu raw = someRawImu();
  raw.acceleration_y.reset();
  raw.rate_x_deg_s.reset();
  boat_.take(raw, at(0s));
  auto imu = *boat_.rawImu();
  expectNear(imu.linear_acceleration, 0.5, 0.0, 9.75);
  expectDiagonal(imu.linear_acceleration_covariance,
                 {kAccelerationVariance, kUnknown, kAccelerationVariance});
  expectNear(imu.angular_velocity, 0.0, -2.0 * kOneDegree, -3.0 * kOneDegree);
  expectDiagonal(imu.angular_velocity_covariance, {kUnknown, kRateVariance, kRateVariance});

  raw = someRawImu();
  raw.acceleration_x.reset();
  raw.rate_y_deg_s.reset();
  boat_.take(raw, at(0s));
  imu = *boat_.rawImu();
  expectNear(imu.linear_acceleration, 0.0, -0.25, 9.75);
  expectDiagonal(imu.linear_acceleration_covariance,
                 {kUnknown, kAccelerationVariance, kAccelerationVariance});
  expectNear(imu.angular_velocity, kOneDegree, 0.0, -3.0 * kOneDegree);
  expectDiagonal(imu.angular_velocity_covariance, {kRateVariance, kUnknown, kRateVariance});

  raw = someRawImu();
  raw.acceleration_z.reset();
  raw.rate_z_deg_s.reset();
  boat_.take(raw, at(0s));
  imu = *boat_.rawImu();
  expectNear(imu.linear_acceleration, 0.5, -0.25, 0.0);
  expectDiagonal(imu.linear_acceleration_covariance,
                 {kAccelerationVariance, kAccelerationVariance, kUnknown});
  expectNear(imu.angular_velocity, kOneDegree, -2.0 * kOneDegree, 0.0);
  expectDiagonal(imu.angular_velocity_covariance, {kRateVariance, kRateVariance, kUnknown});
}

TEST_F(Builder, RawImuOfOneAxisIsThatAxis) {
  vehicle::RawImu raw;
  raw.rate_y_deg_s = 2.0;
  raw.acceleration_z = -9.75;
  boat_.take(raw, at(0s));
  auto imu = *boat_.rawImu();
  expectNear(imu.angular_velocity, 0.0, -2.0 * kOneDegree, 0.0);
  expectDiagonal(imu.angular_velocity_covariance, {kUnknown, kRateVariance, kUnknown});
  expectNear(imu.linear_acceleration, 0.0, 0.0, 9.75);
  expectDiagonal(imu.linear_acceleration_covariance, {kUnknown, kUnknown, kAccelerationVariance});

  raw = {};
  raw.rate_z_deg_s = 3.0;
  raw.acceleration_x = 0.5;
  boat_.take(raw, at(0s));
  imu = *boat_.rawImu();
  expectNear(imu.angular_velocity, 0.0, 0.0, -3.0 * kOneDegree);
  expectDiagonal(imu.angular_velocity_covariance, {kUnknown, kUnknown, kRateVariance});
  expectNear(imu.linear_acceleration, 0.5, 0.0, 0.0);
  expectDiagonal(imu.linear_acceleration_covariance, {kAccelerationVariance, kUnknown, kUnknown});

  raw = {};
  raw.rate_x_deg_s = 1.0;
  raw.acceleration_y = 0.25;
  boat_.take(raw, at(0s));
  imu = *boat_.rawImu();
  expectNear(imu.angular_velocity, kOneDegree, 0.0, 0.0);
  expectDiagonal(imu.angular_velocity_covariance, {kRateVariance, kUnknown, kUnknown});
  expectNear(imu.linear_acceleration, 0.0, -0.25, 0.0);
  expectDiagonal(imu.linear_acceleration_covariance, {kUnknown, kAccelerationVariance, kUnknown});
}

TEST_F(Builder, BlankRawImuIsNotPublished) {
  boat_.take(vehicle::RawImu{}, at(0s));
  EXPECT_FALSE(boat_.rawImu());
}

TEST_F(Builder, RawImuWithRatesOnlyHasNoAcceleration) {
  vehicle::RawImu raw;
  raw.rate_x_deg_s = 1.0;
  boat_.take(raw, at(0s));
  expectNotMeasured(boat_.rawImu()->linear_acceleration_covariance);
}

vehicle::Compass someCompass() {
  vehicle::Compass out;
  out.id = 1;
  out.heading_deg = 60.0;
  out.pitch_deg = 0.0;
  out.roll_deg = 0.0;
  return out;
}

TEST_F(Builder, CompassIsOrientationOnly) {
  const auto imu = boat_.compass(someCompass(), at(0s));
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->header.frame_id, "compass_1_link");
  EXPECT_EQ(imu->header.stamp, stampAt(0s));
  EXPECT_NEAR(yaw_deg(imu->orientation), 30.0, 1e-12);
  expectDiagonal(imu->orientation_covariance,
                 {kOrientationVariance, kOrientationVariance, kOrientationVariance});
  expectNotMeasured(imu->angular_velocity_covariance);
  expectNotMeasured(imu->linear_acceleration_covariance);
}

TEST_F(Builder, CompassWithoutIdHasAFrameWithoutOne) {
  vehicle::Compass compass = someCompass();
  compass.id.reset();
  EXPECT_EQ(boat_.compass(compass, at(0s))->header.frame_id, "compass_link");
}

TEST_F(Builder, CompassWithoutHeadingIsNotPublished) {
  vehicle::Compass compass = someCompass();
  compass.heading_deg.reset();
  EXPECT_FALSE(boat_.compass(compass, at(0s)));
}

TEST_F(Builder, CompassWithoutRollOrPitchIsUnknownAboutThatAxis) {
  vehicle::Compass compass = someCompass();
  compass.pitch_deg.reset();
  expectDiagonal(boat_.compass(compass, at(0s))->orientation_covariance,
                 {kOrientationVariance, kUnknown, kOrientationVariance});
  compass.roll_deg.reset();
  expectDiagonal(boat_.compass(compass, at(0s))->orientation_covariance,
                 {kUnknown, kUnknown, kOrientationVariance});
}

// Magnetic north 0.25 rad (14.3239 deg) west of true north: true = magnetic - 14.3239.
TEST_F(Builder, CompassGetsTheDeclination) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.magnetic_declination_rad = -0.25;
  MessageBuilder builder(parameters);
  EXPECT_NEAR(yaw_deg(builder.compass(someCompass(), at(0s))->orientation), 44.3239448782706,
              1e-10);
}

TEST_F(Builder, CompassOfAHeronIsTurnedBack) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.compass_convention = CompassConvention::Heron;
  MessageBuilder builder(parameters);
  vehicle::Compass compass = someCompass();
  compass.heading_deg = 120.0;  // (180 - 60) mod 360
  EXPECT_NEAR(yaw_deg(builder.compass(compass, at(0s))->orientation), 30.0, 1e-12);
  compass.heading_deg = 90.0;  // east, bow up: q = (0, -sin 5 deg, 0, cos 5 deg)
  compass.pitch_deg = -10.0;
  EXPECT_NEAR(builder.compass(compass, at(0s))->orientation.y, -0.0871557427476582, 1e-14);
}

// Battery

template <class Message, class = void>
struct HasTemperature : std::false_type {};
template <class Message>
struct HasTemperature<Message, std::void_t<decltype(Message::temperature)>> : std::true_type {};

template <class Message>
void expectTemperature(const Message& message, float expected) {
  if constexpr (HasTemperature<Message>::value) {
    EXPECT_EQ(message.temperature, expected);
  } else {
    static_cast<void>(message);
    static_cast<void>(expected);
  }
}

TEST_F(Builder, BatteryIsVoltages) {
  vehicle::Battery battery;
  battery.id = 2;
  battery.stack_v = 15.0;
  battery.lowest_cell_v = 3.5;
  battery.highest_cell_v = 4.0;
  battery.temperature_c = 21.5;
  const auto out = boat_.battery(battery, at(0s));
  EXPECT_EQ(out.header.frame_id, "base_link");
  EXPECT_EQ(out.header.stamp, stampAt(0s));
  EXPECT_EQ(out.voltage, 15.0F);
  EXPECT_EQ(out.cell_voltage, (std::vector<float>{3.5F, 4.0F}));
  EXPECT_EQ(out.location, "battery_2");
  expectTemperature(out, 21.5F);
  for (const float unknown :
       {out.current, out.charge, out.capacity, out.design_capacity, out.percentage}) {
    EXPECT_TRUE(std::isnan(unknown));
  }
  EXPECT_TRUE(out.present);
  EXPECT_EQ(out.power_supply_status, sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_UNKNOWN);
  EXPECT_EQ(out.power_supply_health, sensor_msgs::BatteryState::POWER_SUPPLY_HEALTH_UNKNOWN);
  EXPECT_EQ(out.power_supply_technology,
            sensor_msgs::BatteryState::POWER_SUPPLY_TECHNOLOGY_UNKNOWN);
}

template <class Message>
bool temperatureIsNan(const Message& message) {
  if constexpr (HasTemperature<Message>::value) {
    return std::isnan(message.temperature);
  } else {
    static_cast<void>(message);
    return true;
  }
}

TEST_F(Builder, BlankBatteryIsNan) {
  const auto out = boat_.battery(vehicle::Battery{}, at(0s));
  EXPECT_EQ(out.location, "battery");
  EXPECT_TRUE(std::isnan(out.voltage));
  ASSERT_EQ(out.cell_voltage.size(), 2U);
  EXPECT_TRUE(std::isnan(out.cell_voltage[0]));
  EXPECT_TRUE(std::isnan(out.cell_voltage[1]));
  EXPECT_TRUE(temperatureIsNan(out));
}

// GPS receiver

vehicle::GpsFix someFix(std::int64_t quality) {
  vehicle::GpsFix out;
  out.quality = quality;
  out.position = kHarbor;
  out.altitude_m = 46.5;
  out.geoid_separation_m = -33.25;
  return out;
}

struct Quality {
  std::int64_t sent;
  std::int8_t status;
};

const Quality kQualities[] = {
    {0, NavSatStatus::STATUS_NO_FIX},   {1, NavSatStatus::STATUS_FIX},
    {2, NavSatStatus::STATUS_SBAS_FIX}, {3, NavSatStatus::STATUS_FIX},
    {4, NavSatStatus::STATUS_GBAS_FIX}, {5, NavSatStatus::STATUS_GBAS_FIX},
    {6, NavSatStatus::STATUS_NO_FIX},   {7, NavSatStatus::STATUS_FIX},
    {8, NavSatStatus::STATUS_FIX},      {9, NavSatStatus::STATUS_GBAS_FIX},
    {10, NavSatStatus::STATUS_NO_FIX},  {-1, NavSatStatus::STATUS_NO_FIX},
};

TEST_F(Builder, GpsQualityIsStatus) {
  for (const Quality& row : kQualities) {
    const auto fix = boat_.gpsFix(someFix(row.sent), at(0s));
    EXPECT_EQ(fix.status.status, row.status) << row.sent;
    const bool has_fix = row.status != NavSatStatus::STATUS_NO_FIX;
    EXPECT_EQ(std::isnan(fix.latitude), !has_fix) << row.sent;
    EXPECT_EQ(std::isnan(fix.longitude), !has_fix) << row.sent;
    EXPECT_EQ(std::isnan(fix.altitude), !has_fix) << row.sent;
  }
}

TEST_F(Builder, GpsFixIsAboveTheEllipsoid) {
  const auto fix = boat_.gpsFix(someFix(1), at(0s));
  EXPECT_EQ(fix.header.frame_id, "gps_link");
  EXPECT_EQ(fix.header.stamp, stampAt(0s));
  EXPECT_EQ(fix.latitude, 42.36);
  EXPECT_EQ(fix.longitude, -71.11);
  EXPECT_EQ(fix.altitude, 13.25);
  expectDiagonal(fix.position_covariance, {kGpsVariance, kGpsVariance, kGpsVariance});
}

TEST_F(Builder, GpsAltitudeNeedsBothHeights) {
  vehicle::GpsFix fix = someFix(1);
  fix.geoid_separation_m.reset();
  EXPECT_TRUE(std::isnan(boat_.gpsFix(fix, at(0s)).altitude));
  EXPECT_EQ(boat_.gpsFix(fix, at(0s)).position_covariance[8], kUnknown);
  fix = someFix(1);
  fix.altitude_m.reset();
  EXPECT_TRUE(std::isnan(boat_.gpsFix(fix, at(0s)).altitude));
}

TEST_F(Builder, GpsWithoutPositionHasNoFix) {
  vehicle::GpsFix fix = someFix(1);
  fix.position.reset();
  const auto out = boat_.gpsFix(fix, at(0s));
  EXPECT_EQ(out.status.status, NavSatStatus::STATUS_NO_FIX);
  EXPECT_TRUE(std::isnan(out.latitude));
  EXPECT_EQ(out.position_covariance_type, sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN);
}

vehicle::GpsVelocity someGpsVelocity() {
  vehicle::GpsVelocity out;
  out.measured_at = 11h + 30min;
  out.date = kNoon - 12h;
  out.valid = true;
  out.speed_m_s = 2.0;
  out.course_deg = 30.0;
  return out;
}

TEST_F(Builder, GpsVelocityFollowsTheCourse) {
  const auto velocity = boat_.gpsVelocity(someGpsVelocity(), at(0s));
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->header.frame_id, "gps_link");
  EXPECT_EQ(velocity->header.stamp, stampAt(0s));
  expectNear(velocity->twist.linear, 1.0, 1.73205080756888, 0.0);
}

TEST_F(Builder, GpsVelocityThatIsVoidOrBlankIsNotPublished) {
  vehicle::GpsVelocity velocity = someGpsVelocity();
  velocity.valid = false;
  EXPECT_FALSE(boat_.gpsVelocity(velocity, at(0s)));
  velocity = someGpsVelocity();
  velocity.speed_m_s.reset();
  EXPECT_FALSE(boat_.gpsVelocity(velocity, at(0s)));
  velocity = someGpsVelocity();
  velocity.course_deg.reset();
  EXPECT_FALSE(boat_.gpsVelocity(velocity, at(0s)));
}

TEST_F(Builder, GpsVelocityZeroNeedsNoCourse) {
  vehicle::GpsVelocity velocity = someGpsVelocity();
  velocity.speed_m_s = 0.0;
  velocity.course_deg.reset();
  const auto out = boat_.gpsVelocity(velocity, at(0s));
  ASSERT_TRUE(out);
  expectNear(out->twist.linear, 0.0, 0.0, 0.0);
}

TEST_F(Builder, GpsTimeIsUtcAgainstArrival) {
  Parameters parameters = parametersFor(Dialect::Kingfisher);
  parameters.stamp = StampMode::Vehicle;
  MessageBuilder builder(parameters);
  const auto time = builder.gpsTime(someGpsVelocity(), at(0s));
  ASSERT_TRUE(time);
  EXPECT_EQ(time->header.stamp, stampAt(0s));
  EXPECT_EQ(time->time_ref, toRosTime(kNoon - 30min));
  EXPECT_EQ(time->source, "gps");
}

TEST_F(Builder, GpsTimeNeedsAValidTimeAndDate) {
  vehicle::GpsVelocity velocity = someGpsVelocity();
  velocity.valid = false;
  EXPECT_FALSE(boat_.gpsTime(velocity, at(0s)));
  velocity = someGpsVelocity();
  velocity.date.reset();
  EXPECT_FALSE(boat_.gpsTime(velocity, at(0s)));
  velocity = someGpsVelocity();
  velocity.measured_at.reset();
  EXPECT_FALSE(boat_.gpsTime(velocity, at(0s)));
}

// Status

TEST_F(Builder, MissionStatusIsTheVehiclesWords) {
  vehicle::MissionStatus status;
  status.state = vehicle::MissionStatus::State::Running;
  status.status = "Running";
  status.dive_file = "survey.dive";
  status.log_directory = "/logs/1";
  status.details = "leg 2";
  const MissionStatus out = shark_.missionStatus(status, at(0s));
  EXPECT_EQ(out.header.stamp, stampAt(0s));
  EXPECT_EQ(out.header.frame_id, "");
  EXPECT_EQ(out.state, MissionStatus::RUNNING);
  EXPECT_EQ(out.status, "Running");
  EXPECT_EQ(out.dive_file, "survey.dive");
  EXPECT_EQ(out.log_directory, "/logs/1");
  EXPECT_EQ(out.details, "leg 2");
}

TEST_F(Builder, EveryMissionStateHasItsNumber) {
  using State = vehicle::MissionStatus::State;
  const std::pair<State, std::uint8_t> kStates[] = {
      {State::Unknown, MissionStatus::UNKNOWN},
      {State::Offline, MissionStatus::OFFLINE},
      {State::Waiting, MissionStatus::WAITING},
      {State::InvalidDiveFile, MissionStatus::INVALID_DIVE_FILE},
      {State::InvalidWrapupFile, MissionStatus::INVALID_WRAPUP_FILE},
      {State::Ready, MissionStatus::READY},
      {State::Running, MissionStatus::RUNNING},
      {State::WrappingUp, MissionStatus::WRAPPING_UP},
      {State::Aborting, MissionStatus::ABORTING},
      {State::Completed, MissionStatus::COMPLETED},
      {State::Aborted, MissionStatus::ABORTED},
      {State::Stopped, MissionStatus::STOPPED},
  };
  for (const auto& [state, number] : kStates) {
    vehicle::MissionStatus status;
    status.state = state;
    EXPECT_EQ(shark_.missionStatus(status, at(0s)).state, number);
  }
}

TEST_F(Builder, ControlStatusIsOfItsArrival) {
  vehicle::Control control;
  control.grant = vehicle::Grant::Granted;
  control.commands_enabled = false;
  control.commanding = true;
  control.reason = "the gate is closed";
  const ControlStatus out = shark_.controlStatus(control, at(0s));
  EXPECT_EQ(out.header.stamp, stampAt(0s));
  EXPECT_EQ(out.grant, ControlStatus::GRANTED);
  EXPECT_FALSE(out.commands_enabled);
  EXPECT_TRUE(out.commanding);
  EXPECT_EQ(out.reason, "the gate is closed");
}

TEST_F(Builder, InterfaceVersionHasBothSides) {
  const InterfaceVersion out = shark_.interfaceVersion({{}, "SS_0.0"}, at(0s));
  EXPECT_EQ(out.header.stamp, stampAt(0s));
  EXPECT_EQ(out.vehicle, "SS_0.0");
  EXPECT_EQ(out.payload, "0.1");
}

TEST_F(Builder, ShutdownIsAMinuteAfterItWasSent) {
  Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.stamp = StampMode::Vehicle;
  MessageBuilder builder(parameters);
  vehicle::Shutdown shutdown;
  shutdown.sent_at = 11h;
  const ShutdownNotice out = builder.shutdownNotice(shutdown, at(0s));
  EXPECT_EQ(out.header.stamp, toRosTime(kNoon - 1h));
  EXPECT_EQ(out.earliest_power_off, toRosTime(kNoon - 59min));
}

TEST_F(Builder, AckIsOfAFiveLetterCommand) {
  vehicle::Acknowledgement ack;
  ack.command = "RMB";
  ack.command_time = 12h - 1s;
  ack.behavior_id = "7";
  ack.status = vehicle::Acknowledgement::Status::Pending;
  ack.message = "on its way";
  ack.round_trip = 250ms;
  CommandAck out = shark_.commandAck(ack, at(0s));
  EXPECT_EQ(out.header.stamp, stampAt(0s));
  EXPECT_EQ(out.command, "BPRMB");
  EXPECT_EQ(out.command_stamp, stampAt(-1s));
  EXPECT_EQ(out.behavior_id, "7");
  EXPECT_EQ(out.status, CommandAck::PENDING);
  EXPECT_EQ(out.message, "on its way");
  EXPECT_EQ(out.round_trip, 0.25);
  ack.command = "BPRMB";
  EXPECT_EQ(shark_.commandAck(ack, at(0s)).command, "BPRMB");
}

TEST_F(Builder, AckOfWhatIsNotOursHasNoTimes) {
  vehicle::Acknowledgement ack;
  ack.command = "LOG";
  ack.status = vehicle::Acknowledgement::Status::Done;
  const CommandAck out = shark_.commandAck(ack, at(0s));
  EXPECT_EQ(out.command_stamp, ros::Time());
  EXPECT_TRUE(std::isnan(out.round_trip));
  EXPECT_EQ(out.status, CommandAck::DONE);
}

// Stamps

class VehicleStamps : public Builder {
 protected:
  static Parameters vehicleStamps(Dialect dialect) {
    Parameters out = parametersFor(dialect);
    out.stamp = StampMode::Vehicle;
    return out;
  }

  vehicle::Navigation navigationMeasured(vehicle::TimeOfDay time) {
    vehicle::Navigation out = navigationAt(kHarbor);
    out.measured_at = time;
    return out;
  }
};

TEST_F(VehicleStamps, AreUtcOnASandshark) {
  MessageBuilder builder(vehicleStamps(Dialect::Sandshark));
  EXPECT_EQ(odometryOf(builder, navigationMeasured(12h + 3s), at(0s)).header.stamp,
            toRosTime(kNoon + 3s));
}

TEST_F(VehicleStamps, LeaveOutTheLeapSecondsOfAKingfisher) {
  MessageBuilder builder(vehicleStamps(Dialect::Kingfisher));
  EXPECT_EQ(odometryOf(builder, navigationMeasured(12h + 18s), at(0s)).header.stamp,
            toRosTime(kNoon));
  vehicle::GpsFix fix = someFix(1);
  fix.measured_at = 12h + 5s;
  EXPECT_EQ(builder.gpsFix(fix, at(0s)).header.stamp, toRosTime(kNoon + 5s));
}

TEST_F(VehicleStamps, UseTheParameterFirst) {
  Parameters parameters = vehicleStamps(Dialect::Kingfisher);
  parameters.leap_seconds = 0s;
  MessageBuilder builder(parameters);
  builder.setDialect(Dialect::Kingfisher);
  EXPECT_EQ(odometryOf(builder, navigationMeasured(12h + 18s), at(0s)).header.stamp,
            toRosTime(kNoon + 18s));
}

TEST_F(VehicleStamps, NeverGoBackWithinATopic) {
  MessageBuilder builder(vehicleStamps(Dialect::Sandshark));
  odometryOf(builder, navigationMeasured(12h), at(0s));
  EXPECT_EQ(odometryOf(builder, navigationMeasured(12h - 1s), at(1s)).header.stamp,
            toRosTime(kNoon));
  EXPECT_EQ(builder.depth()->header.stamp, toRosTime(kNoon - 1s));  // a topic of its own
  EXPECT_EQ(odometryOf(builder, navigationMeasured(12h + 1s), at(2s)).header.stamp,
            toRosTime(kNoon + 1s));
}

TEST_F(VehicleStamps, OfTwoCompassesShareTheirTopic) {
  MessageBuilder builder(vehicleStamps(Dialect::Sandshark));
  vehicle::Compass compass = someCompass();
  compass.measured_at = 12h;
  builder.compass(compass, at(0s));
  compass.id = 2;
  compass.measured_at = 12h - 1s;
  EXPECT_EQ(builder.compass(compass, at(0s))->header.stamp, toRosTime(kNoon));
}

TEST_F(Builder, StampsBeginAnewAfterAReset) {
  boat_.take(someVelocity(), at(100s));
  boat_.take(someRawImu(), at(100s));
  EXPECT_TRUE(boat_.transform(odometryOf(boat_, navigationAt(kHarbor), at(100s))));
  boat_.reset();
  EXPECT_FALSE(boat_.odometry());
  EXPECT_FALSE(boat_.imu());
  EXPECT_FALSE(boat_.rawImu());
  EXPECT_TRUE(boat_.datum());
  // Far away: after a reset the vehicle may be anywhere.
  const auto odom = odometryOf(boat_, navigationAt({42.37, -71.11}), at(0s));
  EXPECT_EQ(odom.header.stamp, stampAt(0s));
  EXPECT_EQ(odom.twist.covariance[0], kUnknown);
  EXPECT_TRUE(boat_.transform(odom));
}

TEST_F(Builder, StampsOutsideRosTimeSaturate) {
  Now ancient = at(0s);
  ancient.stamp = -1s;
  EXPECT_EQ(odometryOf(boat_, navigationAt(kHarbor), ancient).header.stamp, ros::Time());
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
