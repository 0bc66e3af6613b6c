#pragma once

#include <cmath>

#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::sim {

/// Everything that is true of a simulated vehicle at one instant.
///
/// Position in the tangent plane ENU at the datum, attitude and body axes nautical: x bow, y
/// starboard, z down, right-hand rule. Heading and velocity refer to the north of the datum, which
/// differs from the local one by less than 0.01 degrees within a kilometre of it.
struct VehicleState {
  double east_m = 0.0;
  double north_m = 0.0;
  double depth_m = 0.0;     ///< below the surface, 0 or more
  double altitude_m = 0.0;  ///< above the bottom

  double heading_rad = 0.0;  ///< true, clockwise from north, [0, 2 pi)
  double roll_rad = 0.0;     ///< positive port side up
  double pitch_rad = 0.0;    ///< positive bow up

  double velocity_east_m_s = 0.0;  ///< over ground: the derivative of the position
  double velocity_north_m_s = 0.0;
  double velocity_down_m_s = 0.0;
  double surge_m_s = 0.0;  ///< along the bow, through the water
  double sway_m_s = 0.0;   ///< level and to starboard, through the water

  double roll_rate_rad_s = 0.0;  ///< body rates about x, y and z
  double pitch_rate_rad_s = 0.0;
  double yaw_rate_rad_s = 0.0;

  double force_x_m_s2 = 0.0;  ///< specific force in body axes; at rest and level 0, 0, -9.80665
  double force_y_m_s2 = 0.0;
  double force_z_m_s2 = -9.80665;

  double stack_v = 0.0;    ///< battery voltage under load
  double energy_wh = 0.0;  ///< left in the battery
};

/// Level, in m/s.
inline double speedOverGround(const VehicleState& state) {
  return std::hypot(state.velocity_east_m_s, state.velocity_north_m_s);
}

}  // namespace frontseat_driver::sim
