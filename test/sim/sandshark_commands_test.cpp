#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bench.h"
#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/geography.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

/// A vehicle under way at the surface to the north, with one client that wants acknowledgements.
class SandsharkCommands : public testing::Test {
 protected:
  explicit SandsharkCommands(const SandsharkConfig& config = runningSandshark()) : bench(config) {
    bench.connect(1);
    bench.tell(1, "BPLOG,ACK,ON");
    bench.run(1.0);
    bench.heard(1);
  }

  /// Repeats one command every half second.
  void repeat(const std::string& body, double s) {
    for (double t = 0.0; t < s; t += 0.5) {
      bench.tell(1, body);
      bench.run(0.5);
    }
  }

  double trueHeading() const { return degrees(bench.state().heading_rad); }
  double convergence() { return gridConvergenceDeg(bench.sandshark().model().position()); }

  Bench bench;
};

struct Acked {
  const char* name;
  const char* body;
  const char* answer;  ///< from the name of the command up to the status
};

const Acked kAcked[] = {
    {"version", "BPVER,115959.123,0.1", "VER,115959.123,,2"},
    {"status", "BPSTS,115959.123,1,all fine", "STS,115959.123,,2"},
    {"log", "BPLOG,NVG,ON", "LOG,,,2"},
    {"log_unknown", "BPLOG,XYZ,ON", "LOG,,,0"},
    {"log_neither_on_nor_off", "BPLOG,NVG,MAYBE", "LOG,,,0"},
    {"unknown_command", "BPTOP,115959.123,hello", "TOP,115959.123,,0"},
    {"depth", "BPRMB,115959.123,,5,0,,,", "RMB,115959.123,,2"},
    {"everything", "BPRMB,115959.123,90,5,0,700,0,0", "RMB,115959.123,,2"},
    {"nothing", "BPRMB,115959.123,,,,,,", "RMB,115959.123,,2"},
    {"finer_time", "BPRMB,115959.123456,90,,,,,0", "RMB,115959.123,,2"},
    {"too_short", "BPRMB,115959.123,90", "RMB,115959.123,,0"},
    {"not_a_number", "BPRMB,115959.123,east,,,,,0", "RMB,115959.123,,0"},
    {"nan", "BPRMB,115959.123,nan,,,,,0", "RMB,115959.123,,0"},
    {"plus_sign", "BPRMB,115959.123,+90,,,,,0", "RMB,115959.123,,0"},
    {"heading_361", "BPRMB,115959.123,361,,,,,0", "RMB,115959.123,,0"},
    {"depth_without_mode", "BPRMB,115959.123,,5,,,,", "RMB,115959.123,,0"},
    {"speed_without_mode", "BPRMB,115959.123,,,,1,,", "RMB,115959.123,,0"},
    {"mode_4", "BPRMB,115959.123,,5,4,,,", "RMB,115959.123,,0"},
    {"too_deep", "BPRMB,115959.123,,50.1,0,,,", "RMB,115959.123,,0"},
    {"above_the_surface", "BPRMB,115959.123,,-1,0,,,", "RMB,115959.123,,0"},
    {"too_near_the_bottom", "BPRMB,115959.123,,1,1,,,", "RMB,115959.123,,0"},
    {"pitch_91", "BPRMB,115959.123,,91,2,,,", "RMB,115959.123,,0"},
    {"too_fast", "BPRMB,115959.123,,,,2.6,1,", "RMB,115959.123,,0"},
    {"too_many_turns", "BPRMB,115959.123,,,,1300,0,", "RMB,115959.123,,0"},
    {"abort", "BPABT,115959.123,enough,1", "ABT,115959.123,,2"},
};

class Acknowledged : public SandsharkCommands, public testing::WithParamInterface<Acked> {};

TEST_P(Acknowledged, AtOnceWithNameTimeAndStatus) {
  bench.tell(1, GetParam().body);
  bench.run(0.01);
  EXPECT_THAT(bench.heard(1, "BFACK"), ElementsAre(StartsWith(std::string{"$BFACK,120001.000,"} +
                                                              GetParam().answer + ",0,")));
}

INSTANTIATE_TEST_SUITE_P(Table, Acknowledged, testing::ValuesIn(kAcked),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(SandsharkCommands, AskingForAcknowledgementsIsNotAcknowledged) {
  bench.tell(1, "BPLOG,ACK,ON");
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1), IsEmpty());
}

TEST_F(SandsharkCommands, AreNotAcknowledgedUnlessAskedFor) {
  bench.connect(2);
  bench.tell(2, "BPSTS,120000.000,1,fine");
  bench.tell(1, "BPLOG,ACK,OFF");
  bench.tell(1, "BPSTS,120000.000,1,fine");
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFACK"), IsEmpty());
  EXPECT_THAT(bench.heard(2, "BFACK"), IsEmpty());
}

TEST_F(SandsharkCommands, AreAcknowledgedToWhoeverSentThem) {
  bench.connect(2);
  bench.tell(2, "BPLOG,ACK,ON");
  bench.tell(2, "BPSTS,120000.000,1,fine");
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFACK"), IsEmpty());
  EXPECT_THAT(bench.heard(2, "BFACK"), SizeIs(1));
}

struct Frame {
  const char* name;
  const char* text;
  std::size_t acks;
};
class Framed : public SandsharkCommands, public testing::WithParamInterface<Frame> {};

TEST_P(Framed, IsTakenOrIgnored) {
  bench.bytes(1, GetParam().text);
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFACK"), SizeIs(GetParam().acks));
}

INSTANTIATE_TEST_SUITE_P(
    Table, Framed,
    testing::Values(Frame{"no_checksum", "$BPSTS,120000.000,1,fine*\r\n", 1},
                    Frame{"no_asterisk", "$BPSTS,120000.000,1,fine\r\n", 1},
                    Frame{"line_feed_only", "$BPSTS,120000.000,1,fine*\n", 1},
                    Frame{"wrong_checksum", "$BPSTS,120000.000,1,fine*00\r\n", 0},
                    Frame{"two_in_one_write", "$BPSTS,1,1,a*\r\n$BPSTS,2,1,b*\r\n", 2},
                    Frame{"other_talker", "$PYDIR,10,10*\r\n", 0},
                    Frame{"noise", "hello\r\n\r\n", 0}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST_F(SandsharkCommands, AHeadingIsAGridHeading) {
  repeat("BPRMB,120000.000,90,,,,,0", 60.0);
  EXPECT_NEAR(trueHeading(), 90.0 + convergence(), 0.1);
  EXPECT_NEAR(trueHeading(), 88.59, 0.1);
}

TEST_F(SandsharkCommands, ADepthDives) {
  repeat("BPRMB,120000.000,,5,0,,,", 60.0);
  EXPECT_NEAR(bench.state().depth_m, 5.0, 0.05);
  EXPECT_NEAR(trueHeading(), 0.0, 0.1);  // heading and speed are still the mission's
  EXPECT_NEAR(bench.state().surge_m_s, 1.5, 0.01);
}

TEST_F(SandsharkCommands, AnAltitudeDivesToTheBottomLessIt) {
  repeat("BPRMB,120000.000,,14,1,,,", 60.0);
  EXPECT_NEAR(bench.state().altitude_m, 14.0, 0.05);
}

TEST_F(SandsharkCommands, ADepthNearTheBottomKeepsAway) {
  repeat("BPRMB,120000.000,,30,0,,,", 120.0);
  EXPECT_NEAR(bench.state().altitude_m, 1.5, 0.1);
}

TEST_F(SandsharkCommands, APitchIsHeld) {
  repeat("BPRMB,120000.000,,-10,2,,,", 10.0);
  EXPECT_NEAR(degrees(bench.state().pitch_rad), -10.0, 0.5);
}

TEST_F(SandsharkCommands, AnElevatorBowUpPitchesUp) {
  repeat("BPRMB,120000.000,,5,3,,,", 10.0);
  EXPECT_GT(degrees(bench.state().pitch_rad), 3.0);
}

TEST_F(SandsharkCommands, ARudderToStarboardTurnsClockwise) {
  repeat("BPRMB,120000.000,10,,,,,1", 5.0);
  EXPECT_GT(bench.state().yaw_rate_rad_s, 0.1);
}

TEST_F(SandsharkCommands, ASpeedAndAnRpmAreReached) {
  repeat("BPRMB,120000.000,,,,0.8,1,", 20.0);
  EXPECT_NEAR(bench.state().surge_m_s, 0.8, 0.01);
  repeat("BPRMB,120000.000,,,,900,0,", 20.0);
  EXPECT_NEAR(bench.state().surge_m_s, 1.8, 0.01);
}

TEST_F(SandsharkCommands, HoldForFiveSecondsThenTheMissionGoesOn) {
  bench.tell(1, "BPRMB,120000.000,180,,,,,0");
  bench.run(4.98);
  EXPECT_TRUE(bench.sandshark().backseatSteers());
  bench.run(0.04);
  EXPECT_FALSE(bench.sandshark().backseatSteers());
  bench.run(30.0);
  EXPECT_LT(std::abs(wrapPi(bench.state().heading_rad)), 0.1);
}

TEST_F(SandsharkCommands, RepeatedInTimeHoldOn) {
  for (int i = 0; i < 10; ++i) {
    bench.tell(1, "BPRMB,120000.000,180,,,,,0");
    bench.run(4.9);
    ASSERT_TRUE(bench.sandshark().backseatSteers());
  }
  EXPECT_NEAR(trueHeading(), 180.0 + convergence(), 0.5);
}

TEST_F(SandsharkCommands, ReplaceEachOtherWhole) {
  repeat("BPRMB,120000.000,,5,0,,,", 30.0);
  repeat("BPRMB,120000.000,90,,,,,0", 60.0);
  EXPECT_NEAR(bench.state().depth_m, 0.0, 0.05);
}

TEST_F(SandsharkCommands, AreRefusedWhileDynamicRequestsAreOff) {
  bench.tell(1, "BPLOG,CTL,ON");
  bench.sandshark().setBackseatControl(false);
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFCTL"), ElementsAre(StartsWith("$BFCTL,120001.010,0*")));
  bench.tell(1, "BPRMB,120000.000,180,,,,,0");
  bench.run(0.01);
  EXPECT_THAT(bench.heard(1, "BFACK"), ElementsAre(testing::HasSubstr(",RMB,120000.000,,1,0,")));
  bench.run(30.0);
  EXPECT_NEAR(trueHeading(), 0.0, 1.0);
  bench.sandshark().setBackseatControl(true);
  bench.run(0.1);
  EXPECT_THAT(bench.heard(1, "BFCTL"), ElementsAre(testing::HasSubstr(",1*")));
}

TEST_F(SandsharkCommands, AreForgottenWhenControlIsTakenBack) {
  bench.tell(1, "BPRMB,120000.000,180,,,,,0");
  bench.run(0.5);
  bench.sandshark().setBackseatControl(false);
  bench.run(0.1);
  bench.sandshark().setBackseatControl(true);
  bench.run(0.1);
  EXPECT_FALSE(bench.sandshark().backseatSteers());
}

TEST_F(SandsharkCommands, OutOfRangeLeaveTheEarlierOneStanding) {
  bench.tell(1, "BPRMB,120000.000,180,,,,,0");
  bench.run(1.0);
  bench.tell(1, "BPRMB,120000.000,0,,,9,1,0");
  bench.run(3.0);
  EXPECT_GT(std::abs(wrapPi(bench.state().heading_rad)), 0.5);
}

TEST_F(SandsharkCommands, AnAbortBringsItUpAndEndsTheMission) {
  repeat("BPRMB,120000.000,,5,0,,,", 40.0);
  bench.tell(1, "BPLOG,MIS,ON");
  bench.tell(1, "BPLOG,CTL,ON");
  bench.run(0.1);
  bench.heard(1);
  bench.tell(1, "BPABT,120000.000,leak,1");
  bench.run(0.1);
  const auto said = bench.heardBytes(1);
  EXPECT_NE(said.find(",Aborting,abort with errors: leak*"), std::string::npos) << said;
  EXPECT_NE(said.find("$BFCTL,"), std::string::npos);
  ASSERT_TRUE(bench.runUntil(
      [&] { return bench.sandshark().mission().state() == Mission::State::Aborted; }, 60.0));
  EXPECT_LT(bench.state().depth_m, 0.3);
  bench.run(60.0);
  EXPECT_NEAR(bench.state().surge_m_s, 0.0, 0.01);
  EXPECT_EQ(bench.sandshark().mission().state(), Mission::State::Aborted);
  bench.heard(1);
  bench.tell(1, "BPRMB,120000.000,180,,,,,0");
  bench.run(0.01);
  EXPECT_THAT(bench.heard(1, "BFACK"), ElementsAre(testing::HasSubstr(",RMB,120000.000,,1,0,")));
}

TEST_F(SandsharkCommands, AnAbortWithoutReasonIsOneWithErrors) {
  bench.tell(1, "BPLOG,MIS,ON");
  bench.tell(1, "BPABT,120000.000,,");
  bench.run(0.1);
  EXPECT_NE(bench.heardBytes(1).find(",Aborting,abort with errors*"), std::string::npos);
}

class Pending : public SandsharkCommands {
 protected:
  static SandsharkConfig config() {
    SandsharkConfig config = runningSandshark();
    config.pending_s = 1.5;
    return config;
  }
  Pending() : SandsharkCommands(config()) {}
};

TEST_F(Pending, ComesFirstAndTheFinalWordWithinTwoSeconds) {
  bench.tell(1, "BPRMB,115959.000,90,,,,,0");
  bench.run(1.4);
  EXPECT_THAT(bench.heard(1, "BFACK"), ElementsAre(testing::HasSubstr(",RMB,115959.000,,3,0,")));
  bench.run(0.2);
  EXPECT_THAT(bench.heard(1, "BFACK"),
              ElementsAre(StartsWith("$BFACK,120002.500,RMB,115959.000,,2,0,")));
}

TEST_F(Pending, IsForgottenWithTheClient) {
  bench.tell(1, "BPRMB,115959.000,90,,,,,0");
  bench.frontseat().clientDisconnected(1);
  bench.connect(2);
  bench.run(3.0);
  EXPECT_THAT(bench.heard(2, "BFACK"), IsEmpty());
}

}  // namespace
}  // namespace frontseat_driver::sim
