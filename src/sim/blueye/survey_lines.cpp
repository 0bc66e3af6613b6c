#include "survey_lines.h"

#include <algorithm>
#include <cmath>

namespace frontseat_driver::sim {
namespace {

constexpr int kMostLines = 1000;

/// Along the lines, and across them to the right.
struct Rotated {
  double along = 0.0;
  double across = 0.0;
};

}  // namespace

std::vector<PlanePoint> surveyLines(const std::vector<PlanePoint>& polygon, double heading_rad,
                                    double spacing_m, double turnaround_m, bool reverse) {
  if (polygon.size() < 3 || !(spacing_m > 0.0)) return {};
  const double sin_heading = std::sin(heading_rad);
  const double cos_heading = std::cos(heading_rad);
  std::vector<Rotated> corners;
  corners.reserve(polygon.size());
  for (const PlanePoint& corner : polygon) {
    corners.push_back({cos_heading * corner.north_m + sin_heading * corner.east_m,
                       -sin_heading * corner.north_m + cos_heading * corner.east_m});
  }
  const auto [low, high] =
      std::minmax_element(corners.begin(), corners.end(),
                          [](const Rotated& a, const Rotated& b) { return a.across < b.across; });
  if ((high->across - low->across) / spacing_m > kMostLines) return {};

  std::vector<PlanePoint> ends;
  bool back = false;
  for (int line = 0; line <= kMostLines; ++line) {
    const double across = low->across + (line + 0.5) * spacing_m;
    if (across >= high->across) break;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Rotated& a = corners[i];
      const Rotated& b = corners[(i + 1) % corners.size()];
      if ((a.across <= across) == (b.across <= across)) continue;
      const double share = (across - a.across) / (b.across - a.across);
      crossings.push_back(a.along + share * (b.along - a.along));
    }
    if (crossings.size() < 2) continue;
    const auto [first, last] = std::minmax_element(crossings.begin(), crossings.end());
    double from = *first - turnaround_m;
    double to = *last + turnaround_m;
    if (back) std::swap(from, to);
    back = !back;
    for (const double along : {from, to}) {
      PlanePoint end;
      end.north_m = cos_heading * along - sin_heading * across;
      end.east_m = sin_heading * along + cos_heading * across;
      ends.push_back(end);
    }
  }
  if (reverse) std::reverse(ends.begin(), ends.end());
  return ends;
}

}  // namespace frontseat_driver::sim
