#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>

namespace frontseat_driver::ros_layer::blueye_layer {

/// What a positive z of the accelerometer means, level and at rest.
enum class AccelerometerSign {
  Auto,           ///< told by the mean of z while the drone lies level
  SpecificForce,  ///< z = -1 g: what an accelerometer feels, in axes forward, right and down
  Gravity         ///< z = +1 g: where gravity pulls
};

/// Where the documents of the protocol are silent or disagree.
struct Conventions {
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

/// The sign that turns a reading of the accelerometer in forward, right and down into specific
/// force.
class AccelerometerSense {
 public:
  explicit AccelerometerSense(AccelerometerSign sign) : sign_(sign) {}

  /// A reading in g. Counts only while roll and pitch are known and small and it is about 1 g.
  void take(double z_g, double norm_g, const std::optional<double>& tilt_rad) {
    const bool level = tilt_rad && std::abs(*tilt_rad) < kLevel_rad;
    // Written so that a reading that is no number returns as well: the mean would stay none.
    if (!level || !(std::abs(norm_g - 1.0) <= kDisturbance_g)) return;
    mean_g_ += (z_g - mean_g_) / kMemory;
    if (samples_ < kEnough) ++samples_;
  }

  /// 1, -1, or empty while it is not known.
  std::optional<double> factor() const {
    if (sign_ == AccelerometerSign::SpecificForce) return 1.0;
    if (sign_ == AccelerometerSign::Gravity) return -1.0;
    if (samples_ < kEnough) return std::nullopt;
    return mean_g_ < 0.0 ? 1.0 : -1.0;
  }

 private:
  static constexpr double kLevel_rad = 0.35;
  static constexpr double kDisturbance_g = 0.2;
  static constexpr double kMemory = 50.0;
  static constexpr std::size_t kEnough = 10;

  AccelerometerSign sign_;
  double mean_g_ = 0.0;
  std::size_t samples_ = 0;
};

/// Compares the sway of DVL and position estimate: signs that keep disagreeing mean that
/// `dvl_y_axis` is set wrong.
class DvlSense {
 public:
  /// Velocities to starboard, of the DVL as the parameter has it. True once, when it is sure.
  bool disagrees(double dvl_m_s, double estimate_m_s) {
    constexpr double kWorthIt_m_s = 0.1;
    constexpr int kSure = 100;
    // NaN is not worth it either.
    if (!(std::abs(dvl_m_s) >= kWorthIt_m_s && std::abs(estimate_m_s) >= kWorthIt_m_s))
      return false;
    const bool opposite = (dvl_m_s < 0.0) != (estimate_m_s < 0.0);
    count_ = opposite ? count_ + 1 : 0;
    return count_ == kSure;
  }

 private:
  int count_ = 0;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
