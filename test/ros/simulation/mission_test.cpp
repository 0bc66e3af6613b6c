#include <gtest/gtest.h>

#include <cstdint>

#include "runs.h"

// A part of `make simulate`, with more happening in less time. A failure names its seed; replay it
// with: mission_simulation --seed=N --dialect=... --hours=0.15 --pace=5

namespace frontseat_driver::simulation {
namespace {

using protocol::Dialect;

Runs someRuns() {
  Runs runs;
  runs.count = 150;
  runs.hours = 0.15;
  runs.pace = 5.0;
  return runs;
}

class MissionTest : public testing::TestWithParam<Dialect> {};

TEST_P(MissionTest, KeepsEveryPromiseWhateverHappens) {
  Runs runs = someRuns();
  runs.dialect = GetParam();
  Totals totals;
  const auto failure = makeRuns(runs, totals, nullptr);
  ASSERT_FALSE(failure) << "seed " << failure->seed << ": " << failure->broken << "\n"
                        << describe(shrunk(*failure));
  EXPECT_EQ(totals.runs, runs.count);
  EXPECT_GT(totals.driver.commands_sent, 20000U);
  EXPECT_GT(totals.truth.positions, 20000U);
  EXPECT_GT(totals.connects, 1000U);
  for (std::size_t i = 0; i < kKinds; ++i) {
    EXPECT_GT(totals.happened[i], 10U) << nameOf(static_cast<Kind>(i));
  }
}

TEST_P(MissionTest, ASeedIsTheSameRunAgain) {
  Mission once{planFor(7, GetParam(), 0.1, 5.0)};
  Mission again{planFor(7, GetParam(), 0.1, 5.0)};
  Mission another{planFor(8, GetParam(), 0.1, 5.0)};
  EXPECT_EQ(once.run() + again.run() + another.run(), "");
  EXPECT_EQ(once.totals().digest, again.totals().digest);
  EXPECT_NE(once.totals().digest, another.totals().digest);
}

INSTANTIATE_TEST_SUITE_P(Dialects, MissionTest,
                         testing::Values(Dialect::Sandshark, Dialect::Kingfisher),
                         [](const auto& row) { return protocol::toString(row.param); });

// A loop that does what no driver may do is noticed.
TEST(MissionModel, NoticesACommandThatNobodyGave) {
  const Plan plan = planFor(2, Dialect::Kingfisher, 0.01);
  closed_loop::ClosedLoop loop{plan.parameters, plan.kingfisher};
  closed_loop::Supervised supervised{loop, plan.parameters, Dialect::Kingfisher};
  supervised.connect();
  loop.pass(std::chrono::seconds{5});
  ASSERT_EQ(supervised.broken(), "");
  loop.publish(closed_loop::drive(0.5, 0.5));  // past the model
  EXPECT_NE(supervised.broken(), "");
}

TEST(MissionModel, LeavesOutWhatAFailureDoesNotNeed) {
  const Plan plan = shrunk({3, Dialect::Sandshark, 0.05, 5.0, "nothing was broken"});
  EXPECT_EQ(plan.actions.size(), planFor(3, Dialect::Sandshark, 0.05, 5.0).actions.size());
}

}  // namespace
}  // namespace frontseat_driver::simulation
