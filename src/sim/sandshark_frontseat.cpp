#include "frontseat_driver/sim/sandshark_frontseat.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/geography.h"
#include "plain_numbers.h"

namespace frontseat_driver::sim {
namespace {

namespace bluefin = protocol::bluefin;

constexpr std::string_view kVersion = "SS_0.0";
constexpr double kChangeHolds_s = 5.0;  // SPI 0.1, section 7.3
constexpr double kAirPressure_kpa = 101.325;
constexpr double kFreshWater_kpa_m = 9.80665;
constexpr double kBeamAngle_deg = 30.0;

/// What a client can ask for; a bit each, in this order.
constexpr std::array<std::string_view, 11> kLogged = {"NVG", "NVR", "MIS", "CTL", "DVL", "CTD",
                                                      "RVL", "SVS", "MBS", "MBE", "ACK"};
constexpr std::uint32_t kConnected = std::uint32_t{1} << 31;

constexpr std::uint32_t bit(std::string_view sentence) {
  for (std::size_t i = 0; i < kLogged.size(); ++i) {
    if (kLogged[i] == sentence) return std::uint32_t{1} << i;
  }
  return 0;
}

/// Field 1 of any command but BPLOG.
std::optional<nmea::TimeOfDay> commandTime(const nmea::Sentence& sentence) {
  if (sentence.formatter() == "LOG") return std::nullopt;
  nmea::FieldReader in{sentence};
  return in.timeOfDay();
}

/// The field's way to find a command: by the first of these names anywhere in the line.
std::string_view addressBySubstring(const nmea::Sentence& sentence) {
  constexpr std::array<std::string_view, 5> kCommands = {"BPRMB", "BPLOG", "BPABT", "BPSTS",
                                                         "BPVER"};
  for (const std::string_view command : kCommands) {
    for (const std::string_view text : {sentence.address, sentence.fields}) {
      if (text.find(command.substr(2)) != std::string_view::npos) return command;
    }
  }
  return sentence.address;
}

}  // namespace

SandsharkFrontseat::SandsharkFrontseat(const SandsharkConfig& config)
    : Frontseat(config, protocol::Dialect::Sandshark, std::chrono::seconds{0}),
      settings_(config),
      torpedo_(config.environment, config.start, config.battery),
      mission_(config.mission),
      dynamic_requests_(config.allow_dynamic_requests),
      said_state_(mission_.state()),
      said_leg_(mission_.leg()) {
  scheduleReports();
}

void SandsharkFrontseat::scheduleReports() {
  schedule("NVR", [this] { broadcast(bit("NVR"), "BF", velocity()); });
  schedule("DVL", [this] { sendDvl(); });
  schedule("CTD", [this] { sendCtd(); });
  schedule("RVL", [this] {
    bluefin::RawVehicleSpeed message;
    message.sent_at = stamp(now());
    message.thruster_rpm = torpedo_.thrusterRpm();
    message.water_speed_m_s = reading().state.surge_m_s;
    broadcast(bit("RVL"), "BF", message);
  });
  schedule("SVS", [this] {
    bluefin::SoundSpeed message;
    message.sent_at = stamp(now());
    message.sound_speed_m_s = 1475.0 + 0.016 * reading().state.depth_m;
    broadcast(bit("SVS"), "BF", message);
  });
}

void SandsharkFrontseat::sendDvl() {
  const VehicleState& state = reading().state;
  const double heading = state.heading_rad;
  bluefin::Dvl message;
  message.sent_at = message.measured_at = stamp(now());
  // A level instrument: bow and starboard lie in the horizontal plane.
  message.bow_m_s =
      state.velocity_north_m_s * std::cos(heading) + state.velocity_east_m_s * std::sin(heading);
  message.starboard_m_s =
      state.velocity_east_m_s * std::cos(heading) - state.velocity_north_m_s * std::sin(heading);
  message.down_m_s = state.velocity_down_m_s;
  message.beam_range_m.fill(state.altitude_m / std::cos(radians(kBeamAngle_deg)));
  message.temperature_c = 14.0;
  broadcast(bit("DVL"), "BF", message);
}

void SandsharkFrontseat::sendCtd() {
  bluefin::Ctd message;
  message.sent_at = message.measured_at = stamp(now());
  message.conductivity_us_cm = 850.0;
  message.temperature_c = 14.0;
  message.pressure_kpa = kAirPressure_kpa + kFreshWater_kpa_m * reading().state.depth_m;
  broadcast(bit("CTD"), "BF", message);
}

void SandsharkFrontseat::welcome(Client& client) {
  client.logged = kConnected;
  bluefin::VehicleVersion version;
  version.sent_at = stamp(now());
  version.version = kVersion;
  nmea::SentenceWriter out = protocol::write(version);
  if (const auto text = out.finish()) queue(client, *text);
}

void SandsharkFrontseat::announceShutdown() {
  bluefin::PayloadShutdown shutdown;
  shutdown.sent_at = stamp(now());
  broadcast(kConnected, "BF", shutdown);
}

void SandsharkFrontseat::adapt(protocol::NavigationUpdate& navigation,
                               const Sensors::Reading& reading) {
  // True heading = grid heading + convergence (SPI 0.1, section 6.1 sends the grid heading).
  navigation.heading_deg = wrap360(*navigation.heading_deg - gridConvergenceDeg(reading.position));
  const bool no_bottom = reading.state.altitude_m > settings_.altimeter_range_m;
  if (no_bottom || config().quirks.zero_altitude) navigation.altitude_m = 0.0;
  if (config().quirks.zero_depth) navigation.depth_m = 0.0;
}

void SandsharkFrontseat::sendNavigation(const protocol::NavigationUpdate& navigation) {
  broadcast(bit("NVG"), "BF", navigation);
}

void SandsharkFrontseat::command(Client& client, const nmea::Sentence& received) {
  if (received.talker() != "BP") return;
  nmea::Sentence sentence = received;
  if (config().quirks.command_by_substring) sentence.address = addressBySubstring(received);
  const auto read = protocol::decode(sentence);
  const bool readable = read && read->faults.count == 0;
  const bool numbers_only = sentence.formatter() != "RMB" || arePlainNumbers(sentence.fields);
  const Answer answer = readable && numbers_only ? obey(client, read->message)
                                                 : Answer{Status::Invalid, "not understood"};
  if (!answer.silent) acknowledge(client, sentence.address, commandTime(sentence), answer);
}

SandsharkFrontseat::Answer SandsharkFrontseat::obey(Client& client,
                                                    const protocol::Message& message) {
  if (const auto* request = std::get_if<bluefin::LogRequest>(&message)) {
    return log(client, *request);
  }
  if (const auto* wanted = std::get_if<BehaviorChange>(&message)) return change(*wanted);
  if (const auto* end = std::get_if<bluefin::AbortMission>(&message)) return abortMission(*end);
  return {Status::Done, ""};
}

SandsharkFrontseat::Answer SandsharkFrontseat::log(Client& client,
                                                   const bluefin::LogRequest& request) {
  const std::uint32_t every = kAll & ~kConnected & ~bit("ACK");
  const std::uint32_t bits = request.sentence == "ALL" ? every : bit(request.sentence);
  if (bits == 0 || !request.on) return {Status::Invalid, "no such sentence"};
  client.logged = *request.on ? client.logged | bits : client.logged & ~bits;
  if (*request.on && (bits & bit("MIS")) != 0) {
    const std::string status = mission_.status();
    nmea::SentenceWriter out = protocol::write(missionStatus(status));
    if (const auto text = out.finish()) queue(client, *text);
  }
  const bool silent = request.sentence == "ACK" && !config().quirks.ack_log_ack;
  return {Status::Done, *request.on ? "logging on" : "logging off", silent};
}

SandsharkFrontseat::Answer SandsharkFrontseat::change(const BehaviorChange& wanted) {
  if (unsafe(wanted)) return {Status::Invalid, "out of safe range"};
  if (!backseat_in_control_) return {Status::Failed, "dynamic requests are off"};
  if (config().quirks.dies_on_empty_field &&
      !(wanted.horizontal && wanted.vertical && wanted.speed)) {
    reboot();
    return {Status::Failed, "empty field"};
  }
  if (!config().faults.lie) change_ = Change{wanted, now()};
  return {settings_.pending_s > 0.0 ? Status::Pending : Status::Done, ""};
}

bool SandsharkFrontseat::unsafe(const BehaviorChange& wanted) const {
  const auto outside = [](double value, double low, double high) {
    return value < low || value > high;
  };
  if (wanted.horizontal) {
    const bool rudder = wanted.horizontal_mode == BehaviorChange::HorizontalMode::Rudder;
    if (outside(*wanted.horizontal, rudder ? -90.0 : 0.0, rudder ? 90.0 : 360.0)) return true;
  }
  if (wanted.vertical) {
    if (!wanted.vertical_mode) return true;
    const bool angle = *wanted.vertical_mode == BehaviorChange::VerticalMode::Pitch ||
                       *wanted.vertical_mode == BehaviorChange::VerticalMode::Elevator;
    const bool altitude = *wanted.vertical_mode == BehaviorChange::VerticalMode::Altitude;
    if (angle && outside(*wanted.vertical, -90.0, 90.0)) return true;
    if (altitude && outside(*wanted.vertical, settings_.limits.min_altitude_m, 1e4)) return true;
    if (!angle && !altitude && outside(*wanted.vertical, 0.0, settings_.limits.max_depth_m)) {
      return true;
    }
  }
  if (!wanted.speed) return false;
  if (!wanted.speed_mode) return true;
  return *wanted.speed_mode == BehaviorChange::SpeedMode::Rpm
             ? outside(*wanted.speed, -Torpedo::kMaxRpm, Torpedo::kMaxRpm)
             : outside(*wanted.speed, 0.0, Torpedo::kMaxSpeed);
}

SandsharkFrontseat::Answer SandsharkFrontseat::abortMission(const bluefin::AbortMission& end) {
  if (config().faults.lie) return {Status::Done, ""};
  const std::string reason = end.with_errors.value_or(true) ? "abort with errors" : "abort";
  mission_.abort(end.message.empty() ? reason : reason + ": " + std::string{end.message});
  return {Status::Done, ""};
}

void SandsharkFrontseat::acknowledge(Client& client, std::string_view address,
                                     const std::optional<nmea::TimeOfDay>& time,
                                     const Answer& answer) {
  if ((client.logged & bit("ACK")) == 0 || config().faults.withhold_acks) return;
  bluefin::Acknowledgement acknowledgement;
  acknowledgement.command = config().quirks.long_ack_names ? address : address.substr(2);
  acknowledgement.command_time = time;
  acknowledgement.status = static_cast<std::int64_t>(answer.status);
  acknowledgement.message = answer.message;
  acknowledgeAfter(config().faults.delay_acks_s, client, acknowledgement);
  if (answer.status != Status::Pending) return;
  acknowledgement.status = static_cast<std::int64_t>(Status::Done);
  acknowledgeAfter(config().faults.delay_acks_s + settings_.pending_s, client, acknowledgement);
}

void SandsharkFrontseat::acknowledgeAfter(double delay_s, Client& client,
                                          bluefin::Acknowledgement acknowledgement) {
  const UtcTime due = now() + UtcTime{static_cast<std::int64_t>(delay_s * 1e9)};
  acknowledgement.sent_at = stamp(due);
  nmea::SentenceWriter out = protocol::write(acknowledgement);
  const auto text = out.finish();
  if (!text) return;
  if (delay_s <= 0.0) return queue(client, *text);
  late_acks_.push_back({due, client.id, std::string{*text}});
}

void SandsharkFrontseat::sendLateAcks() {
  const auto send = [this](const LateAck& ack) {
    if (ack.due > now()) return false;
    if (Client* client = find(ack.client)) queue(*client, ack.sentence);
    return true;
  };
  late_acks_.erase(std::remove_if(late_acks_.begin(), late_acks_.end(), send), late_acks_.end());
}

bool SandsharkFrontseat::backseatSteers() const {
  return backseat_in_control_ && change_ &&
         now() - change_->received < std::chrono::duration<double>(kChangeHolds_s);
}

void SandsharkFrontseat::control(double dt_s) {
  const bool held = backseatSteers() && change_->wanted.horizontal;
  mission_.step(dt_s, torpedo_.state(), held);
  updateControl();
  const Setpoint setpoint = mission_.setpoint(torpedo_.state());
  torpedo_.command(
      steer(backseatSteers() ? modified(setpoint) : setpoint, torpedo_.state(), settings_.limits));
}

Setpoint SandsharkFrontseat::modified(Setpoint setpoint) const {
  const BehaviorChange& wanted = change_->wanted;
  if (wanted.horizontal) {
    setpoint.horizontal_mode =
        wanted.horizontal_mode.value_or(BehaviorChange::HorizontalMode::Heading);
    const bool heading = setpoint.horizontal_mode == BehaviorChange::HorizontalMode::Heading;
    setpoint.horizontal_deg =
        *wanted.horizontal + (heading ? gridConvergenceDeg(torpedo_.position()) : 0.0);
  }
  if (wanted.vertical) {
    setpoint.vertical = *wanted.vertical;
    setpoint.vertical_mode = *wanted.vertical_mode;
  }
  if (wanted.speed) {
    setpoint.speed = *wanted.speed;
    setpoint.speed_mode = *wanted.speed_mode;
  }
  return setpoint;
}

void SandsharkFrontseat::updateControl() {
  const bool in_control = dynamic_requests_ && mission_.state() == Mission::State::Running;
  if (in_control == backseat_in_control_) return;
  backseat_in_control_ = in_control;
  change_.reset();
  bluefin::BackseatControl message;
  message.sent_at = stamp(now());
  message.backseat_in_control = in_control;
  broadcast(bit("CTL"), "BF", message);
}

void SandsharkFrontseat::say() {
  sendLateAcks();
  sayMission();
  sayBehavior();
}

void SandsharkFrontseat::sayMission() {
  if (mission_.state() == said_state_) return;
  said_state_ = mission_.state();
  const std::string status = mission_.status();
  broadcast(bit("MIS"), "BF", missionStatus(status));
}

bluefin::MissionStatus SandsharkFrontseat::missionStatus(const std::string& status) const {
  bluefin::MissionStatus message;
  message.sent_at = stamp(now());
  message.dive_file = mission_.plan().dive_file;
  if (!config().quirks.blank_mission_status) message.status = status;
  message.details = mission_.details();
  return message;
}

void SandsharkFrontseat::sayBehavior() {
  if (mission_.leg() == said_leg_) return;
  const std::size_t ended = said_leg_;
  said_leg_ = mission_.leg();
  const auto fill = [this](auto message) {
    message.sent_at = stamp(now());
    message.dive_file = mission_.plan().dive_file;
    message.behavior_type = "waypoint";
    return message;
  };
  const std::size_t legs = mission_.plan().legs.size();
  if (ended < legs) broadcast(bit("MBE"), "BF", fill(bluefin::BehaviorEnd{}));
  if (said_leg_ < legs) broadcast(bit("MBS"), "BF", fill(bluefin::BehaviorBegin{}));
}

}  // namespace frontseat_driver::sim
