#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "frontseat_driver/session/command_sentence.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::session {

/// Notices a vehicle that takes commands and does not follow them.
///
/// The vehicle answers when each commanded heading, speed or depth is reached, or when one of them
/// comes nearer. When nothing does so for the time-out, that is told with the figures. Rudder,
/// elevator, pitch and rpm have no figure to compare with and count as answered; a boat under
/// thrust must move.
class EffectMonitor {
 public:
  using SteadyTime = vehicle::SteadyTime;

  explicit EffectMonitor(std::chrono::nanoseconds timeout) : timeout_(timeout) {}

  /// The command that is being sent. The time-out begins with the first one, and again whenever the
  /// vehicle answers.
  void commanded(const vehicle::Command& command, const PresentState& present, SteadyTime now);

  void clear();

  /// What the vehicle does now.
  void measured(const PresentState& present, SteadyTime now);

  /// What was commanded, what is measured instead and for how long; empty while all is well.
  const std::string& complaint() const { return complaint_; }

 private:
  struct Target {
    std::optional<double> heading_deg;
    std::optional<double> depth_m;
    std::optional<double> speed_m_s;
    bool must_move = false;  ///< a boat under thrust
  };
  struct Errors {
    std::optional<double> heading_deg;
    std::optional<double> depth_m;
    std::optional<double> speed_m_s;
  };

  static Target targetOf(const vehicle::Command& command);
  static bool same(const Target& a, const Target& b);
  Errors errors(const PresentState& present) const;
  static bool reached(const Errors& errors);
  static bool nearer(const Errors& now, const Errors& before);
  std::string describe(const PresentState& present, std::chrono::nanoseconds since) const;

  const std::chrono::nanoseconds timeout_;
  std::optional<Target> target_;
  Errors baseline_;
  SteadyTime answered_at_{};
  std::string complaint_;
};

}  // namespace frontseat_driver::session
