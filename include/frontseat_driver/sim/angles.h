#pragma once

#include <cmath>

namespace frontseat_driver::sim {

constexpr double kPi = 3.14159265358979323846;

constexpr double degrees(double rad) { return rad * (180.0 / kPi); }
constexpr double radians(double deg) { return deg * (kPi / 180.0); }

/// The same angle in [0, 360).
inline double wrap360(double deg) {
  const double rest = std::fmod(deg, 360.0);
  const double wrapped = rest < 0.0 ? rest + 360.0 : rest;
  return wrapped >= 360.0 ? 0.0 : wrapped;
}

/// The same angle in [-pi, pi].
inline double wrapPi(double rad) { return std::remainder(rad, 2.0 * kPi); }

}  // namespace frontseat_driver::sim
