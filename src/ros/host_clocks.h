#pragma once

#include <chrono>

#include "frontseat_driver/vehicle/clock.h"
#include "stamper.h"

namespace frontseat_driver::ros_layer {

/// The clocks of this computer.
class HostClocks {
 public:
  /// Now. `stamp` never goes back; where it is the system clock, both are one reading, so that a
  /// record of the stamps holds all that there was.
  vehicle::Now read();

  /// How far the simulated ROS clock was behind the latest stamp at the last reading: it was set
  /// back. Zero where the ROS clock is the system clock.
  std::chrono::nanoseconds simulatedBehind() const { return simulated_behind_; }

 private:
  StampGuard guard_;
  std::chrono::nanoseconds simulated_behind_{};
};

}  // namespace frontseat_driver::ros_layer
