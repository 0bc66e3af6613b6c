#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/capture/reader.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::ros_layer {

/// Gives each line of a text capture the time at which it counts as heard. Times never go back.
///
/// A time that stands in front of a line is taken as it is. A capture without any goes by the
/// vehicle's own clock: by the time of day in each sentence of a BF or CP talker, over midnight and
/// gaps; where that clock is set back, time goes on from there. What has no time comes with the
/// sentence before it, or with the first that has one. Without any time at all, lines are kSpacing
/// apart.
class CaptureTimes {
 public:
  static constexpr std::chrono::milliseconds kSpacing{20};

  /// When a capture without times begins.
  struct Start {
    vehicle::UtcTime at{};  ///< the first sentence that tells a time, or the first line
    bool day_only = true;   ///< at the vehicle's own time of that day
  };

  /// As UNIX or ISO 8601 time, or a date (UTC); nothing if it is none of them.
  static std::optional<Start> readStart(const std::string& text);

  /// `first_time` is what firstTime() found.
  CaptureTimes(std::optional<vehicle::TimeOfDay> first_time, const Start& start);

  vehicle::UtcTime timeOf(const capture::Entry& entry);

 private:
  vehicle::UtcTime next(const capture::Entry& entry);

  bool by_vehicle_;
  bool stamped_ = false;  ///< the capture has times of its own
  vehicle::UtcTime last_;
  std::chrono::nanoseconds ahead_{};  ///< of the vehicle's clock, at the date that goes on
};

/// The vehicle's time of day in a line, if it is a good sentence of a BF or CP talker with one.
std::optional<vehicle::TimeOfDay> vehicleTimeIn(std::string_view line);

/// The first one of a capture; reads no further.
std::optional<vehicle::TimeOfDay> firstTime(capture::Reader& capture);

}  // namespace frontseat_driver::ros_layer
