#include "promises.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"

namespace frontseat_driver::blueye_simulation {

using namespace std::chrono_literals;
namespace pb = ::blueye::protocol;

namespace {

constexpr std::size_t kMostASecond = 31;   // thirty, and a zero that does not wait
constexpr int kZeros = 4;                  // at once and each second for three seconds
constexpr Duration kRegistersAgain = 22s;  // nine questions at the start may have no answer
constexpr Duration kLeastPeriod = 34ms;
constexpr Duration kUnderWay = 4s;  // the longest time-out of a request that went before
constexpr Duration kRetry = 20ms;   // what the link did not take

std::string_view withoutPackage(std::string_view type) { return type.substr(type.rfind('.') + 1); }

template <class Message>
Message parsed(std::string_view payload) {
  Message message;
  message.ParseFromArray(payload.data(), static_cast<int>(payload.size()));
  return message;
}

std::optional<std::pair<std::size_t, Wire>> heldOf(std::string_view name,
                                                   std::string_view payload) {
  if (name == "MotionInputCtrl") {
    const auto in = parsed<pb::MotionInputCtrl>(payload).motion_input();
    return {{0,
             {in.surge(), in.sway(), in.heave(), in.roll(), in.pitch(), in.yaw(), in.slow(),
              in.boost()}}};
  }
  if (name == "TiltVelocityCtrl") {
    return {{1, {parsed<pb::TiltVelocityCtrl>(payload).velocity().value()}}};
  }
  if (name == "GripperCtrl") {
    const auto in = parsed<pb::GripperCtrl>(payload).gripper_velocities();
    return {{2, {in.grip_velocity(), in.rotate_velocity()}}};
  }
  return std::nullopt;
}

/// Slow and boost move nothing by themselves.
bool isZero(const Wire& wire) {
  return std::all_of(wire.begin(), wire.begin() + 6, [](float value) { return value == 0.0F; });
}

bool inRange(const Wire& wire) {
  return std::all_of(wire.begin(), wire.end(), [](float value) { return std::abs(value) <= 1.0F; });
}

std::string text(const Wire& wire) {
  std::string all;
  for (const float value : wire) all += " " + std::to_string(value);
  return all;
}

constexpr const char* kNames[kHeld] = {"motion", "tilt", "gripper"};

}  // namespace

void Seen::add(const Seen& other) {
  controls += other.controls;
  motions += other.motions;
  zeros += other.zeros;
  watchdogs += other.watchdogs;
  taken += other.taken;
  refused += other.refused;
  calls += other.calls;
  succeeded += other.succeeded;
  gains += other.gains;
  losses += other.losses;
  requests += other.requests;
}

Promises::Promises(Clock clock, const session::BlueyeOptions& options)
    : clock_(std::move(clock)), options_(options), gate_open_(options.commands_enabled) {}

void Promises::watch(const Session* session) {
  session_ = session;
  gate_open_ = options_.commands_enabled;
  leaving_ = false;
  if (session == nullptr && !calls_.empty()) {
    breakPromise("no answer to " + calls_.begin()->second.what + " when the driver ended");
  }
  forget();
  in_control_ = false;
}

void Promises::breakPromise(const std::string& what) {
  if (!broken_.empty()) return;
  char at[40];
  std::snprintf(at, sizeof at, "at %.6f s: ", inSeconds(now().time_since_epoch() - kBegin));
  broken_ = at + what;
}

// --- Who is in control ---

bool Promises::mayCommand() const {
  return connected_ && id_ != 0 && newest_.in_control == id_ && newest_.names_us;
}

template <class Message>
void Promises::learn(std::uint64_t order, const Message& message) {
  if (order < newest_.order) return;
  const auto& clients = message.connected_clients();
  const auto lists = [&clients](std::uint32_t id) {
    return std::any_of(clients.begin(), clients.end(),
                       [id](const auto& client) { return client.client_id() == id; });
  };
  newest_ = {order, message.client_id_in_control(), lists(message.client_id_in_control())};
  if (lists(id_)) {
    unlisted_since_.reset();
  } else if (!unlisted_since_) {
    unlisted_since_ = now();
  }
}

void Promises::telemetry(const Word& word) {
  const std::string_view name = withoutPackage(word.type);
  if (name == "ConnectedClientsTel") {
    learn(word.order, parsed<pb::ConnectedClientsTel>(word.payload));
  }
  if (name == "MissionStatusTel") {
    const auto state = parsed<pb::MissionStatusTel>(word.payload).mission_status().state();
    if (state == pb::MISSION_STATE_PAUSED || state == pb::MISSION_STATE_INACTIVE) {
      pause_ends_.reset();
    }
  }
}

void Promises::reply(const Word& word) {
  learnFromReply(word);
  under_way_.clear();
}

void Promises::learnFromReply(const Word& word) {
  if (under_way_ == "ConnectClientReq") {
    const auto rep = parsed<pb::ConnectClientRep>(word.payload);
    id_ = rep.client_id();
    return learn(word.order, rep);
  }
  if (under_way_ == "DisconnectClientReq") {
    return learn(word.order, parsed<pb::DisconnectClientRep>(word.payload));
  }
  if (under_way_ != "GetTelemetryReq") return;
  const auto told = parsed<pb::GetTelemetryRep>(word.payload).payload();
  telemetry({word.order, told.type_url(), told.value()});
}

void Promises::noReply() {
  if (under_way_ == "ConnectClientReq") id_ = 0;
  under_way_.clear();
}

void Promises::connected() {
  connected_ = true;
  forget();
}

void Promises::disconnected() {
  connected_ = false;
  id_ = 0;
  newest_.in_control = 0;
  under_way_.clear();
  releasing_ = wanted_ = false;
  unlisted_since_.reset();
  forget();
  if (!calls_.empty()) {
    breakPromise("no answer to " + calls_.begin()->second.what + " when the link was lost");
  }
}

void Promises::forget() {
  for (Held& held : held_) {
    const auto sent = std::move(held.sent);
    held = {};
    held.sent = sent;
  }
  pause_ends_.reset();
  watchdog_by_ = Time::max();
}

// What the session believes may be less than what it could know, never more.
void Promises::followControl() {
  const bool has_control = session_ != nullptr && session_->inControl();
  if (has_control && !mayCommand()) {
    breakPromise("it believes to be in control; the drone said last that client " +
                 std::to_string(newest_.in_control) + " is");
  }
  if (has_control && !in_control_) {
    ++seen_.gains;
    permitted_since_ = now();
    if (!leaving_) {
      watchdog_by_ = now();
      endAll(true);
    }
  }
  if (!has_control && in_control_) {
    ++seen_.losses;
    forget();
  }
  in_control_ = has_control;
}

// --- What the user does ---

void Promises::commanded(std::size_t kind, const Wire& wire, Time received,
                         const std::string& refusal) {
  if (!refusal.empty()) {
    ++seen_.refused;
    return;
  }
  ++seen_.taken;
  if (!mayCommand()) breakPromise("a command was taken without control");
  if (!gate_open_) breakPromise("a command was taken while the gate is closed");
  if (releasing_ || leaving_) breakPromise("a command was taken while control is given back");
  if (received < permitted_since_) breakPromise("a command was taken from before a stop");
  if (now() - received >= options_.command_timeout) breakPromise("a stale command was taken");
  if (!inRange(wire)) breakPromise("a command out of range was taken:" + text(wire));
  Held& held = held_[kind];
  held.wire = wire;
  held.received = received;
  held.since = now();
  held.zeros = 0;
}

void Promises::end(Held& held) {
  held.wire.reset();
  const bool has_just_rested = held.last && held.last_was_zero && now() - *held.last < 67ms;
  held.zeros = has_just_rested ? kZeros - 1 : kZeros;
  held.zero_by = has_just_rested ? now() + 1s : now();
}

void Promises::endAll(bool also_what_rests) {
  for (Held& held : held_) {
    if (also_what_rests || held.wire) end(held);
  }
}

void Promises::stopping() {
  permitted_since_ = now();
  if (!in_control_) return forget();
  endAll(true);
  pause_by_ = now();
  pause_ends_ = now() + 5s;
}

void Promises::stopped(const Session::Answer& answer) {
  if (answer.success && !in_control_) breakPromise("a stop without control is called a success");
  const bool paused = pause_ends_ && paused_at_ == now();
  if (answer.success && !paused) breakPromise("a stop did not pause the mission");
}

void Promises::gate(bool open) {
  if (open && !gate_open_) permitted_since_ = now();
  gate_open_ = open;
  if (!open) endAll(false);
}

void Promises::leaving() {
  leaving_ = true;
  watchdog_by_ = Time::max();
  pause_ends_.reset();
  if (in_control_) endAll(true);
}

void Promises::left() {
  if (!calls_.empty()) {
    breakPromise("no answer to " + calls_.begin()->second.what + " when the driver stopped");
  }
}

// --- What the session sends ---

void Promises::control(std::string_view type, std::string_view payload) {
  ++seen_.controls;
  const std::string_view name = withoutPackage(type);
  if (!mayCommand()) {
    breakPromise(std::string{name} + " was sent without control; client " +
                 std::to_string(newest_.in_control) + " has it, this one is " +
                 std::to_string(id_));
  }
  if (const auto held = heldOf(name, payload)) return sentHeld(held->first, held->second);
  if (name == "WatchdogCtrl") return sentWatchdog(payload);
  if (name != "PauseMissionCtrl") return;
  paused_at_ = now();
  pause_by_ = now() + 500ms;
}

void Promises::sentWatchdog(std::string_view payload) {
  ++seen_.watchdogs;
  const auto id = parsed<pb::WatchdogCtrl>(payload).client_id();
  if (id != id_) breakPromise("a watchdog was sent for client " + std::to_string(id));
  if (leaving_) breakPromise("a watchdog was sent after goodbye");
  watchdog_by_ = now() + 500ms;
}

void Promises::sentHeld(std::size_t kind, const Wire& wire) {
  Held& held = held_[kind];
  const std::string what = std::string{kNames[kind]} + text(wire);
  const bool fresh = held.wire && now() - held.received < options_.command_timeout;
  const Wire wanted = fresh ? *held.wire : Wire{};
  if (wire != wanted) breakPromise(what + " was sent; the newest command is" + text(wanted));
  if (!inRange(wire)) breakPromise(what + " is out of range");
  ++(isZero(wire) ? seen_.zeros : seen_.motions);
  while (!held.sent.empty() && now() - held.sent.front() >= 1s) held.sent.pop_front();
  if (held.last) held.sent.push_back(now());  // the zero of gaining control waits for nothing
  if (held.sent.size() > kMostASecond) {
    breakPromise(what + " is number " + std::to_string(held.sent.size()) + " in a second");
  }
  held.last = now();
  held.last_was_zero = isZero(wire);
  if (held.zeros == 0 || !held.last_was_zero) return;
  --held.zeros;
  held.zero_by = now() + 1s;
}

void Promises::request(std::string_view type, std::chrono::milliseconds timeout) {
  ++seen_.requests;
  under_way_ = withoutPackage(type);
  carried_ += timeout;
}

void Promises::event(const vehicle::Now&, const vehicle::Event& event) {
  const auto* told = std::get_if<vehicle::Control>(&event);
  if (told == nullptr || session_ == nullptr) return;
  followControl();
  const bool releasing = told->reason == "control is being given back";
  if (releasing && !releasing_) endAll(true);
  releasing_ = releasing;
  if (told->reason.empty() && !mayCommand()) {
    breakPromise("it is said that commands are taken, without control");
  }
}

// --- What is owed ---

/// When something is owed that was due when the link took nothing a while ago.
Promises::Time Promises::excuse(Time due, Duration again) const {
  return std::max(due, refused_at_ + again);
}

void Promises::check() {
  if (session_ == nullptr) return;
  followControl();
  if (in_control_ && options_.observer && !wanted_ && !releasing_ && !leaving_) {
    breakPromise("control came that nobody asked for, or after the answer that it did not");
  }
  for (std::size_t kind = 0; kind < kHeld; ++kind) checkHeld(kind);
  if (now() > excuse(watchdog_by_, kRetry)) breakPromise("no watchdog for half a second");
  checkPause();
  checkRegistration();
  checkCalls();
}

// Unless it waits for replies that do not come.
void Promises::checkRegistration() {
  if (!session_->registered() || !calls_.empty() || leaving_) unlisted_since_.reset();
  if (!unlisted_since_ || now() - *unlisted_since_ < kRegistersAgain) return;
  breakPromise("the drone does not list this client any more, and it does not register again");
}

void Promises::checkHeld(std::size_t kind) {
  Held& held = held_[kind];
  if (!in_control_) return;
  if (held.wire && now() - held.received >= options_.command_timeout) {
    const bool sent = held.last == now() && held.last_was_zero;
    end(held);
    held.zeros = sent ? kZeros - 1 : held.zeros;
    held.zero_by = sent ? now() + 1s : held.zero_by;
  }
  const bool first = held.zeros == kZeros;
  if (held.zeros > 0 && now() >= held.zero_by && held.last != now() &&
      now() >= excuse(held.zero_by, first ? kRetry : Duration{1s})) {
    breakPromise(std::string{"no zero "} + kNames[kind] + " in time, " +
                 std::to_string(held.zeros) + " owed");
  }
  if (!held.wire) return;
  const Duration period = fromSeconds(1.0 / options_.command_rate_hz);
  const Time heard = std::max(held.since, held.last.value_or(held.since));
  const Time due = heard + std::max(period, 2 * kLeastPeriod);
  if (now() > excuse(due, kRetry)) {
    breakPromise(std::string{"the newest "} + kNames[kind] + " is not repeated");
  }
  const bool comes_to_rest = isZero(*held.wire) && held.last && !held.last_was_zero;
  if (comes_to_rest && now() > excuse(held.since, kRetry)) {
    breakPromise(std::string{"a "} + kNames[kind] + " of zero has to wait");
  }
}

void Promises::checkPause() {
  if (!pause_ends_ || !in_control_) return;
  if (now() >= *pause_ends_) return pause_ends_.reset();
  if (now() > excuse(pause_by_, kRetry)) breakPromise("the pause of a stop is not repeated");
}

std::uint64_t Promises::call(std::string_view what, Duration limit, bool queues) {
  ++seen_.calls;
  if (what == kTakeControl) wanted_ = true;
  calls_[++last_call_] = {std::string{what}, now(), limit, queues, carried_};
  return last_call_;
}

void Promises::answered(std::uint64_t call, bool success) {
  const auto found = calls_.find(call);
  if (found == calls_.end()) return breakPromise("a call was answered twice");
  const std::string what = found->second.what;
  calls_.erase(found);
  if (success) ++seen_.succeeded;
  if (what == kReleaseControl && success) wanted_ = false;
  if (what != kTakeControl) return;
  if (success && !mayCommand()) breakPromise("take_control succeeded without control");
  wanted_ = success || std::any_of(calls_.begin(), calls_.end(), [](const auto& other) {
              return other.second.what == kTakeControl;
            });
}

// A call waits for what was asked before it, and the drone has its time limit for each.
void Promises::checkCalls() {
  for (const auto& [number, call] : calls_) {
    const Duration queued = call.queues ? carried_ - call.carried + kUnderWay : Duration{0};
    if (now() - call.asked > call.limit + queued) {
      breakPromise("no answer to " + call.what + " for " +
                   std::to_string(inSeconds(now() - call.asked)) + " s");
    }
  }
}

}  // namespace frontseat_driver::blueye_simulation
