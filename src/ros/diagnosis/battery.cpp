#include <algorithm>

#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

using Level = Diagnosis::Level;

// A load that starts pulls the voltage down for a moment.
constexpr double kLasting_s = 10.0;
// Of the voltage at which a battery is low, for NiMH 1.0 of 1.1 V and for Li-ion 3.0 of 3.3 V.
constexpr double kEmpty = 10.0 / 11.0;

std::string nameOf(const BatteryHealth& battery) {
  return battery.id ? "battery " + std::to_string(*battery.id) : "battery";
}

std::string describe(const BatteryHealth& battery) {
  std::string text = printed("%.2f V", battery.stack_v);
  if (battery.cells > 1 && battery.lowest_cell_v) {
    text += printed(", the lowest of %zu cells %.2f V", battery.cells, *battery.lowest_cell_v);
  }
  return text;
}

bool isLow(const BatteryHealth& battery) { return battery.low_for_s >= kLasting_s; }

/// The weakest of those that are low, or of all: a dip of one must not hide that another is low.
const BatteryHealth& weakestOf(const std::vector<BatteryHealth>& batteries) {
  return *std::min_element(batteries.begin(), batteries.end(),
                           [](const BatteryHealth& a, const BatteryHealth& b) {
                             if (isLow(a) != isLow(b)) return isLow(a);
                             return a.weakest_v < b.weakest_v;
                           });
}

void judge(const Health& health, Diagnosis& diagnosis) {
  if (health.batteries.empty()) {
    diagnosis.message = "the vehicle tells no voltage";
    return;
  }
  const BatteryHealth& weakest = weakestOf(health.batteries);
  diagnosis.message = describe(weakest);
  if (health.battery_low_v <= 0.0 || !isLow(weakest)) return;
  const bool empty = weakest.weakest_v < kEmpty * health.battery_low_v;
  diagnosis.level = empty ? Level::Error : Level::Warn;
  diagnosis.message =
      nameOf(weakest) + (empty ? " is empty: " : " is low: ") + diagnosis.message +
      printed(", where battery_low_voltage is %.1f V; bring the vehicle home and charge it",
              health.battery_low_v);
  if (weakest.cells > 1) {
    diagnosis.message += printed(" (that is %.2f V for each cell)",
                                 health.battery_low_v / static_cast<double>(weakest.cells));
  }
}

}  // namespace

Diagnosis diagnoseBattery(const Health& health) {
  Diagnosis diagnosis;
  judge(health, diagnosis);
  for (const BatteryHealth& battery : health.batteries) {
    diagnosis.values.emplace_back(nameOf(battery), describe(battery));
  }
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
