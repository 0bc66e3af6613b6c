#include "mission.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "blueye/control.pb.h"
#include "blueye/messages.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"

namespace frontseat_driver::blueye_simulation {

using namespace std::chrono_literals;
namespace pb = ::blueye::protocol;
using session::BlueyeSession;
using session::ConfirmedControls;

namespace {

constexpr Duration kLastWords = 100ms;   // BlueyeDriver's
constexpr Duration kQuiet = 40s;         // longer than any recovery
constexpr int kMostStepsAtOnce = 10000;  // of one moment

template <class Message>
std::string typeOf() {
  return Message{}.GetTypeName();
}

float toWire(double value) { return static_cast<float>(value); }

}  // namespace

/// What passes goes on to the promises.
class Mission::Tap : public Watcher {
 public:
  explicit Tap(Mission& mission) : mission_(mission), next_(mission.promises_) {}

  void control(std::string_view type, std::string_view payload) override {
    mix(type);
    mix(payload);
    if (mission_.tracing()) tell("> ", type);
    next_.control(type, payload);
  }
  void request(std::string_view type, std::chrono::milliseconds timeout) override {
    mix(type);
    if (mission_.tracing()) tell("? ", type);
    next_.request(type, timeout);
  }
  void linkRefused() override { next_.linkRefused(); }
  void telemetry(const Word& word) override {
    if (mission_.tracing()) tell("< ", word.type);
    next_.telemetry(word);
  }
  void reply(const Word& word) override {
    if (mission_.tracing()) tell("! ", word.type);
    next_.reply(word);
  }
  void noReply() override {
    if (mission_.tracing()) mission_.note("! no reply");
    next_.noReply();
  }
  void connected() override {
    if (mission_.tracing()) mission_.note("  connected");
    next_.connected();
  }
  void disconnected() override {
    if (mission_.tracing()) mission_.note("  connection lost");
    next_.disconnected();
  }

 private:
  void tell(const char* mark, std::string_view type) {
    mission_.note(mark + std::string{type.substr(type.rfind('.') + 1)});
  }
  void mix(std::string_view bytes) {
    std::uint64_t& digest = mission_.digest_;
    for (const char byte : bytes) {
      digest = (digest ^ static_cast<unsigned char>(byte)) * 1099511628211U;
    }
    digest = (digest ^ static_cast<std::uint64_t>(mission_.elapsed_.count())) * 1099511628211U;
  }

  Mission& mission_;
  Promises& next_;
};

void Totals::add(const Totals& other) {
  runs += other.runs;
  virtual_s += other.virtual_s;
  seen.add(other.seen);
  connects += other.connects;
  failed_attempts += other.failed_attempts;
  delivered += other.delivered;
  for (std::size_t i = 0; i < kKinds; ++i) happened[i] += other.happened[i];
  digest += other.digest;  // whatever order the threads end in
}

Mission::Mission(const Plan& plan)
    : plan_(plan),
      drone_(plan_.drone),
      promises_([this] { return now(); }, plan_.options),
      tap_(std::make_unique<Tap>(*this)),
      network_([this] { return now(); }, drone_, *tap_, plan_.seed) {
  load();
}

Mission::~Mission() = default;

vehicle::Now Mission::now() const {
  vehicle::Now now;
  now.steady = vehicle::SteadyTime{kBegin + elapsed_};
  now.utc = now.stamp = plan_.drone.start_time + elapsed_;
  return now;
}

std::string Mission::run() {
  pass(plan_.length);
  calm();
  pass(plan_.length + kQuiet);
  if (promises_.broken().empty()) expectOrder();
  return promises_.broken();
}

Totals Mission::totals() const {
  Totals totals;
  totals.runs = 1;
  totals.virtual_s = inSeconds(elapsed_);
  totals.seen = promises_.seen();
  totals.connects = network_.connects;
  totals.failed_attempts = network_.failures;
  totals.delivered = network_.delivered;
  totals.happened = happened_;
  totals.digest = digest_;
  return totals;
}

void Mission::note(std::string text) {
  char at[32];
  std::snprintf(at, sizeof at, "%12.6f ", inSeconds(elapsed_));
  text.insert(0, at);
  if (verbose) std::puts(text.c_str());
  trace_.push_back(std::move(text));
  if (trace_.size() > trace_lines) trace_.pop_front();
}

// --- Time ---

void Mission::pass(Duration end) {
  int steps = 0;
  while (promises_.broken().empty()) {
    const Duration next = std::max(elapsed_, nextEvent());
    if (next > end) break;
    steps = next == elapsed_ ? steps + 1 : 0;
    if (steps > kMostStepsAtOnce) {
      return promises_.breakPromise("steps are asked for without end");
    }
    elapsed_ = next;
    stepAll();
  }
  elapsed_ = std::max(elapsed_, end);
}

Duration Mission::nextEvent() const {
  const auto from_steady = [](vehicle::SteadyTime time) {
    return time == vehicle::SteadyTime::max() ? Duration::max() : time.time_since_epoch() - kBegin;
  };
  Duration next = next_tick_;
  const Duration for_driver =
      std::min(network_.next() == Duration::max() ? Duration::max() : network_.next() - kBegin,
               session_ ? from_steady(std::max(session_->nextStep(), vehicle::SteadyTime{kBegin}))
                        : Duration::max());
  next = std::min(next, std::max(for_driver, held_up_until_));
  if (next_action_ < plan_.actions.size()) next = std::min(next, plan_.actions[next_action_].at);
  for (const Later& one : laters_) next = std::min(next, one.at);
  for (const Stream& one : streams_) next = std::min(next, std::max(one.next, held_up_until_));
  return next;
}

// A driver that is held up does nothing at all; the drone lives on.
void Mission::stepAll() {
  if (elapsed_ >= next_tick_) {
    next_tick_ += sim::BlueyeDrone::kTick;
    drone_.step(now().utc, network_);
    othersDue();
  }
  if (elapsed_ >= held_up_until_) {
    network_.act();
    drone_.step(now().utc, network_);
    if (session_ && now().steady >= session_->nextStep()) session_->step(now(), network_);
    promises_.check();
  }
  actDue();
  if (elapsed_ < held_up_until_) return;
  streamDue();
  if (session_) session_->step(now(), network_);
  promises_.check();
}

void Mission::actDue() {
  for (std::size_t i = 0; i < laters_.size();) {
    if (laters_[i].at > elapsed_) {
      ++i;
      continue;
    }
    const auto act = std::move(laters_[i].act);
    laters_.erase(laters_.begin() + static_cast<std::ptrdiff_t>(i));
    act();
  }
  for (; next_action_ < plan_.actions.size() && plan_.actions[next_action_].at <= elapsed_;
       ++next_action_) {
    start(plan_.actions[next_action_]);
  }
}

void Mission::later(Duration in, std::function<void()> act) {
  laters_.push_back({elapsed_ + in, std::move(act)});
}

void Mission::start(const Action& action) {
  ++happened_[static_cast<std::size_t>(action.kind)];
  sim::Random random{action.seed};
  if (tracing()) note("* " + std::string{nameOf(action.kind)});
  if (action.kind < Kind::Delay) {
    const bool runs = session_ && !leaving_ && elapsed_ >= held_up_until_;
    if (runs) startUser(action, random);
  } else if (action.kind < Kind::RepliesLost) {
    startNetwork(action, random);
  } else if (action.kind < Kind::OtherTakesControl) {
    startDrone(action, random);
  } else {
    startOther(action, random);
  }
}

// --- The user ---

void Mission::startUser(const Action& action, sim::Random& random) {
  switch (action.kind) {
    case Kind::Stream:
      return startStream(action, random);
    case Kind::Nonsense:
      return command(random, random.below(kHeld), 1.5, fromSeconds(between(random, 0.0, 6.0)));
    case Kind::TakeControl:
      return take();
    case Kind::ReleaseControl:
      return release();
    case Kind::Stop:
      for (std::size_t n = random.chance(0.1) ? 50 : 1; n > 0; --n) {
        promises_.stopping();
        promises_.stopped(session_->stop(now(), network_));
      }
      return;
    case Kind::Abort:
      promises_.stopping();
      return promises_.stopped(session_->abort(now(), network_));
    case Kind::Gate:
      promises_.gate(false);
      session_->setCommandsEnabled(now(), false);
      return later(action.lasts, [this] {
        if (!session_ || leaving_) return;
        promises_.gate(true);
        session_->setCommandsEnabled(now(), true);
      });
    case Kind::Control:
      return control(random);
    case Kind::Mission:
      return commandMission(random);
    case Kind::Request:
      for (std::size_t n = random.chance(0.1) ? 40 : 1; n > 0; --n) {
        request(random, oneOf<std::string>(
                            random, {typeOf<pb::GetBatteryReq>(), typeOf<pb::GetMissionReq>(),
                                     "blueye.protocol.TeleportReq"}));
      }
      return;
    case Kind::SetRate: {
      const auto call = promises_.call("set_rate", plan_.options.request_timeout, true);
      const auto* message = oneOf(random, {"DepthTel", "ConnectedClientsTel", "NoSuchTel"});
      return session_->setRate(now(), message, oneOf(random, {1.0, 20.0, 101.0}), answerTo(call),
                               network_);
    }
    default:
      return unload(action.lasts);
  }
}

std::function<void(const BlueyeSession::Answer&)> Mission::answerTo(std::uint64_t call) {
  return [this, call](const BlueyeSession::Answer& answer) {
    if (tracing()) note("  call " + std::to_string(call) + ": " + answer.message);
    promises_.answered(call, answer.success);
  };
}

void Mission::take() {
  const auto call = promises_.call(kTakeControl, plan_.options.control_timeout, false);
  session_->takeControl(now(), answerTo(call), network_);
}

void Mission::release() {
  const auto call = promises_.call(kReleaseControl, 2 * plan_.options.request_timeout, true);
  session_->releaseControl(now(), answerTo(call), network_);
}

void Mission::send(ConfirmedControls::Control control, Duration limit) {
  const auto call = promises_.call("a control message", limit, false);
  control.respond = [this, call](const std::string& refusal) {
    if (tracing()) note("  call " + std::to_string(call) + ": " + refusal);
    promises_.answered(call, refusal.empty());
  };
  session_->control(now(), std::move(control), network_);
}

void Mission::control(sim::Random& random) {
  ConfirmedControls::Control control;
  if (random.chance(0.3)) {
    control.type = oneOf<std::string>(
        random, {typeOf<pb::TakePictureCtrl>(), typeOf<pb::MotionInputCtrl>(),
                 typeOf<pb::WatchdogCtrl>(), typeOf<pb::ActivateGuestPortsCtrl>()});
    return send(std::move(control), 0s);
  }
  const bool on = random.chance(0.5);
  pb::AutoDepthCtrl wanted;
  wanted.mutable_state()->set_enabled(on);
  control.type = wanted.GetTypeName();
  control.payload = wanted.SerializeAsString();
  control.repeat = true;
  control.confirmed_by = typeOf<pb::ControlModeTel>();
  control.shows = [on](std::string_view payload) {
    pb::ControlModeTel told;
    return told.ParseFromArray(payload.data(), static_cast<int>(payload.size())) &&
           told.state().auto_depth() == on;
  };
  send(std::move(control), 2s);
}

void Mission::commandMission(sim::Random& random) {
  if (random.chance(0.4)) {
    pb::SetMissionReq wanted;
    auto& instruction = *wanted.mutable_mission()->add_instructions();
    instruction.mutable_wait_for_command()->set_wait_for_seconds(60);
    return request(random, wanted.GetTypeName(), wanted.SerializeAsString());
  }
  ConfirmedControls::Control control;
  control.type =
      oneOf<std::string>(random, {typeOf<pb::RunMissionCtrl>(), typeOf<pb::RunMissionCtrl>(),
                                  typeOf<pb::PauseMissionCtrl>(), typeOf<pb::ClearMissionCtrl>()});
  control.confirmed_by = typeOf<pb::MissionStatusTel>();
  control.shows = [](std::string_view) { return false; };
  if (control.type == typeOf<pb::RunMissionCtrl>() && session_->refusal().empty()) {
    promises_.missionRuns();
  }
  send(std::move(control), 2s);
}

void Mission::request(sim::Random& random, std::string type, std::string payload) {
  const std::chrono::milliseconds timeout = oneOf(random, {100ms, 1000ms, 3000ms});
  const auto call = promises_.call("a request", timeout, true);
  session_->request(
      now(), std::move(type), std::move(payload), timeout,
      [this, call](const session::BlueyeReply& reply) { promises_.answered(call, reply.received); },
      network_);
}

// As BlueyeDriver does it.
void Mission::unload(Duration pause) {
  leaving_ = true;
  promises_.leaving();
  session_->leave(now(), network_);
  session_->step(now(), network_);
  promises_.left();
  later(kLastWords, [this, pause] {
    network_.serve(nullptr);
    promises_.disconnected();
    promises_.watch(nullptr);
    session_.reset();
    leaving_ = false;
    later(pause, [this] { load(); });
  });
}

void Mission::load() {
  session_ = std::make_unique<BlueyeSession>(plan_.options, promises_);
  promises_.watch(session_.get());
  network_.serve(session_.get());
}

// --- Commands ---

void Mission::startStream(const Action& action, sim::Random& random) {
  Stream stream;
  stream.kind = random.chance(0.7) ? 0 : random.below(kHeld);
  stream.period = fromSeconds(1.0 / oneOf(random, {1.0, 5.0, 10.0, 30.0, 50.0, 200.0}));
  stream.next = elapsed_;
  stream.end =
      elapsed_ + (stream.period < 10ms ? std::min<Duration>(action.lasts, 4s) : action.lasts);
  stream.fixed = random.chance(0.3);
  stream.reach = random.chance(0.2) ? 1.02 : 1.0;
  stream.random = random;
  streams_.push_back(stream);
  // A program that commands takes control first.
  if (!session_->inControl() && random.chance(0.7)) take();
}

void Mission::streamDue() {
  for (Stream& stream : streams_) {
    while (stream.next <= elapsed_ && stream.next < stream.end) {
      sim::Random same = stream.random;
      sim::Random& random = stream.fixed ? same : stream.random;
      const double waited_s = random.chance(0.2) ? between(random, 0.0, 0.3) : 0.0;
      const Duration age = elapsed_ - stream.next + fromSeconds(waited_s);
      stream.next += stream.period;
      if (session_ && !leaving_) command(random, stream.kind, stream.reach, age);
    }
  }
  const auto ended = [](const Stream& one) { return one.next >= one.end; };
  streams_.erase(std::remove_if(streams_.begin(), streams_.end(), ended), streams_.end());
}

void Mission::command(sim::Random& random, std::size_t kind, double reach, Duration age) {
  const auto received = now().steady - age;
  if (kind == 0) return commandMotion(random, reach, received);
  const auto value = [&] {
    return random.chance(0.1) ? 0.0 : std::clamp(between(random, -reach, reach), -1.0, 1.0);
  };
  if (kind == 1) {
    const double velocity = value();
    return put(kind, vehicle::TiltCommand{velocity}, {toWire(velocity)}, received);
  }
  const double grip = value();
  const double rotate = value();
  put(kind, vehicle::GripperCommand{grip, rotate}, {toWire(grip), toWire(rotate)}, received);
}

// As from the topics; the wire is nautical: starboard, down and clockwise are positive.
void Mission::commandMotion(sim::Random& random, double reach, vehicle::SteadyTime received) {
  const bool rests = random.chance(0.1);
  const auto value = [&] { return rests ? 0.0 : between(random, -reach, reach); };
  const double yaw_sign = plan_.options.clockwise_yaw ? -1.0 : 1.0;
  using ros_layer::blueye_layer::toCommand;
  ros_layer::blueye_layer::ConvertedMotion converted;
  Wire wire{};
  if (random.chance(0.5)) {
    MotionInput in;
    for (auto* axis : {&in.x, &in.y, &in.z, &in.roll, &in.pitch, &in.yaw}) *axis = value();
    for (auto* gain : {&in.slow, &in.boost}) *gain = std::abs(value());
    if (reach > 1.0 && random.chance(0.05)) in.y = std::numeric_limits<double>::quiet_NaN();
    converted = toCommand(in);
    wire = {toWire(in.x),    toWire(-in.y),     toWire(-in.z),
            toWire(in.roll), toWire(-in.pitch), toWire(yaw_sign * in.yaw),
            toWire(in.slow), toWire(in.boost)};
  } else {
    geometry_msgs::Twist in;
    in.linear.x = 2.0 * value();
    in.linear.y = value();
    in.linear.z = value();
    in.angular.z = value();
    const ros_layer::blueye_layer::FullSpeed full{1.5, 0.5, 0.6, 0.8};
    converted = toCommand(in, full);
    const auto share = [](double speed, double most) {
      return toWire(std::max(-1.0, std::min(1.0, speed / most)));
    };
    wire = {share(in.linear.x, 1.5),
            share(-in.linear.y, 0.5),
            share(-in.linear.z, 0.6),
            0.0F,
            0.0F,
            share(yaw_sign * in.angular.z, 0.8)};
  }
  if (const auto* taken = std::get_if<vehicle::DroneCommand>(&converted)) {
    put(0, *taken, wire, received);
  }
}

void Mission::put(std::size_t kind, const vehicle::DroneCommand& command, const Wire& wire,
                  vehicle::SteadyTime received) {
  promises_.commanded(kind, wire, received, session_->command(now(), command, received));
}

// --- The network and this computer ---

void Mission::startNetwork(const Action& action, sim::Random& random) {
  const auto stall = [&](Network::Channel& channel) {
    channel.stalled_until = kBegin + elapsed_ + action.lasts;
  };
  switch (action.kind) {
    case Kind::Delay:
      network_.delay = fromSeconds(oneOf(random, {0.0, 0.02, 0.15, 0.7, 2.5}));
      return later(action.lasts, [this] { network_.delay = 1ms; });
    case Kind::Jitter:
      network_.jitter = fromSeconds(oneOf(random, {0.005, 0.05, 0.5}));
      return later(action.lasts, [this] { network_.jitter = 0ms; });
    case Kind::StalledTelemetry:
      return stall(network_.to_telemetry);
    case Kind::StalledReplies:
      return stall(network_.to_reply);
    case Kind::StalledControl:
      return stall(network_.to_control);
    case Kind::NoRoom:
      network_.takes = false;
      return later(action.lasts, [this] { network_.takes = true; });
    case Kind::LinkLost:
      return network_.lose("reset");
    case Kind::HalfOpen:
      network_.delivers = false;
      return later(action.lasts, [this] {
        if (!network_.delivers) network_.lose("reset");
        network_.delivers = true;
      });
    case Kind::Refusal:
      network_.listens = false;
      network_.lose("reset");
      return later(action.lasts, [this] { network_.listens = true; });
    default:
      held_up_until_ = std::max(held_up_until_, elapsed_ + action.lasts);
      promises_.heldUp(action.lasts);
  }
}

// --- The drone ---

void Mission::startDrone(const Action& action, sim::Random& random) {
  using sim::BlueyeFaults;
  switch (action.kind) {
    case Kind::RepliesLost:
      return faultFor(action, &BlueyeFaults::lose_replies, oneOf(random, {0.1, 0.5, 1.0}));
    case Kind::RepliesLate:
      network_.to_reply.slower_by = fromSeconds(oneOf(random, {0.05, 0.2, 0.4, 1.2, 2.5}));
      return later(action.lasts, [this] { network_.to_reply.slower_by = 0ms; });
    case Kind::TelemetryLost:
      return faultFor(action, &BlueyeFaults::lose_telemetry, oneOf(random, {0.2, 0.8}));
    case Kind::Silence:
      return faultFor(action, &BlueyeFaults::lose_telemetry, 1.0);
    case Kind::Reboot:
    default:
      drone_.faults().reboot_s = inSeconds(action.lasts);
      drone_.reboot();
      if (action.kind == Kind::RebootUnnoticed) return;
      if (random.chance(0.5)) return network_.lose("reset");
      return later(action.lasts, [this] { network_.lose("reset"); });
  }
}

void Mission::faultFor(const Action& action, double sim::BlueyeFaults::*fault, double value) {
  drone_.faults().*fault = value;
  later(action.lasts, [this, fault] { drone_.faults().*fault = 0.0; });
}

// --- Other clients of the drone ---

std::uint32_t Mission::connectOther(Duration pets_for, bool fights) {
  if (!drone_.online()) return 0;
  pb::ConnectClientReq request;
  request.mutable_client_info()->set_name("Blueye App");
  network_.askAsOther(request.GetTypeName(), request.SerializeAsString());
  pb::ConnectClientRep reply;
  reply.ParseFromString(network_.other_reply);
  if (tracing()) note("  another client is " + std::to_string(reply.client_id()));
  others_.push_back({reply.client_id(), elapsed_ + pets_for, elapsed_, fights});
  return reply.client_id();
}

void Mission::disconnectAsOther(std::uint32_t id) {
  if (!drone_.online() || id == 0) return;
  pb::DisconnectClientReq request;
  request.set_client_id(id);
  network_.askAsOther(request.GetTypeName(), request.SerializeAsString());
}

std::uint32_t Mission::inControl() { return clients().client_id_in_control(); }

pb::ConnectedClientsTel Mission::clients() {
  pb::GetTelemetryReq request;
  request.set_message_type("ConnectedClientsTel");
  network_.askAsOther(request.GetTypeName(), request.SerializeAsString());
  pb::GetTelemetryRep reply;
  reply.ParseFromString(network_.other_reply);
  pb::ConnectedClientsTel told;
  told.ParseFromString(reply.payload().value());
  return told;
}

void Mission::startOther(const Action& action, sim::Random& random) {
  if (drone_.faults().lose_replies > 0.0) return;
  const bool fights = action.kind == Kind::OtherFights;
  const bool vanishes = action.kind == Kind::OtherVanishes;
  if (vanishes && random.chance(0.5)) {  // anybody may send anybody away
    const pb::ConnectedClientsTel all = clients();
    for (const auto& one : all.connected_clients()) disconnectAsOther(one.client_id());
    return;
  }
  const std::uint32_t id = connectOther(vanishes ? fromSeconds(0.1) : action.lasts, fights);
  if (id == 0) return;
  if (action.kind != Kind::OtherWaits && inControl() != id) disconnectAsOther(inControl());
  if (vanishes) return;
  const bool polite = random.chance(0.7);
  later(action.lasts, [this, id, polite] {
    if (polite) disconnectAsOther(id);
  });
}

void Mission::othersDue() {
  for (Other& other : others_) {
    if (elapsed_ < other.next || elapsed_ > other.pets_until) continue;
    other.next = elapsed_ + (other.fights ? Duration{70ms} : Duration{500ms});
    pb::WatchdogCtrl watchdog;
    watchdog.set_client_id(other.id);
    drone_.control(watchdog.GetTypeName(), watchdog.SerializeAsString());
    if (!other.fights || !drone_.online() || drone_.faults().lose_replies > 0.0) continue;
    const std::uint32_t in_control = inControl();
    if (in_control != other.id) disconnectAsOther(in_control);
  }
  const auto gone = [this](const Other& one) { return elapsed_ > one.pets_until; };
  others_.erase(std::remove_if(others_.begin(), others_.end(), gone), others_.end());
}

// --- The end ---

void Mission::calm() {
  for (Later& one : laters_) one.at = std::min(one.at, elapsed_ + 1s);
  streams_.clear();
  for (Other& other : others_) other.pets_until = elapsed_;
  later(kQuiet - 10s, [this] {
    if (session_ && !leaving_) take();
  });
  later(kQuiet - 4s, [this] {
    if (session_ && !leaving_) put(0, vehicle::MotionCommand{0.5}, {0.5F}, now().steady);
  });
}

// After a quiet time the session knows what the drone knows, and has what was asked for.
void Mission::expectOrder() {
  const std::uint32_t in_control = inControl();
  if (!session_ || !session_->registered()) {
    return promises_.breakPromise("it is not registered after a quiet time");
  }
  if (!session_->inControl() || in_control != session_->id()) {
    return promises_.breakPromise("it took control in a quiet time; the drone has client " +
                                  std::to_string(in_control) + " in control, this one is " +
                                  std::to_string(session_->id()));
  }
  if (!promises_.allAnswered()) promises_.breakPromise("a call has no answer after a quiet time");
}

}  // namespace frontseat_driver::blueye_simulation
