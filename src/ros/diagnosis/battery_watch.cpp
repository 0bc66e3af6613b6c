#include "diagnosis/battery_watch.h"

#include <cmath>

namespace frontseat_driver::ros_layer {

namespace {

/// A blank is sent as 0 by some vehicles.
bool told(const std::optional<double>& volts) { return volts && *volts > 0.0; }

BatteryHealth healthOf(const vehicle::Battery& battery) {
  BatteryHealth health;
  health.id = battery.id;
  health.stack_v = health.weakest_v = *battery.stack_v;
  if (!told(battery.lowest_cell_v) || !told(battery.highest_cell_v)) return health;
  const double cell_v = (*battery.lowest_cell_v + *battery.highest_cell_v) / 2.0;
  const double cells = std::round(*battery.stack_v / cell_v);
  if (cells < 1.0 || cells > 1000.0) return health;
  health.lowest_cell_v = battery.lowest_cell_v;
  health.cells = static_cast<std::size_t>(cells);
  health.weakest_v = cells * *battery.lowest_cell_v;
  return health;
}

}  // namespace

void BatteryWatch::take(const vehicle::Battery& battery, vehicle::SteadyTime now) {
  if (!told(battery.stack_v)) return;
  if (batteries_.size() == kMost && batteries_.count(battery.id) == 0) return;
  Followed& followed = batteries_[battery.id];
  followed.health = healthOf(battery);
  if (followed.health.weakest_v >= low_v_) {
    followed.low_since.reset();
  } else if (!followed.low_since) {
    followed.low_since = now;
  }
}

std::vector<BatteryHealth> BatteryWatch::take(vehicle::SteadyTime now) const {
  std::vector<BatteryHealth> all;
  for (const auto& [id, followed] : batteries_) {
    all.push_back(followed.health);
    if (followed.low_since) all.back().low_for_s = inSeconds(now - *followed.low_since);
  }
  return all;
}

}  // namespace frontseat_driver::ros_layer
