#include "frontseat_driver/sim/simulator_config.h"

#include <algorithm>
#include <numeric>

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

/// Levenshtein distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
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
  for (const SimulatorParameter& parameter : simulatorParameters()) {
    if (parameter.name != name) continue;
    if (parameter.set(config, value)) return std::nullopt;
    return "parameter '" + parameter.name + "' is '" + value + "': accepted is " +
           parameter.accepted;
  }
  return "there is no parameter '" + std::string{name} + "': did you mean '" +
         nearestParameter(name) + "'?";
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

std::string nearestParameter(std::string_view name) {
  const auto& all = simulatorParameters();
  return std::min_element(all.begin(), all.end(),
                          [name](const SimulatorParameter& a, const SimulatorParameter& b) {
                            return distance(a.name, name) < distance(b.name, name);
                          })
      ->name;
}

}  // namespace frontseat_driver::sim
