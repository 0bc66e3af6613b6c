#pragma once

#include <chrono>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::session {

/// Holds the newest command and nothing else: repeated while it is fresh, gone when it is stale.
/// Nothing queues up, whatever the rate commands come in.
class CommandSlot {
 public:
  using SteadyTime = vehicle::SteadyTime;

  /// `timeout` is how long a command stays fresh, `period` how often it is repeated.
  CommandSlot(std::chrono::nanoseconds timeout, std::chrono::nanoseconds period)
      : timeout_(timeout), period_(period) {}

  /// Takes the place of whatever was there; due at once. `received` is when the user's command
  /// reached this computer, which may be a little earlier than now.
  void put(const vehicle::Command& command, SteadyTime received);

  /// Forgets the command.
  void clear();

  /// The command that is due at `now`, if there is one and it is fresh.
  const vehicle::Command* due(SteadyTime now) const;

  /// The due command went out at `now`: it is due again one period later.
  void sent(SteadyTime now);

  /// The due command could not go out now: it is due again then.
  void putOff(SteadyTime until) { due_at_ = until; }

  /// There is a command, and it has outlived its time-out.
  bool stale(SteadyTime now) const { return command_ && now >= stale_at_; }

  /// There is a command, fresh or not yet noticed to be stale.
  bool occupied() const { return command_.has_value(); }

  const std::optional<vehicle::Command>& command() const { return command_; }

  /// When the command is due, or stale; SteadyTime::max() without one.
  SteadyTime nextDue() const { return command_ ? due_at_ : SteadyTime::max(); }
  SteadyTime staleAt() const { return command_ ? stale_at_ : SteadyTime::max(); }

  /// The command has not gone out since it was put.
  bool unsent() const { return command_ && !sent_; }

 private:
  std::chrono::nanoseconds timeout_;
  std::chrono::nanoseconds period_;
  std::optional<vehicle::Command> command_;
  SteadyTime stale_at_{};
  SteadyTime due_at_{};
  bool sent_ = false;
};

}  // namespace frontseat_driver::session
