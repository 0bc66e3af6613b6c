#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"
#include "parameters.h"

namespace frontseat_driver::ros_layer {

/// Notices a compass that goes on telling another heading than the navigation, as it does when
/// compass_convention is not the vehicle's (Kingfisher field notes, CPRCM).
class CompassCheck {
 public:
  /// Further apart than a boat drifts and a compass deviates.
  static constexpr double kDisagreement_deg = 30.0;
  static constexpr std::chrono::seconds kLasting{20};

  explicit CompassCheck(const Parameters& parameters)
      : convention_(parameters.compass_convention),
        max_age_(parameters.max_data_age),
        declination_rad_(parameters.magnetic_declination_rad) {}

  void take(const vehicle::Navigation& navigation, vehicle::SteadyTime now) {
    heading_deg_ = navigation.heading_deg;
    heading_at_ = now;
  }

  /// What to tell the user, once for each time that they begin to disagree; empty otherwise.
  std::string take(const vehicle::Compass& compass, vehicle::SteadyTime now);

 private:
  const CompassConvention convention_;
  const std::chrono::nanoseconds max_age_;
  const double declination_rad_;
  std::optional<double> heading_deg_;  ///< the navigation's
  vehicle::SteadyTime heading_at_{};
  std::optional<vehicle::SteadyTime> apart_since_;
  bool told_ = false;
};

}  // namespace frontseat_driver::ros_layer
