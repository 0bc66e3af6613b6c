#include "diagnosis/clock_watch.h"

#include <utility>

namespace frontseat_driver::ros_layer {

namespace {

constexpr std::chrono::hours kDay{24};

/// Within half a day of zero: a time of day tells no date.
std::chrono::nanoseconds withinHalfADay(std::chrono::nanoseconds difference) {
  const auto rest = (difference % kDay + kDay + kDay / 2) % kDay;
  return rest - kDay / 2;
}

}  // namespace

ClockHealth ClockWatch::take(const vehicle::Now& now, const vehicle::ClockOffset::State& offset,
                             std::chrono::seconds leap_seconds,
                             std::chrono::nanoseconds held_back) {
  ClockHealth health;
  health.offset = offset;
  const bool stands = std::exchange(last_stamp_, now.stamp) == now.stamp;
  // HostClocks keeps the stamps where they are until the system clock has caught up with them.
  const bool set_back = stands && now.utc < now.stamp;
  health.ros_clock_stands = stands && !set_back;
  if (set_back) held_back = now.stamp - now.utc;
  held_back_in_a_row_ = held_back > kHeldBack ? held_back_in_a_row_ + 1 : 0;
  computer_set_back_ = held_back_in_a_row_ > 0 && (set_back || computer_set_back_);
  health.computer_set_back = computer_set_back_;
  if (held_back_in_a_row_ >= kHeldBackCalls) health.held_back_s = inSeconds(held_back);
  if (offset.samples == 0) return health;
  const bool stepped = std::exchange(steps_, offset.steps) != offset.steps;
  if (stepped) recent_steps_.push_back(now.steady);
  while (!recent_steps_.empty() && now.steady - recent_steps_.front() > kLately) {
    recent_steps_.pop_front();
  }
  if (stepped || !learning_since_) learning_since_ = now.steady;
  health.state = now.steady - *learning_since_ < kLearning ? ClockHealth::State::Learning
                                                           : ClockHealth::State::Tracking;
  // The offset belongs to the clock of the stamps, which need not tell UTC.
  const vehicle::UtcTime vehicle_time = now.stamp - offset.offset;
  health.vehicle_ahead_s = inSeconds(withinHalfADay(vehicle_time - now.utc - leap_seconds));
  health.steps_lately = recent_steps_.size();
  if (!recent_steps_.empty()) health.step_ago_s = inSeconds(now.steady - recent_steps_.back());
  return health;
}

}  // namespace frontseat_driver::ros_layer
