#pragma once

#include <ros/time.h>

#include <chrono>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/clock_offset.h"
#include "frontseat_driver/vehicle/event.h"
#include "parameters.h"

namespace frontseat_driver::ros_layer {

/// What a time of day in a sentence counts.
enum class TimeScale {
  Vehicle,  ///< the vehicle's clock: UTC, or GPS time that is leap_seconds ahead
  Utc       ///< a GPS receiver's sentence
};

/// Gives data its stamp, as the parameter `stamp` has it.
class Stamper {
 public:
  explicit Stamper(StampMode mode);

  /// GPS - UTC, as far as the vehicle's clock shows it.
  void setLeapSeconds(std::chrono::seconds leap_seconds) { leap_seconds_ = leap_seconds; }

  /// A sentence that was made at `sent_at` has arrived.
  void take(vehicle::TimeOfDay sent_at, TimeScale scale, const vehicle::Now& arrival);

  /// Forgets what it learned about the clocks.
  void reset();

  /// What is known of the vehicle's clock.
  vehicle::ClockOffset::State clock() const { return vehicle_clock_.state(); }

  /// When data was valid that arrived at `arrival` and carries `measured_at`. Without a time of its
  /// own, data counts as measured when it arrived. Synced stamps are never later than that.
  ros::Time stamp(std::optional<vehicle::TimeOfDay> measured_at, TimeScale scale,
                  const vehicle::Now& arrival) const;

  /// A time that this host wrote into a sentence (Now::utc) and got back with `arrival`, on the
  /// clock of the stamps.
  ros::Time ownTime(vehicle::TimeOfDay written, const vehicle::Now& arrival) const;

 private:
  const vehicle::ClockOffset& clockOf(TimeScale scale) const;

  StampMode mode_;
  vehicle::ClockOffset vehicle_clock_;
  vehicle::ClockOffset gps_clock_;  ///< of a GPS receiver that the vehicle relays
  std::chrono::seconds leap_seconds_{0};
};

/// Keeps the stamps of one topic from going backwards.
class StampGuard {
 public:
  /// `stamp`, or the last one where that is later.
  ros::Time clamp(const ros::Time& stamp);

  /// True, and remembered, if `stamp` is later than all before.
  bool advances(const ros::Time& stamp);

 private:
  std::optional<ros::Time> last_;
};

}  // namespace frontseat_driver::ros_layer
