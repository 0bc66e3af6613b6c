#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "blueye.h"
#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"
#include "blueye_commands.h"
#include "frontseat_driver/session/blueye_session.h"

// A whole conversation with a drone: the bytes are a script of what drone, link, clock and user do.

namespace frontseat_driver::fuzz {
namespace {

using namespace std::chrono_literals;
namespace pb = blueye::protocol;
using session::BlueyeOptions;
using session::BlueyeReply;
using vehicle::Now;
using vehicle::SteadyTime;

constexpr int kMostStepsAtOnce = 1000;

std::string nameOf(const char* type) { return std::string{"blueye.protocol."} + type; }

class Conversation : private session::BlueyeOutput, private session::BlueyeListener {
 public:
  explicit Conversation(Dice& dice)
      : dice_(dice), options_(anyBlueyeOptions(dice)), session_(options_, *this) {}

  void run() {
    step();
    while (!dice_.empty()) {
      act();
      if (std::exchange(reconnect_, false)) disconnect();
      step();
    }
    takes_ = true;
    pass(10s);
    promise(!session_.inControl() || !connected_ || !moves(), "it moves on without a command");
    disconnect();
    pass(1s);
    promise(answered_ == asked_, "somebody was not answered");
  }

 private:
  void act() {
    switch (dice_.byte() % 24) {
      case 0:
      case 1:
        return connect();
      case 2:
        return disconnect();
      case 3:
      case 4:
        return pass(std::chrono::milliseconds{dice_.value<std::uint16_t>() % 8192});
      case 5:
      case 6:
        return command();
      case 7:
        forgetCommands();
        session_.stop(now(), *this);
        return;
      case 8:
        forgetCommands();
        session_.abort(now(), *this);
        return;
      case 9:
        return session_.setCommandsEnabled(now(), dice_.flag());
      case 10:
      case 11:
        return session_.takeControl(now(), answer(), *this);
      case 12:
        return session_.releaseControl(now(), answer(), *this);
      case 13:
        return control();
      case 14:
        return request();
      case 15:
        return session_.setRate(now(), std::string{dice_.line()}, dice_.value<float>(), answer(),
                                *this);
      case 16:
        takes_ = dice_.flag();
        return;
      case 17:
        if (dice_.byte() % 4 == 0) leave();
        return;
      case 18:
        return hear(anyFrames(dice_));
      case 19:
        return hear("ConnectedClientsTel", clients<pb::ConnectedClientsTel>());
      case 20:
        return hear("MissionStatusTel", missionStatus());
      case 21:
        return reply(anyFrames(dice_));
      default:
        return replyInKind();
    }
  }

  // --- Link and clock ---

  void connect() {
    if (std::exchange(connected_, true)) return;
    session_.connected(now(), *this);
  }

  void disconnect() {
    if (!std::exchange(connected_, false)) return;
    under_way_.reset();
    forgetCommands();
    session_.disconnected(now(), *this);
  }

  void leave() {
    left_ = true;
    forgetCommands();
    session_.leave(now(), *this);
  }

  SteadyTime nextEvent() const {
    const SteadyTime step = session_.nextStep();
    return under_way_ ? std::min(step, under_way_->second) : step;
  }

  void pass(std::chrono::nanoseconds duration) {
    const SteadyTime end = steady_ + duration;
    for (int at_once = 0; nextEvent() <= end;) {
      at_once = nextEvent() > steady_ ? 0 : at_once + 1;
      promise(at_once < kMostStepsAtOnce, "steps are asked for without end");
      steady_ = std::max(steady_, nextEvent());
      noReplyInTime();
      step();
    }
    steady_ = end;
  }

  void noReplyInTime() {
    if (!under_way_ || steady_ < under_way_->second) return;
    under_way_.reset();
    session_.noReply(now(), "no reply", *this);
  }

  void step() { session_.step(now(), *this); }
  Now now() const { return nowAt(steady_); }

  // --- The drone ---

  void hear(const Frames& frames) {
    if (connected_) session_.telemetry(now(), frames.type, frames.payload, *this);
  }
  void hear(const char* type, const std::string& bytes) { hear(Frames{nameOf(type), bytes}); }

  void reply(const Frames& frames) {
    if (!std::exchange(under_way_, std::nullopt)) return;
    session_.reply(now(), frames.type, frames.payload, *this);
  }
  template <class Message>
  void reply(const Message& message) {
    const std::string bytes = message.SerializeAsString();
    reply(Frames{message.GetTypeName(), bytes});
  }

  /// Clients 1 to 3, as bits, and who is in control.
  template <class Message>
  std::string clients(Message message = {}) {
    const unsigned listed = dice_.byte();
    message.set_client_id_in_control(dice_.byte() % 4);
    for (std::uint32_t id = 1; id <= 3; ++id) {
      if ((listed & (1U << id)) == 0) continue;
      auto& client = *message.add_connected_clients();
      client.set_client_id(id);
      client.mutable_client_info()->set_name("somebody");
    }
    return message.SerializeAsString();
  }

  std::string missionStatus() {
    pb::MissionStatusTel message;
    message.mutable_mission_status()->set_state(static_cast<pb::MissionState>(dice_.byte() % 10));
    return message.SerializeAsString();
  }

  void replyInKind() {
    if (!under_way_) return;
    const std::string type = under_way_->first;
    if (type == nameOf("ConnectClientReq")) {
      pb::ConnectClientRep message;
      message.set_client_id(dice_.byte() % 4);
      const std::string bytes = clients(message);
      return reply(Frames{message.GetTypeName(), bytes});
    }
    if (type == nameOf("DisconnectClientReq")) {
      const std::string bytes = clients<pb::DisconnectClientRep>();
      return reply(Frames{nameOf("DisconnectClientRep"), bytes});
    }
    if (type == nameOf("SetPubFrequencyReq")) {
      pb::SetPubFrequencyRep message;
      message.set_success(dice_.flag());
      return reply(message);
    }
    if (type == nameOf("GetTelemetryReq")) return replyWithTelemetry();
    reply(Frames{"google.protobuf.Empty", {}});
  }

  void replyWithTelemetry() {
    pb::GetTelemetryRep message;
    Frames told;
    std::string bytes;
    switch (dice_.byte() % 4) {
      case 0:
        return reply(message);
      case 1:
        told.type = nameOf("ConnectedClientsTel");
        bytes = clients<pb::ConnectedClientsTel>();
        break;
      case 2:
        told.type = nameOf("MissionStatusTel");
        bytes = missionStatus();
        break;
      default:
        told = anyFrames(dice_);
        bytes = std::string{told.payload};
    }
    message.mutable_payload()->set_type_url("type.googleapis.com/" + told.type);
    message.mutable_payload()->set_value(bytes);
    reply(message);
  }

  // --- The user ---

  void command() {
    const vehicle::DroneCommand command = anyDroneCommand(dice_);
    const SteadyTime received = steady_ - std::chrono::milliseconds{dice_.byte() % 64};
    const bool fresh = received + options_.command_timeout > steady_ && received >= stopped_at_;
    const std::string refusal = session_.command(now(), command, received);
    if (!refusal.empty()) return;
    promise(connected_ && !left_ && session_.inControl() && session_.commandsEnabled(),
            "a command was taken without permission");
    promise(fresh, "a command was taken that is stale or from before a stop");
    newest_[command.index()] = {toWire(command, options_.clockwise_yaw), received};
  }

  void forgetCommands() {
    newest_ = {};
    stopped_at_ = steady_;
  }

  void control() {
    const Frames frames = anyFrames(dice_);
    session::ConfirmedControls::Control wanted;
    wanted.type = frames.type;
    wanted.payload = std::string{frames.payload};
    const unsigned how = dice_.byte();
    wanted.repeat = (how & 1U) != 0;
    if ((how & 2U) != 0) {
      wanted.confirmed_by = nameOf("MissionStatusTel");
      wanted.shows = [how](std::string_view payload) { return payload.size() % 4 == how / 64; };
    }
    wanted.respond = refusalAnswer();
    session_.control(now(), std::move(wanted), *this);
  }

  // As mission/load: what the drone shows after the reply is waited for.
  void request() {
    const Frames frames = anyFrames(dice_);
    const auto answer_once = once();
    session_.request(
        now(), frames.type, std::string{frames.payload}, 1ms * (1 + dice_.byte() * 16),
        [this, answer_once](const BlueyeReply& reply) {
          answer_once();
          promise(reply.received || !reply.reason.empty(), "no reply, and no reason");
          if (!reply.received || reply.payload.empty()) return;
          session_.await(
              now(), nameOf("MissionStatusTel"), [](std::string_view) { return true; },
              refusalAnswer(), *this);
        },
        *this);
  }

  std::function<void()> once() {
    const std::size_t number = asked_++;
    answers_.push_back(0);
    return [this, number] {
      promise(++answers_[number] == 1, "somebody was answered twice");
      ++answered_;
    };
  }

  session::BlueyeSession::Respond answer() {
    return [answered = once()](const session::BlueyeSession::Answer& given) {
      answered();
      promise(given.success || !given.message.empty(), "a refusal without a reason");
    };
  }

  session::ConfirmedControls::Respond refusalAnswer() {
    return [answered = once()](const std::string&) { answered(); };
  }

  // --- session::BlueyeOutput ---

  bool publish(const Now&, std::string_view type, std::string_view payload) override {
    promise(connected_ && !options_.listen_only, "something was sent where nothing may be");
    promise(session_.inControl(), "a control message without control: " + std::string{type});
    if (!takes_) return false;
    if (type == nameOf("MotionInputCtrl")) checkMotion(payload);
    if (type == nameOf("TiltVelocityCtrl")) {
      const auto message = read<pb::TiltVelocityCtrl>(payload);
      checkHeld(1, {{message.velocity().value()}, 1});
    }
    if (type == nameOf("GripperCtrl")) {
      const auto message = read<pb::GripperCtrl>(payload);
      const auto& speeds = message.gripper_velocities();
      checkHeld(2, {{speeds.grip_velocity(), speeds.rotate_velocity()}, 2});
    }
    if (type == nameOf("WatchdogCtrl")) {
      promise(read<pb::WatchdogCtrl>(payload).client_id() == session_.id(),
              "the watchdog of another");
    }
    return true;
  }

  template <class Message>
  static Message read(std::string_view payload) {
    Message message;
    promise(message.ParseFromArray(payload.data(), static_cast<int>(payload.size())),
            "what was sent is no message");
    return message;
  }

  void checkMotion(std::string_view payload) {
    const auto message = read<pb::MotionInputCtrl>(payload);
    const pb::MotionInput& in = message.motion_input();
    checkHeld(0, {{in.surge(), in.sway(), in.heave(), in.roll(), in.pitch(), in.yaw(), in.slow(),
                   in.boost()},
                  6});
  }

  void checkHeld(std::size_t kind, const Said& said) {
    moving_[kind] = !said.rests();
    if (said.rests()) return;
    const auto& newest = newest_[kind];
    promise(newest && said.values == newest->first.values, "not the newest command");
    promise(steady_ - newest->second < options_.command_timeout, "a stale command");
    promise(!left_, "a command after leaving");
  }

  bool moves() const {
    return std::any_of(moving_.begin(), moving_.end(), [](bool moving) { return moving; });
  }

  bool request(const Now&, std::string_view type, std::string_view,
               std::chrono::milliseconds timeout) override {
    promise(connected_ && !options_.listen_only, "something was asked where nothing may be");
    if (under_way_ || !takes_) return false;
    under_way_ = {std::string{type}, steady_ + timeout};
    return true;
  }

  void reconnect(const Now&, const std::string&) override {
    promise(!options_.listen_only, "a record was connected to");
    reconnect_ = true;
  }

  // --- session::BlueyeListener ---

  void telemetry(const Now&, std::string_view, std::string_view) override {}
  void event(const Now&, const vehicle::Event& event) override {
    const auto* control = std::get_if<vehicle::Control>(&event);
    if (control == nullptr) return;
    if (!control->reason.empty()) forgetCommands();
    if (control->grant != vehicle::Grant::Granted) moving_ = {};  // somebody else's from now on
  }
  void clients(const Now&) override {}
  void note(const std::string& text) override { promise(!text.empty(), "a note of nothing"); }

  Dice& dice_;
  const BlueyeOptions options_;
  session::BlueyeSession session_;
  SteadyTime steady_{1h};
  SteadyTime stopped_at_{};
  bool connected_ = false, takes_ = true, left_ = false, reconnect_ = false;
  std::optional<std::pair<std::string, SteadyTime>> under_way_;
  std::array<std::optional<std::pair<Said, SteadyTime>>, 3> newest_;
  std::array<bool, 3> moving_{};
  std::vector<int> answers_;
  std::size_t asked_ = 0, answered_ = 0;
};

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  Conversation{dice}.run();
}

}  // namespace frontseat_driver::fuzz
