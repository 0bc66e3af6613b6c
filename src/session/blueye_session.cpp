#include "frontseat_driver/session/blueye_session.h"

#include <algorithm>
#include <array>
#include <utility>

#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"
#include "frontseat_driver/protocol/blueye_parse.h"

namespace frontseat_driver::session {

namespace {

using namespace std::chrono_literals;
namespace pb = blueye::protocol;
using protocol::parse;
using vehicle::Grant;
using vehicle::Now;
using State = vehicle::MissionStatus::State;

// A drone gives up on a client a little more than 1 s after the last one: the spare half is for a
// computer that is busy, or a link that is full for a moment.
constexpr auto kWatchdogPeriod = 500ms;
constexpr auto kWatchdogRetry = 20ms;
constexpr auto kPingTimeout = 1s;
constexpr auto kRegisterAgain = 1s;
constexpr auto kGoodbyeTimeout = 50ms;
constexpr auto kAskAgain = 100ms;
constexpr auto kOvertaken = 1s;
constexpr auto kMissionEnds = 5s;
constexpr auto kAskForConfirmation = 300ms;
constexpr auto kWakingUp = 200ms;  // to read all that came while the process stood still
constexpr std::int64_t kLongestUptime_s = 9000000000;  // more does not fit into nanoseconds
constexpr double kMostRate_hz = 100.0;                 // the document, SetPubFrequencyReq

// What a program wants to know at once, and the drone tells only when it changes.
constexpr std::array<const char*, 7> kAskedAtStart{
    "DroneInfoTel", "ControlModeTel", "MissionStatusTel",      "BatteryTel",
    "LightsTel",    "RecordStateTel", "MagneticDeclinationTel"};

constexpr const char* kNoConnection = "there is no connection to the vehicle";
constexpr const char* kLeaving = "the driver is stopping";
constexpr const char* kTooLate = "the drone answered too late; control is given back";
constexpr const char* kNoAnswer =
    "the drone has not answered in time; if control comes, it is given back";
constexpr const char* kNotTaken =
    "commanding has ended; the link did not take all of it, which is sent again";
constexpr const char* kReleasing = "control is being given back";
constexpr const char* kRecord = "a record is being played";
constexpr const char* kStoodStill = "it may have come long ago, while the driver stood still";

std::chrono::nanoseconds periodOf(double rate_hz) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>{1.0 / rate_hz});
}

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string_view withoutPackage(std::string_view type) { return type.substr(type.rfind('.') + 1); }

/// Sets the clock of the drone to ours.
std::string syncTime(const Now& now) {
  pb::SyncTimeReq request;
  auto& time = *request.mutable_time()->mutable_unix_timestamp();
  time.set_seconds(std::chrono::duration_cast<std::chrono::seconds>(now.utc).count());
  time.set_nanos(static_cast<std::int32_t>((now.utc % 1s).count()));
  return request.SerializeAsString();
}

/// The drone shows that no mission runs. Not that one is ready or has ended: that may be from
/// before it was told to run one.
bool showsNoMission(std::string_view payload, bool paused_will_do) {
  pb::MissionStatusTel message;
  if (!parse(payload, message)) return false;
  const pb::MissionState state = message.mission_status().state();
  return state == pb::MISSION_STATE_INACTIVE ||
         (paused_will_do && state == pb::MISSION_STATE_PAUSED);
}

/// What ends a mission: sent again until the drone shows it.
template <class Message>
ConfirmedControls::Control endOfMission(bool paused_will_do) {
  ConfirmedControls::Control control;
  control.type = Message{}.GetTypeName();
  control.repeat = true;
  control.stops = true;
  control.confirmed_by = pb::MissionStatusTel{}.GetTypeName();
  control.shows = [paused_will_do](std::string_view payload) {
    return showsNoMission(payload, paused_will_do);
  };
  control.timeout = kMissionEnds;
  return control;
}

bool names(const pb::ConnectedClientsTel& message, std::uint32_t id) {
  const auto& clients = message.connected_clients();
  return std::any_of(clients.begin(), clients.end(),
                     [id](const pb::ConnectedClient& client) { return client.client_id() == id; });
}

/// The state in common words; the drone has no word for some of the others.
State toState(pb::MissionState state) {
  switch (state) {
    case pb::MISSION_STATE_INACTIVE:
      return State::Waiting;
    case pb::MISSION_STATE_READY:
      return State::Ready;
    case pb::MISSION_STATE_RUNNING:
      return State::Running;
    case pb::MISSION_STATE_PAUSED:
      return State::Stopped;
    case pb::MISSION_STATE_COMPLETED:
      return State::Completed;
    case pb::MISSION_STATE_ABORTED:
    case pb::MISSION_STATE_FAILED_TO_START_MISSION:
      return State::Aborted;
    case pb::MISSION_STATE_FAILED_TO_LOAD_MISSION:
      return State::InvalidDiveFile;
    default:
      return State::Unknown;
  }
}

std::string_view toWords(pb::MissionState state) {
  switch (state) {
    case pb::MISSION_STATE_INACTIVE:
      return "inactive";
    case pb::MISSION_STATE_READY:
      return "ready";
    case pb::MISSION_STATE_RUNNING:
      return "running";
    case pb::MISSION_STATE_PAUSED:
      return "paused";
    case pb::MISSION_STATE_COMPLETED:
      return "completed";
    case pb::MISSION_STATE_ABORTED:
      return "aborted";
    case pb::MISSION_STATE_FAILED_TO_LOAD_MISSION:
      return "failed to load";
    case pb::MISSION_STATE_FAILED_TO_START_MISSION:
      return "failed to start";
    default:
      return "unspecified";
  }
}

}  // namespace

BlueyeSession::BlueyeSession(BlueyeOptions options, BlueyeListener& listener)
    : options_(std::move(options)),
      listener_(listener),
      rates_hz_(options_.rates_hz),
      water_density_kg_m3_(options_.water_density_kg_m3),
      commands_enabled_(options_.commands_enabled),
      held_(options_.command_timeout, periodOf(options_.command_rate_hz), options_.clockwise_yaw) {}

// --- The connection ---

void BlueyeSession::connected(const Now& now, BlueyeOutput&) {
  connected_ = true;
  if (!silent()) register_due_ = now.steady;
  reportControl(now);
}

void BlueyeSession::disconnected(const Now& now, BlueyeOutput& out) {
  connected_ = false;
  register_due_ = SteadyTime::max();
  ask_clients_due_ = SteadyTime::max();
  drone_uptime_.reset();
  lists_clients_ = false;
  mission_ = State::Unknown;
  goodbye_said_ = true;
  loseRegistration(now);
  clients_.clear();
  const std::string reason = "the connection was lost before the drone answered";
  requests_.failAll(now, reason, out);
  registering_ = false;
  if (taking_) finishTaking(now, {false, reason}, out);
  if (releasing_) finishReleasing(now, {false, reason});
  listener_.clients(now);
}

void BlueyeSession::loseRegistration(const Now& now) {
  streamed_.forget();
  id_ = 0;
  id_in_control_ = 0;
  watchdog_due_ = SteadyTime::max();
  held_.forget();
  confirmed_.failAll("control was lost before the drone showed it");
  reportControl(now);
}

// Whatever fails on the way is tried again from the start.
void BlueyeSession::ping(const Now& now, BlueyeOutput& out) {
  register_due_ = SteadyTime::max();
  registering_ = true;
  const pb::PingReq request;
  requests_.add(
      now, request.GetTypeName(), std::string{}, kPingTimeout,
      [this](const Now& then, const BlueyeReply& reply, BlueyeOutput& o) {
        if (!reply.received) {
          registering_ = false;
          if (connected_ && !silent()) register_due_ = then.steady + kRegisterAgain;
          return;
        }
        registerClient(
            then, options_.observer, [this](const Now& n, BlueyeOutput& o2) { setUp(n, o2); }, o);
      },
      out);
}

void BlueyeSession::registerClient(const Now& now, bool observer, Then then, BlueyeOutput& out) {
  registering_ = true;
  pb::ConnectClientReq request;
  pb::ClientInfo& info = *request.mutable_client_info();
  info.set_type("ROS");
  info.set_version("frontseat_driver");
  info.set_device_type("Computer");
  info.set_platform("Linux");
  info.set_name(options_.client_name);
  info.set_is_observer(observer);
  requests_.add(
      now, request.GetTypeName(), request.SerializeAsString(), options_.request_timeout,
      [this, observer, asked = told_, then = std::move(then)](
          const Now& at, const BlueyeReply& reply, BlueyeOutput& o) {
        registering_ = false;
        loseRegistration(at);  // what was commanded under the one before is not this one's
        pb::ConnectClientRep message;
        if (!reply.received || !parse(reply.payload, message) || message.client_id() == 0) {
          if (connected_ && !silent()) register_due_ = at.steady + kRegisterAgain;
          const Answer failed{false, "the drone did not register this client"};
          if (taking_) finishTaking(at, failed, o);
          if (releasing_) finishReleasing(at, failed);
          return;
        }
        id_ = message.client_id();
        as_observer_ = observer;
        registered_since_ = at.steady;
        learnClients(at, message, asked, o);
        if (then) then(at, o);
      },
      out);
}

void BlueyeSession::unregister(const Now& now, std::uint32_t id, Then then, BlueyeOutput& out) {
  registering_ = true;
  pb::DisconnectClientReq request;
  request.set_client_id(id);
  const auto timeout = leaving_ ? kGoodbyeTimeout : options_.request_timeout;
  requests_.add(
      now, request.GetTypeName(), request.SerializeAsString(), timeout,
      [this, asked = told_, then = std::move(then)](const Now& at, const BlueyeReply& reply,
                                                    BlueyeOutput& o) {
        registering_ = false;
        if (leaving_) goodbye_said_ = true;
        if (leaving_ && reply.received) loseRegistration(at);  // who is next must not be stopped
        // Nothing of what was to follow may wait for the next connection.
        if (!connected_ || leaving_) return;
        pb::DisconnectClientRep message;
        if (reply.received && parse(reply.payload, message)) learnClients(at, message, asked, o);
        then(at, o);
      },
      out);
}

void BlueyeSession::setUp(const Now& now, BlueyeOutput& out) {
  for (const auto& [message, rate_hz] : rates_hz_) askForRate(now, message, rate_hz, {}, out);
  askForClients(now, out);
  for (const char* message : kAskedAtStart) askForTelemetry(now, message, out);
}

void BlueyeSession::askForTelemetry(const Now& now, const std::string& message, BlueyeOutput& out,
                                    Heard heard) {
  pb::GetTelemetryReq request;
  request.set_message_type(message);
  requests_.add(
      now, request.GetTypeName(), request.SerializeAsString(), options_.request_timeout,
      [this, asked = told_, heard = std::move(heard)](const Now& at, const BlueyeReply& reply,
                                                      BlueyeOutput& o) {
        pb::GetTelemetryRep answer;
        if (!reply.received || !parse(reply.payload, answer)) answer.Clear();
        const std::string& url = answer.payload().type_url();
        const std::string_view type = std::string_view{url}.substr(url.rfind('/') + 1);
        if (!url.empty()) hear(at, type, answer.payload().value(), asked, o);  // else none yet
        if (heard) heard(at, reply.received, o);
      },
      out);
}

// One question at a time: the drone may be slow, and its telemetry fast.
void BlueyeSession::askForClients(const Now& now, BlueyeOutput& out) {
  ask_clients_due_ = SteadyTime::max();
  ask_clients_again_ = asking_clients_;
  if (std::exchange(asking_clients_, true)) return;
  const auto heard = [this](const Now& at, bool received, BlueyeOutput& o) {
    asking_clients_ = false;
    if (!connected_ || silent()) return;
    if (!received) ask_clients_due_ = at.steady + kRegisterAgain;
    if (received && ask_clients_again_) askForClients(at, o);
  };
  askForTelemetry(now, "ConnectedClientsTel", out, heard);
}

void BlueyeSession::askForRate(const Now& now, const std::string& message, double rate_hz,
                               Respond respond, BlueyeOutput& out) {
  pb::SetPubFrequencyReq request;
  request.set_message_type(message);
  request.set_frequency(static_cast<float>(rate_hz));
  requests_.add(
      now, request.GetTypeName(), request.SerializeAsString(), options_.request_timeout,
      [this, message, respond = std::move(respond)](const Now&, const BlueyeReply& reply,
                                                    BlueyeOutput&) {
        pb::SetPubFrequencyRep answer;
        const bool parsed = reply.received && parse(reply.payload, answer);
        const std::string trouble =
            !reply.received ? reply.reason
            : !parsed || !answer.success()
                ? "the drone refused a rate for " + message + ": unknown name or rate out of range"
                : std::string{};
        if (respond) return respond({trouble.empty(), trouble.empty() ? "done" : trouble});
        if (!trouble.empty()) listener_.note("rate of " + message + ": " + trouble);
      },
      out);
}

// --- What the drone says ---

void BlueyeSession::telemetry(const Now& now, std::string_view type, std::string_view payload,
                              BlueyeOutput& out) {
  ++counters_.telemetry_received;
  counters_.bytes_received += type.size() + payload.size();
  hear(now, type, payload, std::nullopt, out);
}

void BlueyeSession::hear(const Now& now, std::string_view type, std::string_view payload,
                         std::optional<Asked> asked, BlueyeOutput& out) {
  listener_.telemetry(now, type, payload);
  const std::string_view name = withoutPackage(type);
  if (name == "ConnectedClientsTel") hearClients(now, payload, asked, out);
  if (name == "MissionStatusTel") hearMission(now, payload);
  if (name == "DroneTimeTel") hearClock(now, payload, out);
  confirmed_.telemetry(type, payload);
}

// Telemetry and replies come on two connections, so either may be older than what came before it by
// the other. Word that control is gone counts at once, and may be wrong; control is only gained by
// a reply, and only if nothing else was told since the question.
void BlueyeSession::hearClients(const Now& now, std::string_view payload,
                                std::optional<Asked> asked, BlueyeOutput& out) {
  pb::ConnectedClientsTel message;
  if (!parse(payload, message)) return malformed();
  const std::uint32_t in_control = message.client_id_in_control();
  // A drone that lists nobody may be one that never does.
  const bool lists = lists_clients_ || !message.connected_clients().empty();
  const bool names_us = !lists || names(message, id_);
  const bool gives_control = registered() && in_control == id_ && names_us;
  const bool news = in_control != id_in_control_ || !names_us;
  if (!asked) {
    ++told_;
    told_in_control_ = in_control;
  }
  if (inControl() && !gives_control) setIdInControl(now, in_control == id_ ? 0 : in_control, out);
  if (registering_) return;  // while we come and go ourselves, it may tell of us as we were
  const bool young = now.steady < registered_since_ + kOvertaken;
  const bool doubtful = (young && news) || (gives_control && !inControl());
  if (!asked && registered() && !silent() && doubtful) return askForClients(now, out);
  if (registered() && !names_us) {
    listener_.note("the drone has disconnected this client; registering again");
    loseRegistration(now);
    if (!silent()) register_due_ = now.steady + kRegisterAgain;
  }
  learnClients(now, message, asked.value_or(told_), out);
}

template <class Message>
void BlueyeSession::learnClients(const Now& now, const Message& message, Asked asked,
                                 BlueyeOutput& out) {
  clients_.clear();
  for (const pb::ConnectedClient& client : message.connected_clients()) {
    const pb::ClientInfo& info = client.client_info();
    clients_.push_back({client.client_id(), info.name(), info.type(), info.is_observer()});
  }
  lists_clients_ = lists_clients_ || !clients_.empty();
  const std::uint32_t in_control = message.client_id_in_control();
  const bool gains = registered() && in_control == id_ && !inControl();
  const bool contradicted = asked != told_ && told_in_control_ != in_control;
  if (gains && contradicted && !silent()) {
    askForClients(now, out);
  } else {
    setIdInControl(now, in_control, out);
  }
  listener_.clients(now);
}

void BlueyeSession::setIdInControl(const Now& now, std::uint32_t id, BlueyeOutput& out) {
  const bool had_control = inControl();
  id_in_control_ = id;
  if (inControl() && !had_control && !silent()) gainControl(now, out);
  if (had_control && !inControl()) {
    watchdog_due_ = SteadyTime::max();
    held_.forget();
    confirmed_.failAll("control was lost before the drone showed it");
  }
  if (!inControl()) streamed_.forget();
  reportControl(now);
}

// The watchdog arms the thrusters, and the drone may hold what somebody else last sent.
void BlueyeSession::gainControl(const Now& now, BlueyeOutput& out) {
  watchdog_due_ = now.steady;
  held_.end(now.steady, true);
  if (options_.sync_time) {
    requests_.add(
        now, pb::SyncTimeReq{}.GetTypeName(), syncTime, options_.request_timeout,
        [](const Now&, const BlueyeReply&, BlueyeOutput&) {}, out);
  }
  if (water_density_kg_m3_) {
    pb::WaterDensityCtrl message;
    message.mutable_density()->set_value(static_cast<float>(*water_density_kg_m3_));
    out.publish(now, message.GetTypeName(), message.SerializeAsString());
  }
  if (options_.pinger_mounting != PingerMounting::Unset) {
    pb::PingerConfigurationCtrl message;
    const bool forwards = options_.pinger_mounting == PingerMounting::Forwards;
    message.mutable_configuration()->set_mounting_direction(
        forwards ? pb::PingerConfiguration::MOUNTING_DIRECTION_FORWARDS
                 : pb::PingerConfiguration::MOUNTING_DIRECTION_DOWNWARDS);
    out.publish(now, message.GetTypeName(), message.SerializeAsString());
  }
}

void BlueyeSession::hearMission(const Now& now, std::string_view payload) {
  pb::MissionStatusTel message;
  if (!parse(payload, message)) return malformed();
  const State state = toState(message.mission_status().state());
  if (state == mission_) return;
  mission_ = state;
  vehicle::MissionStatus event;
  event.state = state;
  event.status = toWords(message.mission_status().state());
  listener_.event(now, event);
}

void BlueyeSession::hearClock(const Now& now, std::string_view payload, BlueyeOutput& out) {
  pb::DroneTimeTel message;
  if (!parse(payload, message)) return malformed();
  if (!message.monotonic_clock().has_unix_timestamp() || options_.listen_only) return;
  const auto& time = message.monotonic_clock().unix_timestamp();
  if (time.seconds() < 0 || time.seconds() > kLongestUptime_s) return;
  const auto uptime = std::chrono::seconds{time.seconds()} + std::chrono::nanoseconds{time.nanos()};
  const bool rebooted = drone_uptime_ && uptime + 1s < *drone_uptime_;
  drone_uptime_ = uptime;
  if (rebooted) out.reconnect(now, "the drone was rebooted");
}

void BlueyeSession::reply(const Now& now, std::string_view type, std::string_view payload,
                          BlueyeOutput& out) {
  ++counters_.replies_received;
  counters_.bytes_received += type.size() + payload.size();
  requests_.reply(now, type, payload, out);
}

void BlueyeSession::noReply(const Now& now, const std::string& reason, BlueyeOutput& out) {
  requests_.noReply(now, reason, out);
}

// --- What the user wants ---

std::string BlueyeSession::refusal() const {
  if (leaving_) return kLeaving;
  if (options_.listen_only) return kRecord;
  if (!connected_) return kNoConnection;
  if (releasing_) return kReleasing;
  if (!registered()) return "the drone has not registered this client yet";
  if (!commands_enabled_) return "the command gate is closed; service enable_commands opens it";
  if (inControl()) return {};
  for (const BlueyeClient& client : clients_) {
    if (client.id != id_in_control_) continue;
    return "client " + std::to_string(client.id) + " (" + client.name +
           ") is in control; service take_control takes it";
  }
  return "this client is not in control; service take_control takes it";
}

std::string BlueyeSession::refusal(const Now& now, SteadyTime received) const {
  const std::string reason = refusal();
  if (!reason.empty()) return reason;
  if (received < permitted_since_) return "it is from before the last stop or permission";
  if (received < awake_since_) return kStoodStill;
  if (now.steady - received >= options_.command_timeout) {
    return "it waited in this computer for longer than command_timeout";
  }
  return {};
}

Grant BlueyeSession::grant() const {
  if (!connected_ || !registered()) return Grant::Unknown;
  return inControl() ? Grant::Granted : Grant::Denied;
}

std::string BlueyeSession::command(const Now& now, const vehicle::DroneCommand& command,
                                   SteadyTime received) {
  const std::string reason = refusal(now, received);
  if (!reason.empty()) {
    ++counters_.refused_commands;
    return reason;
  }
  held_.put(command, received);
  reportControl(now);
  return {};
}

void BlueyeSession::endCommanding(const Now& now, bool all) {
  streamed_.forget();
  if (inControl()) {
    held_.end(now.steady, all);
  } else {
    held_.forget();
  }
  reportControl(now);
}

void BlueyeSession::stoodStill(const Now& now) {
  awake_since_ = now.steady + kWakingUp;
  endCommanding(now, false);
}

BlueyeSession::Answer BlueyeSession::stop(const Now& now, BlueyeOutput& out) {
  permitted_since_ = now.steady;
  confirmed_.failAll("commanding was stopped", false);
  if (silent() || !inControl()) {
    endCommanding(now, false);
    return {false, "commanding has ended; this client is not in control, so nothing was sent"};
  }
  endCommanding(now, true);
  held_.step(now, out);
  // Whatever the drone told last: it may have been told to run one since.
  const bool paused = confirmed_.add(now, endOfMission<pb::PauseMissionCtrl>(true), out);
  if (!paused || held_.zerosDue()) return {false, kNotTaken};
  return {true, "commanding has ended and a mission that runs is paused"};
}

BlueyeSession::Answer BlueyeSession::abort(const Now& now, BlueyeOutput& out) {
  const Answer stopped = stop(now, out);
  if (silent() || !inControl()) return stopped;
  const bool cleared = confirmed_.add(now, endOfMission<pb::ClearMissionCtrl>(false), out);
  if (!cleared || !stopped.success) return {false, kNotTaken};
  return {true, "commanding has ended and the mission is cleared"};
}

void BlueyeSession::setCommandsEnabled(const Now& now, bool enabled) {
  commands_enabled_ = enabled;
  if (!enabled) {
    confirmed_.failAll("the command gate was closed", false);
    endCommanding(now, false);
  }
  reportControl(now);
}

void BlueyeSession::takeControl(const Now& now, Respond respond, BlueyeOutput& out) {
  if (releasing_) return respond({false, kReleasing});
  if (inControl()) return respond({true, "this client is in control"});
  if (leaving_) return respond({false, kLeaving});
  if (options_.listen_only) return respond({false, kRecord});
  if (!registered()) return respond({false, connected_ ? refusal() : kNoConnection});
  if (taking_ || registering_) return respond({false, "control is being asked for already"});
  taking_ = Taking{now.steady + options_.control_timeout, SteadyTime::max(), std::move(respond)};
  const Then go_on = [this](const Now& at, BlueyeOutput& o) { continueTaking(at, o); };
  if (!as_observer_) return continueTaking(now, out);
  unregister(
      now, id_,
      [this, go_on](const Now& at, BlueyeOutput& o) {
        const bool late = !taking_ || at.steady >= taking_->deadline;
        if (taking_ && late) finishTaking(at, {false, kTooLate}, o);
        registerClient(at, late, late ? Then{} : go_on, o);
      },
      out);
}

void BlueyeSession::continueTaking(const Now& now, BlueyeOutput& out) {
  if (!taking_) return;
  if (now.steady >= taking_->deadline) {
    const std::string keeper = "client " + std::to_string(id_in_control_) + " keeps control";
    return finishTaking(now, {false, inControl() ? kTooLate : keeper}, out);
  }
  if (inControl()) return finishTaking(now, {true, "this client is in control"}, out);
  // The next look comes from step(): the drone may need a moment.
  taking_->again = SteadyTime::max();
  unregister(
      now, id_in_control_,
      [this](const Now& at, BlueyeOutput& o) {
        if (!taking_) return;
        taking_->again = at.steady + kAskAgain;
        if (inControl() || at.steady >= taking_->deadline) continueTaking(at, o);
      },
      out);
}

// A caller is told in time, also while a reply does not come.
void BlueyeSession::watchTaking(const Now& now, BlueyeOutput& out) {
  if (!taking_ || now.steady < nextTaking()) return;
  if (taking_->again != SteadyTime::max()) return continueTaking(now, out);
  std::exchange(taking_->respond, nullptr)({false, kNoAnswer});
}

vehicle::SteadyTime BlueyeSession::nextTaking() const {
  if (!taking_) return SteadyTime::max();
  return taking_->respond ? std::min(taking_->again, taking_->deadline) : taking_->again;
}

void BlueyeSession::finishTaking(const Now& now, const Answer& answer, BlueyeOutput& out) {
  const Respond respond = std::move(taking_->respond);
  taking_.reset();
  if (respond) respond(answer);
  // Else control would come later, when nobody expects it.
  const bool go_back = !answer.success && registered() && options_.observer && !as_observer_;
  if (go_back && connected_ && !silent())
    giveBack(
        now, [](const Answer&) {}, out);
}

void BlueyeSession::releaseControl(const Now& now, Respond respond, BlueyeOutput& out) {
  if (silent()) return respond({false, leaving_ ? kLeaving : kRecord});
  if (releasing_) return respond({false, kReleasing});
  if (!registered()) return respond({false, connected_ ? refusal() : kNoConnection});
  if (taking_ || registering_) return respond({false, "control is being asked for just now"});
  if (as_observer_) return respond({true, "this client is an observer"});
  giveBack(now, std::move(respond), out);
}

// From here on no command is taken: it would cancel the zeros, and the drone keeps what it has.
void BlueyeSession::giveBack(const Now& now, Respond respond, BlueyeOutput& out) {
  releasing_ = std::move(respond);
  confirmed_.failAll(kReleasing, false);
  endCommanding(now, true);
  held_.step(now, out);
  const Then done = [this](const Now& at, BlueyeOutput&) {
    if (!releasing_) return;
    finishReleasing(at, {true, "control was given back; this client is an observer"});
  };
  unregister(
      now, id_, [this, done](const Now& at, BlueyeOutput& o) { registerClient(at, true, done, o); },
      out);
}

void BlueyeSession::finishReleasing(const Now& now, const Answer& answer) {
  const Respond respond = std::move(*releasing_);
  releasing_.reset();
  respond(answer);
  reportControl(now);
}

std::string BlueyeSession::refusalOf(std::string_view control_type) const {
  const std::string_view name = withoutPackage(control_type);
  if (!endsWith(name, "Ctrl")) return "its name does not end in Ctrl";
  if (name == "MotionInputCtrl") return "motion goes by topic cmd_motion or cmd_vel";
  if (name == "TiltVelocityCtrl") return "tilt goes by topic cmd_tilt";
  if (name == "GripperCtrl") return "the gripper goes by topic cmd_gripper";
  if (name == "WatchdogCtrl") return "the driver sends the watchdog itself";
  if (name == "FormatRemovableStorageDeviceCtrl" && !options_.allow_format) {
    return "it destroys data; parameter allow_format permits it";
  }
  return refusal();
}

void BlueyeSession::control(const Now& now, ConfirmedControls::Control control, BlueyeOutput& out,
                            std::optional<SteadyTime> received) {
  std::string reason = refusalOf(control.type);
  if (reason.empty()) reason = refusal(now, received.value_or(now.steady));
  if (!reason.empty()) {
    ++counters_.refused_commands;
    if (control.respond) control.respond(reason);
    return;
  }
  if (control.type == pb::RunMissionCtrl{}.GetTypeName()) {
    confirmed_.drop(pb::PauseMissionCtrl{}.GetTypeName());
    confirmed_.drop(pb::ClearMissionCtrl{}.GetTypeName());
  }
  const auto send = [&](ConfirmedControls::Control one) {
    confirmed_.add(now, std::move(one), out);
  };
  if (control.stream.empty()) return send(std::move(control));
  streamed_.put(now.steady, std::move(control), send);
}

void BlueyeSession::request(const Now& now, std::string type, std::string payload,
                            std::chrono::milliseconds timeout, RespondReply respond,
                            BlueyeOutput& out) {
  const std::string_view name = withoutPackage(type);
  const auto refuse = [&](const std::string& reason) { respond({false, {}, {}, reason}); };
  if (!endsWith(name, "Req")) return refuse("its name does not end in Req");
  if (leaving_) return refuse(kLeaving);
  if (options_.listen_only) return refuse(kRecord);
  if (!connected_) return refuse(kNoConnection);
  if (now.steady < awake_since_) return refuse(kStoodStill);
  if (name == "FlashEscSettingsReq" && !options_.allow_flash) {
    return refuse("it writes to the motor controllers; parameter allow_flash permits it");
  }
  if (name == "SetMissionReq") confirmed_.drop(pb::ClearMissionCtrl{}.GetTypeName());
  requests_.add(
      now, std::move(type), std::move(payload), timeout,
      [respond = std::move(respond)](const Now&, const BlueyeReply& reply, BlueyeOutput&) {
        respond(reply);
      },
      out, now.steady + timeout);
}

void BlueyeSession::setRate(const Now& now, const std::string& message, double rate_hz,
                            Respond respond, BlueyeOutput& out) {
  if (!(rate_hz >= 0.0 && rate_hz <= kMostRate_hz)) {
    return respond({false, "rate is " + std::to_string(rate_hz) + "; 0 to 100 Hz is accepted"});
  }
  rates_hz_[message] = rate_hz;
  if (leaving_) return respond({false, kLeaving});
  if (options_.listen_only) return respond({false, kRecord});
  if (!connected_) {
    return respond({false, std::string{kNoConnection} + "; it will be asked for when there is"});
  }
  askForRate(now, message, rate_hz, std::move(respond), out);
}

// --- What goes out ---

void BlueyeSession::step(const Now& now, BlueyeOutput& out) {
  if (!reported_) reportControl(now);
  const bool was_commanding = held_.commanding();
  held_.step(now, out);
  if (was_commanding != held_.commanding()) reportControl(now);
  if (now.steady >= watchdog_due_) sendWatchdog(now, out);
  streamed_.step(now.steady,
                 [&](ConfirmedControls::Control one) { confirmed_.add(now, std::move(one), out); });
  confirmed_.step(now, out);
  askForConfirmations(now, out);
  if (now.steady >= register_due_) ping(now, out);
  if (now.steady >= ask_clients_due_) askForClients(now, out);
  watchTaking(now, out);
  requests_.step(now, out);
}

// Some telemetry comes seldom, and nobody should wait for it longer than the drone takes.
void BlueyeSession::askForConfirmations(const Now& now, BlueyeOutput& out) {
  if (confirmed_.empty()) {
    ask_confirmations_ = now.steady + kAskForConfirmation;
  } else if (now.steady >= ask_confirmations_) {
    ask_confirmations_ = now.steady + kAskForConfirmation;
    const std::string type = confirmed_.awaited();
    askForTelemetry(now, std::string{withoutPackage(type)}, out);
  }
}

void BlueyeSession::await(const Now& now, const std::string& telemetry_type,
                          std::function<bool(std::string_view payload)> shows,
                          ConfirmedControls::Respond respond, BlueyeOutput& out) {
  ConfirmedControls::Control nothing;
  nothing.confirmed_by = telemetry_type;
  nothing.shows = std::move(shows);
  nothing.respond = std::move(respond);
  confirmed_.add(now, std::move(nothing), out);
}

void BlueyeSession::sendWatchdog(const Now& now, BlueyeOutput& out) {
  pb::WatchdogCtrl message;
  message.set_client_id(id_);
  const auto since = now.steady - registered_since_;
  message.mutable_connection_duration()->set_value(
      static_cast<std::int32_t>(std::chrono::duration_cast<std::chrono::seconds>(since).count()));
  const bool sent = out.publish(now, message.GetTypeName(), message.SerializeAsString());
  watchdog_due_ = now.steady + (sent ? kWatchdogPeriod : kWatchdogRetry);
}

vehicle::SteadyTime BlueyeSession::nextStep() const {
  if (!reported_) return SteadyTime::min();
  return std::min({held_.nextStep(), watchdog_due_, streamed_.nextStep(), confirmed_.nextStep(),
                   register_due_, ask_clients_due_, requests_.nextStep(), nextTaking(),
                   confirmed_.empty() ? SteadyTime::max() : ask_confirmations_});
}

void BlueyeSession::leave(const Now& now, BlueyeOutput& out) {
  leaving_ = true;  // first, so that no answer begins anything anew
  // The goodbye of a release is under way: its answer counts.
  const std::string goodbye = releasing_ ? pb::DisconnectClientReq{}.GetTypeName() : "";
  requests_.failAll(now, kLeaving, out, goodbye);
  streamed_.forget();
  confirmed_.failAll(kLeaving);
  register_due_ = SteadyTime::max();
  ask_clients_due_ = SteadyTime::max();
  watchdog_due_ = SteadyTime::max();
  if (taking_) finishTaking(now, {false, kLeaving}, out);
  if (releasing_) finishReleasing(now, {false, kLeaving});
  goodbye_said_ = !registered() || options_.listen_only;
  // Also a registration that was under way may just have been given up.
  if (inControl() && !options_.listen_only) {
    held_.end(now.steady, true);
  } else {
    held_.forget();
  }
  reportControl(now);
  if (goodbye_said_) return;
  unregister(now, id_, {}, out);
}

// --- Reports ---

void BlueyeSession::reportControl(const Now& now) {
  Reported state{grant(), commands_enabled_, held_.commanding(), refusal()};
  const bool permitted = state.reason.empty();
  if (permitted && !permitted_) permitted_since_ = now.steady;
  permitted_ = permitted;
  if (reported_ && *reported_ == state) return;
  reported_ = std::move(state);
  listener_.event(now, vehicle::Control{reported_->grant, reported_->commands_enabled,
                                        reported_->commanding, reported_->reason});
}

}  // namespace frontseat_driver::session
