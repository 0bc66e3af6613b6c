#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"
#include "frontseat_driver/session/blueye_session.h"

namespace frontseat_driver::session {

namespace pb = blueye::protocol;
using namespace std::chrono_literals;

/// The drone's side in virtual time: a client registry, answers at once or never, and a record of
/// everything it is sent. It does what the document says and no more.
class ScriptedDrone : public BlueyeOutput, public BlueyeListener {
 public:
  struct Sent {
    vehicle::SteadyTime at;
    std::string type;  ///< without package
    std::string payload;
  };

  explicit ScriptedDrone(BlueyeOptions options = {}) : session(std::move(options), *this) {
    now.steady += 1h;
    now.utc = now.stamp = 1'700'000'000s;
  }

  // What the session sends.

  bool publish(const vehicle::Now& at, std::string_view type, std::string_view payload) override {
    offers[shortName(type)].push_back(at.steady);
    if (!link_takes) return false;
    controls.push_back({at.steady, shortName(type), std::string{payload}});
    return true;
  }

  bool request(const vehicle::Now& at, std::string_view type, std::string_view payload,
               std::chrono::milliseconds timeout) override {
    offers[shortName(type)].push_back(at.steady);
    if (under_way_ || !takes_requests) return false;
    requests.push_back({at.steady, shortName(type), std::string{payload}});
    under_way_ = Waiting{requests.back(), at.steady + timeout};
    return true;
  }

  void reconnect(const vehicle::Now&, const std::string& why) override {
    reconnects.push_back(why);
  }

  // What the session tells.

  void telemetry(const vehicle::Now&, std::string_view type, std::string_view payload) override {
    heard.push_back(shortName(type));
    heard_bytes = std::string{payload};
  }
  void event(const vehicle::Now&, const vehicle::Event& event) override {
    if (const auto* changed = std::get_if<vehicle::Control>(&event)) {
      control = *changed;
      ++control_reports;
      reason = std::string{changed->reason};
    }
    if (const auto* changed = std::get_if<vehicle::MissionStatus>(&event)) {
      mission.push_back(changed->state);
    }
  }
  void clients(const vehicle::Now&) override {}
  void note(const std::string& text) override { notes.push_back(text); }

  // The course of time.

  /// Answers what is asked and lets time pass, a millisecond at a time.
  void run(std::chrono::milliseconds time) {
    for (auto left = time; left > 0ms; left -= 1ms) {
      now.steady += 1ms;
      now.utc += 1ms;
      now.stamp += 1ms;
      turn();
    }
  }

  void turn() {
    if (now.steady >= session.nextStep()) session.step(now, *this);
    if (!under_way_) return;
    if (answers && (held_request == 0 || requests.size() != held_request)) {
      const Sent request = under_way_->request;
      under_way_.reset();
      answer(request);
    } else if (now.steady >= under_way_->deadline) {
      under_way_.reset();
      session.noReply(now, "no reply", *this);
    }
  }

  void connect() {
    session.connected(now, *this);
    run(100ms);
  }

  void loseLink() {
    under_way_.reset();
    session.disconnected(now, *this);
    registry.clear();
    in_control = 0;
  }

  /// Another client comes, and gets control if nobody has it.
  std::uint32_t addClient(const std::string& name, bool observer = false) {
    registry.push_back({++last_id, name, "App", observer});
    promote();
    return last_id;
  }

  void removeClient(std::uint32_t id) {
    registry.erase(std::remove_if(registry.begin(), registry.end(),
                                  [id](const BlueyeClient& one) { return one.id == id; }),
                   registry.end());
    if (in_control == id) in_control = 0;
    promote();
  }

  /// The next request but `others` is not answered until letGo().
  void hold(std::size_t others = 0) { held_request = requests.size() + 1 + others; }
  void letGo() { held_request = 0; }

  void tellClients() { tell(fill(pb::ConnectedClientsTel{})); }

  /// The answer to the question who is connected, as it would be now.
  std::pair<std::string, std::string> replyAboutClients() const {
    pb::GetTelemetryRep rep;
    rep.mutable_payload()->set_type_url("type.googleapis.com/blueye.protocol.ConnectedClientsTel");
    rep.mutable_payload()->set_value(fill(pb::ConnectedClientsTel{}).SerializeAsString());
    return {rep.GetTypeName(), rep.SerializeAsString()};
  }

  template <class Message>
  void tell(const Message& message) {
    session.telemetry(now, message.GetTypeName(), message.SerializeAsString(), *this);
    session.step(now, *this);
  }

  /// Connected and in control.
  void giveControl() {
    connect();
    std::optional<BlueyeSession::Answer> answer;
    session.takeControl(
        now, [&](const auto& given) { answer = given; }, *this);
    run(300ms);
    took_control = answer && answer->success;
    session.step(now, *this);
  }

  std::string command(const vehicle::DroneCommand& command) {
    const std::string refusal = session.command(now, command, now.steady);
    session.step(now, *this);
    return refusal;
  }

  std::vector<Sent> controlsOf(const std::string& type) const {
    std::vector<Sent> found;
    for (const Sent& sent : controls) {
      if (sent.type == type) found.push_back(sent);
    }
    return found;
  }

  std::vector<std::string> requestNames() const {
    std::vector<std::string> names;
    for (const Sent& sent : requests) names.push_back(sent.type);
    return names;
  }

  static pb::MotionInput motionOf(const Sent& sent) {
    pb::MotionInputCtrl message;
    message.ParseFromString(sent.payload);
    return message.motion_input();
  }

  /// The last motion that was sent is all zero.
  bool isAtRest() const {
    const auto motions = controlsOf("MotionInputCtrl");
    if (motions.empty()) return true;
    const auto motion = motionOf(motions.back());
    return motion.surge() == 0.0F && motion.sway() == 0.0F && motion.heave() == 0.0F &&
           motion.yaw() == 0.0F && motion.roll() == 0.0F && motion.pitch() == 0.0F;
  }

  vehicle::Now now;
  BlueyeSession session;
  bool answers = true;
  std::size_t held_request = 0;  ///< the request of this number (from 1) is not answered meanwhile
  bool link_takes = true;        ///< control messages
  bool takes_requests = true;    ///< and these
  bool keeps_control = false;    ///< whoever is in control stays so, whatever is asked
  bool took_control = false;
  bool lists_clients = true;
  bool echoes = false;  ///< every request is answered with `echo`
  std::pair<std::string, std::string> echo;
  std::uint32_t last_id = 0;
  std::uint32_t in_control = 0;
  std::vector<BlueyeClient> registry;
  std::vector<Sent> controls;
  std::vector<Sent> requests;
  std::map<std::string, std::vector<vehicle::SteadyTime>> offers;  ///< also what was not taken
  std::vector<std::string> heard;
  std::string heard_bytes;
  std::vector<std::string> reconnects;
  std::vector<std::string> notes;
  std::vector<vehicle::MissionStatus::State> mission;
  std::vector<std::string> refused_rates;
  vehicle::Control control;
  int control_reports = 0;
  std::string reason;

 private:
  struct Waiting {
    Sent request;
    vehicle::SteadyTime deadline;
  };

  static std::string shortName(std::string_view type) {
    return std::string{type.substr(type.rfind('.') + 1)};
  }

  void promote() {
    if (in_control != 0) return;
    for (const BlueyeClient& client : registry) {
      if (client.observer) continue;
      in_control = client.id;
      return;
    }
  }

  template <class Message>
  Message fill(Message message) const {
    message.set_client_id_in_control(in_control);
    if (!lists_clients) return message;
    for (const BlueyeClient& client : registry) {
      auto& one = *message.add_connected_clients();
      one.set_client_id(client.id);
      one.mutable_client_info()->set_name(client.name);
      one.mutable_client_info()->set_is_observer(client.observer);
    }
    return message;
  }

  template <class Message>
  void reply(const Message& message) {
    session.reply(now, message.GetTypeName(), message.SerializeAsString(), *this);
  }

  void answer(const Sent& request) {
    if (echoes) return session.reply(now, echo.first, echo.second, *this);
    if (request.type == "ConnectClientReq") {
      pb::ConnectClientReq asked;
      asked.ParseFromString(request.payload);
      addClient(asked.client_info().name(), asked.client_info().is_observer());
      auto rep = fill(pb::ConnectClientRep{});
      rep.set_client_id(last_id);
      return reply(rep);
    }
    if (request.type == "DisconnectClientReq") {
      pb::DisconnectClientReq asked;
      asked.ParseFromString(request.payload);
      const bool stays = keeps_control && asked.client_id() == in_control;
      if (!stays) removeClient(asked.client_id());
      return reply(fill(pb::DisconnectClientRep{}));
    }
    if (request.type == "SetPubFrequencyReq") {
      pb::SetPubFrequencyReq asked;
      asked.ParseFromString(request.payload);
      pb::SetPubFrequencyRep rep;
      rep.set_success(std::find(refused_rates.begin(), refused_rates.end(), asked.message_type()) ==
                      refused_rates.end());
      return reply(rep);
    }
    if (request.type == "GetTelemetryReq") {
      pb::GetTelemetryReq asked;
      asked.ParseFromString(request.payload);
      if (asked.message_type() != "ConnectedClientsTel") return reply(pb::GetTelemetryRep{});
      const auto told = replyAboutClients();
      return session.reply(now, told.first, told.second, *this);
    }
    session.reply(now, "google.protobuf.Empty", {}, *this);
  }

  std::optional<Waiting> under_way_;
};

}  // namespace frontseat_driver::session
