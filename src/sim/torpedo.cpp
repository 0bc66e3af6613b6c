#include "frontseat_driver/sim/torpedo.h"

#include <algorithm>
#include <cmath>

namespace frontseat_driver::sim {
namespace {

constexpr double kSurgeLag_s = 2.0;
constexpr double kTurnLag_s = 0.8;
constexpr double kThrusterLag_s = 0.3;
constexpr double kFinLag_s = 0.2;
/// Weight below buoyancy: the hull rights itself like a damped pendulum.
constexpr double kPitchFrequency_rad_s = 1.0;
constexpr double kRollFrequency_rad_s = 2.5;
constexpr double kDamping = 0.8;
constexpr double kElevatorGain = 0.9;  // rad/s2 per rad of elevator and (m/s)2
constexpr double kHeel_s2_m = 0.08;    // heel per surge and rate of turn, outwards

constexpr double kHotelPower_w = 15.0;
constexpr double kThrustPower_w = 150.0;  // at 1000 rpm, growing with the cube

/// The fins lose their hold as the hull stands up, so that it never goes over.
double grip(double pitch_rad) { return std::cos(pitch_rad) * std::cos(pitch_rad); }

double approach(double from, double to, double lag_s, double dt_s) {
  return from + (to - from) * std::min(1.0, dt_s / lag_s);
}

}  // namespace

Torpedo::Torpedo(const Environment& environment, const Start& start, const BatteryType& battery)
    : VehicleModel(environment, start, battery) {}

void Torpedo::command(const Actuators& actuators) {
  commanded_.rudder_rad = std::clamp(actuators.rudder_rad, -kMaxFin_rad, kMaxFin_rad);
  commanded_.elevator_rad = std::clamp(actuators.elevator_rad, -kMaxFin_rad, kMaxFin_rad);
  commanded_.thruster_rpm = std::clamp(actuators.thruster_rpm, -kMaxRpm, kMaxRpm);
}

double Torpedo::elevatorFor(double pitch_rad, double surge_m_s) {
  const double righting = kPitchFrequency_rad_s * kPitchFrequency_rad_s * std::sin(pitch_rad);
  const double hold = std::max(0.1, surge_m_s * surge_m_s * grip(pitch_rad));
  return righting / (kElevatorGain * hold);
}

VehicleModel::Acceleration Torpedo::accelerate(double dt_s) {
  const double rpm = powered() ? commanded_.thruster_rpm : 0.0;
  actual_.thruster_rpm = approach(actual_.thruster_rpm, rpm, kThrusterLag_s, dt_s);
  actual_.rudder_rad = approach(actual_.rudder_rad, commanded_.rudder_rad, kFinLag_s, dt_s);
  actual_.elevator_rad = approach(actual_.elevator_rad, commanded_.elevator_rad, kFinLag_s, dt_s);

  const VehicleState& now = state();
  const AngleRates& rates = angleRates();
  const double surge = now.surge_m_s;
  const double turn = surge * actual_.rudder_rad / (kTurningRadius * kMaxFin_rad);
  const double heel = -kHeel_s2_m * surge * rates.heading_rad_s;
  Acceleration a;
  a.surge_m_s2 = (kSpeedPerRpm * actual_.thruster_rpm - surge) / kSurgeLag_s;
  a.heading_rad_s2 = (turn - rates.heading_rad_s) / kTurnLag_s;
  a.pitch_rad_s2 =
      kElevatorGain * surge * std::abs(surge) * grip(now.pitch_rad) * actual_.elevator_rad -
      kPitchFrequency_rad_s * kPitchFrequency_rad_s * std::sin(now.pitch_rad) -
      2.0 * kDamping * kPitchFrequency_rad_s * rates.pitch_rad_s;
  a.roll_rad_s2 = kRollFrequency_rad_s * kRollFrequency_rad_s * (heel - now.roll_rad) -
                  2.0 * kDamping * kRollFrequency_rad_s * rates.roll_rad_s;
  return a;
}

double Torpedo::sinkRate() const {
  return -state().surge_m_s * std::sin(state().pitch_rad) - kRise;
}

double Torpedo::power() const {
  const double load = std::abs(actual_.thruster_rpm) / 1000.0;
  return kHotelPower_w + kThrustPower_w * load * load * load;
}

}  // namespace frontseat_driver::sim
