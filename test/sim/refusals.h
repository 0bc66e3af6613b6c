#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontseat_driver/sim/parameter.h"

namespace frontseat_driver::sim {

/// What a parameter of a simulator must refuse, by what it says that it accepts.
inline std::vector<std::string> refusedBy(const std::string& accepted) {
  const std::vector<std::string> none_of_any{"", "nan", "inf", "1x", "true 1", "-1e300", "1e300"};
  std::vector<std::string> refused;
  const bool whole = accepted.rfind("a whole number", 0) == 0;
  const bool flag = accepted == "true or false";
  if (whole || flag || accepted.rfind("a number", 0) == 0) refused = none_of_any;
  if (whole) refused.insert(refused.end(), {"0.5", "1.5"});
  if (flag) refused.insert(refused.end(), {"2", "yes", "TRUE"});
  return refused;
}

/// Each parameter that is a number or a flag refuses what is none, or beyond its range, and keeps
/// its value.
template <class Config>
void expectRefusals(const std::vector<ParameterOf<Config>>& all) {
  const Config untouched;
  for (const auto& parameter : all) {
    for (const std::string& text : refusedBy(parameter.accepted)) {
      Config config;
      EXPECT_FALSE(parameter.set(config, text)) << parameter.name << ": '" << text << "'";
      EXPECT_EQ(parameter.get(config), parameter.get(untouched)) << parameter.name;
    }
  }
}

}  // namespace frontseat_driver::sim
