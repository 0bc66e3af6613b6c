#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/simulator_config.h"
#include "parameter_of.h"

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
  return ParameterKinds<Config>::whole<Integer>(std::move(name), in_config, low, high,
                                                std::move(meaning));
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

// The lists, in the order in which --help shows them.
void addCommonParameters(std::vector<Parameter>& all);
void addWaterAndBatteryParameters(std::vector<Parameter>& all);
void addFaultParameters(std::vector<Parameter>& all);
void addSandsharkParameters(std::vector<Parameter>& all);
void addKingfisherParameters(std::vector<Parameter>& all);

}  // namespace frontseat_driver::sim
