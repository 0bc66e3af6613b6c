#pragma once

#include <cmath>

namespace frontseat_driver::ros_layer::blueye_layer {

/// What a positive z of the accelerometer means, level and at rest.
enum class AccelerometerSign {
  Auto,           ///< told by the mean of z while the drone lies level
  SpecificForce,  ///< z = -1 g: what an accelerometer feels, in axes forward, right and down
  Gravity         ///< z = +1 g: where gravity pulls
};

/// Where the documents of the protocol are silent or disagree.
struct Conventions {
  bool yaw_clockwise = true;  ///< MotionInput.yaw and its echo Reference.yaw
  bool dvl_y_right = true;
  AccelerometerSign accelerometer_sign = AccelerometerSign::Auto;
  bool battery_discharge_negative = true;
  bool heave_velocity_down = true;      ///< ReferenceAutoPilot.heave_velocity
  bool bearings_clockwise = true;       ///< MultibeamPing.bearings
  bool multibeam_tilt_up = true;        ///< MultibeamServo.angle, positive
  double add_declination_rad = 0.0;     ///< only for a drone that does not apply it
  double servo_min_rad = -M_PI_4;       ///< where GenericServo.value is 0
  double servo_max_rad = M_PI_4;        ///< where it is 1
  double water_density_kg_m3 = 1025.0;  ///< what the drone computes its depth with
};

/// Densities that a drone can be told: no water is outside. The Dead Sea has 1240.
constexpr double kLightestWater_kg_m3 = 900.0;
constexpr double kHeaviestWater_kg_m3 = 1300.0;

/// Standard deviations, for the covariances.
struct Deviations {
  double depth_m = 0.1;
  double orientation_rad = 0.05;
  double velocity_m_s = 0.1;
  double angular_rate_rad_s = 0.02;
  double acceleration_m_s2 = 0.1;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
