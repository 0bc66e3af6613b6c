#include "frontseat_driver/session/nmea_session.h"

#include <algorithm>
#include <utility>

#include "frontseat_driver/session/to_vehicle.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::session {

namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

constexpr auto kDialectPatience = 2s;
constexpr std::string_view kAck = "ACK";

// Acknowledgements first, so that the other requests are acknowledged (SPI 0.1, section 7.1).
std::vector<std::string> logRequests(const NmeaOptions& options) {
  std::vector<std::string> requests;
  if (options.use_acks) requests.emplace_back(kAck);
  for (const std::string& sentence : options.log_sentences) {
    if (sentence != kAck) requests.push_back(sentence);
  }
  return requests;
}

vehicle::Event toEvent(const ControlState& state) {
  return vehicle::Control{state.grant, state.commands_enabled, state.commanding, state.reason};
}

}  // namespace

NmeaSession::NmeaSession(NmeaOptions options)
    : options_(std::move(options)),
      log_requests_(logRequests(options_)),
      permission_(options_.control_hook, options_.commands_enabled) {}

void NmeaSession::connected(const Now& now, Output& out) {
  connected_ = true;
  confirmed_ = false;
  version_sent_ = false;
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
  framer_.reset();
  permission_.disconnected();
  reportControl(now, out);
}

void NmeaSession::receive(const Now& now, std::string_view bytes, Output& out) {
  framer_.feed(bytes, [&](std::string_view line) { hear(now, line, out); });
}

void NmeaSession::hear(const Now& now, std::string_view line, Output& out) {
  out.heard(now, line);
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  if (!sentence) return count(sentence.failure());
  if (!std::exchange(confirmed_, true)) out.confirmed();
  take(now, *sentence, out);
}

void NmeaSession::take(const Now& now, const nmea::Sentence& sentence, Output& out) {
  const auto spoken = protocol::dialectOf(sentence.talker());
  if (spoken && connected_ && !dialect_) learnDialect(now, *spoken, out);
  if (spoken && spoken != dialect_) {
    ++counters_.unknown;
    ++counters_.other_dialect;
    return;
  }
  const auto reading = protocol::decode(sentence);
  if (!reading) return count(reading.failure());
  ++counters_.decoded;
  counters_.bad_fields += static_cast<std::uint64_t>(reading->faults.count);
  takeMessage(now, reading->message, out);
}

void NmeaSession::takeMessage(const Now& now, const protocol::Message& message, Output& out) {
  const auto event = toVehicle(message);
  if (event) out.event(now, *event);
  if (const auto* control = std::get_if<protocol::bluefin::BackseatControl>(&message)) {
    permission_.take(*control);
    reportControl(now, out);
  } else if (const auto* mission = std::get_if<protocol::bluefin::MissionStatus>(&message)) {
    permission_.take(toVehicle(*mission).state);
    reportControl(now, out);
  }
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

void NmeaSession::learnDialect(const Now& now, Dialect dialect, Output& out) {
  dialect_ = dialect;
  permission_.setDialect(dialect);
  next_log_request_ = 0;
  const bool handshake = dialect == Dialect::Sandshark && !options_.listen_only;
  handshake_due_ = handshake ? std::max(now.steady, next_send_) : SteadyTime::max();
  reportControl(now, out);
}

void NmeaSession::step(const Now& now, Output& out) {
  if (!reported_control_) reportControl(now, out);
  if (connected_ && now.steady >= handshake_due_) continueHandshake(now, out);
}

void NmeaSession::continueHandshake(const Now& now, Output& out) {
  bool sent = false;
  if (!version_sent_) {
    protocol::bluefin::PayloadVersion version;
    version.sent_at = vehicle::timeOfDay(now.utc);
    version.version = options_.interface_version;
    sent = version_sent_ = send(now, protocol::write(version), out);
  } else if (next_log_request_ < log_requests_.size()) {
    protocol::bluefin::LogRequest request;
    request.sentence = log_requests_[next_log_request_];
    request.on = true;
    sent = send(now, protocol::write(request), out);
    next_log_request_ += sent ? 1 : 0;
  }
  const bool more = dialect_ && next_log_request_ < log_requests_.size();
  handshake_due_ = more || !sent ? now.steady + sendSpacing() : SteadyTime::max();
}

bool NmeaSession::send(const Now& now, nmea::SentenceWriter sentence, Output& out) {
  next_send_ = now.steady + sendSpacing();
  const auto line = sentence.finish();
  if (!line || !out.send(now, *line)) return false;
  ++counters_.sentences_sent;
  counters_.bytes_sent += line->size();
  return true;
}

SteadyTime NmeaSession::nextStep() const {
  return reported_control_ ? handshake_due_ : SteadyTime::min();
}

void NmeaSession::reportControl(const Now& now, Output& out) {
  const ControlState state = permission_.state();
  if (reported_control_ == state) return;
  reported_control_ = state;
  out.event(now, toEvent(state));
}

std::chrono::milliseconds NmeaSession::sendSpacing() const {
  if (options_.send_spacing) return *options_.send_spacing;
  return dialect_ == Dialect::Kingfisher ? 20ms : 60ms;
}

NmeaCounters NmeaSession::counters() const {
  NmeaCounters counters = counters_;
  const nmea::Framer::Counters& framed = framer_.counters();
  counters.bytes_received = framed.bytes;
  counters.sentences_received = framed.sentences;
  counters.bad_frames += framed.cut_off + framed.noise_lines;
  counters.oversized = framed.oversized;
  return counters;
}

}  // namespace frontseat_driver::session
