#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mischief.h"
#include "network.h"
#include "plan.h"
#include "supervised.h"
#include "truth_check.h"

namespace frontseat_driver::simulation {

/// What went on in one run or many.
struct Totals {
  std::uint64_t runs = 0;
  double virtual_s = 0.0;
  closed_loop::Supervised::Seen driver;
  closed_loop::TruthCheck::Seen truth;
  std::uint64_t connects = 0;
  std::uint64_t failed_attempts = 0;
  std::array<std::uint64_t, kKinds> happened{};
  std::uint64_t digest = 0;  ///< of all that was sent and when: equal runs, equal digests

  void add(const Totals& other);
};

/// One driver, one vehicle and the network between them, living through a plan in virtual time.
///
/// A session of another kind (Blueye's) takes part by a loop and a model of its own promises behind
/// the same plan.
class Mission {
 public:
  explicit Mission(const Plan& plan);

  /// What was broken, and when; nothing if all promises were kept.
  std::string run();

  /// Prints, if set, what happens and every sentence, with its time.
  bool verbose = false;
  /// Keeps the last so many lines of that; 0: none.
  std::size_t trace_lines = 0;
  const std::deque<std::string>& trace() const { return trace_; }

  Totals totals() const;

 private:
  /// Something that ends, or has to be done, at a time.
  struct Later {
    Duration at{};
    std::function<void()> act;
  };
  /// A program that publishes.
  struct Publisher {
    sim::Random random{1};
    Duration period{};
    Duration next{};
    Duration end{};
    std::size_t topic = 0;
    bool fixed = false;  ///< the same value over and over
    closed_loop::Wanted wanted;
  };

  Duration nextEvent() const;
  void actDue();
  void later(Duration in, std::function<void()> act);
  void start(const Action& action);
  void startUser(const Action& action, sim::Random& random);
  void startNetwork(const Action& action, sim::Random& random);
  void startVehicle(const Action& action, sim::Random& random);
  void publishDue();
  void publishOne(Publisher& publisher);
  void flood(sim::Random& random);
  void unload(const Action& action);
  void reboot(sim::Random& random, bool wrong_clock);
  void crash(const Action& action);
  void setFault(const Action& action, const std::function<void(sim::Faults&, bool)>& set);
  void setMischief(const Action& action);
  void setControl(bool given);
  closed_loop::Wanted anyCommand(sim::Random& random, std::size_t topic, double reach) const;
  Behavior anyBehavior(sim::Random& random, double reach) const;
  std::string anyText(sim::Random& random) const;
  bool isBoat() const { return plan_.dialect == protocol::Dialect::Kingfisher; }
  void note(std::string text);
  void listen();

  const Plan plan_;
  std::unique_ptr<closed_loop::ClosedLoop> loop_;
  closed_loop::Supervised supervised_;
  closed_loop::TruthCheck truth_;
  Network network_;
  Mischief mischief_;
  sim::Faults faults_;
  std::size_t next_action_ = 0;
  std::vector<Later> laters_;
  std::vector<Publisher> publishers_;
  bool running_ = true;
  std::array<std::uint64_t, kKinds> happened_{};
  std::uint64_t digest_ = 14695981039346656037U;
  std::deque<std::string> trace_;
};

}  // namespace frontseat_driver::simulation
