#pragma once

#include "frontseat_driver/sim/vehicle_model.h"

namespace frontseat_driver::sim {

/// A catamaran of the size of a Kingfisher: two motors, steered by their difference.
class Catamaran : public VehicleModel {
 public:
  static constexpr double kMaxSpeed = 1.7;       ///< m/s, both motors full ahead
  static constexpr double kMaxTurn_rad_s = 1.2;  ///< per full difference of the motors' effect
  static constexpr double kAstern = 0.6;         ///< effect of a motor astern to one ahead

  /// -1 full astern to 1 full ahead.
  struct Thrust {
    double port = 0.0;
    double starboard = 0.0;
  };

  /// `waves_deg`: amplitude of the roll that waves cause; 0 for flat water.
  Catamaran(const Environment& environment, const Start& start, const BatteryType& battery,
            double waves_deg);

  /// Sets what the motors go to; values beyond -1..1 are limited.
  void command(const Thrust& thrust);
  const Thrust& commanded() const { return commanded_; }

 private:
  Acceleration accelerate(double dt_s) override;
  double power() const override;

  Thrust commanded_;
  Thrust actual_;
  double waves_rad_;
  double elapsed_s_ = 0.0;
};

}  // namespace frontseat_driver::sim
