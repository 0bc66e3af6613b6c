#pragma once

#include <chrono>

namespace frontseat_driver::vehicle {

/// Intervals and time-outs: never steps.
using SteadyTime = std::chrono::steady_clock::time_point;

/// Time since 1970-01-01 00:00 UTC, leap seconds not counted.
using UtcTime = std::chrono::nanoseconds;

/// The same moment on the three clocks the driver lives with. Handed in from outside: nothing below
/// the driver asks a clock.
struct Now {
  SteadyTime steady{};  ///< for intervals and time-outs
  UtcTime utc{};        ///< system clock; goes into sentences to the vehicle
  UtcTime stamp{};      ///< the clock of the published stamps, such as ROS time
};

}  // namespace frontseat_driver::vehicle
