#pragma once

#include <chrono>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::session {

/// Holds the newest command and nothing else: repeated while it is fresh, gone when it is stale.
/// Nothing queues up, whatever the rate commands come in.
template <class Command>
class BasicCommandSlot {
 public:
  using SteadyTime = vehicle::SteadyTime;

  /// `timeout` is how long a command stays fresh, `period` how often it is repeated.
  BasicCommandSlot(std::chrono::nanoseconds timeout, std::chrono::nanoseconds period)
      : timeout_(timeout), period_(period) {}

  /// Takes the place of whatever was there; due at once. `received` is when the user's command
  /// reached this computer, which may be a little earlier than now.
  void put(const Command& command, SteadyTime received) {
    command_ = command;
    stale_at_ = received + timeout_;
    due_at_ = received;
    sent_ = false;
  }

  /// Forgets the command.
  void clear() { command_.reset(); }

  /// The command that is due at `now`, if there is one and it is fresh.
  const Command* due(SteadyTime now) const {
    const bool is_due = command_ && now >= due_at_ && now < stale_at_;
    return is_due ? &*command_ : nullptr;
  }

  /// The due command went out at `now`: it is due again one period later.
  void sent(SteadyTime now) {
    due_at_ = now + period_;
    sent_ = true;
  }

  /// The due command could not go out now: it is due again then.
  void putOff(SteadyTime until) { due_at_ = until; }

  /// There is a command, and it has outlived its time-out.
  bool stale(SteadyTime now) const { return command_ && now >= stale_at_; }

  /// There is a command, fresh or not yet noticed to be stale.
  bool occupied() const { return command_.has_value(); }

  const std::optional<Command>& command() const { return command_; }

  /// When the command is due, or stale; SteadyTime::max() without one.
  SteadyTime nextDue() const { return command_ ? due_at_ : SteadyTime::max(); }
  SteadyTime staleAt() const { return command_ ? stale_at_ : SteadyTime::max(); }

  /// The command has not gone out since it was put.
  bool unsent() const { return command_ && !sent_; }

 private:
  std::chrono::nanoseconds timeout_;
  std::chrono::nanoseconds period_;
  std::optional<Command> command_;
  SteadyTime stale_at_{};
  SteadyTime due_at_{};
  bool sent_ = false;
};

using CommandSlot = BasicCommandSlot<vehicle::Command>;

}  // namespace frontseat_driver::session
