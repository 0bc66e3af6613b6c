#include "frontseat_driver/sim/rov.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kDt = 0.01;

Rov deepRov(double heading_deg, double buoyancy_n = 0.0, double drift_m_s = 0.0) {
  Environment water;
  water.bottom_depth_m = 200.0;
  water.current_drift_m_s = drift_m_s;
  water.current_set_deg = 90.0;
  Start start;
  start.heading_deg = heading_deg;
  return {water, start, BatteryType{}, buoyancy_n};
}

void run(Rov& rov, double s) {
  for (double passed = 0.0; passed < s; passed += kDt) rov.step(kDt);
}

struct Push {
  const char* name;
  RovAxes effort;
  double heading_deg;
  double north, east, down;  ///< m/s in the end
  double yaw;                ///< rad/s
};

// Full force and resistance balance at the top speed of each axis.
const Push kPushes[] = {{"forward_bow_north", {1, 0, 0, 0, 0, 0}, 0.0, 1.5, 0.0, 0.0, 0.0},
                        {"forward_bow_east", {1, 0, 0, 0, 0, 0}, 90.0, 0.0, 1.5, 0.0, 0.0},
                        {"astern_bow_north", {-1, 0, 0, 0, 0, 0}, 0.0, -1.5, 0.0, 0.0, 0.0},
                        {"right_bow_north", {0, 1, 0, 0, 0, 0}, 0.0, 0.0, 0.7, 0.0, 0.0},
                        {"right_bow_east", {0, 1, 0, 0, 0, 0}, 90.0, -0.7, 0.0, 0.0, 0.0},
                        {"right_bow_south", {0, 1, 0, 0, 0, 0}, 180.0, 0.0, -0.7, 0.0, 0.0},
                        {"down", {0, 0, 1, 0, 0, 0}, 0.0, 0.0, 0.0, 0.7, 0.0},
                        {"clockwise", {0, 0, 0, 1, 0, 0}, 0.0, 0.0, 0.0, 0.0, 1.8},
                        {"counter_clockwise", {0, 0, 0, -1, 0, 0}, 0.0, 0.0, 0.0, 0.0, -1.8},
                        {"limited", {7, 0, 0, 0, 0, 0}, 0.0, 1.5, 0.0, 0.0, 0.0}};

class Pushed : public testing::TestWithParam<Push> {};

TEST_P(Pushed, GoesThereAndNowhereElse) {
  Rov rov = deepRov(GetParam().heading_deg);
  rov.command(GetParam().effort);
  run(rov, 20.0);
  EXPECT_NEAR(rov.state().velocity_north_m_s, GetParam().north, 0.01);
  EXPECT_NEAR(rov.state().velocity_east_m_s, GetParam().east, 0.01);
  EXPECT_NEAR(rov.state().velocity_down_m_s, GetParam().down, 0.01);
  EXPECT_NEAR(rov.state().yaw_rate_rad_s, GetParam().yaw, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Table, Pushed, testing::ValuesIn(kPushes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Rov, HasInertia) {
  Rov rov = deepRov(0.0);
  rov.command({1, 0, 0, 0, 0, 0});
  run(rov, 0.1);
  EXPECT_GT(rov.state().surge_m_s, 0.0);
  EXPECT_LT(rov.state().surge_m_s, 0.3);
  run(rov, 10.0);
  rov.command({});
  run(rov, 0.5);
  EXPECT_GT(rov.state().surge_m_s, 0.2);
  run(rov, 30.0);
  EXPECT_NEAR(rov.state().surge_m_s, 0.0, 0.01);
}

TEST(Rov, RollsToStarboardAndPitchesUpByPositiveEffortAndRightsItself) {
  Rov rov = deepRov(0.0);
  rov.command({0, 0, 0, 0, 1, 0});
  run(rov, 10.0);
  EXPECT_NEAR(rov.state().roll_rad, Rov::kLean_rad, 1e-3);
  EXPECT_NEAR(rov.state().pitch_rad, 0.0, 1e-3);
  rov.command({0, 0, 0, 0, 0, 1});
  run(rov, 10.0);
  EXPECT_NEAR(rov.state().roll_rad, 0.0, 1e-3);
  EXPECT_NEAR(rov.state().pitch_rad, Rov::kLean_rad, 1e-3);
  rov.command({});
  run(rov, 10.0);
  EXPECT_NEAR(rov.state().pitch_rad, 0.0, 1e-3);
}

TEST(Rov, ComesUpWhenNothingHoldsItDownAndStaysAtTheSurface) {
  Rov rov = deepRov(0.0, 0.5);
  rov.command({0, 0, 1, 0, 0, 0});
  run(rov, 5.0);
  const double deep = rov.state().depth_m;
  EXPECT_GT(deep, 2.0);
  rov.command({});
  run(rov, 60.0);
  EXPECT_LT(rov.state().depth_m, deep);
  run(rov, 300.0);
  EXPECT_NEAR(rov.state().depth_m, 0.0, 0.01);
  EXPECT_NEAR(rov.state().velocity_down_m_s, 0.0, 0.01);
}

TEST(Rov, DriftsWithTheCurrent) {
  Rov rov = deepRov(0.0, 0.0, 0.3);
  run(rov, 10.0);
  EXPECT_NEAR(rov.state().east_m, 3.0, 0.05);
  EXPECT_NEAR(rov.state().north_m, 0.0, 1e-6);
  EXPECT_NEAR(rov.state().surge_m_s, 0.0, 1e-9);
}

TEST(Rov, DrainsItsBatteryFasterWhenItWorksAndLeavesOffWhenItIsEmpty) {
  BatteryType small;
  small.capacity_wh = 1.0;
  Rov idle{Environment{}, Start{}, small, 0.0};
  Rov busy{Environment{}, Start{}, small, 0.0};
  busy.command({1, 0, 0, 0, 0, 0});
  run(idle, 10.0);
  run(busy, 10.0);
  EXPECT_LT(busy.batteryFraction(), idle.batteryFraction());
  EXPECT_LT(idle.batteryFraction(), 1.0);
  run(busy, 60.0);
  EXPECT_EQ(busy.batteryFraction(), 0.0);
  EXPECT_NEAR(busy.state().surge_m_s, 0.0, 0.01);
}

}  // namespace
}  // namespace frontseat_driver::sim
