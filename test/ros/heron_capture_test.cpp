// Real sentences of a Clearpath Heron, from the bytes to the messages. The expected numbers were
// worked out by hand from the lines below, none of this project's code involved; test/captures/
// heron_2014.nmea has the same lines.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <variant>

#include "convert.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/session/to_vehicle.h"
#include "message_builder.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view kRawImu =
    "$CPIMU,164958.858,-0.061035,-0.000097,-0.061035,-0.026916,0.104533,-0.932172*57";
constexpr std::string_view kRmc =
    "$GPRMC,164959.00,A,4221.71114,N,07105.44878,W,0.145,156.78,311214,,,A*70";
constexpr std::string_view kGga =
    "$GPGGA,164959.00,4221.71114,N,07105.44878,W,1,06,2.80,46.6,M,-33.2,M,,*5C";
constexpr std::string_view kNavigation =
    "$CPNVG,164959.034,4221.711142,N,7105.44878,W,1,0,0,234.32964,-6.796959,-1.706798,"
    "164959.006*78";
constexpr std::string_view kVelocity =
    "$CPNVR,164959.063,0.02941,-0.068552,0,0.060938,0,-0.061132*59";
constexpr std::string_view kCompass =
    "$CPRCM,164959.065,0,234.326694,-1.655603,-6.628557,164959.060*62";
constexpr std::string_view kSecondNavigation =
    "$CPNVG,150216.246,4221.516161,N,7105.25215,W,1,0,0,151.799032,0.507128,2.519,150216.191*75";
constexpr std::string_view kBattery = "$CPRBS,150218.154,15.091787,15.091787,15.091787,0*77";
constexpr std::string_view kDifferentialGga =
    "$GPGGA,150216.20,4221.51616,N,07105.25215,W,2,10,0.84,19.5,M,-33.2,M,,0000*53";
constexpr std::string_view kSlowRmc =
    "$GPRMC,150216.20,A,4221.51616,N,07105.25215,W,0.021,0.00,260614,,,D*7C";

// `date -u -d '2014-12-31 16:49:59' +%s`, and GPS time is 18 s ahead by default.
constexpr std::chrono::seconds kArrival{1420044599};

vehicle::Now after(std::chrono::nanoseconds time) {
  vehicle::Now now;
  now.steady += std::chrono::duration_cast<vehicle::SteadyTime::duration>(time);
  now.utc = kArrival + time;
  now.stamp = now.utc;
  return now;
}

template <class Event>
Event eventOf(std::string_view line) {
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  if (!sentence) throw std::runtime_error("the frame of a captured line is wrong");
  const auto reading = protocol::decode(*sentence);
  if (!reading) throw std::runtime_error("a captured line has no layout");
  return std::get<Event>(session::toVehicle(reading->message).value());
}

void expectNear(const geometry_msgs::Quaternion& actual, double x, double y, double z, double w) {
  EXPECT_NEAR(actual.x, x, 1e-12);
  EXPECT_NEAR(actual.y, y, 1e-12);
  EXPECT_NEAR(actual.z, z, 1e-12);
  EXPECT_NEAR(actual.w, w, 1e-12);
}

void expectNear(const geometry_msgs::Vector3& actual, double x, double y, double z) {
  EXPECT_NEAR(actual.x, x, 1e-12);
  EXPECT_NEAR(actual.y, y, 1e-12);
  EXPECT_NEAR(actual.z, z, 1e-12);
}

class Heron : public testing::Test {
 protected:
  static Parameters parameters(StampMode stamp) {
    Parameters out;
    out.session.dialect = protocol::Dialect::Kingfisher;
    out.stamp = stamp;
    return out;
  }

  void takeFirstPart(MessageBuilder& builder) {
    builder.take(eventOf<vehicle::RawImu>(kRawImu), after(0s));
    builder.take(eventOf<vehicle::Navigation>(kNavigation), after(100ms));
    builder.take(eventOf<vehicle::Velocity>(kVelocity), after(200ms));
  }

  MessageBuilder builder_{parameters(StampMode::Receive)};
};

// Over matrices, as convert_test.cpp has it, for heading 234.32964, roll -6.796959 and pitch
// -1.706798 degrees. The twist is R_enu_flu^T (0.02941, -0.068552, 0).
constexpr double kQuaternion[] = {-0.00400086903797758, 0.0609784535688439, -0.949891604670375,
                                  0.30654781131829};

TEST_F(Heron, OdometryIsAtItsFirstPosition) {
  takeFirstPart(builder_);
  // The same fix once more, now that the velocity is known.
  builder_.take(eventOf<vehicle::Navigation>(kNavigation), after(300ms));
  const auto odom = builder_.odometry();
  ASSERT_TRUE(odom);
  EXPECT_EQ(odom->pose.pose.position.x, 0.0);
  EXPECT_EQ(odom->pose.pose.position.y, 0.0);
  EXPECT_EQ(odom->pose.pose.position.z, 0.0);
  expectNear(odom->pose.pose.orientation, kQuaternion[0], kQuaternion[1], kQuaternion[2],
             kQuaternion[3]);
  expectNear(odom->twist.twist.linear, 0.0160747263769642, 0.0722716000344494, 0.00909636215012961);
  // Pitch rate 0.060938, roll rate 0, yaw rate -0.061132 deg/s.
  expectNear(odom->twist.twist.angular, 0.0, -0.0010635687395803, 0.00106695467832917);
  EXPECT_NEAR(odom->pose.covariance[0], 9.0, 1e-12);      // 3 m, GPS
  EXPECT_NEAR(odom->pose.covariance[14], 0.01, 1e-12);    // 0.1 m
  EXPECT_NEAR(odom->pose.covariance[35], 0.0025, 1e-12);  // 0.05 rad
}

// From 42 deg 21.711142' N 71 deg 05.44878' W to 42 deg 21.516161' N 71 deg 05.25215' W, over
// Earth-centred coordinates: 269.98598 m east and 360.97054 m south.
TEST_F(Heron, OdometryGoesToItsSecondPosition) {
  takeFirstPart(builder_);
  builder_.take(eventOf<vehicle::Navigation>(kSecondNavigation), after(60s));
  const auto odom = builder_.odometry();
  ASSERT_TRUE(odom);
  EXPECT_NEAR(odom->pose.pose.position.x, 269.98597910711, 1e-6);
  EXPECT_NEAR(odom->pose.pose.position.y, -360.970542546552, 1e-6);
  EXPECT_EQ(odom->pose.pose.position.z, 0.0);
  expectNear(odom->pose.pose.orientation, -0.00749122300042307, -0.0211328382868364,
             -0.513321435039995, 0.857903484695325);
  EXPECT_EQ(odom->twist.covariance[0], 1e6);  // the velocity is a minute old
}

TEST_F(Heron, SecondPositionRightAfterTheFirstIsAJump) {
  takeFirstPart(builder_);
  builder_.take(eventOf<vehicle::Navigation>(kSecondNavigation), after(300ms));
  EXPECT_FALSE(builder_.odometry());
  EXPECT_NEAR(builder_.latestJump_m(), 450.77, 0.01);  // root of 269.986^2 + 360.971^2
}

TEST_F(Heron, FixIsInDegrees) {
  takeFirstPart(builder_);
  const auto fix = builder_.navFix();
  ASSERT_TRUE(fix);
  EXPECT_NEAR(fix->latitude, 42.3618523666667, 1e-12);  // 42 + 21.711142 / 60
  EXPECT_NEAR(fix->longitude, -71.090813, 1e-12);       // 71 + 5.44878 / 60
  EXPECT_EQ(fix->status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
}

// A Heron sends constant 0 for both.
TEST_F(Heron, FloatsAndSeesNoBottom) {
  takeFirstPart(builder_);
  EXPECT_EQ(builder_.depth()->pose.pose.position.z, 0.0);
  EXPECT_FALSE(builder_.altitude());
}

// The accelerations are evidently in g; without acceleration_unit they are taken as documented.
TEST_F(Heron, ImuHasAttitudeRatesAndAccelerations) {
  takeFirstPart(builder_);
  const auto imu = builder_.imu();
  ASSERT_TRUE(imu);
  expectNear(imu->orientation, kQuaternion[0], kQuaternion[1], kQuaternion[2], kQuaternion[3]);
  expectNear(imu->angular_velocity, 0.0, -0.0010635687395803, 0.00106695467832917);
  expectNear(imu->linear_acceleration, -0.026916, -0.104533, 0.932172);
  EXPECT_GE(imu->orientation_covariance[0], 0.0);
  EXPECT_GE(imu->angular_velocity_covariance[0], 0.0);
  EXPECT_GE(imu->linear_acceleration_covariance[0], 0.0);
}

TEST_F(Heron, RawImuIsInBodyAxes) {
  takeFirstPart(builder_);
  const auto imu = builder_.rawImu();
  ASSERT_TRUE(imu);
  expectNear(imu->angular_velocity, -0.00106526170895474, 1.6929693744345e-06, 0.00106526170895474);
  expectNear(imu->linear_acceleration, -0.026916, -0.104533, 0.932172);
}

TEST_F(Heron, RawImuInGIsNearGravity) {
  Parameters in_g = parameters(StampMode::Receive);
  in_g.acceleration_unit = AccelerationUnit::StandardGravity;
  MessageBuilder builder(in_g);
  builder.take(eventOf<vehicle::RawImu>(kRawImu), after(0s));
  EXPECT_NEAR(builder.rawImu()->linear_acceleration.z, 9.1414845438, 1e-9);  // 0.932172 g
}

TEST_F(Heron, VelocityIsEnu) {
  takeFirstPart(builder_);
  expectNear(builder_.navVelocity()->twist.linear, 0.02941, -0.068552, 0.0);
}

// Heading 234.326694, pitch -1.655603, roll -6.628557 degrees.
TEST_F(Heron, CompassCountsAsTheSpecification) {
  const auto compass = builder_.compass(eventOf<vehicle::Compass>(kCompass), after(0s));
  ASSERT_TRUE(compass);
  EXPECT_EQ(compass->header.frame_id, "compass_0_link");
  expectNear(compass->orientation, -0.0039765442461622, 0.059446110344925, -0.949986449856401,
             0.306555202451285);
}

TEST_F(Heron, BatteryHasNoId) {
  const auto battery = builder_.battery(eventOf<vehicle::Battery>(kBattery), after(0s));
  EXPECT_EQ(battery.location, "battery");
  EXPECT_FLOAT_EQ(battery.voltage, 15.091787F);
  ASSERT_EQ(battery.cell_voltage.size(), 2U);
  EXPECT_FLOAT_EQ(battery.cell_voltage[0], 15.091787F);
  EXPECT_FLOAT_EQ(battery.cell_voltage[1], 15.091787F);
}

TEST_F(Heron, GpsFixesAreAboveTheEllipsoid) {
  const auto fix = builder_.gpsFix(eventOf<vehicle::GpsFix>(kGga), after(0s));
  EXPECT_EQ(fix.status.status, sensor_msgs::NavSatStatus::STATUS_FIX);
  EXPECT_NEAR(fix.latitude, 42.361852333333333, 1e-12);  // 42 + 21.71114 / 60
  EXPECT_NEAR(fix.longitude, -71.090813, 1e-12);
  EXPECT_NEAR(fix.altitude, 13.4, 1e-12);  // 46.6 - 33.2
  const auto better = builder_.gpsFix(eventOf<vehicle::GpsFix>(kDifferentialGga), after(0s));
  EXPECT_EQ(better.status.status, sensor_msgs::NavSatStatus::STATUS_SBAS_FIX);
  EXPECT_NEAR(better.altitude, -13.7, 1e-12);  // 19.5 - 33.2
}

// 0.145 kn towards 156.78 is 0.0745944 m/s: what CPNVR tells as 0.02941 east and -0.068552 north.
// 0.021 kn towards 0 is 0.0108033 m/s north.
TEST_F(Heron, GpsVelocitiesAreEnu) {
  const auto velocity = builder_.gpsVelocity(eventOf<vehicle::GpsVelocity>(kRmc), after(0s));
  ASSERT_TRUE(velocity);
  expectNear(velocity->twist.linear, 0.0294098088875156, -0.0685521282176937, 0.0);
  const auto slow = builder_.gpsVelocity(eventOf<vehicle::GpsVelocity>(kSlowRmc), after(0s));
  ASSERT_TRUE(slow);
  expectNear(slow->twist.linear, 0.0, 0.0108033333333333, 0.0);
}

TEST_F(Heron, GpsTimeIsTheReceiversUtc) {
  const auto time = builder_.gpsTime(eventOf<vehicle::GpsVelocity>(kRmc), after(1s));
  ASSERT_TRUE(time);
  EXPECT_EQ(time->time_ref, ros::Time(1420044599));
  EXPECT_EQ(time->header.stamp, ros::Time(1420044600));
}

TEST_F(Heron, StampsOfTheVehicleLeaveOutTheLeapSeconds) {
  MessageBuilder builder(parameters(StampMode::Vehicle));
  takeFirstPart(builder);
  // 16:49:59.006, .063 and 58.858 less 18 s; the fix is UTC as it is.
  EXPECT_EQ(builder.odometry()->header.stamp, ros::Time(1420044581, 6000000));
  EXPECT_EQ(builder.imu()->header.stamp, ros::Time(1420044581, 63000000));
  EXPECT_EQ(builder.rawImu()->header.stamp, ros::Time(1420044580, 858000000));
  EXPECT_EQ(builder.gpsFix(eventOf<vehicle::GpsFix>(kGga), after(0s)).header.stamp,
            ros::Time(1420044599));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
