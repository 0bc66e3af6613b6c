#pragma once

#include "frontseat_driver/sim/vehicle_model.h"

namespace frontseat_driver::sim {

/// One number for each way a ROV can be pushed: x bow, y starboard, z down, and about them.
struct RovAxes {
  double surge = 0.0;  ///< forward
  double sway = 0.0;   ///< to starboard
  double heave = 0.0;  ///< down
  double yaw = 0.0;    ///< clockwise seen from above
  double roll = 0.0;   ///< starboard side down
  double pitch = 0.0;  ///< bow up
};

/// What a ROV does along one axis: its mass (with the water it drags along) or inertia, the most
/// its thrusters give, and the speed at which water takes that up.
struct RovAxis {
  double mass;       ///< kg, or kg m^2
  double force;      ///< N, or N m, all thrusters full
  double linear;     ///< damping in N per m/s, or N m per rad/s
  double top_speed;  ///< m/s, or rad/s, at full force

  /// Resistance at a speed, of the same sign.
  double drag(double speed) const;
};

/// A small ROV of the size of a Blueye X3: four degrees of freedom are driven, roll and pitch right
/// themselves. A little buoyant, so it comes up when nothing holds it down.
class Rov : public VehicleModel {
 public:
  static constexpr RovAxis kSurge{14.0, 45.0, 6.0, 1.5};
  static constexpr RovAxis kSway{22.0, 30.0, 10.0, 0.7};
  static constexpr RovAxis kHeave{22.0, 35.0, 10.0, 0.7};
  static constexpr RovAxis kYaw{0.5, 8.0, 1.0, 1.8};
  static constexpr double kLean_rad = 0.35;  ///< roll or pitch that full effort holds

  Rov(const Environment& environment, const Start& start, const BatteryType& battery,
      double buoyancy_n);

  /// Sets what the thrusters go to, in parts of their full force; beyond -1..1 is limited.
  void command(const RovAxes& effort);
  const RovAxes& commanded() const { return commanded_; }
  const RovAxes& actual() const { return actual_; }  ///< what the thrusters give now

  /// What else draws power: lights, guest port devices. W.
  void setAuxiliaryPower(double power_w) { auxiliary_w_ = power_w; }
  double drawnPower() const { return power(); }  ///< W
  double buoyancy() const { return buoyancy_n_; }

  double yawRate() const { return angleRates().heading_rad_s; }  ///< clockwise

 private:
  Acceleration accelerate(double dt_s) override;
  double sinkRate() const override { return heave_m_s_; }
  double power() const override;
  void followCommand(double dt_s);

  double buoyancy_n_;
  double auxiliary_w_ = 0.0;
  double heave_m_s_ = 0.0;
  RovAxes commanded_;
  RovAxes actual_;
};

}  // namespace frontseat_driver::sim
