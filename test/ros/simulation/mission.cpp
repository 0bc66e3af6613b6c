#include "mission.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace frontseat_driver::simulation {

using namespace std::chrono_literals;
using closed_loop::ClosedLoop;
using closed_loop::Wanted;
using protocol::Dialect;

namespace {

std::unique_ptr<ClosedLoop> loopFor(const Plan& plan) {
  if (plan.dialect == Dialect::Kingfisher) {
    return std::make_unique<ClosedLoop>(plan.parameters, plan.kingfisher);
  }
  return std::make_unique<ClosedLoop>(plan.parameters, plan.sandshark);
}

closed_loop::TruthLimits limitsFor(const Plan& plan) {
  const bool boat = plan.dialect == Dialect::Kingfisher;
  const sim::Quirks& quirks = boat ? plan.kingfisher.quirks : plan.sandshark.quirks;
  closed_loop::TruthLimits limits;
  if (quirks.float32_positions) limits.position_m = 1.5;
  limits.course_heading = quirks.course_heading;
  limits.blank_attitude = quirks.blank_attitude;
  limits.zero_depth = quirks.zero_depth;
  return limits;
}

Duration stepOf(sim::Random& random) {
  const double most_s = oneOf(random, {0.02, 2.0, 100.0, 40000.0});
  return std::chrono::milliseconds{
      static_cast<std::int64_t>(between(random, -most_s, most_s) * 1000.0)};
}

}  // namespace

void Totals::add(const Totals& other) {
  runs += other.runs;
  virtual_s += other.virtual_s;
  const auto& d = other.driver;
  driver.sentences_sent += d.sentences_sent;
  driver.commands_sent += d.commands_sent;
  driver.commands_taken += d.commands_taken;
  driver.commands_refused += d.commands_refused;
  driver.zeros += d.zeros;
  driver.aborts += d.aborts;
  driver.requests += d.requests;
  driver.acknowledged += d.acknowledged;
  driver.sentences_heard += d.sentences_heard;
  truth.positions += other.truth.positions;
  truth.velocities += other.truth.velocities;
  truth.stamps += other.truth.stamps;
  truth.jumps += other.truth.jumps;
  connects += other.connects;
  failed_attempts += other.failed_attempts;
  for (std::size_t i = 0; i < kKinds; ++i) happened[i] += other.happened[i];
  digest += other.digest;  // whatever order the threads end in
}

Mission::Mission(const Plan& plan)
    : plan_(plan),
      loop_(loopFor(plan_)),
      supervised_(*loop_, plan_.parameters, plan_.dialect),
      truth_(*loop_, supervised_, plan_.parameters, plan_.dialect, limitsFor(plan_)),
      network_(*loop_, supervised_, plan_.parameters.link),
      mischief_(plan_.seed, plan_.dialect) {
  loop_->keepRecords(false);
  loop_->seedLink(plan_.seed);
  loop_->link.delay = 1ms;
  loop_->link.edit = [this](std::string_view said) {
    return running_ ? mischief_.spoil(said) : std::string{said};
  };
  loop_->watch.sent = [this, before = loop_->watch.sent](const closed_loop::Sent& sent) {
    for (const char byte : sent.sentence) {
      digest_ = (digest_ ^ static_cast<unsigned char>(byte)) * 1099511628211U;
    }
    digest_ = (digest_ ^ static_cast<std::uint64_t>(sent.at.count())) * 1099511628211U;
    if (trace_lines > 0 || verbose) note("> " + sent.sentence);
    before(sent);
  };
}

std::string Mission::run() {
  if (trace_lines > 0 || verbose) listen();
  try {
    while (loop_->elapsed() < plan_.length && supervised_.broken().empty()) {
      loop_->pass(std::max(Duration{0}, std::min(nextEvent(), plan_.length) - loop_->elapsed()));
      actDue();
    }
  } catch (const std::logic_error& endless) {
    return endless.what();
  }
  return supervised_.broken();
}

void Mission::listen() {
  loop_->watch.heard = [this, before = loop_->watch.heard](std::string_view line) {
    note("< " + std::string{line});
    before(line);
  };
  loop_->watch.answered = [this, before = loop_->watch.answered](std::size_t number,
                                                                 const session::Answer& answer) {
    note("  request " + std::to_string(number) + ": " + (answer.success ? "yes, " : "no, ") +
         answer.message);
    before(number, answer);
  };
  loop_->watch.lost = [this, before = loop_->watch.lost] {
    note("  connection lost");
    before();
  };
}

void Mission::note(std::string text) {
  char at[32];
  std::snprintf(at, sizeof at, "%12.6f ", std::chrono::duration<double>(loop_->elapsed()).count());
  text.insert(0, at);
  if (verbose) std::puts(text.c_str());
  trace_.push_back(std::move(text));
  if (trace_.size() > trace_lines) trace_.pop_front();
}

Totals Mission::totals() const {
  Totals totals;
  totals.runs = 1;
  totals.virtual_s = std::chrono::duration<double>(loop_->elapsed()).count();
  totals.driver = supervised_.seen();
  totals.truth = truth_.seen();
  totals.connects = network_.connects();
  totals.failed_attempts = network_.failures();
  totals.happened = happened_;
  totals.digest = digest_;
  return totals;
}

// --- Time ---

Duration Mission::nextEvent() const {
  Duration next = network_.next();
  if (next_action_ < plan_.actions.size()) {
    next = std::min(next, plan_.actions[next_action_].at);
  }
  for (const Later& one : laters_) next = std::min(next, one.at);
  for (const Publisher& publisher : publishers_) next = std::min(next, publisher.next);
  return next;
}

void Mission::actDue() {
  network_.act();
  for (std::size_t i = 0; i < laters_.size();) {
    if (laters_[i].at > loop_->elapsed()) {
      ++i;
      continue;
    }
    const auto act = std::move(laters_[i].act);
    laters_.erase(laters_.begin() + static_cast<std::ptrdiff_t>(i));
    act();
  }
  for (; next_action_ < plan_.actions.size() && plan_.actions[next_action_].at <= loop_->elapsed();
       ++next_action_) {
    start(plan_.actions[next_action_]);
  }
  publishDue();
}

void Mission::later(Duration in, std::function<void()> act) {
  laters_.push_back({loop_->elapsed() + in, std::move(act)});
}

void Mission::start(const Action& action) {
  ++happened_[static_cast<std::size_t>(action.kind)];
  sim::Random random{action.seed};
  if (trace_lines > 0 || verbose) note("* " + std::string{nameOf(action.kind)});
  if (action.kind < Kind::Delay) {
    if (running_) startUser(action, random);
  } else if (action.kind < Kind::HostClockStep) {
    startNetwork(action, random);
  } else {
    startVehicle(action, random);
  }
}

// --- The user ---

void Mission::startUser(const Action& action, sim::Random& random) {
  switch (action.kind) {
    case Kind::Commands: {
      Publisher publisher;
      publisher.random = random;
      publisher.period = fromSeconds(1.0 / oneOf(random, {1.0, 2.0, 5.0, 10.0, 50.0}));
      const Duration most = publisher.period < 50ms ? Duration{5s} : Duration{90s};
      publisher.next = loop_->elapsed();
      publisher.end = loop_->elapsed() + std::min(action.lasts, most);
      publisher.topic = random.below(4);
      publisher.fixed = random.chance(0.5);
      publisher.wanted = anyCommand(random, publisher.topic, 1.0);
      publishers_.push_back(publisher);
      return;
    }
    case Kind::Flood:
      return flood(random);
    case Kind::Nonsense:
      if (random.chance(0.3)) return supervised_.publishNonsense();
      return supervised_.publish(anyCommand(random, random.below(4), 3.0));
    case Kind::WrongVehicle:
      return supervised_.publishForeign();
    case Kind::Stop:
      return supervised_.stop();
    case Kind::Gate:
      supervised_.gate(false);
      return later(action.lasts, [this] { supervised_.gate(true); });
    case Kind::Abort:
      for (std::size_t n = random.chance(0.1) ? 40 : 1; n > 0; --n) {
        supervised_.requestAbort(anyText(random), random.chance(0.5));
      }
      return;
    case Kind::ModifyBehavior:
      for (std::size_t n = random.chance(0.1) ? 80 : 1 + random.below(3); n > 0; --n) {
        supervised_.requestBehavior();
      }
      return;
    case Kind::SetLogging:
      return supervised_.requestLog(
          oneOf(random, {"CTD", "DVL", "RVL", "ALL", "SVS", "ctd", "NVGX"}), random.chance(0.7));
    case Kind::PayloadStatus:
      return supervised_.payloadStatus(random.chance(0.7), anyText(random));
    case Kind::SetDatum: {
      const vehicle::Position datum{between(random, -60.0, 60.0), between(random, -179.0, 179.0)};
      const auto& near = loop_->builder().datum();
      const bool far = !near || random.chance(0.2);
      const vehicle::Position moved =
          far ? datum : vehicle::Position{near->latitude_deg + 0.01, near->longitude_deg - 0.02};
      loop_->builder().setDatum(moved);
      return truth_.datumMoved(moved);
    }
    default:
      return unload(action);
  }
}

void Mission::publishDue() {
  for (Publisher& publisher : publishers_) {
    if (publisher.next > loop_->elapsed()) continue;
    publisher.next += publisher.period;
    if (running_) publishOne(publisher);
  }
  const auto ended = [this](const Publisher& one) { return one.end <= loop_->elapsed(); };
  publishers_.erase(std::remove_if(publishers_.begin(), publishers_.end(), ended),
                    publishers_.end());
}

void Mission::publishOne(Publisher& publisher) {
  sim::Random& random = publisher.random;
  if (!publisher.fixed) publisher.wanted = anyCommand(random, publisher.topic, 1.02);
  // Some wait for their turn in this computer.
  const Duration waited =
      random.chance(0.05) ? fromSeconds(between(random, 0.0, 1.5)) : Duration{0};
  supervised_.publish(publisher.wanted, waited);
}

void Mission::flood(sim::Random& random) {
  const std::size_t topic = random.below(4);
  Publisher publisher;
  publisher.random = random;
  publisher.period = 1ms;
  publisher.next = loop_->elapsed();
  publisher.end = loop_->elapsed() + 100ms;
  publisher.topic = topic;
  publishers_.push_back(publisher);
}

// The last words have 40 ms, then the program is gone, and comes back after a while.
void Mission::unload(const Action& action) {
  running_ = false;
  supervised_.leave();
  later(40ms, [this] {
    const bool waits = loop_->connected() && !loop_->session().hasLeft();
    const bool link_is_full = loop_->link.room > 0 || !loop_->link.takes;
    supervised_.promise(!waits || link_is_full, "has not left in time");
    network_.setRunning(false);
    supervised_.disconnect();
  });
  later(40ms + action.lasts, [this] {
    supervised_.load();
    truth_.driverLoaded();
    running_ = true;
    network_.setRunning(true);
  });
}

Wanted Mission::anyCommand(sim::Random& random, std::size_t topic, double reach) const {
  if (!isBoat()) return anyBehavior(random, reach);
  const double a = between(random, -reach, reach);
  const double b = between(random, -reach, reach);
  switch (topic) {
    case 0:
      return random.chance(0.05) ? closed_loop::drive(0.0, 0.0) : closed_loop::drive(a, b);
    case 1:
      return closed_loop::helm(a, M_PI * b);
    case 2:
      return closed_loop::course(2.0 * M_PI * a, 5.0 * (b + 1.0));
    default: {
      geometry_msgs::Twist twist;
      twist.linear.x = 2.5 * a;
      twist.angular.z = 1.5 * b;
      return twist;
    }
  }
}

Behavior Mission::anyBehavior(sim::Random& random, double reach) const {
  Behavior message;
  message.horizontal_mode = static_cast<std::uint8_t>(random.below(3));
  message.vertical_mode = static_cast<std::uint8_t>(random.below(5));
  message.speed_mode = static_cast<std::uint8_t>(random.below(3));
  const bool heading = message.horizontal_mode == Behavior::HORIZONTAL_HEADING;
  message.horizontal = between(random, -reach, reach) * (heading ? 2.0 * M_PI : M_PI_2);
  const bool angle = message.vertical_mode >= Behavior::VERTICAL_PITCH;
  message.vertical = angle ? between(random, -reach, reach) * M_PI_2
                           : between(random, 1.0 - reach, reach) * 6000.0;
  const bool rpm = message.speed_mode == Behavior::SPEED_RPM;
  message.speed =
      rpm ? between(random, -reach, reach) * 1e4 : between(random, 1.0 - reach, reach) * 10.0;
  return message;
}

std::string Mission::anyText(sim::Random& random) const {
  return oneOf<const char*>(random, {"leak", "", "all well", "LOG is full", "a,b", "$", "50 * 3",
                                     "low battery: 12.3 V", "ABTRMB", "caf\xc3\xa9", "tab\t"});
}

// --- The network ---

void Mission::startNetwork(const Action& action, sim::Random& random) {
  ClosedLoop::Link& link = loop_->link;
  switch (action.kind) {
    case Kind::Delay:
      link.delay = fromSeconds(oneOf(random, {0.0, 0.02, 0.15, 0.7, 3.0}));
      return later(action.lasts, [&link] { link.delay = 1ms; });
    case Kind::Jitter:
      link.jitter = fromSeconds(oneOf(random, {0.005, 0.05, 0.5}));
      return later(action.lasts, [&link] { link.jitter = 0ms; });
    case Kind::Chunks:
      link.cut = oneOf(random, {0.2, 0.8, 0.97});
      return later(action.lasts, [&link] { link.cut = 0.0; });
    case Kind::Corruption:
      link.corrupt = oneOf(random, {0.02, 0.2, 1.0});
      return later(action.lasts, [&link] { link.corrupt = 0.0; });
    case Kind::SlowReader:
      link.room = 2000;
      link.read_every = fromSeconds(oneOf(random, {0.1, 0.3, 1.0}));
      return later(action.lasts, [&link] {
        link.read_every = 0ms;
        link.room = 0;
      });
    case Kind::NoRoom:
      link.takes = false;
      if (random.chance(0.2)) network_.breakSoon();
      return later(action.lasts, [&link] { link.takes = true; });
    case Kind::Reset:
      return network_.reset();
    case Kind::HalfOpen:
      link.delivers = false;
      return later(action.lasts, [this, &link] {
        // What was sent meanwhile is repeated by TCP or ends the connection.
        if (!link.delivers) network_.reset();
        link.delivers = true;
      });
    case Kind::Refusal:
    case Kind::NoHost:
      network_.setHost(action.kind == Kind::Refusal ? Network::Host::Refuses
                                                    : Network::Host::IsNotThere);
      network_.reset();
      return later(action.lasts, [this] { network_.setHost(Network::Host::Listens); });
    default:
      return;
  }
}

// --- The vehicle and the clocks ---

void Mission::startVehicle(const Action& action, sim::Random& random) {
  switch (action.kind) {
    case Kind::HostClockStep:
      truth_.clocksChanged();
      return supervised_.stepSystemClock(stepOf(random));
    case Kind::VehicleClockStep:
      truth_.clocksChanged();
      return loop_->frontseat().stepClock(stepOf(random));
    case Kind::LeapSecond:
      truth_.clocksChanged();
      return loop_->frontseat().stepClock(-1s);
    case Kind::Reboot:
    case Kind::RebootWrongClock:
      return reboot(random, action.kind == Kind::RebootWrongClock);
    case Kind::Crash:
      return crash(action);
    case Kind::HangUp:
      return network_.reset();
    case Kind::Silence:
      return setFault(action, [](sim::Faults& faults, bool on) {
        faults.stall_s = faults.stall_every_s = on ? 1e-3 : 0.0;
      });
    case Kind::AcksLate:
      return setFault(action,
                      [late_s = oneOf(random, {0.2, 1.0, 2.5, 6.0})](sim::Faults& faults, bool on) {
                        faults.delay_acks_s = on ? late_s : 0.0;
                      });
    case Kind::Disobedience:
      return setFault(action, [](sim::Faults& faults, bool on) { faults.lie = on; });
    case Kind::ControlTaken:
      setControl(false);
      return later(action.lasts, [this] { setControl(true); });
    case Kind::ControlTossed:
      for (int i = 0; i < 12; ++i) later(i * 70ms, [this, i] { setControl(i % 2 == 1); });
      return;
    case Kind::MissionRestart:
      if (!isBoat()) loop_->sandshark().restartMission();
      return;
    case Kind::ShutdownNotice:
      if (!isBoat()) loop_->sandshark().announceShutdown();
      return;
    default:
      return setMischief(action);
  }
}

void Mission::reboot(sim::Random& random, bool wrong_clock) {
  truth_.clocksChanged();
  const double off_s = wrong_clock ? between(random, -40000.0, 40000.0) : 0.0;
  if (isBoat()) {
    sim::KingfisherConfig config = plan_.kingfisher;
    config.clock_offset_s += off_s;
    loop_->powerCycle(config);
  } else {
    sim::SandsharkConfig config = plan_.sandshark;
    config.clock_offset_s += off_s;
    loop_->powerCycle(config);
  }
  loop_->frontseat().setFaults(faults_);
}

// Its host is gone without a word; when it is back it answers the old connection with a reset.
void Mission::crash(const Action& action) {
  truth_.clocksChanged();
  if (isBoat()) {
    loop_->crash(plan_.kingfisher);
  } else {
    loop_->crash(plan_.sandshark);
  }
  loop_->frontseat().setFaults(faults_);
  network_.setHost(Network::Host::IsNotThere);
  network_.resetAt(loop_->elapsed() + action.lasts);
  later(action.lasts, [this] { network_.setHost(Network::Host::Listens); });
}

void Mission::setFault(const Action& action, const std::function<void(sim::Faults&, bool)>& set) {
  set(faults_, true);
  loop_->frontseat().setFaults(faults_);
  later(action.lasts, [this, set] {
    set(faults_, false);
    loop_->frontseat().setFaults(faults_);
  });
}

void Mission::setMischief(const Action& action) {
  mischief_.set(action.kind, true);
  later(action.lasts, [this, kind = action.kind] { mischief_.set(kind, false); });
}

void Mission::setControl(bool given) {
  if (!isBoat()) loop_->sandshark().setBackseatControl(given);
}

}  // namespace frontseat_driver::simulation
