#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/simulator_config.h"

namespace frontseat_driver::sim {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// Name and value of each line `name: value  # comment`; the files have no other kind.
Values valuesOf(const std::string& file) {
  std::ifstream in{std::string{CONFIG_FOLDER} + "/" + file};
  const std::regex line_of_value{R"(^(\w+): (.*?)\s*(#.*)?$)"};
  Values values;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_match(line, match, line_of_value)) values.emplace_back(match[1], match[2]);
  }
  return values;
}

class ConfigFile : public testing::TestWithParam<const char*> {};

TEST_P(ConfigFile, HasOnlyWhatTheSimulatorTakes) {
  SimulatorConfig config;
  const Values values = valuesOf(GetParam());
  EXPECT_FALSE(values.empty());
  for (const auto& [name, value] : values) {
    EXPECT_EQ(setParameter(config, name, value), std::nullopt);
  }
  EXPECT_EQ(findContradiction(config), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Table, ConfigFile,
                         testing::Values("simulator.yaml", "simulator_sandshark_field.yaml",
                                         "simulator_kingfisher_field.yaml"),
                         [](const auto& row) {
                           return std::regex_replace(std::string{row.param}, std::regex{"\\W"},
                                                     "_");
                         });

TEST(SimulatorYaml, NamesEveryParameterWithItsDefault) {
  SimulatorConfig config;
  std::vector<std::string> named;
  for (const auto& [name, value] : valuesOf("simulator.yaml")) {
    ASSERT_EQ(setParameter(config, name, value), std::nullopt);
    named.push_back(name);
  }
  std::vector<std::string> known;
  const SimulatorConfig defaults;
  for (const SimulatorParameter& parameter : simulatorParameters()) {
    known.push_back(parameter.name);
    EXPECT_EQ(parameter.get(config), parameter.get(defaults)) << parameter.name;
  }
  EXPECT_THAT(named, testing::UnorderedElementsAreArray(known));
}

}  // namespace
}  // namespace frontseat_driver::sim
