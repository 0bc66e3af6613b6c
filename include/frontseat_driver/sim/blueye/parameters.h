#pragma once

#include <vector>

#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/blueye/server.h"
#include "frontseat_driver/sim/parameter.h"

namespace frontseat_driver::sim {

/// All that `blueye_simulator` can be told.
struct BlueyeSimulatorConfig {
  BlueyeConfig drone;
  BlueyeServerConfig server;
};

/// Every parameter there is; the only list of them.
const std::vector<ParameterOf<BlueyeSimulatorConfig>>& blueyeParameters();

}  // namespace frontseat_driver::sim
