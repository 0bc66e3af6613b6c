#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "diagnosis/health.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::ros_layer {

/// Follows every battery that the vehicle tells of, and how long it has been low.
///
/// A stack is as low as its weakest cell: the lowest cell times their number counts. The number
/// follows from the voltages: a stack of 14.4 V with cells near 1.2 V has twelve. A Heron that
/// repeats the stack's voltage in place of the cells' so counts as one cell, which is right.
class BatteryWatch {
 public:
  /// Other ids than the first so many are not followed: no vehicle has more.
  static constexpr std::size_t kMost = 16;

  explicit BatteryWatch(double low_v) : low_v_(low_v) {}

  void take(const vehicle::Battery& battery, vehicle::SteadyTime now);
  std::vector<BatteryHealth> take(vehicle::SteadyTime now) const;
  void clear() { batteries_.clear(); }

 private:
  struct Followed {
    BatteryHealth health;
    std::optional<vehicle::SteadyTime> low_since;
  };

  double low_v_;
  std::map<std::optional<std::int64_t>, Followed> batteries_;
};

}  // namespace frontseat_driver::ros_layer
