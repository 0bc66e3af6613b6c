#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "convert.h"

/// Covariance matrices in messages, row by row, with only their diagonal set.
namespace frontseat_driver::ros_layer {

/// What a message says where nothing is known and it has no variance to tell so.
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Variances about or along x, y and z.
using Variances = std::array<double, 3>;

inline Variances allAxes(double variance) { return {variance, variance, variance}; }

/// What is known of a value where it is there, nothing where it is blank.
inline double varianceOf(const std::optional<double>& measured, double known) {
  return measured ? known : kUnknownVariance;
}

template <class Matrix>
void setVariance(Matrix& covariance, std::size_t axis, double value) {
  constexpr std::size_t kSize = Matrix::static_size == 36 ? 6 : 3;
  covariance[axis * (kSize + 1)] = value;
}

template <class Matrix>
void setVariances(Matrix& covariance, std::size_t first_axis, const Variances& values) {
  for (std::size_t i = 0; i < 3; ++i) setVariance(covariance, first_axis + i, values[i]);
}

/// Three axes of one sensor, blank ones as 0 with unknown variance.
struct Axes {
  std::optional<double> x, y, z;

  bool blank() const { return !x && !y && !z; }
  Variances variances(double known) const {
    return {varianceOf(x, known), varianceOf(y, known), varianceOf(z, known)};
  }
};

}  // namespace frontseat_driver::ros_layer
