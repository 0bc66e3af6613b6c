#include "diagnosis/health_monitor.h"

#include <algorithm>
#include <utility>

#include "command_words.h"

namespace frontseat_driver::ros_layer {

namespace {

using session::NmeaCounters;

NmeaCounters operator-(const NmeaCounters& a, const NmeaCounters& b) {
  NmeaCounters difference;
  difference.bytes_received = a.bytes_received - b.bytes_received;
  difference.bytes_sent = a.bytes_sent - b.bytes_sent;
  difference.sentences_received = a.sentences_received - b.sentences_received;
  difference.sentences_sent = a.sentences_sent - b.sentences_sent;
  difference.decoded = a.decoded - b.decoded;
  difference.bad_checksums = a.bad_checksums - b.bad_checksums;
  difference.bad_frames = a.bad_frames - b.bad_frames;
  difference.no_sentences = a.no_sentences - b.no_sentences;
  difference.bad_fields = a.bad_fields - b.bad_fields;
  difference.unknown = a.unknown - b.unknown;
  difference.other_dialect = a.other_dialect - b.other_dialect;
  difference.oversized = a.oversized - b.oversized;
  difference.refused_commands = a.refused_commands - b.refused_commands;
  return difference;
}

std::string dialectName(const std::optional<protocol::Dialect>& dialect, const char* unknown) {
  return dialect ? protocol::toString(*dialect) : unknown;
}

bool isOwnTalker(const SentenceRates::Rate& rate, protocol::Dialect dialect) {
  const char* talker = dialect == protocol::Dialect::Kingfisher ? "CP" : "BF";
  return rate.address.compare(0, 2, talker) == 0;
}

}  // namespace

HealthMonitor::HealthMonitor(const Parameters& parameters, const session::NmeaSession& session)
    : parameters_(parameters),
      configured_endpoint_(parameters.link.host + ":" + std::to_string(parameters.link.port)),
      session_(session),
      endpoint_(configured_endpoint_),
      batteries_(parameters.battery_low_v) {}

void HealthMonitor::connected(const vehicle::Now& now, const std::string& endpoint) {
  connected_ = true;
  endpoint_ = endpoint;
  connected_at_ = now.steady;
  at_connect_ = session_.counters();
  at_ticks_.fill(at_connect_);
  rates_.reset(now.steady);
  latest_rates_.clear();
  batteries_.clear();
}

void HealthMonitor::disconnected(const vehicle::Now& now, const std::string& reason) {
  losses_.push_back(now.steady);
  other_dialect_before_ = otherDialectOnly();
  connected_ = false;
  failed_ = true;
  last_failure_ = reason;
}

void HealthMonitor::connectFailed(const std::string& reason) {
  endpoint_ = configured_endpoint_;
  failed_ = true;
  last_failure_ = reason;
}

void HealthMonitor::heard(const vehicle::Now& now, std::string_view line) {
  failed_ = false;  // not by a connection alone: a busy Sandshark accepts one and says nothing
  rates_.count(line, now.steady);
}

void HealthMonitor::event(const vehicle::Now& now, const vehicle::Event& event) {
  if (const auto* battery = std::get_if<vehicle::Battery>(&event)) {
    batteries_.take(*battery, now.steady);
  }
}

Health HealthMonitor::take(const vehicle::Now& now, const MessageBuilder& builder,
                           std::chrono::nanoseconds held_back) {
  latest_rates_ = rates_.take(now.steady);
  Health health;
  health.link = link(now);
  health.replay = parameters_.source == Source::Topic;
  health.max_data_age_s = inSeconds(parameters_.max_data_age);
  health.dialect = dialectName(session_.dialect(), "");
  health.parameter_dialect = dialectName(parameters_.session.dialect, "auto");
  health.other_dialect_only = otherDialectOnly();
  health.log_requests = session_.logRequests();
  health.rates = latest_rates_;
  health.counters = session_.counters();
  health.connection = health.counters - at_connect_;
  health.recent = recentCounters();
  health.position_known = builder.positionKnown();
  health.jumps = builder.jumps();
  health.leap_seconds = leapSeconds();
  health.stamp = parameters_.stamp;
  health.clock = clock_.take(now, builder.clock(), health.leap_seconds, held_back);
  if (health.replay) health.clock.ros_clock_stands = false;  // a record may stand still
  health.control = session_.control();
  health.control_hook = parameters_.session.control_hook;
  health.refused_command = recentWords(session_.lastRefusedCommand(), now);
  const auto& commanded = session_.commanded();
  health.commanded = commanded ? toWords(*commanded) : "";
  health.effect_complaint = session_.effectComplaint();
  health.vehicle_refusal = recentWords(session_.lastRefusal(), now);
  const auto& held_back_since = session_.heldBackSince();
  if (held_back_since) health.held_back_s = inSeconds(now.steady - *held_back_since);
  health.unacknowledged = session_.unacknowledged();
  health.batteries = batteries_.take(now.steady);
  health.battery_low_v = parameters_.battery_low_v;
  return health;
}

LinkHealth HealthMonitor::link(const vehicle::Now& now) {
  while (!losses_.empty() && now.steady - losses_.front() > kLately) losses_.pop_front();
  LinkHealth link;
  link.connected = connected_;
  link.failed = failed_;
  link.endpoint = connected_ ? endpoint_ : configured_endpoint_;
  link.last_failure = last_failure_;
  link.losses_lately = losses_.size();
  if (connected_) link.connected_s = inSeconds(now.steady - connected_at_);
  return link;
}

// A Sandshark that is taken for a boat is asked for nothing, says who it is and falls silent: then
// the next connection has yet to show anything.
bool HealthMonitor::otherDialectOnly() const {
  const auto& given = parameters_.session.dialect;
  if (!given) return false;
  const bool own = std::any_of(latest_rates_.begin(), latest_rates_.end(),
                               [&](const auto& rate) { return isOwnTalker(rate, *given); });
  if (own) return false;
  const bool other = session_.counters().other_dialect > at_connect_.other_dialect;
  return other || other_dialect_before_;
}

std::string HealthMonitor::recentWords(const std::optional<session::CommandRefusal>& refusal,
                                       const vehicle::Now& now) const {
  return refusal && now.steady - refusal->at < kRecent ? refusal->words : "";
}

std::chrono::seconds HealthMonitor::leapSeconds() const {
  const bool boat = session_.dialect() == protocol::Dialect::Kingfisher;
  return parameters_.leap_seconds.value_or(std::chrono::seconds{boat ? 18 : 0});
}

session::NmeaCounters HealthMonitor::recentCounters() {
  const NmeaCounters now = session_.counters();
  const NmeaCounters before = std::exchange(at_ticks_[tick_], now);
  tick_ = (tick_ + 1) % at_ticks_.size();
  return now - before;
}

}  // namespace frontseat_driver::ros_layer
