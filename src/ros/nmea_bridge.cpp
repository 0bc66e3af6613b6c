#include "nmea_bridge.h"

#include <ros/console.h>

#include <chrono>
#include <utility>

#include "convert.h"

namespace frontseat_driver::ros_layer {

namespace {

session::NmeaOptions sessionOptions(const Parameters& parameters) {
  session::NmeaOptions options = parameters.session;
  options.listen_only = parameters.source == Source::Topic;
  options.command_timeout = parameters.command_timeout;
  options.command_rate_hz = parameters.command_rate_hz;
  options.format.thrust_decimals = parameters.thrust_decimals;
  options.format.yaw_rate_in_degrees = parameters.yaw_rate_unit == YawRateUnit::Deg;
  for (const SpeedPoint& point : parameters.speed_table) {
    options.format.speed_table.push_back({point.speed_m_s, point.rpm});
  }
  options.format.fill_behavior_fields = parameters.fill_behavior_fields;
  options.ack_timeout = parameters.ack_timeout;
  options.effect_timeout = parameters.effect_timeout;
  options.max_data_age = parameters.max_data_age;
  options.status_rate_hz = parameters.status_rate_hz;
  return options;
}

void log(const std::string& name, const TransitionLog::Line& line) {
  switch (line.level) {
    case Diagnosis::Level::Ok:
      ROS_INFO("%s: %s", name.c_str(), line.text.c_str());
      break;
    case Diagnosis::Level::Warn:
      ROS_WARN("%s: %s", name.c_str(), line.text.c_str());
      break;
    case Diagnosis::Level::Error:
      ROS_ERROR("%s: %s", name.c_str(), line.text.c_str());
      break;
  }
}

std::string withAdvice(const std::string& reason) {
  const std::string advice = linkAdvice(reason);
  return advice.empty() ? reason : reason + "; " + advice;
}

}  // namespace

NmeaBridge::NmeaBridge(ros::NodeHandle node, ros::NodeHandle private_node, std::string name,
                       const Parameters& parameters)
    : name_(std::move(name)),
      session_(sessionOptions(parameters)),
      publisher_(node, parameters),
      diagnostics_(node, private_node, name_),
      monitor_(parameters, session_),
      compass_check_(parameters) {
  reportHealth(clocks_.read());
  driver::Listener& listener = *this;
  if (parameters.source == Source::Topic) {
    replay_ = std::make_unique<Replay>(session_, listener,
                                       [this](Restart what) { startRecordAgain(what); });
  } else {
    driver_ = std::make_unique<driver::Driver>(parameters.link, session_, listener,
                                               [this] { return clocks_.read(); });
  }
  const auto post_task = [this](SessionTask task) { post(std::move(task)); };
  input_ = std::make_unique<CommandInput>(node, name_, parameters, session_, publisher_, post_task);
  services_ = std::make_unique<CommandServices>(node, parameters, session_, publisher_, post_task);
  subscribers_ = std::make_unique<ExpectedSubscribers>(node, publisher_.publishers(), [=] {
    if (driver_) driver_->start();
    if (replay_) replay_->start(node);
  });
}

// The driver first: taking back topics and services waits for the master, which may be silent.
// Tasks refer to the input and the services, so these stay until no task can run any more.
NmeaBridge::~NmeaBridge() {
  subscribers_->close();
  if (driver_) driver_->stop();
  services_->close();
  input_->close();
  if (replay_) replay_->close();
}

void NmeaBridge::post(SessionTask task) {
  if (replay_) return replay_->post(task);
  driver_->post(
      [this, task = std::move(task)](const vehicle::Now& now) { task(now, driver_->output()); });
}

void NmeaBridge::startRecordAgain(Restart what) {
  if (what == Restart::Driver) {
    publisher_.startAfresh();
  } else {
    publisher_.reset();
  }
  last_heard_.reset();
  jump_log_ = {};
  connect_log_ = {};
  disconnect_log_ = {};
  failure_log_ = {};
  transitions_ = {};
}

// A record is a record: what is replayed keeps its name.
const std::string& NmeaBridge::connection() const {
  return replay_ ? replay_->connection() : connection_;
}

void NmeaBridge::onConnected(const vehicle::Now& now, const std::string& endpoint) {
  monitor_.connected(now, endpoint);
  ++connects_;
  // Each run of a driver counts from 1, so its begin tells two runs in one record apart.
  connection_ = printed("connection_%u@%.3f", connects_, inSeconds(started_));
  connected_ = true;
  logged_failure_.clear();
  if (connect_log_.passes(now.steady)) {
    ROS_INFO("%s: connected to %s%s", name_.c_str(), endpoint.c_str(),
             connect_log_.repeats().c_str());
  }
  publishLink(now);
}

void NmeaBridge::onDisconnected(const vehicle::Now& now, const std::string& reason) {
  if (disconnect_log_.passes(now.steady)) {
    ROS_WARN("%s: disconnected from %s: %s%s", name_.c_str(), monitor_.endpoint().c_str(),
             withAdvice(reason).c_str(), disconnect_log_.repeats().c_str());
  }
  monitor_.disconnected(now, reason);
  connected_ = false;
  followed_dialect_.reset();
  publishLink(now);
}

void NmeaBridge::onConnectFailed(const vehicle::Now& now, const std::string& reason,
                                 std::chrono::milliseconds retry_in) {
  monitor_.connectFailed(reason);
  ROS_DEBUG("%s: %s; next try in %.1f s", name_.c_str(), reason.c_str(), inSeconds(retry_in));
  if (reason == logged_failure_ || !failure_log_.passes(now.steady)) return;
  logged_failure_ = reason;
  ROS_WARN("%s: cannot connect to the vehicle at %s: %s; trying again until it answers",
           name_.c_str(), monitor_.endpoint().c_str(), withAdvice(reason).c_str());
  publishLink(now);
}

void NmeaBridge::onHeard(const vehicle::Now& now, std::string_view line) {
  last_heard_ = now.steady;
  monitor_.heard(now, line);
  publisher_.publishReceived(now, connection(), line);
}

void NmeaBridge::onSent(const vehicle::Now& now, std::string_view line) {
  publisher_.publishSent(now, connection(), line);
}

void NmeaBridge::onEvent(const vehicle::Now& now, const vehicle::Event& event) {
  followDialect();
  monitor_.event(now, event);
  publisher_.publish(now, event);
  watchCompass(now, event);
}

void NmeaBridge::onTick(const vehicle::Now& now) {
  warnOfJumps(now);
  publishLink(now);
  const Health health = reportHealth(now);
  for (const auto& line : transitions_.take(diagnose(health), now.steady)) log(name_, line);
}

// The publisher's defaults follow the dialect, so it must know before it sees the first event.
void NmeaBridge::followDialect() {
  const auto dialect = session_.dialect();
  if (!dialect || dialect == followed_dialect_) return;
  followed_dialect_ = dialect;
  publisher_.setDialect(*dialect);
  ROS_INFO("%s: the vehicle speaks the %s dialect", name_.c_str(), protocol::toString(*dialect));
}

void NmeaBridge::watchCompass(const vehicle::Now& now, const vehicle::Event& event) {
  if (const auto* navigation = std::get_if<vehicle::Navigation>(&event)) {
    compass_check_.take(*navigation, now.steady);
  } else if (const auto* compass = std::get_if<vehicle::Compass>(&event)) {
    const std::string disagreement = compass_check_.take(*compass, now.steady);
    if (!disagreement.empty()) ROS_WARN("%s: %s", name_.c_str(), disagreement.c_str());
  }
}

void NmeaBridge::warnOfJumps(const vehicle::Now& now) {
  const std::uint64_t jumps = publisher_.builder().jumps();
  if (jumps == jumps_warned_ || !jump_log_.passes(now.steady)) return;
  ROS_WARN(
      "%s: dropped %lu position(s) too far from the last one, the latest by %.1f m; parameter "
      "max_jump sets the limit",
      name_.c_str(), static_cast<unsigned long>(jumps - jumps_warned_),
      publisher_.builder().latestJump_m());
  jumps_warned_ = jumps;
}

void NmeaBridge::publishLink(const vehicle::Now& now) {
  const session::NmeaCounters counters = session_.counters();
  LinkStatus status;
  status.header.stamp = toRosTime(now.stamp);
  status.connected = connected_;
  status.endpoint = monitor_.endpoint();
  const auto dialect = session_.dialect();
  status.dialect = dialect ? protocol::toString(*dialect) : "";
  status.connects = connects_;
  status.bytes_received = counters.bytes_received;
  status.bytes_sent = counters.bytes_sent;
  status.sentences_received = counters.sentences_received;
  status.sentences_sent = counters.sentences_sent;
  status.bad_checksums = counters.bad_checksums;
  status.malformed = counters.bad_frames + counters.bad_fields;
  status.unknown = counters.unknown;
  status.oversized = counters.oversized;
  status.refused_commands = counters.refused_commands;
  if (last_heard_) status.since_received.fromNSec((now.steady - *last_heard_).count());
  publisher_.publishLink(status);
}

Health NmeaBridge::reportHealth(const vehicle::Now& now) {
  Health health = monitor_.take(now, publisher_.builder(), publisher_.takeHeldBack());
  health.clock.simulated_behind_s = inSeconds(clocks_.simulatedBehind());
  // The timer that publishes it goes by the steady clock, also while a record is played.
  diagnostics_.set(health, std::chrono::steady_clock::now());
  return health;
}

}  // namespace frontseat_driver::ros_layer
