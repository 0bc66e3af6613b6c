#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "closed_loop.h"
#include "happenings.h"

namespace frontseat_driver::simulation {

using closed_loop::Duration;

/// Everything that can happen to a driver. Names are in plan.cpp.
enum class Kind {
  // A user.
  Commands,
  Flood,
  Nonsense,
  WrongVehicle,
  Stop,
  Gate,
  Abort,
  ModifyBehavior,
  SetLogging,
  PayloadStatus,
  SetDatum,
  Unload,
  // The network.
  Delay,
  Jitter,
  Chunks,
  Corruption,
  SlowReader,
  NoRoom,
  Reset,
  HalfOpen,
  Refusal,
  NoHost,
  // The clocks.
  HostClockStep,
  VehicleClockStep,
  LeapSecond,
  // The vehicle.
  Reboot,
  RebootWrongClock,
  Crash,
  HangUp,
  Silence,
  SentencesLost,
  AcksLost,
  AcksLate,
  AcksPending,
  AcksTwice,
  AcksLying,
  AcksForOthers,
  Disobedience,
  ControlTaken,
  ControlTossed,
  MissionRestart,
  ShutdownNotice,
  OtherDialect,
  Garbage,
  kCount
};
constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::kCount);

/// "half-open", for people.
std::string_view nameOf(Kind kind);

using Action = Happening<Kind>;

/// All that a seed decides before a run begins. What happens can be taken out one by one without
/// changing the rest, to find what a failure needs.
struct Plan {
  ros_layer::Parameters parameters;
  sim::SandsharkConfig sandshark;
  sim::KingfisherConfig kingfisher;
  closed_loop::Duration length{};
  std::uint64_t seed = 0;
  protocol::Dialect dialect{};
  bool field_rates = false;
  std::vector<Action> actions;  ///< in the order of time
};

/// `hours` of the vehicle's time, in which things happen `pace` times as often as usual.
Plan planFor(std::uint64_t seed, protocol::Dialect dialect, double hours, double pace = 1.0);

/// The vehicle that a seed is given if none is asked for.
protocol::Dialect dialectOf(std::uint64_t seed);

}  // namespace frontseat_driver::simulation
