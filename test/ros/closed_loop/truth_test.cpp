#include <gtest/gtest.h>
#include <tf2/LinearMath/Quaternion.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>

#include "closed_loop.h"

// What the driver publishes against the truth that the simulator knows: ten minutes of the mission
// that each vehicle runs by itself, without noise.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

// 2026-03-01 23:55 UTC, so that both UTC and GPS time go through midnight.
constexpr vehicle::UtcTime kBeforeMidnight = std::chrono::seconds{1772409300};

/// The largest differences of a run.
struct Worst {
  double position_m = 0.0;
  double angle_deg = 0.0;
  double velocity_m_s = 0.0;
  double rate_rad_s = 0.0;
  double imu_rate_rad_s = 0.0;
  int compared = 0;
  double most_turn_rad_s = 0.0;
  double most_depth_m = 0.0;
  double most_pitch_rad = 0.0;
};

struct Vector {
  double x, y, z;
};

// By the rotation matrix from body FLU to ENU, written out for yaw, pitch about port, roll about
// the bow: columns are the bow, port and up axes in ENU.
Vector inBody(const Vector& enu, double yaw, double pitch, double roll) {
  const double cy = std::cos(yaw), sy = std::sin(yaw);
  const double cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  return {cy * cp * enu.x + sy * cp * enu.y - sp * enu.z,
          (cy * sp * sr - sy * cr) * enu.x + (sy * sp * sr + cy * cr) * enu.y + cp * sr * enu.z,
          (cy * sp * cr + sy * sr) * enu.x + (sy * sp * cr - cy * sr) * enu.y + cp * cr * enu.z};
}

double distance(const Vector& a, const Vector& b) {
  return std::hypot(std::hypot(a.x - b.x, a.y - b.y), a.z - b.z);
}

double roll(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
}

double pitch(const geometry_msgs::Quaternion& q) {
  return std::asin(std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
}

void raise(double& worst, double value) { worst = std::max(worst, value); }

void compare(const nav_msgs::Odometry& odometry, const sim::VehicleState& truth, Worst& worst) {
  const auto& position = odometry.pose.pose.position;
  const auto& orientation = odometry.pose.pose.orientation;
  const auto& linear = odometry.twist.twist.linear;
  const auto& angular = odometry.twist.twist.angular;
  // Nautical angles to those of REP-103: yaw from east to port, bow down, port side up.
  const double yaw = M_PI_2 - truth.heading_rad;
  const double bow_down = -truth.pitch_rad;
  const Vector velocity =
      inBody({truth.velocity_east_m_s, truth.velocity_north_m_s, -truth.velocity_down_m_s}, yaw,
             bow_down, truth.roll_rad);
  ++worst.compared;
  raise(worst.position_m, distance({position.x, position.y, position.z},
                                   {truth.east_m, truth.north_m, -truth.depth_m}));
  const double angle_rad =
      std::max({apart(yawOf(orientation), yaw), apart(pitch(orientation), bow_down),
                apart(roll(orientation), truth.roll_rad)});
  raise(worst.angle_deg, angle_rad * 180.0 / M_PI);
  raise(worst.velocity_m_s, distance({linear.x, linear.y, linear.z}, velocity));
  raise(worst.rate_rad_s,
        distance({angular.x, angular.y, angular.z},
                 {truth.roll_rate_rad_s, -truth.pitch_rate_rad_s, -truth.yaw_rate_rad_s}));
  raise(worst.most_turn_rad_s, std::abs(truth.yaw_rate_rad_s));
  raise(worst.most_depth_m, truth.depth_m);
  raise(worst.most_pitch_rad, std::abs(truth.pitch_rad));
}

tf2::Quaternion orientationOf(const nav_msgs::Odometry& odometry) {
  const auto& q = odometry.pose.pose.orientation;
  return {q.x, q.y, q.z, q.w};
}

/// The turn about the axes of the body that leads from one orientation to the next, rad/s.
Vector turnedPerSecond(const nav_msgs::Odometry& a, const nav_msgs::Odometry& b) {
  const tf2::Quaternion turn = orientationOf(a).inverse() * orientationOf(b);
  const double angle = std::remainder(turn.getAngle(), 2.0 * M_PI);
  const tf2::Vector3 rate = turn.getAxis() * (angle / (b.header.stamp - a.header.stamp).toSec());
  return {rate.x(), rate.y(), rate.z()};
}

Vector meanRates(const nav_msgs::Odometry& a, const nav_msgs::Odometry& b) {
  const auto& before = a.twist.twist.angular;
  const auto& after = b.twist.twist.angular;
  return {(before.x + after.x) / 2.0, (before.y + after.y) / 2.0, (before.z + after.z) / 2.0};
}

struct Voyage {
  const char* name;
  Dialect dialect;
  nmea::LatLon datum;
  vehicle::UtcTime start;
};

void PrintTo(const Voyage& voyage, std::ostream* out) { *out << voyage.name; }

constexpr nmea::LatLon kBoston{42.358456, -71.087589};
const vehicle::UtcTime kNoon = quietKingfisher().start_time;

const Voyage kVoyages[] = {
    {"sandshark", Dialect::Sandshark, kBoston, kNoon},
    {"kingfisher", Dialect::Kingfisher, kBoston, kNoon},
    {"sandshark_midnight", Dialect::Sandshark, kBoston, kBeforeMidnight},
    {"kingfisher_midnight", Dialect::Kingfisher, kBoston, kBeforeMidnight},
    {"sandshark_south_west", Dialect::Sandshark, {-22.9, -43.17}, kNoon},
    {"kingfisher_south_west", Dialect::Kingfisher, {-54.81, -68.3}, kNoon},
    {"sandshark_south_east", Dialect::Sandshark, {-33.86, 151.21}, kNoon},
    {"kingfisher_north_east", Dialect::Kingfisher, {63.43, 10.4}, kNoon},
    {"sandshark_date_line", Dialect::Sandshark, {-16.8, -179.9999}, kNoon},
    {"kingfisher_equator_greenwich", Dialect::Kingfisher, {0.00001, -0.00001}, kNoon},
};

class Truth : public testing::TestWithParam<Voyage> {
 protected:
  static ClosedLoop loopFor(const Voyage& voyage) {
    ros_layer::Parameters parameters = parametersFor(voyage.dialect);
    parameters.datum = vehicle::Position{voyage.datum.latitude_deg, voyage.datum.longitude_deg};
    const auto prepare = [&](auto config) {
      config.start_time = voyage.start;
      config.noise = false;
      config.environment.datum = voyage.datum;
      return config;
    };
    if (voyage.dialect == Dialect::Sandshark) {
      return ClosedLoop{parameters, prepare(sim::SandsharkConfig{})};
    }
    return ClosedLoop{parameters, prepare(sim::KingfisherConfig{})};
  }
};

TEST_P(Truth, OdometryOfTenMinutesIsTheTruthAtTheSameStamp) {
  ClosedLoop loop = loopFor(GetParam());
  Worst worst;
  loop.watch.odometry = [&](const nav_msgs::Odometry& odometry, const sim::Truth& truth) {
    compare(odometry, truth.state, worst);
  };
  loop.watch.imu = [&](const sensor_msgs::Imu& imu) {
    const sim::VehicleState& state = loop.state();  // the same tick: no delay on this link
    raise(worst.imu_rate_rad_s,
          distance({imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z},
                   {state.roll_rate_rad_s, -state.pitch_rate_rad_s, -state.yaw_rate_rad_s}));
  };
  loop.connect();
  loop.pass(10min);

  // 10 Hz, less the handshake.
  EXPECT_GE(worst.compared, 5980);
  EXPECT_LT(worst.position_m, 0.01);
  EXPECT_LT(worst.angle_deg, 0.01);
  // Four decimals on the wire, turned by angles of four decimals.
  EXPECT_LT(worst.velocity_m_s, 0.0002);
  // Four decimals of deg/s in each of three axes: 0.00005 deg/s * sqrt(3) = 1.5e-6 rad/s.
  EXPECT_LT(worst.rate_rad_s, 1.6e-6);
  EXPECT_LT(worst.imu_rate_rad_s, 1.6e-6);
  EXPECT_GT(worst.most_turn_rad_s, 0.1) << "a mission without turns shows no signs";
  EXPECT_GT(worst.most_pitch_rad, 0.01);
  const double dives_to_m = GetParam().dialect == Dialect::Sandshark ? 3.5 : 0.0;
  EXPECT_GE(worst.most_depth_m, dives_to_m);
  EXPECT_EQ(loop.builder().jumps(), 0u);
}

TEST_P(Truth, RatesAreThoseOfTheOrientation) {
  ClosedLoop loop = loopFor(GetParam());
  std::optional<nav_msgs::Odometry> before;
  double worst_rad_s = 0.0;
  loop.watch.odometry = [&](const nav_msgs::Odometry& odometry, const sim::Truth&) {
    if (before) {
      const Vector turned = turnedPerSecond(*before, odometry);
      const Vector told = meanRates(*before, odometry);
      raise(worst_rad_s, distance(turned, told));
    }
    before = odometry;
  };
  loop.connect();
  loop.pass(5min);
  // Rates change by up to some 0.5 rad/s2 within a second, so that the mean of two of them a tenth
  // of a second apart is not quite that between them.
  EXPECT_LT(worst_rad_s, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Runs, Truth, testing::ValuesIn(kVoyages),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::closed_loop
