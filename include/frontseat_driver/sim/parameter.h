#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frontseat_driver::sim {

/// One parameter of a simulator: its text, as a command line or a YAML file has it.
template <class Config>
struct ParameterOf {
  std::string name;
  std::string meaning;                                   ///< with its unit
  std::string accepted;                                  ///< in words
  std::function<bool(Config&, const std::string&)> set;  ///< false: not accepted
  std::function<std::string(const Config&)> get;
};

/// What a command line tells of a parameter.
struct ParameterHelp {
  std::string name;
  std::string meaning;
  std::string accepted;
  std::string standard;  ///< its value unless told otherwise
};

template <class Config>
std::vector<ParameterHelp> helpOf(const std::vector<ParameterOf<Config>>& parameters) {
  const Config standard;
  std::vector<ParameterHelp> help;
  help.reserve(parameters.size());
  for (const auto& parameter : parameters) {
    help.push_back(
        {parameter.name, parameter.meaning, parameter.accepted, parameter.get(standard)});
  }
  return help;
}

/// The name that is spelt most like `name`.
std::string nearestName(const std::vector<ParameterHelp>& known, std::string_view name);

/// The line for a name that is no parameter: it tells the nearest one.
std::string unknownParameter(const std::vector<ParameterHelp>& known, std::string_view name);

/// Sets one parameter. Returns the line that tells what is wrong, if anything is: it names the
/// parameter, its value and what is accepted.
template <class Config>
std::optional<std::string> setParameter(const std::vector<ParameterOf<Config>>& all, Config& config,
                                        std::string_view name, const std::string& value) {
  for (const auto& parameter : all) {
    if (parameter.name != name) continue;
    if (parameter.set(config, value)) return std::nullopt;
    return "parameter '" + parameter.name + "' is '" + value + "': accepted is " +
           parameter.accepted;
  }
  return unknownParameter(helpOf(all), name);
}

}  // namespace frontseat_driver::sim
