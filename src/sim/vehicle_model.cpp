#include "frontseat_driver/sim/vehicle_model.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/geography.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kGravity = 9.80665;
/// The surface and the bottom are neared ever more slowly, so that no velocity jumps there.
constexpr double kBoundary_s = 0.5;

/// The mean of a rate before and after a step moves what it is the rate of (trapezoidal rule).
double moved(double before, double after, double dt_s) { return 0.5 * (before + after) * dt_s; }

}  // namespace

VehicleModel::VehicleModel(const Environment& environment, const Start& start,
                           const BatteryType& battery)
    : environment_(environment), battery_(battery) {
  const double set = radians(environment.current_set_deg);
  state_.east_m = start.east_m;
  state_.north_m = start.north_m;
  state_.heading_rad = radians(wrap360(start.heading_deg));
  state_.velocity_east_m_s = environment.current_drift_m_s * std::sin(set);
  state_.velocity_north_m_s = environment.current_drift_m_s * std::cos(set);
  state_.altitude_m = environment.bottom_depth_m;
  state_.stack_v = battery_.volts();
  state_.energy_wh = battery_.energyWh();
}

void VehicleModel::step(double dt_s) {
  const Acceleration acceleration = accelerate(dt_s);
  turn(acceleration, dt_s);
  state_.surge_m_s += acceleration.surge_m_s2 * dt_s;
  state_.sway_m_s += acceleration.sway_m_s2 * dt_s;
  translate(dt_s);
  updateBodyRates();
  battery_.drain(power(), dt_s);
  state_.stack_v = battery_.volts();
  state_.energy_wh = battery_.energyWh();
}

nmea::LatLon VehicleModel::position() const {
  return fromPlane(environment_.datum, {state_.east_m, state_.north_m});
}

void VehicleModel::turn(const Acceleration& acceleration, double dt_s) {
  const AngleRates before = rates_;
  rates_.heading_rad_s += acceleration.heading_rad_s2 * dt_s;
  rates_.pitch_rad_s += acceleration.pitch_rad_s2 * dt_s;
  rates_.roll_rad_s += acceleration.roll_rad_s2 * dt_s;
  const double heading =
      state_.heading_rad + moved(before.heading_rad_s, rates_.heading_rad_s, dt_s);
  state_.heading_rad = radians(wrap360(degrees(heading)));
  state_.pitch_rad += moved(before.pitch_rad_s, rates_.pitch_rad_s, dt_s);
  state_.roll_rad += moved(before.roll_rad_s, rates_.roll_rad_s, dt_s);
}

void VehicleModel::translate(double dt_s) {
  const VehicleState before = state_;
  const double set = radians(environment_.current_set_deg);
  const double ahead = state_.surge_m_s * std::cos(state_.pitch_rad);
  const double right = state_.sway_m_s;
  const double sin_heading = std::sin(state_.heading_rad);
  const double cos_heading = std::cos(state_.heading_rad);
  state_.velocity_east_m_s =
      ahead * sin_heading + right * cos_heading + environment_.current_drift_m_s * std::sin(set);
  state_.velocity_north_m_s =
      ahead * cos_heading - right * sin_heading + environment_.current_drift_m_s * std::cos(set);
  const double predicted_depth = state_.depth_m + before.velocity_down_m_s * dt_s;
  state_.velocity_down_m_s =
      std::clamp(sinkRate(), -std::max(0.0, predicted_depth) / kBoundary_s,
                 std::max(0.0, environment_.bottom_depth_m - predicted_depth) / kBoundary_s);

  state_.east_m += moved(before.velocity_east_m_s, state_.velocity_east_m_s, dt_s);
  state_.north_m += moved(before.velocity_north_m_s, state_.velocity_north_m_s, dt_s);
  state_.depth_m += moved(before.velocity_down_m_s, state_.velocity_down_m_s, dt_s);
  state_.depth_m = std::clamp(state_.depth_m, 0.0, environment_.bottom_depth_m);
  state_.altitude_m = environment_.bottom_depth_m - state_.depth_m;
  updateSpecificForce((state_.velocity_east_m_s - before.velocity_east_m_s) / dt_s,
                      (state_.velocity_north_m_s - before.velocity_north_m_s) / dt_s,
                      (state_.velocity_down_m_s - before.velocity_down_m_s) / dt_s);
}

void VehicleModel::updateBodyRates() {
  const double sin_roll = std::sin(state_.roll_rad);
  const double cos_roll = std::cos(state_.roll_rad);
  const double cos_pitch = std::cos(state_.pitch_rad);
  state_.roll_rate_rad_s = rates_.roll_rad_s - rates_.heading_rad_s * std::sin(state_.pitch_rad);
  state_.pitch_rate_rad_s =
      rates_.pitch_rad_s * cos_roll + rates_.heading_rad_s * cos_pitch * sin_roll;
  state_.yaw_rate_rad_s =
      -rates_.pitch_rad_s * sin_roll + rates_.heading_rad_s * cos_pitch * cos_roll;
}

void VehicleModel::updateSpecificForce(double east, double north, double down) {
  const double sin_heading = std::sin(state_.heading_rad);
  const double cos_heading = std::cos(state_.heading_rad);
  const double sin_pitch = std::sin(state_.pitch_rad);
  const double cos_pitch = std::cos(state_.pitch_rad);
  const double sin_roll = std::sin(state_.roll_rad);
  const double cos_roll = std::cos(state_.roll_rad);
  // NED to body by heading, then pitch, then roll, of the acceleration less gravity.
  const double ahead = cos_heading * north + sin_heading * east;
  const double right = -sin_heading * north + cos_heading * east;
  const double below = down - kGravity;
  const double keel = sin_pitch * ahead + cos_pitch * below;
  state_.force_x_m_s2 = cos_pitch * ahead - sin_pitch * below;
  state_.force_y_m_s2 = cos_roll * right + sin_roll * keel;
  state_.force_z_m_s2 = -sin_roll * right + cos_roll * keel;
}

}  // namespace frontseat_driver::sim
