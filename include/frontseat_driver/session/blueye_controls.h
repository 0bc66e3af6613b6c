#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "frontseat_driver/session/blueye_requests.h"
#include "frontseat_driver/session/command_slot.h"
#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::session {

/// What the drone keeps doing until it is told otherwise: motion, tilt, gripper. Each has one
/// newest-value slot, repeated while it is fresh. When it ends, zero goes out at once and again
/// each second for three seconds, since a control message may be lost and is never answered.
///
/// No more than 30 of a kind go out in a second, the newest each time: a drone keeps what comes
/// faster and acts on it late. Zero does not wait; what follows it waits for longer.
class HeldControls {
 public:
  using SteadyTime = vehicle::SteadyTime;

  /// `clockwise_yaw`: what the drone takes a positive yaw for.
  HeldControls(std::chrono::nanoseconds timeout, std::chrono::nanoseconds period,
               bool clockwise_yaw);

  void put(const vehicle::DroneCommand& command, SteadyTime received);

  /// Ends what is going on; what is not going on gets its zeros only if `all`.
  void end(SteadyTime now, bool all);

  /// Ends everything and sends nothing: somebody else is in control, or nobody hears.
  void forget();

  void step(const vehicle::Now& now, BlueyeOutput& out);

  SteadyTime nextStep() const;

  /// A fresh command is being repeated.
  bool commanding() const;

  /// Zeros that have not gone out for the first time.
  bool zerosDue() const;

  const std::optional<vehicle::DroneCommand>& motion() const { return held_[0].slot.command(); }

 private:
  struct Held {
    BasicCommandSlot<vehicle::DroneCommand> slot;
    int zeros = 0;  ///< still to go out
    SteadyTime zero_due{};
    SteadyTime next{};     ///< only zero goes out before, and only if what went out last was not
    bool resting = false;  ///< what went out last was zero
  };

  void end(Held& held, SteadyTime now);
  void step(const vehicle::Now& now, std::size_t kind, BlueyeOutput& out);
  bool send(const vehicle::Now& now, const vehicle::DroneCommand& command, BlueyeOutput& out) const;

  std::array<Held, std::variant_size_v<vehicle::DroneCommand>> held_;
  const bool clockwise_yaw_;
};

/// Control messages that telemetry confirms. Sent at once and, where that does no harm, again until
/// the telemetry shows their effect or time is up; each is answered once.
class ConfirmedControls {
 public:
  using SteadyTime = vehicle::SteadyTime;
  /// Empty: confirmed. Else why not, for people.
  using Respond = std::function<void(const std::string& refusal)>;

  struct Control {
    std::string type;  ///< with package; empty: nothing is sent, only waited for
    std::string payload;
    bool repeat = false;  ///< sending it twice is as good as once
    bool stops = false;   ///< ends something: no end of commanding ends it
    /// Of a stream of the same kind, of which no more than 30 a second go out, the newest each time
    /// (StreamedControls). Empty: each goes out at once.
    std::string stream;
    std::string confirmed_by;  ///< telemetry type with package; empty: sent is done
    /// Whether this telemetry shows the effect.
    std::function<bool(std::string_view payload)> shows;
    std::chrono::milliseconds timeout{2000};
    Respond respond;  ///< may be empty
  };

  /// Takes the place of one of the same type that waits, but not of one that ends something.
  /// False if the link did not take it.
  bool add(const vehicle::Now& now, Control control, BlueyeOutput& out);

  void telemetry(std::string_view type, std::string_view payload);
  void step(const vehicle::Now& now, BlueyeOutput& out);
  SteadyTime nextStep() const;
  /// Those that end something go on unless `stops_too`.
  void failAll(const std::string& reason, bool stops_too = true);

  /// Sends those of a type no more, since the opposite is wanted now.
  void drop(const std::string& type);

  bool empty() const { return waiting_.empty(); }

  /// The telemetry that is waited for next, with package; not while empty().
  std::string awaited();

 private:
  struct Waiting {
    Control control;
    SteadyTime deadline;
    SteadyTime again;
  };

  std::list<Waiting> waiting_;
};

/// Controls that programs send in streams, such as lights and servos: of each stream no more than
/// 30 go out in a second, the newest each time, since a drone keeps what comes faster and a stop
/// would come after it.
class StreamedControls {
 public:
  using SteadyTime = vehicle::SteadyTime;
  using Control = ConfirmedControls::Control;
  using Send = std::function<void(Control)>;

  /// Sends the control at once, or as soon as its stream may go on; then it is answered now.
  void put(SteadyTime now, Control control, const Send& send);

  void step(SteadyTime now, const Send& send);
  SteadyTime nextStep() const;

  /// What waits is not sent any more.
  void forget();

 private:
  struct Stream {
    SteadyTime next{};              ///< nothing goes out before
    std::optional<Control> newest;  ///< that waits
  };

  std::map<std::string, Stream> streams_;
};

}  // namespace frontseat_driver::session
