#include "stamper.h"

#include <algorithm>

#include "convert.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::ros_layer {

namespace {

// The silence time-out ends a link long before its data gets this old.
constexpr std::chrono::seconds kOldest{30};

}  // namespace

Stamper::Stamper(StampMode mode) : mode_(mode) {}

ros::Time Stamper::stamp(std::optional<vehicle::TimeOfDay> measured_at, TimeScale scale,
                         const vehicle::Now& arrival) const {
  if (mode_ == StampMode::Receive || !measured_at) return toRosTime(arrival.stamp);
  if (mode_ == StampMode::Synced) {
    const auto on_host = clockOf(scale).toHost(*measured_at, arrival.stamp).value_or(arrival.stamp);
    // A clock that stands still, or a wrong time in one field, must not hold all stamps back.
    const bool believable = arrival.stamp - on_host < kOldest;
    return toRosTime(believable ? std::min(on_host, arrival.stamp) : arrival.stamp);
  }
  const std::chrono::seconds ahead =
      scale == TimeScale::Vehicle ? leap_seconds_ : std::chrono::seconds(0);
  return toRosTime(vehicle::resolveDate(*measured_at - ahead, arrival.utc));
}

void Stamper::take(vehicle::TimeOfDay sent_at, TimeScale scale, const vehicle::Now& arrival) {
  auto& clock = scale == TimeScale::Vehicle ? vehicle_clock_ : gps_clock_;
  clock.take(sent_at, arrival.stamp);
}

void Stamper::reset() {
  vehicle_clock_.reset();
  gps_clock_.reset();
}

const vehicle::ClockOffset& Stamper::clockOf(TimeScale scale) const {
  return scale == TimeScale::Vehicle ? vehicle_clock_ : gps_clock_;
}

ros::Time Stamper::ownTime(vehicle::TimeOfDay written, const vehicle::Now& arrival) const {
  const vehicle::UtcTime utc = vehicle::resolveDate(written, arrival.utc);
  if (mode_ == StampMode::Vehicle) return toRosTime(utc);
  return toRosTime(utc + (arrival.stamp - arrival.utc));
}

ros::Time StampGuard::clamp(const ros::Time& stamp) {
  last_ = last_ ? std::max(*last_, stamp) : stamp;
  return *last_;
}

bool StampGuard::advances(const ros::Time& stamp) {
  const bool later = !last_ || stamp > *last_;
  if (later) last_ = stamp;
  return later;
}

}  // namespace frontseat_driver::ros_layer
