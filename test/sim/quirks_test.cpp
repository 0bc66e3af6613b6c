#include "frontseat_driver/sim/quirks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "bench.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/editable_sentence.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

Quirks only(std::string_view name) {
  Quirks quirks;
  EXPECT_TRUE(enable(quirks, name));
  return quirks;
}

TEST(QuirkNames, AreDifferentAndKnown) {
  std::set<std::string_view> names;
  for (const QuirkName& quirk : quirkNames()) {
    EXPECT_TRUE(names.insert(quirk.name).second) << quirk.name;
    EXPECT_TRUE(only(quirk.name).*quirk.member);
    EXPECT_FALSE(quirk.meaning.empty());
  }
  Quirks quirks;
  EXPECT_FALSE(enable(quirks, "cr_lf"));
}

struct Rewritten {
  const char* name;
  const char* quirk;
  const char* before;
  const char* after;
};
class Rewrite : public testing::TestWithParam<Rewritten> {};

TEST_P(Rewrite, GivesExactlyTheseBytesWithTheirChecksum) {
  const Quirks quirks = only(GetParam().quirk);
  EXPECT_TRUE(rewrites(quirks));
  const std::string text = rewrite(sentence(GetParam().before), quirks, true);
  const std::string wanted = sentence(GetParam().after);
  EXPECT_EQ(text, quirks.cr_lf_lf ? wanted + "\n" : wanted);
}

const Rewritten kRewritten[] = {
    {"latitude_minutes_below_ten", "unpadded_minutes", "BFNVG,1,4209.123456,N,07109.500000,W,1",
     "BFNVG,1,429.123456,N,0719.500000,W,1"},
    {"minutes_from_ten_on", "unpadded_minutes", "BFNVG,1,4210.123456,N,07111.500000,W,1",
     "BFNVG,1,4210.123456,N,07111.500000,W,1"},
    {"minutes_below_one", "unpadded_minutes", "BFNVG,1,4200.123456,N,07100.500000,W,1",
     "BFNVG,1,420.123456,N,0710.500000,W,1"},
    {"blank_position", "unpadded_minutes", "BFNVG,1,,,,,1", "BFNVG,1,,,,,1"},
    {"degrees_below_100", "dropped_zeros", "CPNVG,1,4221.711142,N,07105.448780,W,1",
     "CPNVG,1,4221.711142,N,7105.448780,W,1"},
    {"degrees_zero", "dropped_zeros", "CPNVG,1,0005.250000,N,00030.600000,W,1",
     "CPNVG,1,5.250000,N,30.600000,W,1"},
    {"minutes_zero", "dropped_zeros", "CPNVG,1,0000.250000,N,00000.600000,W,1",
     "CPNVG,1,0.250000,N,0.600000,W,1"},
    {"zeros_of_rmc", "dropped_zeros", "GPRMC,1,A,4221.500000,N,07105.448780,W,0,0,010326,,,A",
     "GPRMC,1,A,4221.500000,N,7105.448780,W,0,0,010326,,,A"},
    {"battery", "battery_without_id", "CPRBS,150218.154,1,15.091,3.76,3.78,24.5",
     "CPRBS,150218.154,15.091,3.76,3.78,24.5"},
    {"other_than_battery", "battery_without_id", "CPRCM,1,0,1,2,3,4", "CPRCM,1,0,1,2,3,4"},
    {"standing", "nan_velocities", "CPNVR,1,0.0000,0.0000,0.0000,0.1,0.2,0.3",
     "CPNVR,1,nan,nan,nan,0.1,0.2,0.3"},
    {"line_end", "cr_lf_lf", "BFVER,120000.000,SS_0.0", "BFVER,120000.000,SS_0.0"},
    {"second_sixty", "seconds_sixty", "BFNVR,120000.250,0,0,0,0,0,0",
     "BFNVR,115960.250,0,0,0,0,0,0"},
    {"second_sixty_of_the_day", "seconds_sixty", "BFNVR,000000.250,0,0,0,0,0,0",
     "BFNVR,235960.250,0,0,0,0,0,0"},
    {"second_one", "seconds_sixty", "BFNVR,120001.000,0,0,0,0,0,0", "BFNVR,120001.000,0,0,0,0,0,0"},
    {"both_times", "seconds_sixty", "BFNVG,120000.010,,,,,0,,,,,,120000.000",
     "BFNVG,115960.010,,,,,0,,,,,,115960.000"},
};
INSTANTIATE_TEST_SUITE_P(Table, Rewrite, testing::ValuesIn(kRewritten),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(RewriteNan, OnlyWhenStanding) {
  const std::string moving = sentence("CPNVR,1,1.0000,0.0000,0.0000,0.1,0.2,0.3");
  EXPECT_EQ(rewrite(moving, only("nan_velocities"), false), moving);
}

// What the vehicles really send with a quirk, from one that stands at 42 09.5 N 071 05.25 W.
KingfisherConfig kingfisherWith(std::string_view quirk) {
  KingfisherConfig config = restingKingfisher();
  config.environment.datum = {42.0 + 9.5 / 60.0, -(71.0 + 5.25 / 60.0)};
  config.start = {0.0, 0.0, 30.0};
  config.quirks = only(quirk);
  return config;
}

SandsharkConfig sandsharkWith(std::string_view quirk) {
  SandsharkConfig config = runningSandshark();
  config.environment.datum = {42.0 + 9.5 / 60.0, -(71.0 + 5.25 / 60.0)};
  config.quirks = only(quirk);
  return config;
}

std::string heardAtRest(const KingfisherConfig& config) {
  Bench bench{config};
  bench.connect(1);
  bench.run(0.01);
  return bench.heardBytes(1);
}

struct Heard {
  const char* quirk;
  const char* text;
};
class OfAKingfisher : public testing::TestWithParam<Heard> {};

TEST_P(OfAKingfisher, IsHeard) {
  KingfisherConfig config = kingfisherWith(GetParam().quirk);
  config.first_fix_s = config.quirks.zero_position_before_fix ? 5.0 : 0.0;
  EXPECT_THAT(heardAtRest(config), HasSubstr(GetParam().text));
}

INSTANTIATE_TEST_SUITE_P(
    Table, OfAKingfisher,
    testing::Values(
        Heard{"dropped_zeros", "$CPNVG,120018.010,4209.500000,N,7105.250000,W,1,"},
        Heard{"zero_position_before_fix", "$CPNVG,120018.010,0000.000000,N,00000.000000,E,0,"},
        Heard{"blank_attitude", ",1,,,30.0000,,,120018.000*"},
        Heard{"zero_altitude", ",1,0.000,,30.0000,"}, Heard{"zero_depth", ",1,,0.000,30.0000,"},
        Heard{"nan_velocities", "$CPNVR,120018.000,nan,nan,nan,0.0000,"},
        Heard{"heron_compass", "$CPRCM,120018.000,1,150.0000,0.0000,0.0000,"},
        Heard{"acceleration_in_g", ",0.000000,0.000000,-1.000000,120018.000*"},
        Heard{"battery_without_id", "$CPRBS,120018.000,16."}, Heard{"zero_temperature", ",0.000*"},
        Heard{"gn_talkers", "$GNGGA,120000.000,4209.500000,N,"},
        Heard{"cr_lf_lf", "\r\n\n$CPRCM,"}),
    [](const auto& row) { return std::string{row.param.quirk}; });

TEST(QuirkOfAKingfisher, EverySentenceKeepsARightChecksum) {
  KingfisherConfig config = restingKingfisher();
  for (const QuirkName& quirk : quirkNames()) enable(config.quirks, quirk.name);
  config.loop = usualLoop();
  Bench bench{config};
  bench.connect(1);
  bench.run(30.0);
  std::size_t count = 0;
  for (const std::string& line : bench.heard(1)) {
    if (line.empty()) continue;
    ++count;
    ASSERT_TRUE(nmea::parseSentence(line, nmea::ChecksumRule::Required)) << line;
  }
  EXPECT_GT(count, 1000U);
}

TEST(QuirkOfAKingfisher, HeronPitchHasTheOtherSign) {
  const auto pitch = [](std::string_view quirk) {
    KingfisherConfig config = restingKingfisher();
    if (!quirk.empty()) config.quirks = only(quirk);
    Bench bench{config};
    bench.connect(1);
    for (int i = 0; i < 30; ++i) {
      bench.tell(1, "PYDIR,80,80");
      bench.run(0.5);
    }
    return std::stod(fields(bench.heard(1, "CPRCM").back())[4]);
  };
  EXPECT_GT(pitch({}), 0.5);
  EXPECT_DOUBLE_EQ(pitch("heron_compass"), -pitch({}));
}

TEST(QuirkOfAKingfisher, HeadingIsTheCourseWhenUnderWay) {
  KingfisherConfig config = restingKingfisher();
  config.quirks = only("course_heading");
  config.environment.current_set_deg = 90.0;
  config.environment.current_drift_m_s = 0.3;
  Bench bench{config};
  bench.connect(1);
  bench.run(1.0);
  EXPECT_EQ(fields(bench.heard(1, "CPNVG").back())[9], "90.0000");  // it drifts, bow to the north
  config.environment.current_drift_m_s = 0.1;
  Bench slow{config};
  slow.connect(1);
  slow.run(1.0);
  EXPECT_EQ(fields(slow.heard(1, "CPNVG").back())[9], "0.0000");
}

TEST(QuirkOfAKingfisher, NoThrustNoTurn) {
  KingfisherConfig config = restingKingfisher();
  config.quirks = only("zero_thrust_stops");
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "PYDEP,0.3,0");
  bench.run(0.5);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.0);
}

/// A running Sandshark with one quirk and one client that asked for everything.
class OfASandshark {
 public:
  explicit OfASandshark(std::string_view quirk) : bench(sandsharkWith(quirk)) {
    bench.connect(1);
    for (const char* body : {"BPLOG,ACK,ON", "BPLOG,ALL,ON"}) {
      bench.tell(1, body);
      bench.run(0.1);
    }
  }
  Bench bench;
};

TEST(QuirkOfASandshark, UnpaddedMinutes) {
  OfASandshark vehicle{"unpadded_minutes"};
  EXPECT_THAT(vehicle.bench.heard(1, "BFNVG").back(), HasSubstr(",429.500"));
}

TEST(QuirkOfASandshark, PositionsThroughFloats) {
  OfASandshark vehicle{"float32_positions"};
  const auto nvg = fields(vehicle.bench.heard(1, "BFNVG").back());
  // The float nearest to -71.0875 is -71.08750152587890625: 5.2500915527 minutes.
  EXPECT_EQ(nvg[4], "07105.250092");
}

TEST(QuirkOfASandshark, RatesJumpWhereTheHeadingWraps) {
  OfASandshark vehicle{"rate_wrap"};
  double largest = 0.0;
  for (int i = 0; i < 40; ++i) {
    vehicle.bench.tell(1, "BPRMB,120000.000,-15,,,,,1");
    vehicle.bench.run(0.5);
    for (const std::string& line : vehicle.bench.heard(1, "BFNVR")) {
      largest = std::max(largest, std::abs(std::stod(fields(line)[7])));
    }
  }
  EXPECT_GT(largest, 3500.0);
  EXPECT_LT(largest, 3700.0);
}

TEST(QuirkOfASandshark, LongNames) {
  OfASandshark vehicle{"long_ack_names"};
  vehicle.bench.tell(1, "BPSTS,120000.000,1,fine");
  vehicle.bench.run(0.1);
  EXPECT_THAT(vehicle.bench.heard(1, "BFACK").back(), HasSubstr(",BPSTS,120000.000,,2,"));
}

TEST(QuirkOfASandshark, BlankMissionStatus) {
  OfASandshark vehicle{"blank_mission_status"};
  EXPECT_THAT(vehicle.bench.heard(1, "BFMIS"), testing::Each(HasSubstr(",survey.dive,,")));
}

TEST(QuirkOfASandshark, AsksForAcknowledgementsAcknowledged) {
  OfASandshark vehicle{"ack_log_ack"};
  EXPECT_THAT(vehicle.bench.heard(1, "BFACK"), SizeIs(2));
}

TEST(QuirkOfASandshark, ASecondClientHearsNothingUntilTheFirstLeaves) {
  OfASandshark vehicle{"single_client"};
  Bench& bench = vehicle.bench;
  bench.connect(2);
  bench.tell(2, "BPLOG,NVR,ON");
  bench.run(5.0);
  EXPECT_THAT(bench.heard(2), IsEmpty());
  bench.frontseat().clientDisconnected(1);
  bench.run(1.0);
  const auto heard = bench.heard(2);
  ASSERT_THAT(heard, SizeIs(11));
  EXPECT_THAT(heard[0], StartsWith("$BFVER"));
  EXPECT_THAT(heard[1], StartsWith("$BFNVR"));
}

TEST(QuirkOfASandshark, OneReadIsOneSentence) {
  OfASandshark vehicle{"one_read_one_sentence"};
  Bench& bench = vehicle.bench;
  bench.heard(1);
  bench.tell(1, "BPSTS,120001.000,1,first");
  bench.tell(1, "BPSTS,120002.000,1,lost");
  bench.run(0.06);
  bench.tell(1, "BPSTS,120003.000,1,third");
  bench.run(0.06);
  EXPECT_THAT(bench.heard(1, "BFACK"),
              ElementsAre(HasSubstr("STS,120001.000"), HasSubstr("STS,120003.000")));
}

TEST(QuirkOfASandshark, AReadIs256BytesAtMost) {
  OfASandshark vehicle{"one_read_one_sentence"};
  Bench& bench = vehicle.bench;
  bench.heard(1);
  const std::string filler = "$BPSTS,120001.000,1," + std::string(234, 'x') + "*\n";
  ASSERT_EQ(filler.size(), 256U);
  bench.bytes(1, filler);
  bench.tell(1, "BPSTS,120002.000,1,next");
  bench.run(0.11);
  EXPECT_THAT(bench.heard(1, "BFACK"),
              ElementsAre(HasSubstr("STS,120001.000"), HasSubstr("STS,120002.000")));
}

struct Cut {
  const char* name;
  const char* text;
  const char* status;  ///< of the answer
};
class CutLastThree : public testing::TestWithParam<Cut> {};

TEST_P(CutLastThree, OfEachCommand) {
  OfASandshark vehicle{"cut_last_three"};
  Bench& bench = vehicle.bench;
  bench.heard(1);
  bench.bytes(1, GetParam().text);
  bench.run(0.1);
  const auto acks = bench.heard(1, "BFACK");
  ASSERT_THAT(acks, SizeIs(1));
  EXPECT_EQ(fields(acks[0])[5], GetParam().status);
}

INSTANTIATE_TEST_SUITE_P(
    Table, CutLastThree,
    testing::Values(Cut{"with_checksum", "$BPRMB,115959.000,90,5,0,700,0,0*00\r\n", "2"},
                    Cut{"without_checksum", "$BPRMB,115959.000,90,5,0,700,0,0*\r\n", "0"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(QuirkOfASandshark, ACommandIsFoundAnywhereInTheLine) {
  OfASandshark vehicle{"command_by_substring"};
  vehicle.bench.heard(1);
  vehicle.bench.tell(1, "BPABT,120000.000,LOG is full,1");
  vehicle.bench.run(0.1);
  EXPECT_THAT(vehicle.bench.heard(1, "BFACK"), ElementsAre(HasSubstr(",LOG,,,0,")));
  EXPECT_EQ(vehicle.bench.sandshark().mission().state(), Mission::State::Running);
  vehicle.bench.tell(1, "BPABT,120000.000,log is full,1");
  vehicle.bench.run(0.1);
  EXPECT_EQ(vehicle.bench.sandshark().mission().state(), Mission::State::Aborting);
}

TEST(QuirkOfASandshark, DiesOfAnEmptyField) {
  OfASandshark vehicle{"dies_on_empty_field"};
  vehicle.bench.tell(1, "BPRMB,120000.000,90,5,0,700,0,0");
  vehicle.bench.run(0.1);
  EXPECT_THAT(vehicle.bench.disconnected, IsEmpty());
  vehicle.bench.tell(1, "BPRMB,120000.000,90,,,,,0");
  vehicle.bench.run(0.1);
  EXPECT_THAT(vehicle.bench.disconnected, ElementsAre(1));
}

}  // namespace
}  // namespace frontseat_driver::sim
