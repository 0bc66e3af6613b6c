#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bench.h"
#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

SandsharkConfig waiting() {
  SandsharkConfig config = runningSandshark();
  config.mission.ready_s = 1e6;
  return config;
}

TEST(SandsharkConnection, BeginsWithTheVersionAndNothingElse) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.run(5.0);
  EXPECT_THAT(bench.heard(1), ElementsAre("$BFVER,120000.000,SS_0.0*29"));
}

TEST(SandsharkConnection, IsForgottenWhenItEnds) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(1.0);
  bench.frontseat().clientDisconnected(1);
  bench.heard(1);
  bench.run(1.0);
  EXPECT_THAT(bench.heard(1), IsEmpty());
  bench.connect(2);
  bench.run(1.0);
  EXPECT_THAT(bench.heard(2), ElementsAre(StartsWith("$BFVER")));
}

struct Subscription {
  const char* sentence;
  std::size_t in_ten_seconds;
};
class Logged : public testing::TestWithParam<Subscription> {};

TEST_P(Logged, IsSentAtItsRateFromThenOnUntilTurnedOff) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.run(0.05);
  bench.tell(1, std::string{"BPLOG,"} + GetParam().sentence + ",ON");
  bench.heard(1);
  bench.run(10.0);
  const auto heard = bench.heard(1);
  EXPECT_THAT(heard, SizeIs(GetParam().in_ten_seconds));
  EXPECT_THAT(heard, testing::Each(StartsWith(std::string{"$BF"} + GetParam().sentence + ",")));
  bench.tell(1, std::string{"BPLOG,"} + GetParam().sentence + ",OFF");
  bench.run(10.0);
  EXPECT_THAT(bench.heard(1), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Table, Logged,
                         testing::Values(Subscription{"NVG", 100}, Subscription{"NVR", 100},
                                         Subscription{"DVL", 10}, Subscription{"CTD", 10},
                                         Subscription{"RVL", 10}, Subscription{"SVS", 10}),
                         [](const auto& row) { return std::string{row.param.sentence}; });

TEST(SandsharkLogging, AllIsEverythingButAcknowledgements) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.tell(1, "BPLOG,ALL,ON");
  bench.tell(1, "BPSTS,120000.000,1,fine");
  bench.run(1.0);
  const auto heard = bench.heardBytes(1);
  for (const char* sentence :
       {"$BFNVG", "$BFNVR", "$BFMIS", "$BFDVL", "$BFCTD", "$BFRVL", "$BFSVS"}) {
    EXPECT_NE(heard.find(sentence), std::string::npos) << sentence;
  }
  EXPECT_EQ(heard.find("$BFACK"), std::string::npos);
}

TEST(SandsharkLogging, AllOffLeavesAcknowledgementsOn) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.tell(1, "BPLOG,ACK,ON");
  bench.tell(1, "BPLOG,ALL,OFF");
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFACK"), SizeIs(1));
}

TEST(SandsharkLogging, IsEachClientsOwn) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.connect(2);
  bench.connect(3);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.tell(2, "BPLOG,NVR,ON");
  bench.run(1.05);
  EXPECT_THAT(bench.heard(1, "BFNV"), SizeIs(11));
  EXPECT_THAT(bench.heard(2, "BFNV"), testing::Each(StartsWith("$BFNVR")));
  EXPECT_THAT(bench.heard(3, "BFNV"), IsEmpty());
}

TEST(SandsharkLogging, ASetRateIsKept) {
  SandsharkConfig config = waiting();
  config.rates = {{"NVG", 4.0}, {"NVR", 0.0}, {"SVS", 7.0}};
  Bench bench{config};
  bench.connect(1);
  bench.run(0.1);
  bench.tell(1, "BPLOG,ALL,ON");
  bench.heard(1);
  bench.run(10.0);
  const auto heard = bench.heard(1);
  const auto count = [&](const char* start) {
    return std::count_if(heard.begin(), heard.end(),
                         [&](const auto& line) { return line.rfind(start, 0) == 0; });
  };
  EXPECT_EQ(count("$BFNVG"), 40);
  EXPECT_EQ(count("$BFNVR"), 0);
  EXPECT_NEAR(static_cast<double>(count("$BFSVS")), 70.0, 1.0);
}

TEST(SandsharkLogging, AThousandHertzAreWholeMilliseconds) {
  SandsharkConfig config = waiting();
  config.rates = {{"NVR", 1000.0}};
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVR,ON");
  bench.run(0.01);
  const auto heard = bench.heard(1, "BFNVR");
  ASSERT_THAT(heard, SizeIs(11));
  EXPECT_THAT(heard[3], StartsWith("$BFNVR,120000.003,"));
}

TEST(SandsharkNavigation, TellsTheTruthWithoutNoise) {
  SandsharkConfig config = waiting();
  config.environment.datum = {42.36, -71.11};
  config.start = {0.0, 0.0, 90.0};
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(0.05);
  // 0.36 degrees are 21.6 minutes, 0.11 are 6.6; the grid heading is the true one + 1.4217.
  EXPECT_THAT(bench.heard(1, "BFNVG"),
              ElementsAre(StartsWith("$BFNVG,120000.010,4221.600000,N,07106.600000,W,1,20.000,"
                                     "0.000,91.42")));
  EXPECT_EQ(bench.truths.at(0).stamp, kNoon);
  EXPECT_NEAR(bench.truths.at(0).state.heading_rad, kPi / 2.0, 1e-12);
}

TEST(SandsharkNavigation, HasItsSolutionTimeAtTheEndAndTheTruthOfThatInstant) {
  Bench bench{runningSandshark()};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(60.01);
  const auto heard = bench.heard(1, "BFNVG");
  ASSERT_THAT(heard, SizeIs(601));
  const auto last = fields(heard.back());
  EXPECT_EQ(last[1], "120100.010");
  EXPECT_EQ(last[12], "120100.000");
  const Truth& truth = bench.truths.back();
  EXPECT_EQ(truth.stamp, kNoon + std::chrono::seconds{60});
  EXPECT_NEAR(42.0 + std::stod(last[2].substr(2)) / 60.0, truth.position.latitude_deg, 1e-8);
  EXPECT_NEAR(std::stod(last[8]), truth.state.depth_m, 5e-4);
  EXPECT_NEAR(std::stod(last[11]), degrees(truth.state.pitch_rad), 5e-5);
  EXPECT_GT(truth.state.north_m, 60.0);
}

TEST(SandsharkNavigation, HasGpsAtTheSurfaceOnly) {
  SandsharkConfig config = runningSandshark();
  config.mission.legs[0].vertical_m = 3.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(0.1);
  EXPECT_EQ(fields(bench.heard(1, "BFNVG").back())[6], "1");
  bench.run(60.0);
  EXPECT_EQ(fields(bench.heard(1, "BFNVG").back())[6], "0");
}

TEST(SandsharkNavigation, IsBlankBeforeTheFirstFix) {
  SandsharkConfig config = waiting();
  config.first_fix_s = 2.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(1.0);
  EXPECT_THAT(bench.heard(1, "BFNVG").back(), testing::HasSubstr(",,,,,0,20.000,"));
  bench.run(2.0);
  EXPECT_THAT(bench.heard(1, "BFNVG").back(), testing::HasSubstr(",N,07105"));
}

TEST(SandsharkNavigation, AltitudeIsZeroWithoutBottom) {
  SandsharkConfig config = waiting();
  config.altimeter_range_m = 10.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(0.1);
  EXPECT_EQ(fields(bench.heard(1, "BFNVG").back())[7], "0.000");
}

TEST(SandsharkNavigation, VelocityIsThatOfTheSameInstant) {
  Bench bench{runningSandshark()};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVR,ON");
  bench.run(20.0);
  const auto last = fields(bench.heard(1, "BFNVR").back());
  EXPECT_EQ(last[1], "120020.000");
  const VehicleState& state = bench.truths.back().state;
  EXPECT_NEAR(std::stod(last[2]), state.velocity_east_m_s, 5e-5);
  EXPECT_NEAR(std::stod(last[3]), state.velocity_north_m_s, 5e-5);
  EXPECT_NEAR(std::stod(last[4]), state.velocity_down_m_s, 5e-5);
  EXPECT_NEAR(std::stod(last[5]), degrees(state.pitch_rate_rad_s), 5e-5);
  EXPECT_NEAR(std::stod(last[6]), degrees(state.roll_rate_rad_s), 5e-5);
  EXPECT_NEAR(std::stod(last[7]), degrees(state.yaw_rate_rad_s), 5e-5);
}

TEST(SandsharkClock, IsAheadAndGainsAsToldInSentencesAndTruth) {
  SandsharkConfig config = waiting();
  config.clock_offset_s = 18018.0;
  config.clock_drift_ppm = 50.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVR,ON");
  bench.run(100.0);
  // 5 h 0 min 18 s ahead and 5 ms gained.
  EXPECT_THAT(bench.heard(1, "BFNVR").back(), StartsWith("$BFNVR,170158.005,"));
  EXPECT_EQ(bench.truths.back().stamp, kNoon + std::chrono::milliseconds{18118005});
}

TEST(SandsharkClock, GoesThroughMidnight) {
  SandsharkConfig config = waiting();
  config.start_time = kNoon + std::chrono::hours{12} - std::chrono::milliseconds{100};
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,NVR,ON");
  bench.run(0.1);
  const auto heard = bench.heard(1, "BFNVR");
  EXPECT_THAT(heard.front(), StartsWith("$BFNVR,235959.900,"));
  EXPECT_THAT(heard.back(), StartsWith("$BFNVR,000000.000,"));
}

TEST(SandsharkShutdown, IsToldToEveryClient) {
  Bench bench{waiting()};
  bench.connect(1);
  bench.connect(2);
  bench.run(1.0);
  bench.sandshark().announceShutdown();
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFSHT"), ElementsAre(StartsWith("$BFSHT,120001.000*")));
  EXPECT_THAT(bench.heard(2, "BFSHT"), SizeIs(1));
}

TEST(SandsharkSensors, ExtraSentencesFollowTheMotion) {
  SandsharkConfig config = runningSandshark();
  config.mission.legs[0].vertical_m = 5.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "BPLOG,ALL,ON");
  bench.run(60.0);
  const auto heard = bench.heard(1);
  const auto last = [&](const char* start) {
    return fields(*std::find_if(heard.rbegin(), heard.rend(),
                                [&](const auto& line) { return line.rfind(start, 0) == 0; }));
  };
  EXPECT_NEAR(std::stod(last("$BFDVL")[2]), 1.5, 0.01);             // along the bow
  EXPECT_NEAR(std::stod(last("$BFDVL")[5]), 15.0 / 0.866025, 0.1);  // 30 degrees off the vertical
  EXPECT_NEAR(std::stod(last("$BFCTD")[4]), 101.325 + 49.03, 1.0);  // 5 m of fresh water
  EXPECT_NEAR(std::stod(last("$BFRVL")[2]), 750.0, 5.0);
}

TEST(SandsharkDeterminism, TheSameSeedGivesTheSameBytes) {
  const auto record = [](std::uint64_t seed) {
    SandsharkConfig config = runningSandshark();
    config.noise = true;
    config.seed = seed;
    config.faults.drop = 0.05;
    config.faults.corrupt = 0.05;
    config.faults.split = true;
    Bench bench{config};
    bench.connect(1);
    bench.tell(1, "BPLOG,ALL,ON");
    bench.run(60.0);
    return bench.heardBytes(1);
  };
  const std::string first = record(3);
  EXPECT_EQ(first, record(3));
  EXPECT_NE(first, record(4));
  EXPECT_GT(first.size(), 50000U);
}

}  // namespace
}  // namespace frontseat_driver::sim
