#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "diagnosis/health.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/clock_offset.h"

namespace frontseat_driver::ros_layer {

/// Follows what the clocks do: steps, offset to UTC, a ROS clock that stands still.
class ClockWatch {
 public:
  static constexpr std::chrono::seconds kLately{60};
  /// Stamps held back by more, in so many calls in a row, are stamps of a clock that was set back.
  static constexpr std::chrono::seconds kHeldBack{1};
  static constexpr int kHeldBackCalls = 3;
  /// After the first sample or a step, until the drift can be told.
  static constexpr std::chrono::seconds kLearning{10};

  /// The clocks at `now`, once a second. `leap_seconds` is how far the vehicle's clock is meant to
  /// be ahead of UTC, `held_back` by how much stamps would have gone back since the last call: what
  /// lasts is told, since a step of the vehicle's clock takes a moment to be believed.
  ClockHealth take(const vehicle::Now& now, const vehicle::ClockOffset::State& offset,
                   std::chrono::seconds leap_seconds, std::chrono::nanoseconds held_back);

 private:
  std::optional<vehicle::SteadyTime> learning_since_;
  std::optional<vehicle::UtcTime> last_stamp_;
  int held_back_in_a_row_ = 0;
  bool computer_set_back_ = false;  ///< seen while held back
  std::uint64_t steps_ = 0;
  std::deque<vehicle::SteadyTime> recent_steps_;  ///< at most one for each call in kLately
};

}  // namespace frontseat_driver::ros_layer
