#include "frontseat_driver/sim/sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "frontseat_driver/sim/geography.h"
#include "frontseat_driver/sim/torpedo.h"

namespace frontseat_driver::sim {
namespace {

Torpedo at(double east_m, double north_m) {
  Start start;
  start.east_m = east_m;
  start.north_m = north_m;
  return {Environment{}, start, BatteryType{}};
}

TEST(Sensors, WithoutNoiseReadTheTruth) {
  const Torpedo vehicle = at(12.0, -7.0);
  Sensors sensors{Random{1}, false};
  const Sensors::Reading reading = sensors.read(vehicle, 0.1);
  EXPECT_EQ(reading.state.east_m, 12.0);
  EXPECT_EQ(reading.position, vehicle.position());
}

TEST(Sensors, WithNoiseErrABitAndNeverBelowZeroDepth) {
  const Torpedo vehicle = at(12.0, -7.0);
  Sensors sensors{Random{1}, true};
  double squares = 0.0;
  double farthest = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const Sensors::Reading reading = sensors.read(vehicle, 0.1);
    squares += reading.state.velocity_east_m_s * reading.state.velocity_east_m_s;
    farthest = std::max(farthest, std::abs(reading.state.east_m - 12.0));
    ASSERT_GE(reading.state.depth_m, 0.0);
    ASSERT_GE(reading.state.heading_rad, 0.0);
  }
  EXPECT_NEAR(std::sqrt(squares / 10000.0), 0.02, 0.001);
  EXPECT_GT(farthest, 0.2);
  EXPECT_LT(farthest, 3.0);
}

TEST(RandomNumbers, AreThoseOfTheSeedAndTheStream) {
  Random a{7, 1};
  Random b{7, 1};
  Random other{7, 2};
  const double first = a.uniform();
  EXPECT_EQ(first, b.uniform());
  EXPECT_NE(first, other.uniform());
}

TEST(RandomNumbers, AreTheSameEverywhere) {
  // mt19937_64 of seed 5489 begins with 14514284786278117030; its upper 53 bits, by 2^53.
  EXPECT_DOUBLE_EQ(Random{5489}.uniform(), 14514284786278117030.0 / 18446744073709551616.0);
}

}  // namespace
}  // namespace frontseat_driver::sim
