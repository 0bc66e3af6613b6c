#include "frontseat_driver/sim/guidance.h"

#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {

double length(const Line& line) {
  return std::hypot(line.to.east_m - line.from.east_m, line.to.north_m - line.from.north_m);
}

double alongTrack(const Line& line, const VehicleState& state) {
  const double whole_m = length(line);
  if (whole_m == 0.0) return 0.0;
  return ((state.east_m - line.from.east_m) * (line.to.east_m - line.from.east_m) +
          (state.north_m - line.from.north_m) * (line.to.north_m - line.from.north_m)) /
         whole_m;
}

double headingAlong(const Line& line, const VehicleState& state, double lookahead_m) {
  const double whole_m = length(line);
  const double aim = whole_m == 0.0 ? 1.0 : (alongTrack(line, state) + lookahead_m) / whole_m;
  const double east_m = line.from.east_m + aim * (line.to.east_m - line.from.east_m);
  const double north_m = line.from.north_m + aim * (line.to.north_m - line.from.north_m);
  return wrap360(degrees(std::atan2(east_m - state.east_m, north_m - state.north_m)));
}

bool atEnd(const Line& line, const VehicleState& state, double radius_m) {
  if (std::hypot(line.to.east_m - state.east_m, line.to.north_m - state.north_m) <= radius_m) {
    return true;
  }
  return length(line) > 0.0 && alongTrack(line, state) >= length(line);
}

}  // namespace frontseat_driver::sim
