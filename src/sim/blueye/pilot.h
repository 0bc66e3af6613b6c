#pragma once

#include <optional>

#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/rov.h"
#include "navigation.h"

namespace frontseat_driver::sim {

/// What the operator's stick says: parts of full force, and two modifiers of the gain, 0..1.
struct BlueyeStick {
  RovAxes axes;
  double slow = 0.0;
  double boost = 0.0;

  /// Axes times gain; `slow` and `boost` cancel each other.
  RovAxes scaled() const;
};

/// Which controllers run.
struct BlueyeModes {
  bool auto_depth = false;
  bool auto_heading = false;
  bool auto_altitude = false;
  bool station_keeping = false;
  bool weather_vaning = false;
  bool auto_pilot_surge_yaw = false;  ///< a mission steers
  bool auto_pilot_heave = false;      ///< a mission dives
};

/// Where a mission wants the drone, in the position estimate's frame.
struct BlueyeGuidance {
  std::optional<PlanePoint> target;  ///< go there, bow first, or hold it; empty: hold this place
  double speed_m_s = 0.0;            ///< over ground, while going
  bool hold_heading = false;         ///< keep the heading instead of turning to the target
  std::optional<double> depth_m;     ///< go to this depth,
  std::optional<double> altitude_m;  ///< or to this height above the bottom
  double vertical_speed_m_s = 0.3;
};

/// The controllers of a Blueye drone: stick, auto functions and mission become thrust.
class BlueyePilot {
 public:
  static constexpr double kGain = 0.7;           ///< of the stick without slow and boost
  static constexpr double kVerticalSpeed = 0.5;  ///< m/s, full heave in auto depth or altitude
  static constexpr double kTurnRate = 0.8;       ///< rad/s, full yaw in auto heading
  static constexpr double kStationSpeed = 0.4;   ///< m/s, full stick in station keeping

  BlueyeStick stick;
  std::optional<BlueyeGuidance> guidance;

  const BlueyeModes& modes() const { return modes_; }
  /// Takes modes over; a controller that begins holds what is now.
  void setModes(const BlueyeModes& modes, const Rov& rov, const BlueyeNavigation& navigation);

  /// The thrust for the next `dt_s`. `arms` false: none.
  RovAxes control(const Rov& rov, const BlueyeNavigation& navigation, bool armed, double dt_s);

  double depthSetPoint() const { return depth_m_; }
  double headingSetPoint() const { return heading_rad_; }  ///< continuous, clockwise from north
  double altitudeSetPoint() const { return altitude_m_; }
  double depthError(const Rov& rov) const;  ///< m, set point less depth; 0 if not controlled
  double headingError(const BlueyeNavigation& navigation) const;  ///< rad; 0 if not controlled

 private:
  double heave(const RovAxes& wanted, const Rov& rov, double dt_s);
  double yaw(const RovAxes& wanted, const Rov& rov, const BlueyeNavigation& navigation,
             double dt_s);
  void hold(const RovAxes& wanted, const Rov& rov, const BlueyeNavigation& navigation, double dt_s,
            RovAxes& effort);
  double verticalEffort(double error_m, double speed_m_s, double limit_m_s, const Rov& rov) const;
  bool controlsDepth() const { return modes_.auto_depth || modes_.auto_altitude; }
  bool keepsStation() const { return modes_.station_keeping || modes_.weather_vaning; }
  bool steers() const { return modes_.auto_pilot_surge_yaw && guidance; }
  bool dives() const { return modes_.auto_pilot_heave && guidance; }

  BlueyeModes modes_;
  double depth_m_ = 0.0;
  double heading_rad_ = 0.0;
  double altitude_m_ = 0.0;
  PlanePoint station_;
};

}  // namespace frontseat_driver::sim
