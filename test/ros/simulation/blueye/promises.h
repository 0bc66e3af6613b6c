#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/session/blueye_session.h"
#include "network.h"

namespace frontseat_driver::blueye_simulation {

/// What a command must look like on the wire, axis by axis.
using Wire = std::array<float, 8>;

/// Motion, tilt and gripper, as in vehicle::DroneCommand.
constexpr std::size_t kHeld = 3;

constexpr std::string_view kTakeControl = "take_control";
constexpr std::string_view kReleaseControl = "release_control";

/// What was seen in one run or many.
struct Seen {
  std::uint64_t controls = 0;
  std::uint64_t motions = 0;
  std::uint64_t zeros = 0;
  std::uint64_t watchdogs = 0;
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;
  std::uint64_t calls = 0;
  std::uint64_t succeeded = 0;
  std::uint64_t gains = 0;
  std::uint64_t losses = 0;
  std::uint64_t requests = 0;

  void add(const Seen& other);
};

/// A model of the session's promises that shares no code with it: it knows what was told to the
/// session and when, works out who is in control and what may be said, and holds every message of
/// the session against that.
class Promises : public Watcher, public session::BlueyeListener {
 public:
  using Clock = Network::Clock;
  using Session = session::BlueyeSession;

  Promises(Clock clock, const session::BlueyeOptions& options);

  /// The session that is watched, or none.
  void watch(const Session* session);

  /// What was broken first, with its time; empty as long as nothing was.
  const std::string& broken() const { return broken_; }
  void breakPromise(const std::string& what);
  const Seen& seen() const { return seen_; }

  /// After every step of the session.
  void check();

  // What the user does.

  /// A command that was taken (or why not), and what it must be on the wire.
  void commanded(std::size_t kind, const Wire& wire, vehicle::SteadyTime received,
                 const std::string& refusal);
  void stopping();
  void stopped(const Session::Answer& answer);
  void gate(bool open);
  void leaving();
  void left();
  /// The drone was told to run a mission, so no pause is owed any more.
  void missionRuns() { pause_ends_.reset(); }

  /// A call that must be answered once within `limit`, longer by what requests take that go first
  /// if it `queues`.
  std::uint64_t call(std::string_view what, Duration limit, bool queues);
  void answered(std::uint64_t call, bool success);
  /// This computer does nothing for so long.
  void heldUp(Duration time) { carried_ += time; }
  bool allAnswered() const { return calls_.empty(); }

  /// The drone may have heard what the link took, and of us as in control.
  bool mayCommand() const;

  // Watcher
  void control(std::string_view type, std::string_view payload) override;
  void request(std::string_view type, std::chrono::milliseconds timeout) override;
  void linkRefused() override { refused_at_ = now(); }
  void telemetry(const Word& word) override;
  void reply(const Word& word) override;
  void noReply() override;
  void connected() override;
  void disconnected() override;

  // session::BlueyeListener
  void telemetry(const vehicle::Now&, std::string_view, std::string_view) override {}
  void event(const vehicle::Now&, const vehicle::Event& event) override;
  void clients(const vehicle::Now&) override {}
  void note(const std::string&) override {}

 private:
  using Time = vehicle::SteadyTime;

  /// Who is in control, as the drone said last by its own order.
  struct Authority {
    std::uint64_t order = 0;
    std::uint32_t in_control = 0;
    bool names_us = false;
  };
  struct Held {
    std::optional<Wire> wire;  ///< of the newest command taken
    Time received{};
    Time since{};   ///< it was taken
    int zeros = 0;  ///< still owed
    Time zero_by{};
    std::optional<Time> last;  ///< sent, in this time of control
    bool last_was_zero = false;
    std::deque<Time> sent;  ///< in the last second
  };
  struct Call {
    std::string what;
    Time asked;
    Duration limit;
    bool queues;
    Duration carried;  ///< by then
  };

  Time now() const { return clock_().steady; }
  template <class Message>
  void learn(std::uint64_t order, const Message& message);
  void learnFromReply(const Word& word);
  void end(Held& held);
  void endAll(bool also_what_rests);
  void forget();
  void followControl();
  void checkHeld(std::size_t kind);
  void checkCalls();
  void checkPause();
  void checkRegistration();
  void sentHeld(std::size_t kind, const Wire& wire);
  void sentWatchdog(std::string_view payload);
  Time excuse(Time due, Duration again) const;

  const Clock clock_;
  const session::BlueyeOptions options_;
  const Session* session_ = nullptr;
  std::string broken_;
  Seen seen_;
  bool connected_ = false;
  bool gate_open_;
  bool leaving_ = false;
  bool releasing_ = false;
  bool wanted_ = false;  ///< control was asked for, and that was not refused or taken back
  std::uint32_t id_ = 0;
  std::string under_way_;  ///< type of the request
  Authority newest_;
  std::optional<Time> unlisted_since_;  ///< the drone does not list this client
  bool in_control_ = false;             ///< as the session had it at the last check
  std::array<Held, kHeld> held_;
  Time permitted_since_{};
  Time watchdog_by_ = Time::max();
  Time refused_at_{};
  std::optional<Time> pause_ends_;
  Time pause_by_{};
  Time paused_at_{};
  Duration carried_{0};  ///< time-outs of all requests so far, and the time held up
  std::map<std::uint64_t, Call> calls_;
  std::uint64_t last_call_ = 0;
};

}  // namespace frontseat_driver::blueye_simulation
