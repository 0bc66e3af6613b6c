#include "frontseat_driver/sim/mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

SandsharkConfig survey() {
  SandsharkConfig config;
  config.start_time = kNoon;
  config.noise = false;
  return config;
}

TEST(LawnMower, GoesToAndFroBelowTheSurfaceAndTransitsOnIt) {
  Survey wanted;
  wanted.lines = 2;
  wanted.length_m = 40.0;
  wanted.spacing_m = 10.0;
  wanted.depth_m = 3.0;
  const std::vector<Leg> legs = lawnMower(wanted);
  ASSERT_THAT(legs, SizeIs(4));
  const double expected[][3] = {{15, -20, 0}, {15, 20, 3}, {25, 20, 0}, {25, -20, 3}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(legs[i].to.east_m, expected[i][0]);
    EXPECT_DOUBLE_EQ(legs[i].to.north_m, expected[i][1]);
    EXPECT_DOUBLE_EQ(legs[i].vertical_m, expected[i][2]);
  }
}

TEST(SurveyMission, RunsThroughItsStatesAndStartsOver) {
  Bench bench{survey()};
  bench.connect(1);
  bench.tell(1, "BPLOG,MIS,ON");
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Completed; }, 1200.0));
  bench.run(20.0);
  std::vector<std::string> statuses;
  for (const std::string& line : bench.heard(1, "BFMIS")) statuses.push_back(fields(line)[3]);
  EXPECT_THAT(statuses, ElementsAre("Ready", "Running /logs/dive_0001", "WrappingUp", "Completed",
                                    "Ready", "Running /logs/dive_0002"));
}

TEST(SurveyMission, DivesOnEveryLineAndFollowsIt) {
  Bench bench{survey()};
  bench.connect(1);
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Running; }, 10.0));
  int dives = 0;
  double off_track_m = 0.0;
  for (bool under = false; bench.sandshark().mission().state() == Mission::State::Running;) {
    bench.run(0.1);
    const double depth_m = bench.state().depth_m;
    if (!under && depth_m > 3.8) ++dives;
    under = depth_m > 3.8 || (under && depth_m > 1.0);
    if (depth_m > 3.8 && std::abs(bench.state().north_m) < 10.0) {
      const double line_m = 15.0 + 12.0 * std::round((bench.state().east_m - 15.0) / 12.0);
      off_track_m = std::max(off_track_m, std::abs(bench.state().east_m - line_m));
    }
  }
  EXPECT_EQ(dives, 4);
  EXPECT_LT(off_track_m, 1.5);
}

TEST(SurveyMission, EndsAtTheDatumOnTheSurface) {
  SandsharkConfig config = survey();
  config.mission.loop = false;
  Bench bench{config};
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Completed; }, 1200.0));
  EXPECT_LT(std::hypot(bench.state().east_m, bench.state().north_m), 3.5);
  EXPECT_LT(bench.state().depth_m, 0.3);
  bench.run(100.0);
  EXPECT_EQ(bench.sandshark().mission().state(), Mission::State::Completed);
  bench.sandshark().restartMission();
  bench.run(6.0);
  EXPECT_EQ(bench.sandshark().mission().state(), Mission::State::Running);
}

TEST(SurveyMission, HandsControlOverWhileItRunsOnly) {
  Bench bench{survey()};
  bench.connect(1);
  bench.tell(1, "BPLOG,CTL,ON");
  bench.run(4.9);
  EXPECT_THAT(bench.heard(1, "BFCTL"), testing::IsEmpty());
  bench.run(0.2);
  EXPECT_THAT(bench.heard(1, "BFCTL"), ElementsAre(HasSubstr(",1*")));
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::WrappingUp; }, 1200.0));
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFCTL"), ElementsAre(HasSubstr(",0*")));
}

TEST(SurveyMission, NeverHandsControlOverUnlessItMay) {
  SandsharkConfig config = survey();
  config.allow_dynamic_requests = false;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,CTL,ON");
  bench.run(60.0);
  EXPECT_THAT(bench.heard(1, "BFCTL"), testing::IsEmpty());
}

TEST(SurveyMission, TellsOfItsBehaviors) {
  SandsharkConfig config = survey();
  config.mission.legs = {{{0.0, 20.0}, 0.0, Setpoint::VerticalMode::Depth, 1.5},
                         {{0.0, 40.0}, 0.0, Setpoint::VerticalMode::Depth, 1.5}};
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,MBS,ON");
  bench.tell(1, "BPLOG,MBE,ON");
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::WrappingUp; }, 200.0));
  bench.run(0.01);
  EXPECT_THAT(bench.heard(1, "BFMB"), ElementsAre(HasSubstr("MBS,"), HasSubstr("MBE,"),
                                                  HasSubstr("MBS,"), HasSubstr("MBE,")));
}

TEST(SurveyMission, GoesOnWhereThePayloadLeftIt) {
  Bench bench{survey()};
  bench.connect(1);
  bench.run(30.0);
  const std::size_t leg = bench.sandshark().mission().leg();
  for (int i = 0; i < 60; ++i) {
    bench.tell(1, "BPRMB,120000.000,270,,,,,0");
    bench.run(1.0);
  }
  EXPECT_EQ(bench.sandshark().mission().leg(), leg);
  EXPECT_LT(bench.state().east_m, -20.0);
  EXPECT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Completed; }, 1500.0));
}

TEST(SurveyMission, WithoutLegsWrapsUpAtOnce) {
  SandsharkConfig config = survey();
  config.mission.legs.clear();
  Bench bench{config};
  bench.run(5.2);
  EXPECT_EQ(bench.sandshark().mission().state(), Mission::State::Completed);
}

TEST(SurveyMission, AgainstACurrentStillFinishes) {
  SandsharkConfig config = survey();
  config.environment.current_set_deg = 60.0;
  config.environment.current_drift_m_s = 0.4;
  Bench bench{config};
  EXPECT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Completed; }, 1800.0));
}

}  // namespace
}  // namespace frontseat_driver::sim
