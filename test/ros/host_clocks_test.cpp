#include "host_clocks.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include "convert.h"

namespace frontseat_driver::ros_layer {
namespace {

/// Puts the ROS clock back as it was.
class HostClock : public testing::Test {
 protected:
  void TearDown() override { ros::Time::init(); }
};

TEST_F(HostClock, StampIsTheSystemClock) {
  ros::Time::init();
  HostClocks clocks;
  const ros::Time before = ros::Time::now();
  const vehicle::Now now = clocks.read();
  EXPECT_GE(now.stamp, toUtcTime(before));
  EXPECT_LE(now.stamp, toUtcTime(ros::Time::now()));
  EXPECT_EQ(now.stamp, now.utc) << "two readings would differ, and a record holds one";
}

TEST_F(HostClock, StampIsTheSimulatedClockAndUtcIsNot) {
  HostClocks clocks;
  ros::Time::setNow(ros::Time{100, 5});
  const vehicle::Now now = clocks.read();
  EXPECT_EQ(toRosTime(now.stamp), ros::Time(100, 5));
  EXPECT_GT(now.utc, std::chrono::hours{24 * 365});
}

TEST_F(HostClock, StampsNeverGoBack) {
  HostClocks clocks;
  ros::Time::setNow(ros::Time{100});
  const vehicle::Now before = clocks.read();
  ros::Time::setNow(ros::Time{40});
  const vehicle::Now after = clocks.read();
  EXPECT_EQ(after.stamp, before.stamp);
  EXPECT_GE(after.steady, before.steady);
  EXPECT_EQ(clocks.simulatedBehind(), std::chrono::seconds{60});
  ros::Time::setNow(ros::Time{101});
  EXPECT_EQ(toRosTime(clocks.read().stamp), ros::Time(101));
  EXPECT_EQ(clocks.simulatedBehind(), std::chrono::seconds{0});
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
