#pragma once

#include "frontseat_driver/nmea/values.h"
#include "frontseat_driver/sim/battery.h"
#include "frontseat_driver/sim/vehicle_state.h"

namespace frontseat_driver::sim {

/// The water the vehicle is in.
struct Environment {
  nmea::LatLon datum{42.358456, -71.087589};  ///< origin of the tangent plane: Charles River
  double current_set_deg = 0.0;    ///< direction the water flows to, clockwise from true north
  double current_drift_m_s = 0.0;  ///< its speed, 0 or more
  double bottom_depth_m = 20.0;    ///< below the surface, > 0, the same everywhere
};

/// Where and how a vehicle starts: at rest, level, at the surface.
struct Start {
  double east_m = 0.0;
  double north_m = 0.0;
  double heading_deg = 0.0;  ///< true
};

/// A vehicle with inertia, stepped in virtual time. Equal steps give equal states: nothing here
/// asks a clock or draws a random number.
class VehicleModel {
 public:
  virtual ~VehicleModel() = default;

  /// Moves on by `dt_s`; 0.001 to 0.02 s keep the integration true.
  void step(double dt_s);

  const VehicleState& state() const { return state_; }
  const Environment& environment() const { return environment_; }
  nmea::LatLon position() const;

  void replaceBattery() { battery_.replace(); }
  double batteryFraction() const { return battery_.fraction(); }

 protected:
  /// Second derivatives of the angles (heading, pitch, roll), derivatives of surge and sway.
  struct Acceleration {
    double surge_m_s2 = 0.0;
    double sway_m_s2 = 0.0;
    double heading_rad_s2 = 0.0;
    double pitch_rad_s2 = 0.0;
    double roll_rad_s2 = 0.0;
  };
  struct AngleRates {
    double heading_rad_s = 0.0;
    double pitch_rad_s = 0.0;
    double roll_rad_s = 0.0;
  };

  VehicleModel(const Environment& environment, const Start& start, const BatteryType& battery);

  /// What hull and actuators do in the next `dt_s`.
  virtual Acceleration accelerate(double dt_s) = 0;
  /// Electrical power of thrusters and everything else, W.
  virtual double power() const = 0;
  /// Vertical speed that hull and fins want, m/s, positive down; 0 for a vehicle that floats.
  virtual double sinkRate() const { return 0.0; }

  const AngleRates& angleRates() const { return rates_; }
  bool powered() const { return battery_.fraction() > 0.0; }

 private:
  void turn(const Acceleration& acceleration, double dt_s);
  void translate(double dt_s);
  void updateBodyRates();
  void updateSpecificForce(double east, double north, double down);

  Environment environment_;
  Battery battery_;
  AngleRates rates_;
  VehicleState state_;
};

}  // namespace frontseat_driver::sim
