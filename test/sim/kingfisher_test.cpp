#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "bench.h"
#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

struct Sent {
  const char* address;
  std::size_t in_ten_seconds;
};
class KingfisherSentences : public testing::TestWithParam<Sent> {};

TEST_P(KingfisherSentences, GoToEveryClientAtTheirRate) {
  Bench bench{restingKingfisher()};
  bench.run(0.05);
  bench.connect(1);
  bench.connect(2);
  bench.run(10.0);
  EXPECT_THAT(bench.heard(1, GetParam().address), SizeIs(GetParam().in_ten_seconds));
  EXPECT_THAT(bench.heard(2, GetParam().address), SizeIs(GetParam().in_ten_seconds));
}

INSTANTIATE_TEST_SUITE_P(Table, KingfisherSentences,
                         testing::Values(Sent{"CPNVG", 100}, Sent{"CPNVR", 100}, Sent{"CPRCM", 100},
                                         Sent{"CPIMU", 200}, Sent{"CPRIM", 0}, Sent{"CPRBS", 10},
                                         Sent{"GPRMC", 50}, Sent{"GPGGA", 50}, Sent{"GPVTG", 0}),
                         [](const auto& row) { return std::string{row.param.address}; });

TEST(KingfisherSentence, BytesAtRest) {
  KingfisherConfig config = restingKingfisher();
  config.start = {0.0, 0.0, 90.0};
  config.environment.datum = {42.36, -71.11};
  Bench bench{config};
  bench.connect(1);
  bench.run(0.01);
  const auto heard = bench.heard(1);
  // The solution is 10 ms old when it is sent, so NVG comes in the second step.
  ASSERT_THAT(heard, SizeIs(7));
  EXPECT_THAT(heard[0], StartsWith("$CPNVR,120018.000,0.0000,0.0000,0.0000,0.0000,0.0000,0.0000*"));
  EXPECT_THAT(heard[1], StartsWith("$CPRCM,120018.000,1,90.0000,0.0000,0.0000,120018.000*"));
  EXPECT_THAT(heard[2], StartsWith("$CPIMU,120018.000,0.0000,0.0000,0.0000,0.000000,0.000000,"
                                   "-9.806650,120018.000*"));
  EXPECT_THAT(heard[3], StartsWith("$CPRBS,120018.000,1,16."));
  EXPECT_THAT(heard[4], StartsWith("$GPRMC,120000.000,A,4221.600000,N,07106.600000,W,0.00"));
  EXPECT_THAT(heard[4], testing::HasSubstr(",010326,"));
  EXPECT_THAT(heard[5], StartsWith("$GPGGA,120000.000,4221.600000,N,07106.600000,W,1,"));
  EXPECT_THAT(heard[6], StartsWith("$CPNVG,120018.010,4221.600000,N,07106.600000,W,1,,,90.0000,"
                                   "0.0000,0.0000,120018.000*"));
}

TEST(KingfisherSentence, TimesOfTheReceiverAreUtcThroughMidnight) {
  KingfisherConfig config = restingKingfisher();
  config.start_time = kNoon + std::chrono::hours{12} - std::chrono::seconds{10};
  config.rates = {{"RMC", 0.1}, {"NVR", 0.1}};
  Bench bench{config};
  bench.connect(1);
  bench.run(10.0);
  auto heard = bench.heard(1);
  heard.erase(std::remove_if(heard.begin(), heard.end(),
                             [](const auto& line) {
                               return line.rfind("$GPRMC", 0) != 0 && line.rfind("$CPNVR", 0) != 0;
                             }),
              heard.end());
  ASSERT_THAT(heard, SizeIs(4));
  EXPECT_THAT(heard[0], StartsWith("$CPNVR,000008.000,"));
  EXPECT_THAT(heard[1], StartsWith("$GPRMC,235950.000,"));
  EXPECT_THAT(heard[1], testing::HasSubstr(",010326,"));
  EXPECT_THAT(heard[3], StartsWith("$GPRMC,000000.000,"));
  EXPECT_THAT(heard[3], testing::HasSubstr(",020326,"));
  EXPECT_EQ(bench.truths.front().stamp, config.start_time);
}

TEST(KingfisherSentence, TheReceiverHasNothingBeforeTheFirstFix) {
  KingfisherConfig config = restingKingfisher();
  config.first_fix_s = 5.0;
  Bench bench{config};
  bench.connect(1);
  bench.run(0.01);
  const auto heard = bench.heardBytes(1);
  EXPECT_NE(heard.find("$GPRMC,120000.000,V,,,,,,,010326,"), std::string::npos) << heard;
  EXPECT_NE(heard.find("$GPGGA,120000.000,,,,,0,,,,M,,M,,*"), std::string::npos) << heard;
  EXPECT_NE(heard.find("$CPNVG,120018.010,,,,,0,,,"), std::string::npos) << heard;
}

TEST(KingfisherSentence, TheImuHasTheOtherNameIfWanted) {
  KingfisherConfig config = restingKingfisher();
  config.imu_formatter = "RIM";
  Bench bench{config};
  bench.connect(1);
  bench.run(0.01);
  const auto heard = bench.heardBytes(1);
  EXPECT_NE(heard.find("$CPRIM,"), std::string::npos);
  EXPECT_EQ(heard.find("$CPIMU,"), std::string::npos);
}

TEST(KingfisherSentence, AllOfAnInstantTellOfTheSameState) {
  KingfisherConfig config = restingKingfisher();
  config.waves_deg = 3.0;
  config.noise = true;
  Bench bench{config};
  bench.connect(1);
  for (int i = 0; i < 20; ++i) {
    bench.tell(1, "PYDIR,80,40");
    bench.run(0.5);
  }
  bench.heard(1);
  bench.run(0.11);
  const auto heard = bench.heard(1);
  const auto find = [&](const char* start) {
    return fields(*std::find_if(heard.begin(), heard.end(),
                                [&](const auto& line) { return line.rfind(start, 0) == 0; }));
  };
  EXPECT_EQ(find("$CPNVG,120028.1")[9], find("$CPRCM,120028.1")[3]);
  EXPECT_EQ(find("$CPNVG,120028.1")[2], find("$CPNVG,120028.1")[2]);
  EXPECT_EQ(find("$CPNVR,120028.1")[7], find("$CPIMU,120028.1")[4]);
  EXPECT_EQ(find("$CPNVR,120028.1")[5], find("$CPIMU,120028.1")[3]);
}

TEST(KingfisherLoop, IsDrivenUntilSomebodyCommands) {
  KingfisherConfig config = restingKingfisher();
  config.loop = usualLoop();
  Bench bench{config};
  bench.connect(1);
  std::set<std::pair<bool, bool>> quadrants;
  double farthest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    bench.run(0.1);
    const VehicleState& state = bench.state();
    if (std::abs(state.east_m) > 10.0 && std::abs(state.north_m) > 6.0) {
      quadrants.insert({state.east_m > 0.0, state.north_m > 0.0});
    }
    farthest = std::max({farthest, std::abs(state.east_m), std::abs(state.north_m)});
  }
  EXPECT_THAT(quadrants, SizeIs(4));
  EXPECT_LT(farthest, 25.0);
  EXPECT_NEAR(bench.state().surge_m_s, 1.0, 0.3);
  bench.tell(1, "PYDIR,0,0");
  bench.run(20.0);
  EXPECT_NEAR(bench.state().surge_m_s, 0.0, 0.01);
}

TEST(KingfisherLoop, IsTakenUpAgainAfterHalfAMinute) {
  KingfisherConfig config = restingKingfisher();
  config.loop = usualLoop();
  Bench bench{config};
  bench.connect(1);
  bench.run(10.0);
  bench.tell(1, "PYDIR,0,0");
  bench.run(29.9);
  EXPECT_NEAR(bench.state().surge_m_s, 0.0, 0.01);
  bench.run(5.0);
  EXPECT_GT(bench.state().surge_m_s, 0.1);
}

TEST(KingfisherLoop, IsNeverTakenUpAgainIfNotWanted) {
  KingfisherConfig config = restingKingfisher();
  config.loop = usualLoop();
  config.resume_loop_s = 0.0;
  Bench bench{config};
  bench.connect(1);
  bench.tell(1, "PYDIR,0,0");
  bench.run(200.0);
  EXPECT_NEAR(bench.state().surge_m_s, 0.0, 0.01);
}

class KingfisherCommands : public testing::Test {
 protected:
  explicit KingfisherCommands(const KingfisherConfig& config = restingKingfisher())
      : bench(config) {
    bench.connect(1);
  }

  void repeat(const std::string& body, double s) {
    for (double t = 0.0; t < s; t += 0.2) {
      bench.tell(1, body);
      bench.run(0.2);
    }
  }

  Bench bench;
};

TEST_F(KingfisherCommands, ThrustOfEachMotor) {
  repeat("PYDIR,50,30", 10.0);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.5);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().starboard, 0.3);
  EXPECT_GT(bench.state().yaw_rate_rad_s, 0.05);
}

TEST_F(KingfisherCommands, TheMotorsStopOneSecondAfterTheLast) {
  bench.tell(1, "PYDIR,50,50");
  bench.run(1.0);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.5);
  bench.run(0.02);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.0);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().starboard, 0.0);
}

TEST_F(KingfisherCommands, ARateOfTurnIsClockwiseRadians) {
  repeat("PYDEP,0.2,40", 20.0);
  EXPECT_NEAR(bench.state().yaw_rate_rad_s, 0.2, 0.005);
  EXPECT_NEAR(bench.state().surge_m_s, 0.4 * 1.7, 0.05);
  repeat("PYDEP,-0.2,40", 20.0);
  EXPECT_NEAR(bench.state().yaw_rate_rad_s, -0.2, 0.005);
}

TEST_F(KingfisherCommands, ARateOfTurnWithoutThrustTurnsOnTheSpot) {
  repeat("PYDEP,0.3,0", 20.0);
  EXPECT_NEAR(bench.state().yaw_rate_rad_s, 0.3, 0.01);
  EXPECT_NEAR(bench.state().surge_m_s, 0.0, 0.05);
}

TEST_F(KingfisherCommands, AThrustAsternGoesAstern) {
  repeat("PYDEP,0,-50", 20.0);
  EXPECT_NEAR(bench.state().surge_m_s, -0.5 * 0.6 * 1.7, 0.01);
  EXPECT_NEAR(bench.state().yaw_rate_rad_s, 0.0, 1e-3);
}

TEST_F(KingfisherCommands, AHeadingAndASpeed) {
  repeat("PYDEV,225,1.2", 40.0);
  EXPECT_NEAR(degrees(bench.state().heading_rad), 225.0, 0.1);
  EXPECT_NEAR(bench.state().surge_m_s, 1.2, 0.01);
}

TEST_F(KingfisherCommands, NoSpeedIsNoThrust) {
  repeat("PYDEV,90,0", 10.0);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.0);
}

TEST_F(KingfisherCommands, TheLastOfAnyClientCounts) {
  bench.connect(2);
  bench.tell(1, "PYDIR,50,50");
  bench.tell(2, "PYDIR,-20,-20");
  bench.run(0.1);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, -0.2);
}

struct Ignored {
  const char* name;
  const char* text;
};
class NotObeyed : public KingfisherCommands, public testing::WithParamInterface<Ignored> {};

TEST_P(NotObeyed, AndNothingIsSaid) {
  bench.tell(1, "PYDIR,10,10");
  bench.run(0.5);
  bench.bytes(1, GetParam().text);
  bench.run(0.3);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.1);
  EXPECT_THAT(bench.heard(1, "CPACK"), IsEmpty());
  bench.run(0.3);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.0);  // it did not count as a command either
}

INSTANTIATE_TEST_SUITE_P(Table, NotObeyed,
                         testing::Values(Ignored{"plus_sign", "$PYDIR,+50,50*\r\n"},
                                         Ignored{"word", "$PYDIR,full,full*\r\n"},
                                         Ignored{"not_a_number", "$PYDIR,nan,50*\r\n"},
                                         Ignored{"exponent", "$PYDIR,5e1,50*\r\n"},
                                         Ignored{"blank", "$PYDIR,,50*\r\n"},
                                         Ignored{"one_field", "$PYDIR,50*\r\n"},
                                         Ignored{"too_much", "$PYDIR,101,50*\r\n"},
                                         Ignored{"wrong_checksum", "$PYDIR,50,50*00\r\n"},
                                         Ignored{"thrust_beyond", "$PYDEP,0.1,-101*\r\n"},
                                         Ignored{"speed_astern", "$PYDEV,90,-1*\r\n"},
                                         Ignored{"heading_beyond", "$PYDEV,400,1*\r\n"},
                                         Ignored{"lower_case", "$pydir,50,50*\r\n"},
                                         Ignored{"other_dialect", "$BPRMB,120000,90,,,,,0*\r\n"}),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Obeyed {
  const char* name;
  const char* text;
};
class TakenAnyway : public KingfisherCommands, public testing::WithParamInterface<Obeyed> {};

TEST_P(TakenAnyway, HalfThrust) {
  bench.bytes(1, GetParam().text);
  bench.run(0.1);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Table, TakenAnyway,
                         testing::Values(Obeyed{"no_checksum", "$PYDIR,50,50*\r\n"},
                                         Obeyed{"no_asterisk", "$PYDIR,50,50\r\n"},
                                         Obeyed{"decimals", "$PYDIR,50.0,50.00*\r\n"},
                                         Obeyed{"blanks", "$PYDIR, 50, 50*\r\n"}),
                         [](const auto& row) { return std::string{row.param.name}; });

class DegreesPerSecond : public KingfisherCommands {
 protected:
  static KingfisherConfig config() {
    KingfisherConfig config = restingKingfisher();
    config.yaw_rate_in_degrees = true;
    return config;
  }
  DegreesPerSecond() : KingfisherCommands(config()) {}
};

TEST_F(DegreesPerSecond, AsHeronFirmwareReadsThem) {
  repeat("PYDEP,10,40", 20.0);
  EXPECT_NEAR(degrees(bench.state().yaw_rate_rad_s), 10.0, 0.3);
}

}  // namespace
}  // namespace frontseat_driver::sim
