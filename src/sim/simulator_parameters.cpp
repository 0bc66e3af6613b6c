#include "parameter_kinds.h"

namespace frontseat_driver::sim {

const std::vector<SimulatorParameter>& simulatorParameters() {
  static const std::vector<SimulatorParameter> kAll = [] {
    std::vector<SimulatorParameter> all;
    addCommonParameters(all);
    addWaterAndBatteryParameters(all);
    addFaultParameters(all);
    addSandsharkParameters(all);
    addKingfisherParameters(all);
    return all;
  }();
  return kAll;
}

}  // namespace frontseat_driver::sim
