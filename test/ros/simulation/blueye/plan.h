#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/session/blueye_session.h"
#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/blueye/drone.h"
#include "happenings.h"

namespace frontseat_driver::blueye_simulation {

using Duration = std::chrono::nanoseconds;
using simulation::between;
using simulation::fromSeconds;
using simulation::inSeconds;
using simulation::oneOf;

/// What the steady clock shows when a run begins.
constexpr Duration kBegin = std::chrono::hours{1};

/// Everything that can happen to the driver of a Blueye. Names are in plan.cpp.
enum class Kind {
  // A user.
  Stream,
  Nonsense,
  TakeControl,
  ReleaseControl,
  Stop,
  Abort,
  Gate,
  Control,
  Mission,
  Request,
  SetRate,
  Unload,
  // The network and this computer.
  Delay,
  Jitter,
  StalledTelemetry,
  StalledReplies,
  StalledControl,
  NoRoom,
  LinkLost,
  HalfOpen,
  Refusal,
  HeldUp,
  // The drone.
  RepliesLost,
  RepliesLate,
  TelemetryLost,
  Silence,
  Reboot,
  RebootUnnoticed,
  // Other clients of the drone.
  OtherTakesControl,
  OtherVanishes,
  OtherWaits,
  OtherFights,
  kCount
};
constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::kCount);

/// "held up", for people.
std::string_view nameOf(Kind kind);

using Action = simulation::Happening<Kind>;

/// All that a seed decides before a run begins. What happens can be taken out one by one without
/// changing the rest, to find what a failure needs.
struct Plan {
  std::uint64_t seed = 0;
  session::BlueyeOptions options;
  sim::BlueyeConfig drone;
  Duration length{};  ///< of the unrest; a quiet time follows
  std::vector<Action> actions;
};

/// `hours` of the drone's time, in which things happen `pace` times as often as usual.
Plan planFor(std::uint64_t seed, double hours, double pace = 1.0);

/// What happens in a plan, a line each.
std::string describe(const Plan& plan);

}  // namespace frontseat_driver::blueye_simulation
