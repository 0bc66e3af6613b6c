#pragma once

#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/parameter.h"

namespace frontseat_driver::sim {

/// A program with parameters.
struct SimulatorProgram {
  std::string name;
  std::string description;
  std::vector<ParameterHelp> parameters;
};

/// What the command line of a simulator says.
struct SimulatorArguments {
  bool with_ros = true;
  /// The program is to end at once with this exit code; what there is to say has been printed.
  bool ended = false;
  int exit_code = 0;
  std::vector<std::pair<std::string, std::string>> values;  ///< parameters by name
};

/// Reads `--name value` and, as ROS writes it, `_name:=value`; other remappings are left alone.
SimulatorArguments parseArguments(const SimulatorProgram& program,
                                  const std::vector<std::string>& arguments);

}  // namespace frontseat_driver::sim
