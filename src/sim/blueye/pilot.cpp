#include "pilot.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kBoostGain = 0.3;
constexpr double kSlowGain = 0.5;

// Each controller asks for a speed that closes the error, then for the force that makes the speed.
constexpr double kDepthGain = 0.8;
constexpr double kVerticalGain = 2.5;
constexpr double kHeadingGain = 1.5;
constexpr double kTurnGain = 5.0;
constexpr double kTurnLimit_rad_s = 1.2;
constexpr double kPlaceGain = 0.4;
constexpr double kSpeedGain = 1.2;
constexpr double kPlaceLimit_m_s = 0.6;
/// A mission turns towards its target before it moves that way.
constexpr double kTurnFirst_rad = 0.6;
constexpr double kTooNearToTurn_m = 0.5;

double effort(const RovAxis& axis, double acceleration, double speed, double bias = 0.0) {
  return std::clamp((axis.mass * acceleration + axis.drag(speed) + bias) / axis.force, -1.0, 1.0);
}

}  // namespace

RovAxes BlueyeStick::scaled() const {
  const double extra = std::clamp(boost, 0.0, 1.0) - std::clamp(slow, 0.0, 1.0);
  const double gain = BlueyePilot::kGain + (extra > 0.0 ? kBoostGain : kSlowGain) * extra;
  return {gain * axes.surge, gain * axes.sway, gain * axes.heave,
          gain * axes.yaw,   gain * axes.roll, gain * axes.pitch};
}

void BlueyePilot::setModes(const BlueyeModes& modes, const Rov& rov,
                           const BlueyeNavigation& navigation) {
  const bool held_station = keepsStation();
  if (modes.auto_depth && !modes_.auto_depth) depth_m_ = rov.state().depth_m;
  if (modes.auto_altitude && !modes_.auto_altitude) altitude_m_ = rov.state().altitude_m;
  if (modes.auto_heading && !modes_.auto_heading) heading_rad_ = navigation.heading();
  if (modes.auto_pilot_surge_yaw && !modes_.auto_pilot_surge_yaw) {
    heading_rad_ = navigation.heading();
    station_ = navigation.place();
  }
  modes_ = modes;
  if (keepsStation() && !held_station) station_ = navigation.place();
}

RovAxes BlueyePilot::control(const Rov& rov, const BlueyeNavigation& navigation, bool armed,
                             double dt_s) {
  if (!armed) return {};
  const RovAxes wanted = stick.scaled();
  RovAxes out = wanted;
  out.heave = heave(wanted, rov, dt_s);
  if (steers() || (keepsStation() && navigation.valid())) hold(wanted, rov, navigation, dt_s, out);
  out.yaw = yaw(wanted, rov, navigation, dt_s);
  return out;
}

double BlueyePilot::verticalEffort(double error_m, double speed_m_s, double limit_m_s,
                                   const Rov& rov) const {
  const double down = rov.state().velocity_down_m_s;
  const double wanted = std::clamp(kDepthGain * error_m, -limit_m_s, limit_m_s) + speed_m_s;
  return effort(Rov::kHeave, kVerticalGain * (wanted - down), down, rov.buoyancy());
}

double BlueyePilot::heave(const RovAxes& wanted, const Rov& rov, double dt_s) {
  const VehicleState& now = rov.state();
  if (dives() && (guidance->depth_m || guidance->altitude_m)) {
    depth_m_ = guidance->depth_m.value_or(now.depth_m);
    altitude_m_ = guidance->altitude_m.value_or(now.altitude_m);
    const double error = guidance->depth_m ? depth_m_ - now.depth_m : now.altitude_m - altitude_m_;
    return verticalEffort(error, 0.0, guidance->vertical_speed_m_s, rov);
  }
  const double speed = kVerticalSpeed * wanted.heave;
  const double deepest = rov.environment().bottom_depth_m;
  if (modes_.auto_altitude) {
    altitude_m_ = std::clamp(altitude_m_ - speed * dt_s, 0.0, deepest);
    return verticalEffort(now.altitude_m - altitude_m_, speed, kVerticalSpeed, rov);
  }
  if (!modes_.auto_depth) return wanted.heave;
  depth_m_ = std::clamp(depth_m_ + speed * dt_s, 0.0, deepest);
  return verticalEffort(depth_m_ - now.depth_m, speed, kVerticalSpeed, rov);
}

double BlueyePilot::yaw(const RovAxes& wanted, const Rov& rov, const BlueyeNavigation& navigation,
                        double dt_s) {
  double rate = kTurnRate * wanted.yaw;
  if (steers()) {
    rate = 0.0;
  } else if (modes_.weather_vaning && rov.environment().current_drift_m_s > 0.0) {
    const double bow_into = radians(rov.environment().current_set_deg + 180.0);
    heading_rad_ = navigation.heading() + wrapPi(bow_into - navigation.heading());
    rate = 0.0;
  } else if (!modes_.auto_heading) {
    return wanted.yaw;
  }
  heading_rad_ += rate * dt_s;
  const double closing = std::clamp(kHeadingGain * (heading_rad_ - navigation.heading()),
                                    -kTurnLimit_rad_s, kTurnLimit_rad_s);
  return effort(Rov::kYaw, kTurnGain * (closing + rate - rov.yawRate()), rov.yawRate());
}

void BlueyePilot::hold(const RovAxes& wanted, const Rov& rov, const BlueyeNavigation& navigation,
                       double dt_s, RovAxes& out) {
  const double sin_heading = std::sin(navigation.heading());
  const double cos_heading = std::cos(navigation.heading());
  double limit = kPlaceLimit_m_s;
  double ahead = 0.0;
  double right = 0.0;
  PlanePoint target = station_;
  if (steers()) {
    if (guidance->target) target = *guidance->target;
    if (guidance->target && guidance->speed_m_s > 0.0) limit = guidance->speed_m_s;
    station_ = guidance->target ? navigation.place() : station_;
  } else {
    ahead = kStationSpeed * wanted.surge;
    right = kStationSpeed * wanted.sway;
    station_.north_m += (cos_heading * ahead - sin_heading * right) * dt_s;
    station_.east_m += (sin_heading * ahead + cos_heading * right) * dt_s;
  }
  const double north = target.north_m - navigation.place().north_m;
  const double east = target.east_m - navigation.place().east_m;
  const double distance = std::hypot(north, east);
  if (steers() && guidance->target && !guidance->hold_heading && distance > kTooNearToTurn_m) {
    heading_rad_ = navigation.heading() + wrapPi(std::atan2(east, north) - navigation.heading());
    if (std::abs(heading_rad_ - navigation.heading()) > kTurnFirst_rad) limit = 0.0;
  }
  const double closing = distance > 0.0 ? std::min(kPlaceGain * distance, limit) / distance : 0.0;
  ahead += closing * (cos_heading * north + sin_heading * east);
  right += closing * (-sin_heading * north + cos_heading * east);
  const VehicleState& now = rov.state();
  out.surge = effort(Rov::kSurge, kSpeedGain * (ahead - navigation.surgeRate()), now.surge_m_s);
  out.sway = effort(Rov::kSway, kSpeedGain * (right - navigation.swayRate()), now.sway_m_s);
}

double BlueyePilot::depthError(const Rov& rov) const {
  return controlsDepth() || dives() ? depth_m_ - rov.state().depth_m : 0.0;
}

double BlueyePilot::headingError(const BlueyeNavigation& navigation) const {
  const bool controlled = modes_.auto_heading || modes_.weather_vaning || steers();
  return controlled ? heading_rad_ - navigation.heading() : 0.0;
}

}  // namespace frontseat_driver::sim
