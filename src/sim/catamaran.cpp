#include "frontseat_driver/sim/catamaran.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kSurgeLag_s = 1.5;
constexpr double kTurnLag_s = 0.6;
constexpr double kMotorLag_s = 0.25;
constexpr double kRollFrequency_rad_s = 4.0;
constexpr double kPitchFrequency_rad_s = 3.5;
constexpr double kDamping = 0.5;
constexpr double kHeel_s2_m = 0.03;  // outwards, as a catamaran does
constexpr double kTrim_s_m = 0.02;   // bow up with speed

constexpr double kRollWave_rad_s = 2.1;
constexpr double kPitchWave_rad_s = 1.7;
constexpr double kPitchShare = 0.6;  // of the roll's amplitude

constexpr double kHotelPower_w = 20.0;
constexpr double kMotorPower_w = 200.0;  // one motor, full

double approach(double from, double to, double dt_s) {
  return from + (to - from) * std::min(1.0, dt_s / kMotorLag_s);
}

double effect(double thrust) { return thrust < 0.0 ? Catamaran::kAstern * thrust : thrust; }

double cubed(double load) { return std::abs(load * load * load); }

}  // namespace

Catamaran::Catamaran(const Environment& environment, const Start& start, const BatteryType& battery,
                     double waves_deg)
    : VehicleModel(environment, start, battery), waves_rad_(radians(waves_deg)) {}

void Catamaran::command(const Thrust& thrust) {
  commanded_.port = std::clamp(thrust.port, -1.0, 1.0);
  commanded_.starboard = std::clamp(thrust.starboard, -1.0, 1.0);
}

VehicleModel::Acceleration Catamaran::accelerate(double dt_s) {
  const Thrust wanted = powered() ? commanded_ : Thrust{};
  actual_.port = approach(actual_.port, wanted.port, dt_s);
  actual_.starboard = approach(actual_.starboard, wanted.starboard, dt_s);
  elapsed_s_ += dt_s;

  const VehicleState& now = state();
  const AngleRates& rates = angleRates();
  const double port = effect(actual_.port);
  const double starboard = effect(actual_.starboard);
  const double roll = waves_rad_ * std::sin(kRollWave_rad_s * elapsed_s_) -
                      kHeel_s2_m * now.surge_m_s * rates.heading_rad_s;
  const double pitch = kPitchShare * waves_rad_ * std::sin(kPitchWave_rad_s * elapsed_s_) +
                       kTrim_s_m * now.surge_m_s;
  Acceleration a;
  a.surge_m_s2 = (0.5 * kMaxSpeed * (port + starboard) - now.surge_m_s) / kSurgeLag_s;
  a.heading_rad_s2 = (0.5 * kMaxTurn_rad_s * (port - starboard) - rates.heading_rad_s) / kTurnLag_s;
  a.roll_rad_s2 = kRollFrequency_rad_s * kRollFrequency_rad_s * (roll - now.roll_rad) -
                  2.0 * kDamping * kRollFrequency_rad_s * rates.roll_rad_s;
  a.pitch_rad_s2 = kPitchFrequency_rad_s * kPitchFrequency_rad_s * (pitch - now.pitch_rad) -
                   2.0 * kDamping * kPitchFrequency_rad_s * rates.pitch_rad_s;
  return a;
}

double Catamaran::power() const {
  return kHotelPower_w + kMotorPower_w * (cubed(actual_.port) + cubed(actual_.starboard));
}

}  // namespace frontseat_driver::sim
