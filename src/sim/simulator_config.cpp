#include "frontseat_driver/sim/simulator_config.h"

#include <algorithm>

namespace frontseat_driver::sim {
namespace {

bool knows(const std::vector<Rate>& rates, const std::string& sentence) {
  return std::any_of(rates.begin(), rates.end(),
                     [&](const Rate& rate) { return rate.sentence == sentence; });
}

std::string namesOf(const std::vector<Rate>& rates) {
  std::string names;
  for (const Rate& rate : rates) names.append(names.empty() ? "" : ", ").append(rate.sentence);
  return names;
}

}  // namespace

std::unique_ptr<Frontseat> makeFrontseat(const SimulatorConfig& config, UtcTime start_time) {
  FrontseatConfig vehicle = config.vehicle;
  vehicle.start_time = start_time;
  if (config.dialect == protocol::Dialect::Kingfisher) {
    KingfisherConfig kingfisher = config.kingfisher;
    static_cast<FrontseatConfig&>(kingfisher) = vehicle;
    return std::make_unique<KingfisherFrontseat>(kingfisher);
  }
  SandsharkConfig sandshark = config.sandshark;
  static_cast<FrontseatConfig&>(sandshark) = vehicle;
  sandshark.mission.legs = config.legs.empty() ? lawnMower(config.survey) : config.legs;
  return std::make_unique<SandsharkFrontseat>(sandshark);
}

std::optional<std::string> setParameter(SimulatorConfig& config, std::string_view name,
                                        const std::string& value) {
  return setParameter(simulatorParameters(), config, name, value);
}

std::optional<std::string> findContradiction(const SimulatorConfig& config) {
  const std::vector<Rate>& rates = defaultRates(config.dialect);
  for (const auto& [sentence, hz] : config.vehicle.rates) {
    if (knows(rates, sentence)) continue;
    return "parameter 'rates' is '" + sentence + "': accepted for a " +
           protocol::toString(config.dialect) + " are " + namesOf(rates);
  }
  return std::nullopt;
}

}  // namespace frontseat_driver::sim
