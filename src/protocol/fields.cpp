#include "fields.h"

#include <cmath>

namespace frontseat_driver::protocol {

void writeHeading(const std::optional<double>& heading_deg, int decimals,
                  nmea::SentenceWriter& out) {
  if (!heading_deg) return out.blank();
  const bool usual = *heading_deg >= 0.0 && *heading_deg < 359.0;  // what rounding makes no turn of
  if (usual) return out.number(*heading_deg, decimals);
  const double turned = std::fmod(*heading_deg, 360.0);
  const double wrapped = turned < 0.0 ? turned + 360.0 : turned;
  const double units = std::pow(10.0, decimals);
  const bool full_turn = std::nearbyint(wrapped * units) >= 360.0 * units;
  out.number(full_turn ? 0.0 : wrapped, decimals);
}

}  // namespace frontseat_driver::protocol
