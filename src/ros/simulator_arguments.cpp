#include "simulator_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>

namespace frontseat_driver::sim {
namespace {

/// `_name:=value` as `--name=value`; remappings of topics and `__name` mean nothing here.
std::vector<std::string> withoutRemappings(const std::vector<std::string>& arguments) {
  std::vector<std::string> plain;
  for (const std::string& argument : arguments) {
    const std::size_t assignment = argument.find(":=");
    if (assignment == std::string::npos) {
      plain.push_back(argument);
    } else if (argument[0] == '_' && argument[1] != '_') {
      plain.push_back("--" + argument.substr(1, assignment - 1) + "=" +
                      argument.substr(assignment + 2));
    }
  }
  return plain;
}

/// An option that does not exist; empty if all do.
std::string unknownOption(const std::vector<ParameterHelp>& known,
                          const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument.compare(0, 2, "--") != 0) continue;
    const std::string name = argument.substr(2, argument.find('=') - 2);
    const bool found = name == "no-ros" || name == "help" ||
                       std::any_of(known.begin(), known.end(),
                                   [&](const auto& parameter) { return parameter.name == name; });
    if (!found) return name;
  }
  return {};
}

SimulatorArguments ended(int exit_code) {
  SimulatorArguments arguments;
  arguments.ended = true;
  arguments.exit_code = exit_code;
  return arguments;
}

void addOptions(const std::vector<ParameterHelp>& known, CLI::App& app,
                std::map<std::string, std::string>& values) {
  for (const ParameterHelp& parameter : known) {
    app.add_option("--" + parameter.name, values[parameter.name],
                   parameter.meaning + " (" + parameter.standard + "); " + parameter.accepted)
        ->type_name("");
  }
}

}  // namespace

SimulatorArguments parseArguments(const SimulatorProgram& program,
                                  const std::vector<std::string>& arguments) {
  const std::vector<std::string> plain = withoutRemappings(arguments);
  const std::vector<ParameterHelp>& known = program.parameters;
  if (const std::string unknown = unknownOption(known, plain); !unknown.empty()) {
    std::cerr << unknownParameter(known, unknown) << std::endl;
    return ended(EXIT_FAILURE);
  }
  CLI::App app{
      program.description +
          "\nParameters may also be given as _name:=value and, with ROS, in its namespace.",
      program.name};
  SimulatorArguments parsed;
  bool no_ros = false;
  app.add_flag("--no-ros", no_ros, "serve without a ROS master; nothing is published");
  std::map<std::string, std::string> values;
  addOptions(known, app, values);
  std::vector<std::string> last_first{plain.rbegin(), plain.rend()};  // as CLI11 wants them
  try {
    app.parse(last_first);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == EXIT_SUCCESS) return ended(app.exit(error));  // --help
    std::cerr << error.what() << std::endl;
    return ended(EXIT_FAILURE);
  }
  parsed.with_ros = !no_ros;
  for (const auto& [name, value] : values) {
    if (app.count("--" + name) > 0) parsed.values.emplace_back(name, value);
  }
  return parsed;
}

}  // namespace frontseat_driver::sim
