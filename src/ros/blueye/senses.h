#pragma once

#include <cstddef>
#include <optional>

#include "blueye/conventions.h"

/// What the documents leave open and the drone's own numbers tell.
namespace frontseat_driver::ros_layer::blueye_layer {

/// The sign that turns a reading of the accelerometer in forward, right and down into specific
/// force.
class AccelerometerSense {
 public:
  explicit AccelerometerSense(AccelerometerSign sign) : sign_(sign) {}

  /// A reading in g. Counts only while roll and pitch are known and small and it is about 1 g.
  void take(double z_g, double norm_g, const std::optional<double>& tilt_rad);

  /// 1, -1, or empty while it is not known.
  std::optional<double> factor() const;

 private:
  AccelerometerSign sign_;
  double mean_g_ = 0.0;
  std::size_t samples_ = 0;
};

/// Compares the sway of DVL and position estimate: signs that keep disagreeing mean that
/// `dvl_y_axis` is set wrong.
class DvlSense {
 public:
  /// Velocities to starboard, of the DVL as the parameter has it. True once, when it is sure.
  bool disagrees(double dvl_m_s, double estimate_m_s);

 private:
  int count_ = 0;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
