#pragma once

#include <optional>

#include "frontseat_driver/sim/geography.h"
#include "frontseat_driver/sim/random.h"
#include "frontseat_driver/sim/rov.h"

namespace frontseat_driver::sim {

/// How the position estimate starts anew.
struct BlueyeReset {
  std::optional<double> manual_heading_deg;  ///< true; empty: the compass tells
  std::optional<nmea::LatLon> position;      ///< empty: where it is is not known
  bool gyro_only = false;                    ///< the heading follows the gyro, not the compass
};

/// The drone's own idea of where it is: dead reckoning from a reset point by DVL and heading.
class BlueyeNavigation {
 public:
  static constexpr double kBottomLock_m = 50.0;  ///< the DVL does not see a bottom further down

  BlueyeNavigation(const Rov& rov, Random random, bool noise);

  /// Follows the vehicle, `dt_s` later.
  void step(const Rov& rov, bool dvl, double dt_s);

  void reset(const BlueyeReset& how);
  void resetOdometer() { odometer_m_ = 0.0; }
  void setGyroOnly(bool gyro_only);
  void calibrateGyro() { drift_rad_ = 0.0; }

  bool valid() const { return valid_; }                             ///< the DVL sees the bottom
  PlanePoint place() const { return place_; }                       ///< from the reset point
  double heading() const { return heading_rad_ + headingError(); }  ///< continuous, clockwise
  double surgeRate() const { return surge_m_s_; }                   ///< over ground, forward
  double swayRate() const { return sway_m_s_; }                     ///< over ground, to starboard
  double odometer() const { return odometer_m_; }
  double sinceReset() const { return since_reset_s_; }
  double accuracy() const { return 0.5 + 0.005 * odometer_m_; }  ///< m, 95 % radius
  std::optional<nmea::LatLon> origin() const { return origin_; }
  /// Where it believes to be on the globe, if it was ever told.
  std::optional<nmea::LatLon> position() const;

 private:
  double headingError() const { return offset_rad_ + drift_rad_; }

  Random random_;
  bool noise_;
  bool valid_ = false;
  bool gyro_only_ = false;
  double heading_rad_;  ///< the true one, continuous
  double offset_rad_ = 0.0;
  double drift_rad_ = 0.0;
  double true_east_m_;
  double true_north_m_;
  double surge_m_s_ = 0.0;
  double sway_m_s_ = 0.0;
  double scale_ = 1.0;  ///< of the DVL's velocities
  PlanePoint place_;
  double odometer_m_ = 0.0;
  double since_reset_s_ = 0.0;
  std::optional<nmea::LatLon> origin_;
};

}  // namespace frontseat_driver::sim
