#include "frontseat_driver/session/blueye_controls.h"

#include <algorithm>
#include <utility>

#include "blueye/control.pb.h"

namespace frontseat_driver::session {

namespace {

using namespace std::chrono_literals;
using vehicle::DroneCommand;

constexpr int kZeros = 4;  // at once and each second for three seconds
constexpr auto kZeroPeriod = 1s;
constexpr auto kRepeatPeriod = 500ms;
constexpr auto kRetry = 20ms;           // what the link did not take
constexpr auto kLeastPeriod = 33334us;  // 30 of them are a second

template <class Message>
bool publish(const vehicle::Now& now, const Message& message, BlueyeOutput& out) {
  return out.publish(now, message.GetTypeName(), message.SerializeAsString());
}

// All fields in every message: the drone takes each message whole.
blueye::protocol::MotionInputCtrl toMessage(const vehicle::MotionCommand& motion,
                                            bool clockwise_yaw) {
  blueye::protocol::MotionInputCtrl message;
  auto& input = *message.mutable_motion_input();
  input.set_surge(static_cast<float>(motion.surge));
  input.set_sway(static_cast<float>(motion.sway));
  input.set_heave(static_cast<float>(motion.heave));
  input.set_roll(static_cast<float>(motion.roll));
  input.set_pitch(static_cast<float>(motion.pitch));
  input.set_yaw(static_cast<float>(clockwise_yaw ? motion.yaw : 0.0 - motion.yaw));
  input.set_slow(static_cast<float>(motion.slow));
  input.set_boost(static_cast<float>(motion.boost));
  return message;
}

bool isZero(const DroneCommand& command) {
  if (const auto* motion = std::get_if<vehicle::MotionCommand>(&command)) {
    return motion->surge == 0.0 && motion->sway == 0.0 && motion->heave == 0.0 &&
           motion->roll == 0.0 && motion->pitch == 0.0 && motion->yaw == 0.0;
  }
  if (const auto* tilt = std::get_if<vehicle::TiltCommand>(&command)) return tilt->velocity == 0.0;
  const auto& gripper = std::get<vehicle::GripperCommand>(command);
  return gripper.grip == 0.0 && gripper.rotate == 0.0;
}

DroneCommand zeroOf(std::size_t kind) {
  if (kind == 0) return vehicle::MotionCommand{};
  if (kind == 1) return vehicle::TiltCommand{};
  return vehicle::GripperCommand{};
}

}  // namespace

HeldControls::HeldControls(std::chrono::nanoseconds timeout, std::chrono::nanoseconds period,
                           bool clockwise_yaw)
    : held_{Held{{timeout, period}}, Held{{timeout, period}}, Held{{timeout, period}}},
      clockwise_yaw_(clockwise_yaw) {}

void HeldControls::put(const DroneCommand& command, SteadyTime received) {
  Held& held = held_[command.index()];
  held.slot.put(command, received);
  const bool comes_to_rest = isZero(command) && !held.resting;
  if (!comes_to_rest) held.slot.putOff(std::max(received, held.next));
  held.zeros = 0;
}

void HeldControls::end(Held& held, SteadyTime now) {
  // A zero that has only just gone out is the first one.
  const bool done = held.resting && now < held.next;
  held.slot.clear();
  held.zeros = done ? kZeros - 1 : kZeros;
  held.zero_due = done ? now + kZeroPeriod : now;
}

void HeldControls::end(SteadyTime now, bool all) {
  for (Held& held : held_) {
    if (all || held.slot.occupied()) end(held, now);
  }
}

void HeldControls::forget() {
  for (Held& held : held_) {
    held.slot.clear();
    held.zeros = 0;
    held.resting = false;  // whoever is in control next may move it
  }
}

void HeldControls::step(const vehicle::Now& now, BlueyeOutput& out) {
  for (std::size_t kind = 0; kind < held_.size(); ++kind) step(now, kind, out);
}

// What was not taken counts as not sent.
void HeldControls::step(const vehicle::Now& now, std::size_t kind, BlueyeOutput& out) {
  Held& held = held_[kind];
  const auto send_one = [&](const DroneCommand& command) {
    if (!send(now, command, out)) return false;
    held.resting = isZero(command);
    held.next = std::max(held.next, now.steady) + kLeastPeriod;
    return true;
  };
  if (held.slot.stale(now.steady)) end(held, now.steady);
  if (held.zeros > 0 && now.steady >= held.zero_due) {
    if (send_one(zeroOf(kind))) --held.zeros;
    held.zero_due = now.steady + (held.zeros == kZeros ? kRetry : kZeroPeriod);
  }
  const DroneCommand* due = held.slot.due(now.steady);
  if (due == nullptr) return;
  if (send_one(*due)) {
    held.slot.sent(now.steady);
    held.slot.putOff(std::max(held.slot.nextDue(), held.next));
  } else {
    held.slot.putOff(now.steady + kRetry);
  }
}

bool HeldControls::send(const vehicle::Now& now, const DroneCommand& command,
                        BlueyeOutput& out) const {
  if (const auto* motion = std::get_if<vehicle::MotionCommand>(&command)) {
    return publish(now, toMessage(*motion, clockwise_yaw_), out);
  }
  if (const auto* tilt = std::get_if<vehicle::TiltCommand>(&command)) {
    blueye::protocol::TiltVelocityCtrl message;
    message.mutable_velocity()->set_value(static_cast<float>(tilt->velocity));
    return publish(now, message, out);
  }
  const auto& gripper = std::get<vehicle::GripperCommand>(command);
  blueye::protocol::GripperCtrl message;
  message.mutable_gripper_velocities()->set_grip_velocity(static_cast<float>(gripper.grip));
  message.mutable_gripper_velocities()->set_rotate_velocity(static_cast<float>(gripper.rotate));
  return publish(now, message, out);
}

vehicle::SteadyTime HeldControls::nextStep() const {
  SteadyTime next = SteadyTime::max();
  for (const Held& held : held_) {
    next = std::min({next, held.slot.nextDue(), held.slot.staleAt()});
    if (held.zeros > 0) next = std::min(next, held.zero_due);
  }
  return next;
}

bool HeldControls::commanding() const {
  return std::any_of(held_.begin(), held_.end(),
                     [](const Held& held) { return held.slot.occupied(); });
}

bool HeldControls::zerosDue() const {
  return std::any_of(held_.begin(), held_.end(),
                     [](const Held& held) { return held.zeros == kZeros; });
}

bool ConfirmedControls::add(const vehicle::Now& now, Control control, BlueyeOutput& out) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const bool same = it->control.type == control.type && it->control.stops == control.stops;
    if (same && it->control.respond) it->control.respond("a newer one took its place");
    it = same ? waiting_.erase(it) : std::next(it);
  }
  const bool sent = control.type.empty() || out.publish(now, control.type, control.payload);
  if (!control.confirmed_by.empty()) {
    const SteadyTime again = sent ? now.steady + kRepeatPeriod : now.steady;
    waiting_.push_back({std::move(control), now.steady, again});
    waiting_.back().deadline += waiting_.back().control.timeout;
  } else if (control.respond) {
    control.respond(sent ? "" : "the link did not take it");
  }
  return sent;
}

void ConfirmedControls::telemetry(std::string_view type, std::string_view payload) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const bool shown = it->control.confirmed_by == type && it->control.shows(payload);
    if (shown && it->control.respond) it->control.respond("");
    it = shown ? waiting_.erase(it) : std::next(it);
  }
}

void ConfirmedControls::step(const vehicle::Now& now, BlueyeOutput& out) {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const bool late = now.steady >= it->deadline;
    if (late && it->control.respond) {
      it->control.respond(it->control.type.empty()
                              ? "the drone's telemetry did not show it in time"
                              : "sent, but the drone's telemetry did not show it in time");
    }
    if (!late && it->control.repeat && now.steady >= it->again) {
      const bool sent = out.publish(now, it->control.type, it->control.payload);
      it->again = now.steady + (sent ? kRepeatPeriod : kRetry);
    }
    it = late ? waiting_.erase(it) : std::next(it);
  }
}

vehicle::SteadyTime ConfirmedControls::nextStep() const {
  SteadyTime next = SteadyTime::max();
  for (const Waiting& waiting : waiting_) {
    next = std::min(next, waiting.deadline);
    if (waiting.control.repeat) next = std::min(next, waiting.again);
  }
  return next;
}

// In turn, so that each is asked for.
std::string ConfirmedControls::awaited() {
  waiting_.splice(waiting_.end(), waiting_, waiting_.begin());
  return waiting_.back().control.confirmed_by;
}

void ConfirmedControls::failAll(const std::string& reason, bool stops_too) {
  std::list<Waiting> failed;
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const auto next = std::next(it);
    if (stops_too || !it->control.stops) failed.splice(failed.end(), waiting_, it);
    it = next;
  }
  for (const Waiting& one : failed) {
    if (one.control.respond) one.control.respond(reason);
  }
}

void ConfirmedControls::drop(const std::string& type) {
  waiting_.remove_if(
      [&type](const Waiting& one) { return one.control.stops && one.control.type == type; });
}

void StreamedControls::put(SteadyTime now, Control control, const Send& send) {
  Stream& stream = streams_[control.stream];
  if (now < stream.next) {
    if (control.respond) std::exchange(control.respond, nullptr)("");
    stream.newest = std::move(control);
    return;
  }
  stream = {now + kLeastPeriod, std::nullopt};
  send(std::move(control));
}

void StreamedControls::step(SteadyTime now, const Send& send) {
  for (auto& [name, stream] : streams_) {
    if (!stream.newest || now < stream.next) continue;
    stream.next = now + kLeastPeriod;
    send(*std::exchange(stream.newest, std::nullopt));
  }
}

vehicle::SteadyTime StreamedControls::nextStep() const {
  SteadyTime next = SteadyTime::max();
  for (const auto& [name, stream] : streams_) {
    if (stream.newest) next = std::min(next, stream.next);
  }
  return next;
}

void StreamedControls::forget() {
  for (auto& [name, stream] : streams_) stream.newest.reset();
}

}  // namespace frontseat_driver::session
