#pragma once

#include "frontseat_driver/sim/vehicle_model.h"

namespace frontseat_driver::sim {

/// A torpedo-shaped vehicle of the size of a Sandshark: one thruster, rudder, elevator, slightly
/// buoyant.
class Torpedo : public VehicleModel {
 public:
  static constexpr double kMaxRpm = 1250.0;
  static constexpr double kSpeedPerRpm = 0.002;  ///< m/s per rpm, steady: 2.0 m/s at 1000 rpm
  static constexpr double kMaxSpeed = kMaxRpm * kSpeedPerRpm;
  static constexpr double kMaxFin_rad = 0.35;    ///< about 20 degrees
  static constexpr double kTurningRadius = 4.0;  ///< m, rudder hard over, at any speed
  static constexpr double kRise = 0.05;          ///< m/s upwards by buoyancy

  struct Actuators {
    double rudder_rad = 0.0;    ///< positive turns to starboard
    double elevator_rad = 0.0;  ///< positive lifts the bow
    double thruster_rpm = 0.0;
  };

  Torpedo(const Environment& environment, const Start& start, const BatteryType& battery);

  /// Sets what the actuators go to; values beyond their limits are limited.
  void command(const Actuators& actuators);

  /// What the thruster turns at, with its lag.
  double thrusterRpm() const { return actual_.thruster_rpm; }

  /// Elevator that holds a pitch at a speed, before limits.
  static double elevatorFor(double pitch_rad, double surge_m_s);

 private:
  Acceleration accelerate(double dt_s) override;
  double power() const override;
  double sinkRate() const override;

  Actuators commanded_;
  Actuators actual_;
};

}  // namespace frontseat_driver::sim
