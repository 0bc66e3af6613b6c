#include "frontseat_driver/sim/simulator_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "bench.h"
#include "frontseat_driver/sim/angles.h"
#include "refusals.h"

namespace frontseat_driver::sim {
namespace {

using testing::HasSubstr;

TEST(SimulatorParameters, HaveDifferentNamesAndSayEverything) {
  std::set<std::string> names;
  for (const SimulatorParameter& parameter : simulatorParameters()) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
    EXPECT_FALSE(parameter.accepted.empty()) << parameter.name;
  }
}

TEST(SimulatorParameters, TakeTheirOwnDefaultsAndStayTheSame) {
  const SimulatorConfig defaults;
  for (const SimulatorParameter& parameter : simulatorParameters()) {
    SimulatorConfig config;
    const std::string before = parameter.get(defaults);
    EXPECT_EQ(setParameter(config, parameter.name, before), std::nullopt) << parameter.name;
    EXPECT_EQ(parameter.get(config), before) << parameter.name;
  }
}

TEST(SimulatorParameters, NumbersAndFlagsRefuseWhatIsNone) {
  expectRefusals(simulatorParameters());
}

struct Value {
  const char* name;
  const char* value;
  const char* reads_back;
};
class Accepted : public testing::TestWithParam<Value> {};

TEST_P(Accepted, IsKept) {
  SimulatorConfig config;
  ASSERT_EQ(setParameter(config, GetParam().name, GetParam().value), std::nullopt);
  for (const SimulatorParameter& parameter : simulatorParameters()) {
    if (parameter.name == GetParam().name) {
      EXPECT_EQ(parameter.get(config), GetParam().reads_back);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, Accepted,
    testing::Values(Value{"dialect", "kingfisher", "kingfisher"}, Value{"port", "0", "0"},
                    Value{"bind", "::1", "::1"}, Value{"speed", "20", "20"},
                    Value{"datum", "[-42.5, 147]", "[-42.5, 147]"},
                    Value{"start", "1 2 0.5", "[1, 2, 0.5]"}, Value{"noise", "False", "false"},
                    Value{"seed", "4294967295", "4294967295"},
                    Value{"rates", "NVG=5,RIM=40", "{IMU: 40, NVG: 5}"},
                    Value{"quirks", "cr_lf_lf unpadded_minutes", "[unpadded_minutes, cr_lf_lf]"},
                    Value{"current", "[0.3, -0.4]", "[0.3, -0.4]"},
                    Value{"legs", "10 0 2 1.5, 20 0 0 1", "[10, 0, 2, 1.5, 20, 0, 0, 1]"},
                    Value{"legs", "", "[]"}, Value{"drop", "0.25", "0.25"},
                    Value{"loop_corners", "0 0 10 0 10 10", "[0, 0, 10, 0, 10, 10]"},
                    Value{"yaw_rate_unit", "deg", "deg"}, Value{"yaw_rate_unit", "rad", "rad"},
                    Value{"imu_name", "IMU", "IMU"}, Value{"imu_name", "RIM", "RIM"},
                    Value{"solution_age", "0.05", "0.05"}, Value{"clock_offset", "-18", "-18"},
                    Value{"bind", "0.0.0.0", "0.0.0.0"}, Value{"loop", "1", "true"},
                    Value{"loop", "0", "false"}, Value{"loop_corners", "[]", "[]"},
                    Value{"waves", "0.1", "0.1"}, Value{"compass_id", "99", "99"},
                    Value{"dive_file", "night dive", "night dive"}),
    [](const auto& row) { return std::string{row.param.name} + "_" + std::to_string(row.index); });

class Refused : public testing::TestWithParam<Value> {};

TEST_P(Refused, WithOneLineThatNamesParameterValueAndWhatIsAccepted) {
  SimulatorConfig config;
  const auto wrong = setParameter(config, GetParam().name, GetParam().value);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(*wrong, HasSubstr("'" + std::string{GetParam().name} + "'"));
  EXPECT_THAT(*wrong, HasSubstr("'" + std::string{GetParam().value} + "'"));
  EXPECT_THAT(*wrong, HasSubstr(GetParam().reads_back));
  EXPECT_EQ(wrong->find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Refused,
    testing::Values(Value{"dialect", "blueye", "sandshark or kingfisher"},
                    Value{"port", "65536", "from 0 to 65535"}, Value{"port", "29500.5", "whole"},
                    Value{"port", "abc", "whole"}, Value{"bind", "localhost", "IPv4"},
                    Value{"speed", "0", "0.01"}, Value{"speed", "nan", "number"},
                    Value{"speed", "2x", "number"}, Value{"datum", "[91, 0]", "latitude"},
                    Value{"datum", "[42]", "latitude"}, Value{"noise", "maybe", "true or false"},
                    Value{"rates", "NVG", "pairs"}, Value{"rates", "NVG: -1", "pairs"},
                    Value{"rates", "NVG: fast", "pairs"}, Value{"rates", "NVG: 1001", "pairs"},
                    Value{"quirks", "none", "unpadded_minutes"},
                    Value{"datum", "[0, -181]", "longitude"}, Value{"datum", "north", "latitude"},
                    Value{"start", "1 2", "yaw"}, Value{"current", "1", "5 m/s"},
                    Value{"drop", "1.5", "from 0 to 1"}, Value{"legs", "1 2 3", "groups of four"},
                    Value{"legs", "1 2 3 9", "m/s"}, Value{"legs", "1 2 3 0", "m/s"},
                    Value{"legs", "1 2 -3 1", "m depth"}, Value{"loop_corners", "1 2 3", "pairs"},
                    Value{"waves", "0.6", "0.5"}, Value{"solution_age", "1.5", "from 0 to 1"},
                    Value{"loop_corners", "1 2", "two at least"},
                    Value{"current", "[5, 5]", "5 m/s"}, Value{"dive_file", "a,b", "printable"}),
    [](const auto& row) { return std::string{row.param.name} + "_" + std::to_string(row.index); });

TEST(SimulatorParameters, AnUnknownOneGetsTheNearestName) {
  SimulatorConfig config;
  EXPECT_EQ(setParameter(config, "dialekt", "x"),
            "there is no parameter 'dialekt': did you mean 'dialect'?");
}

TEST(SimulatorParameters, ARateTheDialectDoesNotHaveIsAContradiction) {
  SimulatorConfig config;
  ASSERT_EQ(setParameter(config, "rates", "RCM: 5"), std::nullopt);
  const auto wrong = findContradiction(config);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(*wrong, HasSubstr("'RCM'"));
  EXPECT_THAT(*wrong, HasSubstr("NVG, NVR, DVL"));
  config.dialect = protocol::Dialect::Kingfisher;
  EXPECT_EQ(findContradiction(config), std::nullopt);
}

TEST(SimulatorParameters, ReachTheVehicle) {
  SimulatorConfig config;
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, const char*>>{
           {"start", "5 -7 0"}, {"legs", "100 0 2 1.5"}, {"ready_time", "0"}, {"noise", "false"}}) {
    ASSERT_EQ(setParameter(config, name, value), std::nullopt);
  }
  const auto frontseat = makeFrontseat(config, kNoon);
  EXPECT_DOUBLE_EQ(frontseat->model().state().east_m, 5.0);
  EXPECT_DOUBLE_EQ(frontseat->model().state().north_m, -7.0);
  EXPECT_NEAR(frontseat->model().state().heading_rad, kPi / 2.0, 1e-12);
  EXPECT_EQ(frontseat->now(), kNoon);
  const auto& sandshark = dynamic_cast<const SandsharkFrontseat&>(*frontseat);
  ASSERT_EQ(sandshark.mission().plan().legs.size(), 1U);
  EXPECT_DOUBLE_EQ(sandshark.mission().plan().legs[0].to.east_m, 100.0);
}

TEST(SimulatorParameters, ReachTheBoat) {
  SimulatorConfig config;
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, const char*>>{
           {"dialect", "kingfisher"}, {"start", "5 -7 0"}, {"noise", "false"}}) {
    ASSERT_EQ(setParameter(config, name, value), std::nullopt);
  }
  const auto frontseat = makeFrontseat(config, kNoon);
  EXPECT_DOUBLE_EQ(frontseat->model().state().east_m, 5.0);
  EXPECT_DOUBLE_EQ(frontseat->model().state().north_m, -7.0);
  EXPECT_NE(dynamic_cast<const KingfisherFrontseat*>(frontseat.get()), nullptr);
}

}  // namespace
}  // namespace frontseat_driver::sim
