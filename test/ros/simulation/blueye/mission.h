#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blueye/telemetry.pb.h"
#include "network.h"
#include "plan.h"
#include "promises.h"

namespace frontseat_driver::blueye_simulation {

/// What went on in one run or many.
struct Totals {
  std::uint64_t runs = 0;
  double virtual_s = 0.0;
  Seen seen;
  std::uint64_t connects = 0;
  std::uint64_t failed_attempts = 0;
  std::uint64_t delivered = 0;
  std::array<std::uint64_t, kKinds> happened{};
  std::uint64_t digest = 0;  ///< of all that was sent and when: equal runs, equal digests

  void add(const Totals& other);
};

/// A driver's session, a simulated drone, its other clients and the network between them, living
/// through a plan in virtual time; then a quiet time, in which all must come right again.
class Mission {
 public:
  explicit Mission(const Plan& plan);
  ~Mission();
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  /// What was broken, and when; nothing if all promises were kept.
  std::string run();

  /// Prints, if set, what happens and every message, with its time.
  bool verbose = false;
  /// Keeps the last so many lines of that; 0: none.
  std::size_t trace_lines = 0;
  const std::deque<std::string>& trace() const { return trace_; }

  Totals totals() const;

 private:
  /// What passes goes to the promises, and to the trace and the digest.
  class Tap;
  struct Later {
    Duration at{};
    std::function<void()> act;
  };
  /// A program that commands.
  struct Stream {
    sim::Random random{1};
    std::size_t kind = 0;
    Duration period{};
    Duration next{};
    Duration end{};
    bool fixed = false;
    double reach = 1.0;
  };
  /// Another client of the drone.
  struct Other {
    std::uint32_t id = 0;
    Duration pets_until{};
    Duration next{};
    bool fights = false;
  };

  void pass(Duration end);
  Duration nextEvent() const;
  void stepAll();
  void actDue();
  void later(Duration in, std::function<void()> act);
  void start(const Action& action);
  void startUser(const Action& action, sim::Random& random);
  void startNetwork(const Action& action, sim::Random& random);
  void startDrone(const Action& action, sim::Random& random);
  void startOther(const Action& action, sim::Random& random);
  void startStream(const Action& action, sim::Random& random);
  void streamDue();
  void command(sim::Random& random, std::size_t kind, double reach, Duration age);
  void commandMotion(sim::Random& random, double reach, vehicle::SteadyTime received);
  void put(std::size_t kind, const vehicle::DroneCommand& command, const Wire& wire,
           vehicle::SteadyTime received);
  void take();
  void release();
  void control(sim::Random& random);
  void send(session::ConfirmedControls::Control control, Duration limit);
  void commandMission(sim::Random& random);
  void request(sim::Random& random, std::string type, std::string payload = {});
  void unload(Duration pause);
  void load();
  void faultFor(const Action& action, double sim::BlueyeFaults::*fault, double value);
  std::uint32_t connectOther(Duration pets_for, bool fights);
  void disconnectAsOther(std::uint32_t id);
  std::uint32_t inControl();
  ::blueye::protocol::ConnectedClientsTel clients();
  void othersDue();
  void calm();
  void expectOrder();
  std::function<void(const session::BlueyeSession::Answer&)> answerTo(std::uint64_t call);
  bool tracing() const { return verbose || trace_lines > 0; }
  void note(std::string text);
  vehicle::Now now() const;

  const Plan plan_;
  Duration elapsed_{0};
  sim::BlueyeDrone drone_;
  Promises promises_;
  std::unique_ptr<Tap> tap_;
  Network network_;
  std::unique_ptr<session::BlueyeSession> session_;
  bool leaving_ = false;
  Duration held_up_until_{0};
  Duration next_tick_{0};
  std::size_t next_action_ = 0;
  std::vector<Later> laters_;
  std::vector<Stream> streams_;
  std::vector<Other> others_;
  std::array<std::uint64_t, kKinds> happened_{};
  std::uint64_t digest_ = 14695981039346656037U;
  std::deque<std::string> trace_;
};

}  // namespace frontseat_driver::blueye_simulation
