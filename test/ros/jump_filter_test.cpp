#include "jump_filter.h"

#include <gtest/gtest.h>

#include <chrono>

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using vehicle::Position;
using vehicle::SteadyTime;

// One minute of latitude is 1852 m within 0.3 % at this place; a degree 111 km.
constexpr double kMetresPerDegree = 111000.0;
constexpr double kMaxSpeed = 50.0;

Position north(double meters) { return {42.0 + meters / kMetresPerDegree, -71.0}; }

SteadyTime at(std::chrono::milliseconds time) { return SteadyTime{} + time; }

TEST(JumpFilter, BelievesTheFirstPosition) {
  JumpFilter filter(kMaxSpeed);
  EXPECT_FALSE(filter.last());
  EXPECT_TRUE(filter.accept(north(0), at(0s)));
  EXPECT_EQ(filter.last()->latitude_deg, 42.0);
}

TEST(JumpFilter, AllowsWhatTheSpeedAllows) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  EXPECT_TRUE(filter.accept(north(98), at(2s)));
  EXPECT_FALSE(filter.accept(north(98 + 102), at(4s)));
  EXPECT_EQ(filter.jumps(), 1U);
  EXPECT_NEAR(filter.latestJump_m(), 102.0, 0.5);
}

TEST(JumpFilter, CountsTimeFromTheLastAcceptedPosition) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  EXPECT_FALSE(filter.accept(north(300), at(2s)));
  EXPECT_TRUE(filter.accept(north(300), at(7s)));
}

TEST(JumpFilter, TakesABundleForATenthOfASecond) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  EXPECT_TRUE(filter.accept(north(4.9), at(0s)));
  EXPECT_FALSE(filter.accept(north(4.9 + 5.1), at(0s)));
}

TEST(JumpFilter, DropsOneOutlierAndGoesOn) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  EXPECT_FALSE(filter.accept({0.0, 10.0}, at(200ms)));
  EXPECT_TRUE(filter.accept(north(1), at(400ms)));
  EXPECT_EQ(filter.jumps(), 1U);
}

TEST(JumpFilter, BelievesTheFifthInARow) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  for (int i = 1; i <= 4; ++i) EXPECT_FALSE(filter.accept(north(5000 + i), at(i * 200ms))) << i;
  EXPECT_TRUE(filter.accept(north(5005), at(1s)));
  EXPECT_EQ(filter.jumps(), 4U);
  EXPECT_TRUE(filter.accept(north(5006), at(1200ms)));
}

TEST(JumpFilter, CountsARowAnewAfterTheFifth) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  for (int i = 1; i <= 5; ++i) filter.accept(north(5000), at(i * 10ms));
  EXPECT_FALSE(filter.accept(north(0), at(100ms)));
}

TEST(JumpFilter, CountsARowAnewAfterAGoodPosition) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  for (int i = 1; i <= 4; ++i) filter.accept(north(5000), at(i * 10ms));
  EXPECT_TRUE(filter.accept(north(1), at(100ms)));
  EXPECT_FALSE(filter.accept(north(5000), at(200ms)));
  EXPECT_EQ(filter.jumps(), 5U);
}

TEST(JumpFilter, IsNotMisledByTheDateLine) {
  JumpFilter filter(kMaxSpeed);
  filter.accept({-17.0, 179.99999}, at(0s));
  EXPECT_TRUE(filter.accept({-17.0, -179.99999}, at(200ms)));
}

TEST(JumpFilter, ForgetsThePlaceButNotTheCount) {
  JumpFilter filter(kMaxSpeed);
  filter.accept(north(0), at(0s));
  filter.accept(north(5000), at(200ms));
  filter.reset();
  EXPECT_FALSE(filter.last());
  EXPECT_TRUE(filter.accept(north(-5000), at(0s)));
  EXPECT_EQ(filter.jumps(), 1U);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
