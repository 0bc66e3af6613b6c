#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/simulator_config.h"
#include "text_values.h"

namespace frontseat_driver::sim {

using Config = SimulatorConfig;
using Parameter = SimulatorParameter;

/// A number from `low` to `high`; `in_config` finds it.
Parameter number(std::string name, double& (*in_config)(Config&), double low, double high,
                 std::string meaning);

/// A whole number from `low` to `high`.
template <class Integer>
Parameter whole(std::string name, Integer& (*in_config)(Config&), double low, double high,
                std::string meaning) {
  const std::string range = "from " + toText(low) + " to " + toText(high);
  return {std::move(name), std::move(meaning), "a whole number " + range,
          [=](Config& config, const std::string& text) {
            const auto value = toNumber(text);
            if (!value || *value < low || *value > high || *value != std::floor(*value))
              return false;
            in_config(config) = static_cast<Integer>(*value);
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return toText(static_cast<double>(in_config(copy)));
          }};
}

/// true or false, also as Python and numbers have them.
Parameter flag(std::string name, bool& (*in_config)(Config&), std::string meaning);

/// One word of a few, each of which sets something.
struct Choice {
  std::string word;
  void (*choose)(Config&);
};
Parameter choice(std::string name, std::vector<Choice> choices, std::string meaning,
                 std::function<std::string(const Config&)> get);

/// A list of numbers; `take` refuses one that it cannot use.
Parameter numbers(std::string name, std::string meaning, std::string accepted,
                  bool (*take)(Config&, const std::vector<double>&),
                  std::vector<double> (*get)(const Config&));

/// A number without limit.
constexpr double kAny = 1e9;

// The lists, in the order in which --help shows them.
void addCommonParameters(std::vector<Parameter>& all);
void addWaterAndBatteryParameters(std::vector<Parameter>& all);
void addFaultParameters(std::vector<Parameter>& all);
void addSandsharkParameters(std::vector<Parameter>& all);
void addKingfisherParameters(std::vector<Parameter>& all);

}  // namespace frontseat_driver::sim
