#include "frontseat_driver/sim/sensors.h"

#include <algorithm>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/geography.h"

namespace frontseat_driver::sim {

Sensors::Reading Sensors::read(const VehicleModel& model, double dt_s) {
  Reading reading;
  reading.state = model.state();
  if (noise_) spoil(reading.state, dt_s);
  reading.position =
      fromPlane(model.environment().datum, {reading.state.east_m, reading.state.north_m});
  return reading;
}

void Sensors::spoil(VehicleState& state, double dt_s) {
  state.east_m += east_.step(dt_s, random_) + white(0.01);
  state.north_m += north_.step(dt_s, random_) + white(0.01);
  state.depth_m = std::max(0.0, state.depth_m + white(0.02));
  state.altitude_m = std::max(0.0, state.altitude_m + white(0.05));
  const double heading = state.heading_rad + heading_.step(dt_s, random_) + white(0.001);
  state.heading_rad = radians(wrap360(degrees(heading)));
  state.roll_rad += white(0.003);
  state.pitch_rad += white(0.003);
  for (double* velocity :
       {&state.velocity_east_m_s, &state.velocity_north_m_s, &state.velocity_down_m_s}) {
    *velocity += white(0.02);
  }
  for (double* rate : {&state.roll_rate_rad_s, &state.pitch_rate_rad_s, &state.yaw_rate_rad_s}) {
    *rate += white(0.004);
  }
  for (double* force : {&state.force_x_m_s2, &state.force_y_m_s2, &state.force_z_m_s2}) {
    *force += white(0.03);
  }
  state.stack_v += white(0.005);
}

}  // namespace frontseat_driver::sim
