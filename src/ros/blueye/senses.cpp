#include "blueye/senses.h"

#include <cmath>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

constexpr double kLevel_rad = 0.35;
constexpr double kDisturbance_g = 0.2;
constexpr double kMemory = 50.0;
constexpr std::size_t kEnough = 10;

}  // namespace

void AccelerometerSense::take(double z_g, double norm_g, const std::optional<double>& tilt_rad) {
  const bool level = tilt_rad && std::abs(*tilt_rad) < kLevel_rad;
  // Written so that a reading that is no number returns as well: the mean would stay none.
  if (!level || !(std::abs(norm_g - 1.0) <= kDisturbance_g)) return;
  mean_g_ += (z_g - mean_g_) / kMemory;
  if (samples_ < kEnough) ++samples_;
}

std::optional<double> AccelerometerSense::factor() const {
  if (sign_ == AccelerometerSign::SpecificForce) return 1.0;
  if (sign_ == AccelerometerSign::Gravity) return -1.0;
  if (samples_ < kEnough) return std::nullopt;
  return mean_g_ < 0.0 ? 1.0 : -1.0;
}

bool DvlSense::disagrees(double dvl_m_s, double estimate_m_s) {
  constexpr double kWorthIt_m_s = 0.1;
  constexpr int kSure = 100;
  // NaN is not worth it either.
  if (!(std::abs(dvl_m_s) >= kWorthIt_m_s && std::abs(estimate_m_s) >= kWorthIt_m_s)) return false;
  const bool opposite = (dvl_m_s < 0.0) != (estimate_m_s < 0.0);
  count_ = opposite ? count_ + 1 : 0;
  return count_ == kSure;
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
