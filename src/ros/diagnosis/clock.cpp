#include <cmath>

#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

using Level = Diagnosis::Level;

// More than the clocks of two computers without NTP differ after a day.
constexpr double kOffsetWarned_s = 5.0;
// More than a simulator's clock wavers.
constexpr double kSimulatedBehind_s = 0.5;
// A vehicle sets its clock when it gets its first GPS fix, which is normal; this is not.
constexpr std::size_t kStepsWarned = 3;
constexpr double kQuarterHour_s = 900.0;
constexpr double kRounding_s = 1.5;  // delay of the link and a clock that is nearly right
// GPS - UTC since 2017-01-01 (IERS Bulletin C 52).
constexpr double kLeapSeconds = 18.0;

bool near(double a, double b) { return std::abs(a - b) < kRounding_s; }

/// What an offset looks like.
std::string guess(const Health& health, double ahead_s) {
  const auto leap = static_cast<double>(health.leap_seconds.count());
  if (near(ahead_s + leap, 0.0)) return "it seems to tell UTC: set parameter leap_seconds to 0";
  if (near(ahead_s + leap, kLeapSeconds)) {
    return "it seems to tell GPS time: set parameter leap_seconds to 18";
  }
  const double quarters = std::round(ahead_s / kQuarterHour_s);
  if (quarters != 0.0 && near(ahead_s, quarters * kQuarterHour_s)) {
    return printed(
        "it seems to tell the time of zone UTC%+.4g: set it to UTC, or this computer's "
        "clock if that is wrong",
        quarters / 4.0);
  }
  return "set it, or this computer's if that is the wrong one, by GPS or NTP";
}

std::string consequence(StampMode mode) {
  return mode == StampMode::Vehicle
             ? "all stamps and tf are off by that (or set parameter stamp to synced)"
             : "stamps are right all the same (stamp: synced), its own logs will not match";
}

std::string offsetWords(double ahead_s) {
  return printed("the vehicle's clock is %.1f s %s this computer's", std::abs(ahead_s),
                 ahead_s > 0.0 ? "ahead of" : "behind");
}

std::string fine(const ClockHealth& clock) {
  if (!clock.vehicle_ahead_s) return "the vehicle has told no time yet";
  std::string text = clock.state == ClockHealth::State::Learning
                         ? "learning the vehicle's clock"
                         : printed("following the vehicle's clock, %.3f s %s this computer's",
                                   std::abs(*clock.vehicle_ahead_s),
                                   *clock.vehicle_ahead_s > 0.0 ? "ahead of" : "behind");
  if (clock.step_ago_s) text += printed("; one of them stepped %.0f s ago", *clock.step_ago_s);
  return text;
}

void judge(const Health& health, Diagnosis& diagnosis) {
  const ClockHealth& clock = health.clock;
  const bool off = clock.vehicle_ahead_s && std::abs(*clock.vehicle_ahead_s) > kOffsetWarned_s;
  diagnosis.level = Level::Warn;
  if (clock.simulated_behind_s > kSimulatedBehind_s) {
    diagnosis.level = Level::Error;
    diagnosis.message = printed(
        "stamps and tf stand still: /clock was set back by %.0f s, and stamps never go back; "
        "restart the driver",
        clock.simulated_behind_s);
  } else if (clock.ros_clock_stands) {
    diagnosis.message =
        "the ROS clock stands still, and all stamps with it: /use_sim_time is true, and /clock "
        "does "
        "not go on; publish it, or set /use_sim_time to false and restart";
  } else if (clock.held_back_s > 0.0) {
    diagnosis.level = Level::Error;
    diagnosis.message = printed(
        "stamps and tf stand still for %.0f s more: %s was set back, and stamps never go back; "
        "wait, or restart the driver and all that uses tf",
        clock.held_back_s,
        clock.computer_set_back ? "this computer's clock" : "the vehicle's clock");
  } else if (clock.steps_lately >= kStepsWarned) {
    diagnosis.message = printed(
        "the vehicle's clock, or this computer's, stepped %zu times in the last minute: does the "
        "vehicle's stand still, or do two time servers set one of them?",
        clock.steps_lately);
  } else if (off && health.stamp == StampMode::Receive) {
    diagnosis.level = Level::Ok;
    diagnosis.message = offsetWords(*clock.vehicle_ahead_s) + "; not used (stamp: receive)";
  } else if (off) {
    diagnosis.message = offsetWords(*clock.vehicle_ahead_s) + ": " + consequence(health.stamp) +
                        "; " + guess(health, *clock.vehicle_ahead_s);
  } else {
    diagnosis.level = Level::Ok;
    diagnosis.message = fine(clock);
  }
}

const char* name(ClockHealth::State state) {
  switch (state) {
    case ClockHealth::State::Unsynchronized:
      return "unsynchronized";
    case ClockHealth::State::Learning:
      return "learning";
    case ClockHealth::State::Tracking:
      return "tracking";
  }
  return "";
}

}  // namespace

Diagnosis diagnoseClock(const Health& health) {
  Diagnosis diagnosis;
  judge(health, diagnosis);
  const ClockHealth& clock = health.clock;
  const auto known = [](const std::optional<double>& value, const char* format) {
    return value ? printed("%.3f", *value) + format : std::string{"unknown"};
  };
  diagnosis.values = {
      {"state", name(clock.state)},
      {"vehicle minus computer, less the delay of the link", known(clock.vehicle_ahead_s, " s")},
      {"learned offset", printed("%.6f s", inSeconds(clock.offset.offset))},
      {"jitter", printed("%.3f ms", 1e3 * inSeconds(clock.offset.jitter))},
      {"drift", printed("%.1f ppm", clock.offset.drift_ppm)},
      {"clock steps", std::to_string(clock.offset.steps)},
      {"clock steps in the last minute", std::to_string(clock.steps_lately)},
      {"stamps held back", printed("%.3f s", clock.held_back_s)}};
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
