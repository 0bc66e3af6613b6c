#include "frontseat_driver/session/nmea_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frontseat_driver/session/sentence_text.h"
#include "frontseat_driver/session/to_vehicle.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::session {

namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using vehicle::Acknowledgement;

constexpr auto kDialectPatience = 2s;
constexpr std::string_view kAck = "ACK";
constexpr std::string_view kAll = "ALL";

constexpr const char* kNoConnection = "there is no connection to the vehicle";
constexpr const char* kLeaving = "the driver is stopping";
constexpr const char* kRecord = "a record is being played";
constexpr const char* kStoodStill = "it may have come long ago, while the driver stood still";
constexpr const char* kUnfilled =
    "what it leaves alone of heading, depth and speed is not known, and parameter "
    "fill_behavior_fields needs it";

// Before a link that takes nothing is offered the next sentence; spacing may be zero.
constexpr std::chrono::milliseconds kOfferAgain = 5ms;

// To read all that came while the process stood still.
constexpr auto kWakingUp = 200ms;

// Spacing longer than this must not keep the last zero thrust from being sent: see driver::Driver.
constexpr auto kLastWordsWait = 30ms;

// Acknowledgements first, so that the other requests are acknowledged (SPI 0.1, section 7.1).
std::vector<LogSwitch> firstLogRequests(const NmeaOptions& options) {
  std::vector<LogSwitch> requests;
  if (options.use_acks) requests.push_back({std::string{kAck}, true});
  for (const std::string& sentence : options.log_sentences) {
    if (sentence != kAck) requests.push_back({sentence, true});
  }
  return requests;
}

// A day at most: what is slower still does not fit into nanoseconds.
std::chrono::nanoseconds periodOf(double rate_hz) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds kDay{86400.0};
  const Seconds period = std::min(Seconds{1.0 / rate_hz}, kDay);
  return std::chrono::duration_cast<std::chrono::nanoseconds>(period);
}

vehicle::Event toEvent(const ControlState& state) {
  return vehicle::Control{state.grant, state.commands_enabled, state.commanding, state.reason};
}

std::string otherDialect(Dialect command, Dialect vehicle) {
  return std::string{"it is for a "} + protocol::toString(command) + ", and the vehicle is a " +
         protocol::toString(vehicle);
}

bool isRefusal(const Acknowledgement& ack) {
  return ack.command == protocol::bluefin::BehaviorChange::kFormatter &&
         (ack.status == Acknowledgement::Status::Invalid ||
          ack.status == Acknowledgement::Status::Failed);
}

bool isLogName(const std::string& name) {
  return name.size() == 3 && !holdsCommand(name) &&
         std::all_of(name.begin(), name.end(), [](char letter) {
           return (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
         });
}

// Of the others the driver checks every part before.
std::string unsendable(const Request& request) {
  if (const auto* raw = std::get_if<RawSentence>(&request)) return rawRefusal(raw->body);
  const auto* abort = std::get_if<AbortRequest>(&request);
  return abort ? lengthRefusal("reason", abort->reason) : "the sentence cannot be written";
}

std::string_view formatterOf(const Request& request) {
  if (std::holds_alternative<AbortRequest>(request)) {
    return protocol::bluefin::AbortMission::kFormatter;
  }
  if (std::holds_alternative<LogSwitch>(request)) return protocol::bluefin::LogRequest::kFormatter;
  return protocol::bluefin::BehaviorChange::kFormatter;
}

}  // namespace

NmeaSession::NmeaSession(NmeaOptions options)
    : options_(std::move(options)),
      log_requests_(firstLogRequests(options_)),
      use_acks_(options_.use_acks),
      permission_(options_.control_hook, options_.commands_enabled),
      slot_(options_.command_timeout, periodOf(options_.command_rate_hz)),
      requests_(options_.ack_timeout),
      acks_(std::max<std::chrono::nanoseconds>(10s, options_.ack_timeout)),
      effect_(options_.effect_timeout) {}

// --- The connection ---

void NmeaSession::connected(const Now& now, Output& out) {
  connected_ = true;
  confirmed_ = false;
  version_sent_ = false;
  command_was_last_ = false;
  next_send_ = now.steady;
  permission_.connected();
  if (!options_.listen_only) handshake_due_ = now.steady + kDialectPatience;
  if (options_.dialect) learnDialect(now, *options_.dialect, out);
  reportControl(now, out);
}

void NmeaSession::disconnected(const Now& now, Output& out) {
  connected_ = false;
  dialect_.reset();
  handshake_due_ = SteadyTime::max();
  status_due_ = SteadyTime::max();
  framer_.reset();
  emptySlot();
  zero_due_ = false;
  effect_.clear();
  acks_.clear();
  last_refusal_.reset();
  present_ = {};
  permission_.disconnected();
  requests_.failAll("the connection was lost before the vehicle answered");
  reportControl(now, out);
}

void NmeaSession::stoodStill(const Now& now, Output& out) {
  awake_since_ = now.steady + kWakingUp;
  endCommanding(now, out);
}

void NmeaSession::leave(const Now& now, Output& out) {
  endCommanding(now, out);
  leaving_ = true;
  if (!connected_) zero_due_ = false;
  next_send_ = std::min(next_send_, now.steady + kLastWordsWait);
  handshake_due_ = SteadyTime::max();
  status_due_ = SteadyTime::max();
  requests_.failAll(kLeaving);
}

void NmeaSession::learnDialect(const Now& now, Dialect dialect, Output& out) {
  dialect_ = dialect;
  permission_.setDialect(dialect);
  next_log_request_ = 0;
  const bool speaks = dialect == Dialect::Sandshark && !options_.listen_only && !leaving_;
  handshake_due_ = speaks ? std::max(now.steady, next_send_) : SteadyTime::max();
  status_due_ = speaks && options_.status_rate_hz > 0.0 ? now.steady : SteadyTime::max();
  reportControl(now, out);
}

// --- What the vehicle says ---

void NmeaSession::receive(const Now& now, std::string_view bytes, Output& out) {
  framer_.feed(bytes, [&](std::string_view line) { hear(now, line, out); });
}

void NmeaSession::hear(const Now& now, std::string_view line, Output& out) {
  out.heard(now, line);
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  if (!sentence) return count(sentence.failure());
  if (!std::exchange(confirmed_, true)) out.confirmed();
  if (take(now, *sentence, out)) counters_.decoded_bytes += line.size();
}

bool NmeaSession::take(const Now& now, const nmea::Sentence& sentence, Output& out) {
  const auto spoken = protocol::dialectOf(sentence.talker());
  if (spoken && connected_ && !dialect_) learnDialect(now, *spoken, out);
  if (spoken && spoken != dialect_) {
    ++counters_.unknown;
    ++counters_.other_dialect;
    return false;
  }
  const auto reading = protocol::decode(sentence);
  if (!reading) {
    count(reading.failure());
    return false;
  }
  ++counters_.decoded;
  counters_.bad_fields += static_cast<std::uint64_t>(reading->faults.count);
  // A GPS receiver's sentences go by its own clock.
  const auto sent_at = spoken ? sentAt(reading->message) : std::nullopt;
  if (sent_at) out.event(now, vehicle::ClockSample{*sent_at});
  takeMessage(now, *reading, out);
  return true;
}

void NmeaSession::takeMessage(const Now& now, const protocol::Reading& reading, Output& out) {
  const protocol::Message& message = reading.message;
  auto event = toVehicle(message);
  if (event) {
    if (auto* ack = std::get_if<Acknowledgement>(&*event)) takeAcknowledgement(now, *ack);
    takeMotion(now, *event);
    out.event(now, *event);
  }
  if (const auto* control = std::get_if<protocol::bluefin::BackseatControl>(&message)) {
    const bool unreadable = !control->backseat_in_control && reading.faults.count > 0;
    if (unreadable) permission_.takeUnreadableControl();
    permission_.take(*control);
    permissionChanged(now, out);
  } else if (const auto* mission = std::get_if<protocol::bluefin::MissionStatus>(&message)) {
    permission_.take(toVehicle(*mission).state);
    permissionChanged(now, out);
  }
}

void NmeaSession::takeAcknowledgement(const Now& now, Acknowledgement& ack) {
  const auto sent = acks_.match(ack, now.steady);
  if (!sent) return;
  ack.round_trip = now.steady - sent->at;
  if (sent->request != AckTracker::kNoRequest) return requests_.take(sent->request, ack);
  if (isRefusal(ack)) last_refusal_ = {now.steady, finalWords(ack)};
}

void NmeaSession::takeMotion(const Now& now, const vehicle::Event& event) {
  if (const auto* navigation = std::get_if<vehicle::Navigation>(&event)) {
    present_.heading_deg = navigation->heading_deg;
    present_.depth_m = navigation->depth_m;
    navigation_at_ = now.steady;
  } else if (const auto* velocity = std::get_if<vehicle::Velocity>(&event)) {
    present_.speed_m_s.reset();
    if (velocity->east_m_s && velocity->north_m_s) {
      present_.speed_m_s = std::hypot(*velocity->east_m_s, *velocity->north_m_s);
    }
    velocity_at_ = now.steady;
  } else {
    return;
  }
  if (slot_.occupied()) effect_.measured(present(now), now.steady);
}

PresentState NmeaSession::present(const Now& now) const {
  PresentState fresh = present_;
  if (now.steady - navigation_at_ > options_.max_data_age) {
    fresh.heading_deg.reset();
    fresh.depth_m.reset();
  }
  if (now.steady - velocity_at_ > options_.max_data_age) fresh.speed_m_s.reset();
  return fresh;
}

void NmeaSession::count(const nmea::Failure& failure) {
  switch (failure.fault) {
    case nmea::Fault::BadChecksum:
      ++counters_.bad_checksums;
      break;
    case nmea::Fault::UnknownType:
      ++counters_.unknown;
      break;
    default:
      ++counters_.bad_frames;
  }
}

// --- What the user wants ---

std::string NmeaSession::command(const Now& now, const vehicle::Command& command,
                                 SteadyTime received, Output& out) {
  std::string refusal = refusalOf(now, command);
  if (refusal.empty()) refusal = refusalOf(now, received);
  if (!refusal.empty()) {
    countRefusedCommands(now, 1, refusal);
    return refusal;
  }
  slot_.put(command, received);
  effect_.commanded(command, present(now), now.steady);
  reportControl(now, out);
  return {};
}

void NmeaSession::countRefusedCommands(const Now& now, std::uint64_t count, std::string words) {
  counters_.refused_commands += count;
  last_refused_command_ = {now.steady, std::move(words)};
}

std::string NmeaSession::refusalOf(const Now& now, const vehicle::Command& command) const {
  if (leaving_) return kLeaving;
  if (options_.listen_only) return kRecord;
  const ControlState control = permission_.state();
  if (!control.reason.empty()) return std::string{control.reason};
  if (dialectOf(command) != *dialect_) return otherDialect(dialectOf(command), *dialect_);
  if (!canBeSent(command, options_.format, present(now))) return kUnfilled;
  return {};
}

// What a callback that was held up brings is older than it looks.
std::string NmeaSession::refusalOf(const Now& now, SteadyTime received) const {
  if (received < permitted_since_) return "it is from before the last stop, abort or permission";
  if (received < awake_since_) return kStoodStill;
  if (now.steady - received >= options_.command_timeout) {
    return "it waited in this computer for longer than command_timeout";
  }
  return {};
}

void NmeaSession::stop(const Now& now, Output& out) {
  endEverything(now, "commanding was stopped before it could be sent", out);
  zero_due_ = connected_ && isBoat() && !options_.listen_only && !hasLeft();
}

void NmeaSession::setCommandsEnabled(const Now& now, bool enabled, Output& out) {
  permission_.setCommandsEnabled(enabled);
  permissionChanged(now, out);
}

void NmeaSession::permissionChanged(const Now& now, Output& out) {
  if (!permission_.granted()) {
    requests_.failUnsentBehaviors(std::string{permission_.state().reason});
    endCommanding(now, out);
  }
  reportControl(now, out);
}

// Also what waits to be sent, or for the driver to come to it.
void NmeaSession::endEverything(const Now& now, const char* why, Output& out) {
  requests_.failUnsentCommands(why);
  permitted_since_ = now.steady;
  endCommanding(now, out);
}

void NmeaSession::endCommanding(const Now& now, Output& out) {
  if (!slot_.occupied()) return;
  emptySlot();
  effect_.clear();
  zero_due_ = isBoat();
  reportControl(now, out);
}

void NmeaSession::emptySlot() {
  slot_.clear();
  held_back_since_.reset();
}

void NmeaSession::request(const Now& now, Request request, Respond respond, Output& out) {
  std::string note;
  if (auto* abort = std::get_if<AbortRequest>(&request)) {
    const auto text = toSentenceText(abort->reason);
    if (!text) {
      return respond({false, refuseAbort(now, textRefusal("reason", abort->reason), out)});
    }
    abort->reason = text->text;
    if (text->lowered) note = "the reason was sent in lower case: it held a command's name";
  }
  const std::string refusal = refusalOf(request, now);
  const auto* log = std::get_if<LogSwitch>(&request);
  const bool remembered = log && isLogName(log->sentence) && !isBoat();
  if (remembered) remember(*log);
  const bool is_abort = std::holds_alternative<AbortRequest>(request);
  if (!refusal.empty() && is_abort) return respond({false, refuseAbort(now, refusal, out)});
  if (!refusal.empty()) {
    const bool later = remembered && !connected_;
    return respond({false, later ? refusal + "; it will be asked for when there is" : refusal});
  }
  if (is_abort) endEverything(now, "the mission was aborted before it could be sent", out);
  requests_.add(std::move(request), std::move(note), std::move(respond), now.steady);
}

// A boat has no mission to abort, but who asks for it does not want it to go on.
std::string NmeaSession::refuseAbort(const Now& now, const std::string& refusal, Output& out) {
  if (!isBoat()) return refusal;
  const bool commanded = slot_.occupied();
  endEverything(now, "an abort came before it could be sent", out);
  return commanded ? refusal + "; commanding has ended" : refusal;
}

std::string NmeaSession::refusalOf(const Request& request, const Now& now) const {
  if (leaving_) return kLeaving;
  if (const auto* log = std::get_if<LogSwitch>(&request); log && !isLogName(log->sentence)) {
    return "sentence is '" + log->sentence +
           "'; three capital letters such as NVG, or ALL, are accepted (RMB, LOG, ABT, STS and VER "
           "are commands)";
  }
  const auto sentence = sentenceFor(request, now).finish();
  if (!sentence || sentence->size() > kMostBytesSent) return unsendable(request);
  if (!connected_) return kNoConnection;
  if (options_.listen_only) return kRecord;
  const bool abort = std::holds_alternative<AbortRequest>(request);
  const bool log = std::holds_alternative<LogSwitch>(request);
  if (now.steady < awake_since_ && !abort && !log) return kStoodStill;
  if (requests_.full() && !abort) return "too many requests are waiting for the vehicle";
  if (std::holds_alternative<RawSentence>(request)) return {};
  // A boat ignores an abort, so it may go out before the dialect is known.
  if (!dialect_ && abort) return {};
  if (!dialect_) return "the vehicle has not shown its dialect yet; parameter dialect sets it";
  if (isBoat()) return otherDialect(Dialect::Sandshark, *dialect_);
  if (const auto* behavior = std::get_if<vehicle::BehaviorCommand>(&request)) {
    return refusalOf(now, *behavior);
  }
  return {};
}

// A handshake under way starts again: asking twice does no harm, leaving one out would. What is off
// need not be said on a new connection, unless ALL turned it on before.
void NmeaSession::remember(const LogSwitch& log) {
  const bool all_asked = next_log_request_ == log_requests_.size();
  const bool about_all = log.sentence == kAll;
  const auto replaced = [&](const LogSwitch& one) {
    return one.sentence == log.sentence || (about_all && one.sentence != kAck);
  };
  log_requests_.erase(std::remove_if(log_requests_.begin(), log_requests_.end(), replaced),
                      log_requests_.end());
  const bool all_on = std::any_of(log_requests_.begin(), log_requests_.end(),
                                  [](const LogSwitch& one) { return one.sentence == kAll; });
  if (log.sentence == kAck) use_acks_ = log.enable;
  if (log.sentence == kAck && log.enable) {
    log_requests_.insert(log_requests_.begin(), log);
  } else if (log.enable || all_on) {
    log_requests_.push_back(log);
  }
  next_log_request_ = all_asked ? log_requests_.size() : 0;
}

std::string NmeaSession::setPayloadStatus(const Now& now, const vehicle::PayloadStatus& status) {
  const auto text = toSentenceText(status.message);
  if (!text) return textRefusal("message", status.message);
  protocol::bluefin::PayloadStatus sentence;
  sentence.sent_at = vehicle::timeOfDay(now.utc);
  sentence.ok = status.ok;
  sentence.message = text->text;
  nmea::SentenceWriter writer = protocol::write(sentence);
  const auto line = writer.finish();
  if (!line || line->size() > kMostBytesSent) {
    return lengthRefusal("message", status.message);
  }
  payload_status_ = {status.ok, text->text};
  const bool speaks = dialect_ == Dialect::Sandshark && !options_.listen_only && !leaving_;
  if (speaks) status_due_ = now.steady;
  return {};
}

// --- What goes out ---

void NmeaSession::step(const Now& now, Output& out) {
  if (!reported_control_) reportControl(now, out);
  if (slot_.stale(now.steady)) endCommanding(now, out);
  for (const RequestQueue::Id id : requests_.expire(now.steady)) acks_.forget(id);
  if (connected_ && now.steady >= next_send_) sendWhatIsDue(now, out);
}

// One sentence at a time: next_send_ then holds the others back.
void NmeaSession::sendWhatIsDue(const Now& now, Output& out) {
  if (sendUrgent(now, out)) return;
  if (command_was_last_ && sendOther(now, out)) return;
  if (sendCommand(now, out)) return;
  sendOther(now, out);
}

bool NmeaSession::sendUrgent(const Now& now, Output& out) {
  if (zero_due_) {
    zero_due_ = !send(now, zeroThrust(), out);
    if (!zero_due_) held_back_since_.reset();
    return true;
  }
  const auto* abort = requests_.dueAbort(now.steady);
  return abort && sendRequest(now, *abort, out);
}

bool NmeaSession::sendCommand(const Now& now, Output& out) {
  const vehicle::Command* command = slot_.due(now.steady);
  if (!command || !permission_.granted()) return false;
  if (out.congested()) {
    holdBack(now);
    slot_.putOff(now.steady + std::max(sendSpacing(), kOfferAgain));
    return false;
  }
  if (!canBeSent(*command, options_.format, present(now))) {
    endCommanding(now, out);
    return false;
  }
  command_was_last_ = true;
  const auto time = vehicle::timeOfDay(now.utc);
  if (!send(now, commandSentence(*command, options_.format, present(now), time), out)) return true;
  slot_.sent(now.steady);
  held_back_since_.reset();
  if (!isBoat() && use_acks_) {
    acks_.sent(
        {protocol::bluefin::BehaviorChange::kFormatter, time, AckTracker::kNoRequest, now.steady});
  }
  return true;
}

bool NmeaSession::sendOther(const Now& now, Output& out) {
  command_was_last_ = false;
  if (now.steady >= handshake_due_) return sendHandshake(now, out);
  const auto* open = requests_.dueOther(now.steady);
  if (open) return sendRequest(now, *open, out);
  return now.steady >= status_due_ && sendStatus(now, out);
}

bool NmeaSession::sendHandshake(const Now& now, Output& out) {
  if (!version_sent_) {
    protocol::bluefin::PayloadVersion version;
    version.sent_at = vehicle::timeOfDay(now.utc);
    version.version = options_.interface_version;
    version_sent_ = send(now, protocol::write(version), out);
  } else if (next_log_request_ < log_requests_.size()) {
    const LogSwitch& log = log_requests_[next_log_request_];
    protocol::bluefin::LogRequest request;
    request.sentence = log.sentence;
    request.on = log.enable;
    if (send(now, protocol::write(request), out)) {
      ++next_log_request_;
      if (isAcknowledged(log)) {
        acks_.sent({protocol::bluefin::LogRequest::kFormatter, std::nullopt, AckTracker::kNoRequest,
                    now.steady});
      }
    }
  }
  const bool more = !version_sent_ || (dialect_ && next_log_request_ < log_requests_.size());
  if (!more) handshake_due_ = SteadyTime::max();
  return true;
}

bool NmeaSession::sendRequest(const Now& now, const RequestQueue::Open& open, Output& out) {
  const auto* behavior = std::get_if<vehicle::BehaviorCommand>(&open.request);
  if (behavior && !canBeSent(*behavior, options_.format, present(now))) {
    requests_.failUnsentBehaviors(kUnfilled);
    return false;
  }
  if (!send(now, sentenceFor(open.request, now), out)) return true;
  const bool raw = std::holds_alternative<RawSentence>(open.request);
  const auto* log = std::get_if<LogSwitch>(&open.request);
  const bool acknowledged = log ? isAcknowledged(*log) : use_acks_ && !raw;
  if (acknowledged) {
    const auto time = !log ? std::optional{vehicle::timeOfDay(now.utc)} : std::nullopt;
    acks_.sent({formatterOf(open.request), time, open.id, now.steady});
  }
  requests_.sent(open.id, now.steady, acknowledged);
  return true;
}

// A field Sandshark does not acknowledge that it is to acknowledge.
bool NmeaSession::isAcknowledged(const LogSwitch& log) const {
  return use_acks_ && log.sentence != kAck;
}

nmea::SentenceWriter NmeaSession::sentenceFor(const Request& request, const Now& now) const {
  const auto time = vehicle::timeOfDay(now.utc);
  if (const auto* abort = std::get_if<AbortRequest>(&request)) {
    protocol::bluefin::AbortMission sentence;
    sentence.sent_at = time;
    sentence.message = abort->reason;
    sentence.with_errors = abort->with_errors;
    return protocol::write(sentence);
  }
  if (const auto* log = std::get_if<LogSwitch>(&request)) {
    protocol::bluefin::LogRequest sentence;
    sentence.sentence = log->sentence;
    sentence.on = log->enable;
    return protocol::write(sentence);
  }
  if (const auto* raw = std::get_if<RawSentence>(&request)) return rawSentence(raw->body);
  return commandSentence(std::get<vehicle::BehaviorCommand>(request), options_.format, present(now),
                         time);
}

bool NmeaSession::sendStatus(const Now& now, Output& out) {
  protocol::bluefin::PayloadStatus status;
  status.sent_at = vehicle::timeOfDay(now.utc);
  status.ok = payload_status_.ok;
  status.message = payload_status_.message;
  if (!send(now, protocol::write(status), out)) return true;
  const bool again = options_.status_rate_hz > 0.0;
  status_due_ = again ? now.steady + periodOf(options_.status_rate_hz) : SteadyTime::max();
  if (use_acks_) {
    acks_.sent({protocol::bluefin::PayloadStatus::kFormatter, status.sent_at,
                AckTracker::kNoRequest, now.steady});
  }
  return true;
}

bool NmeaSession::send(const Now& now, nmea::SentenceWriter sentence, Output& out) {
  next_send_ = now.steady + sendSpacing();
  const auto line = sentence.finish();
  if (!line || !out.send(now, *line)) {
    next_send_ = now.steady + std::max(sendSpacing(), kOfferAgain);
    holdBack(now);
    return false;
  }
  ++counters_.sentences_sent;
  counters_.bytes_sent += line->size();
  return true;
}

// Whatever the link did not take, a command that is due waits behind it.
void NmeaSession::holdBack(const Now& now) {
  const bool waits = zero_due_ || slot_.due(now.steady);
  if (waits && !held_back_since_) held_back_since_ = now.steady;
}

SteadyTime NmeaSession::nextStep() const {
  if (!reported_control_) return SteadyTime::min();
  return std::min({slot_.staleAt(), requests_.nextDeadline(), nextSend()});
}

SteadyTime NmeaSession::nextSend() const {
  if (!connected_) return SteadyTime::max();
  if (zero_due_) return next_send_;
  const SteadyTime due =
      std::min({slot_.nextDue(), requests_.nextDue(), handshake_due_, status_due_});
  return std::max(due, next_send_);
}

// --- Reports ---

ControlState NmeaSession::control() const {
  ControlState state = permission_.state();
  if (options_.listen_only) state.reason = kRecord;
  state.commanding = slot_.occupied();
  return state;
}

void NmeaSession::reportControl(const Now& now, Output& out) {
  const ControlState state = control();
  const bool permitted = state.reason.empty();
  if (permitted && !permitted_) permitted_since_ = now.steady;
  permitted_ = permitted;
  if (reported_control_ == state) return;
  reported_control_ = state;
  out.event(now, toEvent(state));
}

std::chrono::milliseconds NmeaSession::sendSpacing() const {
  if (options_.send_spacing) return *options_.send_spacing;
  return isBoat() ? 20ms : 60ms;
}

NmeaCounters NmeaSession::counters() const {
  NmeaCounters counters = counters_;
  const nmea::Framer::Counters& framed = framer_.counters();
  counters.bytes_received = framed.bytes;
  counters.sentences_received = framed.sentences;
  counters.no_sentences = framed.cut_off + framed.noise_lines;
  counters.bad_frames += counters.no_sentences;
  counters.oversized = framed.oversized;
  counters.refused_bytes = framed.sentence_bytes - counters.decoded_bytes + framed.dropped_bytes;
  counters.line_end_bytes = framed.line_end_bytes;
  counters.pending_bytes = framer_.pending();
  return counters;
}

}  // namespace frontseat_driver::session
