#include "frontseat_driver/sim/parameter.h"

#include <algorithm>
#include <numeric>

namespace frontseat_driver::sim {
namespace {

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

std::string nearestName(const std::vector<ParameterHelp>& known, std::string_view name) {
  return std::min_element(known.begin(), known.end(),
                          [name](const ParameterHelp& a, const ParameterHelp& b) {
                            return distance(a.name, name) < distance(b.name, name);
                          })
      ->name;
}

std::string unknownParameter(const std::vector<ParameterHelp>& known, std::string_view name) {
  return "there is no parameter '" + std::string{name} + "': did you mean '" +
         nearestName(known, name) + "'?";
}

}  // namespace frontseat_driver::sim
