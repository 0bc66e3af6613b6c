#include "compass_check.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "convert.h"

namespace frontseat_driver::ros_layer {

std::string CompassCheck::take(const vehicle::Compass& compass, vehicle::SteadyTime now) {
  if (now - heading_at_ > max_age_) {  // what it was then says nothing of now
    heading_deg_.reset();
    apart_since_.reset();
  }
  if (!compass.heading_deg || !heading_deg_) return {};
  const CompassAngles angles = toSpecification({*compass.heading_deg, 0.0}, convention_);
  const double compass_deg = wrapHeading_deg(angles.heading_deg + declination_rad_ * 180.0 / M_PI);
  const double apart_deg = std::abs(std::remainder(compass_deg - *heading_deg_, 360.0));
  if (apart_deg <= kDisagreement_deg) {
    apart_since_.reset();
    told_ = false;
    return {};
  }
  if (!apart_since_) apart_since_ = now;
  if (now - *apart_since_ < kLasting || std::exchange(told_, true)) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "the compass tells %.0f deg where the navigation tells %.0f deg, for %d s now; is "
                "parameter compass_convention right? It is %s",
                compass_deg, *heading_deg_, static_cast<int>(kLasting.count()),
                convention_ == CompassConvention::Spec ? "spec" : "heron");
  return text;
}

}  // namespace frontseat_driver::ros_layer
