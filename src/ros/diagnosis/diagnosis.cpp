#include "diagnosis/diagnosis.h"

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

namespace frontseat_driver::ros_layer {

Diagnoses diagnose(const Health& health) {
  Diagnoses all;
  all[0] = kLayers[0].diagnose(health);
  for (std::size_t i = 1; i < kLayers.size(); ++i) {
    if (health.link.connected) {
      all[i] = kLayers[i].diagnose(health);
    } else {
      all[i].message = health.replay ? "no record is being played" : "not known without a link";
      all[i].known = false;
    }
  }
  return all;
}

std::string printed(const char* format, ...) {
  char text[400];
  std::va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const auto longest = static_cast<int>(sizeof text) - 1;
  return {text, static_cast<std::size_t>(std::clamp(length, 0, longest))};
}

}  // namespace frontseat_driver::ros_layer
