#pragma once

#include "frontseat_driver/vehicle/clock.h"
#include "stamper.h"

namespace frontseat_driver::ros_layer {

/// The clocks of this computer.
class HostClocks {
 public:
  /// Now. `stamp` never goes back; where it is the system clock, both are one reading, so that a
  /// record of the stamps holds all that there was.
  vehicle::Now read();

 private:
  StampGuard guard_;
};

}  // namespace frontseat_driver::ros_layer
