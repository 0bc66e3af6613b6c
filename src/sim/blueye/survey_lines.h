#pragma once

#include <vector>

#include "frontseat_driver/sim/geography.h"

namespace frontseat_driver::sim {

/// The ends of parallel lines over a polygon, in the order in which they are run, there and back.
/// `heading_rad` is that of the lines, clockwise from north; `turnaround_m` lengthens each at both
/// ends. Empty if the polygon has fewer than three corners or `spacing_m` is not positive.
std::vector<PlanePoint> surveyLines(const std::vector<PlanePoint>& polygon, double heading_rad,
                                    double spacing_m, double turnaround_m, bool reverse);

}  // namespace frontseat_driver::sim
