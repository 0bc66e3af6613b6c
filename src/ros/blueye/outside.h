#pragma once

#include <cstdio>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {

/// Why `value` is refused, with what would be right; empty if it lies from `low` to `high`.
inline std::string outside(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return {};  // false for NaN
  char text[120];
  std::snprintf(text, sizeof text, "%s is %.10g; %g to %g is accepted", name, value, low, high);
  return text;
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
