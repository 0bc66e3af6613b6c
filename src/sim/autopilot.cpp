#include "frontseat_driver/sim/autopilot.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kLeastSteerage_m_s = 0.3;  // below it fins do nothing

double rudder(const Setpoint& setpoint, const VehicleState& state) {
  if (setpoint.horizontal_mode == Setpoint::HorizontalMode::Rudder) {
    return radians(setpoint.horizontal_deg);
  }
  const double error = wrapPi(radians(setpoint.horizontal_deg) - state.heading_rad);
  return 1.0 * error - 0.5 * state.yaw_rate_rad_s;
}

double elevatorForPitch(double pitch_rad, const VehicleState& state) {
  if (state.surge_m_s < kLeastSteerage_m_s) return 0.0;
  return Torpedo::elevatorFor(pitch_rad, state.surge_m_s) + 0.5 * (pitch_rad - state.pitch_rad) -
         0.3 * state.pitch_rate_rad_s;
}

/// Pitch that brings the vehicle to a depth, its buoyancy made up for.
double pitchForDepth(double depth_m, const VehicleState& state, const SafeLimits& limits) {
  const double sink_m_s = 0.25 * (depth_m - state.depth_m) + Torpedo::kRise;
  const double speed_m_s = std::max(kLeastSteerage_m_s, state.surge_m_s);
  const double most = std::sin(radians(limits.max_pitch_deg));
  return -std::asin(std::clamp(sink_m_s / speed_m_s, -most, most));
}

double safeDepth(double depth_m, const VehicleState& state, const SafeLimits& limits) {
  const double bottom_m = state.depth_m + state.altitude_m;
  return std::clamp(depth_m, 0.0,
                    std::max(0.0, std::min(limits.max_depth_m, bottom_m - limits.min_altitude_m)));
}

double elevator(const Setpoint& setpoint, const VehicleState& state, const SafeLimits& limits) {
  using Mode = Setpoint::VerticalMode;
  const double bottom_m = state.depth_m + state.altitude_m;
  double depth_m = setpoint.vertical;
  switch (setpoint.vertical_mode) {
    case Mode::Depth:
      break;
    case Mode::Altitude:
      depth_m = bottom_m - setpoint.vertical;
      break;
    case Mode::Pitch: {
      const double most = limits.max_pitch_deg;
      return elevatorForPitch(radians(std::clamp(setpoint.vertical, -most, most)), state);
    }
    case Mode::Elevator:
      return radians(setpoint.vertical);
  }
  return elevatorForPitch(pitchForDepth(safeDepth(depth_m, state, limits), state, limits), state);
}

/// Thrust of one motor for what it is to effect: astern it effects less.
double thrustFor(double effect) {
  return std::clamp(effect < 0.0 ? effect / Catamaran::kAstern : effect, -1.0, 1.0);
}

/// Both motors; the turn comes first, thrust takes what is left.
Catamaran::Thrust share(double ahead, double turn) {
  const double turning = std::clamp(turn, -0.8, 0.8);
  const double room = 1.0 - std::abs(turning);
  const double both = std::clamp(ahead, std::min(0.0, -Catamaran::kAstern + std::abs(turning)),
                                 std::max(0.0, room));
  return {thrustFor(both + turning), thrustFor(both - turning)};
}

}  // namespace

Torpedo::Actuators steer(const Setpoint& setpoint, const VehicleState& state,
                         const SafeLimits& limits) {
  Torpedo::Actuators actuators;
  actuators.rudder_rad = rudder(setpoint, state);
  actuators.elevator_rad = elevator(setpoint, state, limits);
  actuators.thruster_rpm = setpoint.speed_mode == Setpoint::SpeedMode::Rpm
                               ? setpoint.speed
                               : setpoint.speed / Torpedo::kSpeedPerRpm;
  return actuators;
}

Catamaran::Thrust helm(double yaw_rate_rad_s, double thrust, const VehicleState& state) {
  const double turn = yaw_rate_rad_s + 0.6 * (yaw_rate_rad_s - state.yaw_rate_rad_s);
  const double ahead = thrust < 0.0 ? Catamaran::kAstern * thrust : thrust;
  return share(ahead, turn / Catamaran::kMaxTurn_rad_s);
}

Catamaran::Thrust hold(double heading_deg, double speed_m_s, const VehicleState& state) {
  const double error = wrapPi(radians(heading_deg) - state.heading_rad);
  const double over_ground_m_s = state.velocity_east_m_s * std::sin(state.heading_rad) +
                                 state.velocity_north_m_s * std::cos(state.heading_rad);
  const double wanted_m_s = speed_m_s * std::max(0.2, std::cos(error));
  const double through_water_m_s = wanted_m_s + (wanted_m_s - over_ground_m_s);
  return helm(std::clamp(0.8 * error, -0.6, 0.6),
              std::clamp(through_water_m_s / Catamaran::kMaxSpeed, 0.0, 1.0), state);
}

}  // namespace frontseat_driver::sim
