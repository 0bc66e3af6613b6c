#pragma once

#include "frontseat_driver/protocol/bluefin/behavior_change.h"
#include "frontseat_driver/sim/catamaran.h"
#include "frontseat_driver/sim/torpedo.h"

namespace frontseat_driver::sim {

/// What a torpedo is to do: one value and one mode for each of the three aspects.
struct Setpoint {
  using HorizontalMode = protocol::bluefin::BehaviorChange::HorizontalMode;
  using VerticalMode = protocol::bluefin::BehaviorChange::VerticalMode;
  using SpeedMode = protocol::bluefin::BehaviorChange::SpeedMode;

  HorizontalMode horizontal_mode = HorizontalMode::Rudder;
  double horizontal_deg = 0.0;  ///< true heading, or rudder to starboard
  VerticalMode vertical_mode = VerticalMode::Elevator;
  double vertical = 0.0;  ///< m of depth or altitude, degrees of pitch or elevator, bow up
  SpeedMode speed_mode = SpeedMode::Rpm;
  double speed = 0.0;  ///< rpm or m/s through the water
};

/// What a torpedo is never brought beyond.
struct SafeLimits {
  double max_depth_m = 50.0;
  double min_altitude_m = 1.5;
  double max_pitch_deg = 30.0;
};

/// Fins and thruster that bring a torpedo to its setpoint.
Torpedo::Actuators steer(const Setpoint& setpoint, const VehicleState& state,
                         const SafeLimits& limits);

/// Motors for a rate of turn (clockwise) at a thrust of -1..1.
Catamaran::Thrust helm(double yaw_rate_rad_s, double thrust, const VehicleState& state);

/// Motors for a true heading and a speed over ground.
Catamaran::Thrust hold(double heading_deg, double speed_m_s, const VehicleState& state);

}  // namespace frontseat_driver::sim
