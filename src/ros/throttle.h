#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Lets what repeats into the log at most once in five seconds.
class Throttle {
 public:
  static constexpr std::chrono::seconds kAtMostEvery{5};

  bool passes(vehicle::SteadyTime now) {
    if (last_ && now - *last_ < kAtMostEvery) {
      ++held_back_;
      return false;
    }
    last_ = now;
    return true;
  }

  /// For the end of a line that passes: " (and 3 times more before)", or nothing.
  std::string repeats() {
    const std::uint64_t times = std::exchange(held_back_, 0);
    return times == 0 ? "" : " (and " + std::to_string(times) + " times more before)";
  }

 private:
  std::optional<vehicle::SteadyTime> last_;
  std::uint64_t held_back_ = 0;
};

}  // namespace frontseat_driver::ros_layer
