#pragma once

namespace frontseat_driver::sim {

/// What a battery is made of.
struct BatteryType {
  double capacity_wh = 400.0;  ///< > 0
  double full_v = 16.4;        ///< open circuit
  double empty_v = 13.2;
  double resistance_ohm = 0.03;
};

/// A battery that drains with the power drawn from it; its voltage falls with charge and load.
class Battery {
 public:
  explicit Battery(const BatteryType& type) : type_(type), energy_wh_(type.capacity_wh) {}

  void drain(double power_w, double dt_s);
  void replace() { energy_wh_ = type_.capacity_wh; }

  double energyWh() const { return energy_wh_; }
  double fraction() const { return energy_wh_ / type_.capacity_wh; }  ///< 0 empty, 1 full
  double volts() const;                                               ///< under the present load

 private:
  BatteryType type_;
  double energy_wh_;
  double power_w_ = 0.0;
};

}  // namespace frontseat_driver::sim
