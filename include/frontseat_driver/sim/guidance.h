#pragma once

#include "frontseat_driver/sim/geography.h"
#include "frontseat_driver/sim/vehicle_state.h"

namespace frontseat_driver::sim {

/// A straight line over ground.
struct Line {
  PlanePoint from;
  PlanePoint to;
};

/// Metres of the line that the vehicle has behind it; negative before its beginning.
double alongTrack(const Line& line, const VehicleState& state);

/// Length, metres.
double length(const Line& line);

/// True heading, degrees, that brings the vehicle onto the line and along it: it aims at a point of
/// the line `lookahead_m` ahead of it.
double headingAlong(const Line& line, const VehicleState& state, double lookahead_m);

/// Whether the vehicle is within `radius_m` of the line's end, or has passed it.
bool atEnd(const Line& line, const VehicleState& state, double radius_m);

}  // namespace frontseat_driver::sim
