#include "frontseat_driver/sim/random.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "closed_loop.h"
#include "supervised.h"

// Two minutes of anything, for many seeds: what a user, a link, a clock and a vehicle can do, in
// any order, with what the driver promises looked at after every step.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

constexpr std::uint64_t kSeeds = 100;  // of each dialect
constexpr Duration kRun = 2min;

template <class T, std::size_t kCount>
const T& oneOf(sim::Random& random, const T (&choices)[kCount]) {
  return choices[random.below(kCount)];
}

Duration upTo(sim::Random& random, Duration most) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(most * random.uniform());
}

ros_layer::Parameters anyParameters(sim::Random& random, Dialect dialect) {
  ros_layer::Parameters parameters = parametersFor(dialect);
  session::NmeaOptions& session = parameters.session;
  if (random.chance(0.3)) session.dialect.reset();
  if (random.chance(0.3)) session.send_spacing = oneOf(random, {5ms, 20ms, 100ms, 300ms});
  session.command_timeout = oneOf<Duration>(random, {200ms, 500ms, 1s, 1s, 5s});
  session.command_rate_hz = oneOf(random, {0.25, 2.0, 5.0, 5.0, 50.0});
  session.ack_timeout = oneOf<Duration>(random, {500ms, 3s, 3s, 12s});
  session.status_rate_hz = oneOf(random, {0.0, 1.0, 10.0});
  session.use_acks = !random.chance(0.1);
  session.commands_enabled = !random.chance(0.2);
  session.format.thrust_decimals = 2;  // so that all commands differ
  if (random.chance(0.2)) session.control_hook = session::ControlHook::None;
  return parameters;
}

template <class Config>
Config withTroubles(Config config, sim::Random& random) {
  config.seed = random.below(1000000);
  config.noise = true;
  config.solution_age = 10ms;
  sim::Faults& faults = config.faults;
  if (random.chance(0.3)) faults.drop = 0.1;
  if (random.chance(0.3)) faults.corrupt = 0.1;
  faults.split = random.chance(0.3);
  if (random.chance(0.2)) faults.disconnect_every_s = 20.0;
  if (random.chance(0.2)) faults.stall_s = faults.stall_every_s = 5.0;
  faults.withhold_acks = random.chance(0.2);
  faults.delay_acks_s = oneOf(random, {0.0, 0.0, 1.0, 5.0});
  faults.lie = random.chance(0.1);
  config.quirks.long_ack_names = random.chance(0.5);
  config.quirks.ack_log_ack = random.chance(0.5);
  config.quirks.one_read_one_sentence = random.chance(0.3);
  config.quirks.cr_lf_lf = random.chance(0.3);
  return config;
}

std::unique_ptr<ClosedLoop> anyLoop(const ros_layer::Parameters& parameters, Dialect dialect,
                                    sim::Random& random) {
  if (dialect == Dialect::Kingfisher) {
    return std::make_unique<ClosedLoop>(parameters, withTroubles(quietKingfisher(), random));
  }
  sim::SandsharkConfig vehicle = withTroubles(quietSandshark(), random);
  vehicle.pending_s = oneOf(random, {0.0, 0.0, 0.3, 1e6});
  vehicle.quirks.dies_on_empty_field = random.chance(0.1);
  return std::make_unique<ClosedLoop>(parameters, vehicle);
}

/// One seed's run.
class Anything {
 public:
  Anything(std::uint64_t seed, Dialect dialect)
      : random_(seed, dialect == Dialect::Kingfisher ? 1 : 2),
        dialect_(dialect),
        parameters_(anyParameters(random_, dialect)),
        loop_(anyLoop(parameters_, dialect, random_)),
        supervised_(*loop_, parameters_, dialect) {}

  /// What was broken, or nothing.
  std::string run() {
    try {
      live();
      leave();
    } catch (const std::logic_error& endless) {
      return endless.what();
    }
    return supervised_.broken();
  }

  std::size_t sent() const { return loop_->sent().size(); }

 private:
  void live() {
    while (loop_->elapsed() < kRun && supervised_.broken().empty()) {
      act();
      loop_->pass(upTo(random_, 400ms));
    }
  }

  void leave() {
    supervised_.leave();
    loop_->pass(40ms);  // what driver::Driver gives it
    const bool left = loop_->session().hasLeft() || !loop_->link.takes;
    if (!left) throw std::logic_error{"has not left in time"};
    loop_->pass(5s);
  }

  void act() {
    if (!loop_->connected() && random_.chance(0.3)) supervised_.connect();
    switch (random_.below(20)) {
      case 0:
        return supervised_.stop();
      case 1:
        return supervised_.gate(random_.chance(0.8));
      case 2:
        return actOnLink();
      case 3:
        return actOnVehicle();
      case 4:
        return actOnClock();
      case 5:
        return ask();
      case 6:
        return flood();
      case 7:
        return supervised_.publishNonsense();
      case 8:
        return supervised_.publishForeign();
      case 9:
        return loop_->pass(upTo(random_, 7s));
      default:
        return supervised_.publish();
    }
  }

  void actOnLink() {
    if (random_.chance(0.2)) supervised_.disconnect();
    supervised_.setTakes(!random_.chance(0.2));
    loop_->link.delivers = !random_.chance(0.2);
    loop_->link.congested = random_.chance(0.2);
    loop_->link.delay = oneOf<Duration>(random_, {0ms, 0ms, 1ms, 100ms, 700ms});
  }

  void actOnVehicle() {
    if (dialect_ == Dialect::Kingfisher) return;
    if (random_.chance(0.5)) return loop_->sandshark().setBackseatControl(random_.chance(0.7));
    loop_->sandshark().restartMission();
  }

  void actOnClock() {
    const double step_s = (random_.uniform() - 0.5) * 36000.0;
    supervised_.stepSystemClock(
        std::chrono::milliseconds{static_cast<std::int64_t>(step_s * 1000.0)});
  }

  void ask() {
    const std::size_t callers = random_.chance(0.1) ? 80 : 1 + random_.below(3);
    for (std::size_t i = 0; i < callers; ++i) {
      if (random_.chance(0.1)) {
        supervised_.requestAbort();
      } else if (random_.chance(0.5)) {
        supervised_.requestBehavior();
      } else {
        supervised_.requestLog(random_.chance(0.9) ? "CTD" : "ctd");
      }
    }
  }

  void flood() {
    for (int i = 0; i < 100; ++i) {
      supervised_.publish();
      loop_->pass(1ms);
    }
  }

  sim::Random random_;
  const Dialect dialect_;
  const ros_layer::Parameters parameters_;
  const std::unique_ptr<ClosedLoop> loop_;
  Supervised supervised_;
};

class RandomRun : public testing::TestWithParam<Dialect> {};

TEST_P(RandomRun, KeepsEveryPromiseWhateverHappens) {
  std::size_t sent = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Anything anything{seed, GetParam()};
    const std::string broken = anything.run();
    ASSERT_EQ(broken, "") << "with seed " << seed;
    sent += anything.sent();
  }
  EXPECT_GT(sent, kSeeds * 100) << "there is hardly anything to look at";
}

INSTANTIATE_TEST_SUITE_P(Dialects, RandomRun,
                         testing::Values(Dialect::Sandshark, Dialect::Kingfisher),
                         [](const auto& row) { return protocol::toString(row.param); });

}  // namespace
}  // namespace frontseat_driver::closed_loop
