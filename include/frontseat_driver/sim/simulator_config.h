#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/sim/kingfisher_frontseat.h"
#include "frontseat_driver/sim/parameter.h"
#include "frontseat_driver/sim/sandshark_frontseat.h"
#include "frontseat_driver/sim/simulator_server.h"

namespace frontseat_driver::sim {

/// All that a simulator can be told.
struct SimulatorConfig {
  protocol::Dialect dialect = protocol::Dialect::Sandshark;
  ServerConfig server;
  FrontseatConfig vehicle;      ///< of either dialect
  SandsharkConfig sandshark;    ///< its FrontseatConfig is not used
  KingfisherConfig kingfisher;  ///< likewise
  Survey survey;
  std::vector<Leg> legs;  ///< instead of the survey, if there are any
};

/// The vehicle that a configuration describes, beginning at `start_time`.
std::unique_ptr<Frontseat> makeFrontseat(const SimulatorConfig& config, UtcTime start_time);

using SimulatorParameter = ParameterOf<SimulatorConfig>;

/// Every parameter there is; the only list of them.
const std::vector<SimulatorParameter>& simulatorParameters();

/// Sets one parameter. Returns the line that tells what is wrong, if anything is: it names the
/// parameter, its value and what is accepted.
std::optional<std::string> setParameter(SimulatorConfig& config, std::string_view name,
                                        const std::string& value);

/// What only both values together tell to be wrong, such as a rate the dialect does not have.
std::optional<std::string> findContradiction(const SimulatorConfig& config);

}  // namespace frontseat_driver::sim
