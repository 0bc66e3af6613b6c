#include "navigation.h"

#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kScaleError = 0.002;
constexpr double kGyroDrift_rad_s = 2e-6;  // 0.4 degrees an hour, one sigma

}  // namespace

BlueyeNavigation::BlueyeNavigation(const Rov& rov, Random random, bool noise)
    : random_(random),
      noise_(noise),
      heading_rad_(rov.state().heading_rad),
      true_east_m_(rov.state().east_m),
      true_north_m_(rov.state().north_m) {
  if (noise_) scale_ = 1.0 + kScaleError * random_.normal();
}

void BlueyeNavigation::step(const Rov& rov, bool dvl, double dt_s) {
  const VehicleState& state = rov.state();
  heading_rad_ += wrapPi(state.heading_rad - heading_rad_);
  if (noise_ && gyro_only_) drift_rad_ += kGyroDrift_rad_s * dt_s;
  since_reset_s_ += dt_s;
  valid_ = dvl && state.altitude_m <= kBottomLock_m;

  const double east = state.east_m - true_east_m_;
  const double north = state.north_m - true_north_m_;
  true_east_m_ = state.east_m;
  true_north_m_ = state.north_m;
  const double sin_heading = std::sin(state.heading_rad);
  const double cos_heading = std::cos(state.heading_rad);
  surge_m_s_ = cos_heading * state.velocity_north_m_s + sin_heading * state.velocity_east_m_s;
  sway_m_s_ = -sin_heading * state.velocity_north_m_s + cos_heading * state.velocity_east_m_s;
  if (!valid_) return;
  // What was moved, turned by what the heading is wrong.
  const double sin_error = std::sin(headingError());
  const double cos_error = std::cos(headingError());
  place_.north_m += scale_ * (cos_error * north - sin_error * east);
  place_.east_m += scale_ * (sin_error * north + cos_error * east);
  odometer_m_ += std::hypot(east, north);
}

void BlueyeNavigation::reset(const BlueyeReset& how) {
  place_ = {};
  since_reset_s_ = 0.0;
  odometer_m_ = 0.0;
  drift_rad_ = 0.0;
  offset_rad_ =
      how.manual_heading_deg ? wrapPi(radians(*how.manual_heading_deg) - heading_rad_) : 0.0;
  gyro_only_ = how.gyro_only || how.manual_heading_deg;
  origin_ = how.position;
}

void BlueyeNavigation::setGyroOnly(bool gyro_only) {
  gyro_only_ = gyro_only;
  if (gyro_only) return;
  offset_rad_ = 0.0;
  drift_rad_ = 0.0;
}

std::optional<nmea::LatLon> BlueyeNavigation::position() const {
  if (!origin_) return std::nullopt;
  return fromPlane(*origin_, place_);
}

}  // namespace frontseat_driver::sim
