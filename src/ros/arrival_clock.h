#pragma once

#include <algorithm>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Tells how far apart sentences arrived by their stamps, which is all that a record holds: what is
/// fresh, or a jump, when it is heard is the same in a replay. While the stamps stand still, as
/// with /use_sim_time and no clock, the steady clock goes on for them.
class ArrivalClock {
 public:
  /// The arrival with a steady time that goes by the stamps.
  vehicle::Now take(vehicle::Now arrival) {
    if (last_) {
      const auto by_stamps = arrival.stamp - last_->stamp;
      const auto by_steady = arrival.steady - last_->steady;
      at_ += by_stamps > by_stamps.zero() ? by_stamps : std::max(by_steady, by_steady.zero());
    }
    last_ = arrival;
    arrival.steady = at_;
    return arrival;
  }

 private:
  std::optional<vehicle::Now> last_;
  vehicle::SteadyTime at_{};
};

}  // namespace frontseat_driver::ros_layer
