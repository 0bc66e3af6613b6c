#include <gtest/gtest.h>

#include "mission.h"
#include "seeds.h"

// A part of `make simulate`. A failure names its seed; replay it with:
// blueye_mission_simulation --seed=N --hours=0.03 --pace=5 --verbose

namespace frontseat_driver::blueye_simulation {
namespace {

constexpr double kHours = 0.03;
constexpr double kPace = 5.0;

TEST(BlueyeMission, KeepsEveryPromiseWhateverHappens) {
  constexpr std::uint64_t kSeeds = 150;
  Totals totals;
  const auto broken = simulation::firstBroken(1, kSeeds, 1, [&](std::uint64_t seed) {
    Mission mission{planFor(seed, kHours, kPace)};
    const std::string found = mission.run();
    totals.add(mission.totals());
    return found;
  });
  ASSERT_FALSE(broken) << "seed " << broken->seed << ": " << broken->broken;
  EXPECT_EQ(totals.runs, kSeeds);
  EXPECT_GT(totals.seen.motions, 10000U);
  EXPECT_GT(totals.seen.gains, 500U);
  EXPECT_GT(totals.connects, 300U);
  for (std::size_t i = 0; i < kKinds; ++i) {
    EXPECT_GT(totals.happened[i], 10U) << nameOf(static_cast<Kind>(i));
  }
}

TEST(BlueyeMission, ASeedIsTheSameRunAgain) {
  Mission once{planFor(7, kHours, kPace)};
  Mission again{planFor(7, kHours, kPace)};
  Mission another{planFor(8, kHours, kPace)};
  EXPECT_EQ(once.run() + again.run() + another.run(), "");
  EXPECT_EQ(once.totals().digest, again.totals().digest);
  EXPECT_NE(once.totals().digest, another.totals().digest);
}

// The model has no part of the session in it.
TEST(BlueyeMission, NoticesACommandThatNobodyGave) {
  vehicle::Now now;
  Promises promises{[&] { return now; }, {}};
  promises.connected();
  promises.control("blueye.protocol.MotionInputCtrl", {});
  EXPECT_NE(promises.broken(), "");
}

}  // namespace
}  // namespace frontseat_driver::blueye_simulation
