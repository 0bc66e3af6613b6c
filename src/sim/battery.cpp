#include "frontseat_driver/sim/battery.h"

#include <algorithm>

namespace frontseat_driver::sim {

void Battery::drain(double power_w, double dt_s) {
  power_w_ = power_w;
  energy_wh_ = std::max(0.0, energy_wh_ - power_w * dt_s / 3600.0);
}

double Battery::volts() const {
  const double open_circuit_v = type_.empty_v + (type_.full_v - type_.empty_v) * fraction();
  return open_circuit_v - type_.resistance_ohm * power_w_ / open_circuit_v;
}

}  // namespace frontseat_driver::sim
