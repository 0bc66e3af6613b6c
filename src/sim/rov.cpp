#include "frontseat_driver/sim/rov.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace frontseat_driver::sim {
namespace {

constexpr double kThrusterLag_s = 0.15;
/// The centre of mass lies below that of buoyancy: roll and pitch are damped pendulums.
constexpr double kFrequency_rad_s = 2.5;
constexpr double kDamping = 0.6;

constexpr double kHotelPower_w = 25.0;
constexpr double kThrusterPower_w = 150.0;  // one axis, full

constexpr double RovAxes::*const kAxes[] = {&RovAxes::surge, &RovAxes::sway, &RovAxes::heave,
                                            &RovAxes::yaw,   &RovAxes::roll, &RovAxes::pitch};

double lean(double effort, double angle_rad, double rate_rad_s) {
  return kFrequency_rad_s * kFrequency_rad_s * (Rov::kLean_rad * effort - angle_rad) -
         2.0 * kDamping * kFrequency_rad_s * rate_rad_s;
}

}  // namespace

double RovAxis::drag(double speed) const {
  const double quadratic = (force - linear * top_speed) / (top_speed * top_speed);
  return linear * speed + quadratic * speed * std::abs(speed);
}

Rov::Rov(const Environment& environment, const Start& start, const BatteryType& battery,
         double buoyancy_n)
    : VehicleModel(environment, start, battery), buoyancy_n_(buoyancy_n) {}

void Rov::command(const RovAxes& effort) {
  for (const auto axis : kAxes) commanded_.*axis = std::clamp(effort.*axis, -1.0, 1.0);
}

void Rov::followCommand(double dt_s) {
  const RovAxes wanted = powered() ? commanded_ : RovAxes{};
  const double share = std::min(1.0, dt_s / kThrusterLag_s);
  for (const auto axis : kAxes) actual_.*axis += (wanted.*axis - actual_.*axis) * share;
}

VehicleModel::Acceleration Rov::accelerate(double dt_s) {
  followCommand(dt_s);
  const VehicleState& now = state();
  const AngleRates& rates = angleRates();
  Acceleration a;
  a.surge_m_s2 = (kSurge.force * actual_.surge - kSurge.drag(now.surge_m_s)) / kSurge.mass;
  a.sway_m_s2 = (kSway.force * actual_.sway - kSway.drag(now.sway_m_s)) / kSway.mass;
  a.heading_rad_s2 = (kYaw.force * actual_.yaw - kYaw.drag(rates.heading_rad_s)) / kYaw.mass;
  a.roll_rad_s2 = lean(actual_.roll, now.roll_rad, rates.roll_rad_s);
  a.pitch_rad_s2 = lean(actual_.pitch, now.pitch_rad, rates.pitch_rad_s);
  // Surface and bottom may have stopped it: go on from the speed it has.
  const double down = now.velocity_down_m_s;
  heave_m_s_ =
      down + dt_s / kHeave.mass * (kHeave.force * actual_.heave - kHeave.drag(down) - buoyancy_n_);
  return a;
}

double Rov::power() const {
  double load = 0.0;
  for (const auto axis : kAxes) load += std::pow(std::abs(actual_.*axis), 1.5);
  return kHotelPower_w + auxiliary_w_ + kThrusterPower_w * load;
}

}  // namespace frontseat_driver::sim
