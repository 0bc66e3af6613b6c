#include "nmea_bridge.h"

#include <ros/console.h>

#include <utility>

#include "command_words.h"
#include "convert.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;

constexpr auto kWarnAtMostEvery = 5s;
constexpr auto kRefusalTold = 3s;

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

double seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

NmeaBridge::NmeaBridge(ros::NodeHandle node, ros::NodeHandle private_node, std::string name,
                       const Parameters& parameters)
    : name_(std::move(name)),
      configured_endpoint_(parameters.link.host + ":" + std::to_string(parameters.link.port)),
      configured_leap_seconds_(parameters.leap_seconds),
      session_(sessionOptions(parameters)),
      publisher_(node, parameters),
      diagnostics_(node, private_node, name_, seconds(parameters.max_data_age)),
      compass_check_(parameters) {
  health_.endpoint = configured_endpoint_;
  health_.last_failure = "not tried yet";
  reportHealth(clocks_.read());
  driver::Listener& listener = *this;
  if (parameters.source == Source::Topic) {
    replay_ = std::make_unique<Replay>(session_, listener, [this] { startRecordAgain(); });
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

// Tasks refer to the input and the services, so these stay until no task can run any more.
NmeaBridge::~NmeaBridge() {
  subscribers_->close();
  services_->close();
  input_->close();
  if (driver_) driver_->stop();
  if (replay_) replay_->close();
}

void NmeaBridge::post(SessionTask task) {
  if (replay_) return replay_->post(task);
  driver_->post(
      [this, task = std::move(task)](const vehicle::Now& now) { task(now, driver_->output()); });
}

void NmeaBridge::startRecordAgain() {
  publisher_.reset();
  last_heard_.reset();
  next_jump_warning_ = {};
}

// A record is a record: what is replayed keeps its name.
std::string NmeaBridge::connection() const {
  return replay_ ? replay_->connection() : "connection_" + std::to_string(connects_);
}

void NmeaBridge::onConnected(const vehicle::Now& now, const std::string& endpoint) {
  ROS_INFO("%s: connected to %s", name_.c_str(), endpoint.c_str());
  ++connects_;
  failure_logged_ = false;
  health_.connected = true;
  health_.endpoint = endpoint;
  last_navigation_.reset();
  publishLink(now);
}

void NmeaBridge::onDisconnected(const vehicle::Now& now, const std::string& reason) {
  ROS_WARN("%s: disconnected from %s: %s", name_.c_str(), health_.endpoint.c_str(), reason.c_str());
  health_.connected = false;
  health_.last_failure = reason;
  health_.navigation_age_s.reset();
  followed_dialect_.reset();
  publishLink(now);
}

void NmeaBridge::onConnectFailed(const vehicle::Now& now, const std::string& reason,
                                 std::chrono::milliseconds retry_in) {
  health_.endpoint = configured_endpoint_;
  health_.last_failure = reason;
  if (std::exchange(failure_logged_, true)) {
    ROS_DEBUG("%s: %s; next try in %.1f s", name_.c_str(), reason.c_str(), seconds(retry_in));
    return;
  }
  ROS_WARN("%s: cannot connect to the vehicle at %s: %s; trying again until it answers",
           name_.c_str(), configured_endpoint_.c_str(), reason.c_str());
  publishLink(now);
}

void NmeaBridge::onHeard(const vehicle::Now& now, std::string_view line) {
  last_heard_ = now.steady;
  rates_.count(line, now.steady);
  publisher_.publishReceived(now, connection(), line);
}

void NmeaBridge::onSent(const vehicle::Now& now, std::string_view line) {
  publisher_.publishSent(now, connection(), line);
}

void NmeaBridge::onEvent(const vehicle::Now& now, const vehicle::Event& event) {
  followDialect();
  publisher_.publish(now, event);
  watch(now, event);
}

void NmeaBridge::onTick(const vehicle::Now& now) {
  warnOfJumps(now);
  publishLink(now);
  reportHealth(now);
}

// The publisher's defaults follow the dialect, so it must know before it sees the first event.
void NmeaBridge::followDialect() {
  const auto dialect = session_.dialect();
  if (!dialect || dialect == followed_dialect_) return;
  followed_dialect_ = dialect;
  publisher_.setDialect(*dialect);
  ROS_INFO("%s: the vehicle speaks the %s dialect", name_.c_str(), protocol::toString(*dialect));
}

void NmeaBridge::watch(const vehicle::Now& now, const vehicle::Event& event) {
  if (const auto* navigation = std::get_if<vehicle::Navigation>(&event)) {
    last_navigation_ = now.steady;
    compass_check_.take(*navigation);
    if (!navigation->measured_at) return;
    const auto leap_seconds = configured_leap_seconds_.value_or(
        session_.dialect() == protocol::Dialect::Kingfisher ? 18s : 0s);
    const auto told = vehicle::resolveDate(*navigation->measured_at - leap_seconds, now.utc);
    health_.clock_offset_s = seconds(told - now.utc);
  } else if (const auto* compass = std::get_if<vehicle::Compass>(&event)) {
    const std::string disagreement = compass_check_.take(*compass, now.steady);
    if (!disagreement.empty()) ROS_WARN("%s: %s", name_.c_str(), disagreement.c_str());
  } else if (const auto* battery = std::get_if<vehicle::Battery>(&event)) {
    health_.battery_v = battery->stack_v;
  } else if (const auto* control = std::get_if<vehicle::Control>(&event)) {
    health_.grant = control->grant;
    health_.commands_enabled = control->commands_enabled;
    health_.control_reason = std::string{control->reason};
  }
}

void NmeaBridge::warnOfJumps(const vehicle::Now& now) {
  const std::uint64_t jumps = publisher_.builder().jumps();
  if (jumps == jumps_warned_ || now.steady < next_jump_warning_) return;
  ROS_WARN(
      "%s: dropped %lu position(s) too far from the last one, the latest by %.1f m; parameter "
      "max_jump sets the limit",
      name_.c_str(), static_cast<unsigned long>(jumps - jumps_warned_),
      publisher_.builder().latestJump_m());
  jumps_warned_ = jumps;
  next_jump_warning_ = now.steady + kWarnAtMostEvery;
}

void NmeaBridge::publishLink(const vehicle::Now& now) {
  const session::NmeaCounters counters = session_.counters();
  LinkStatus status;
  status.header.stamp = toRosTime(now.stamp);
  status.connected = health_.connected;
  status.endpoint = health_.endpoint;
  status.dialect = dialectName();
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

void NmeaBridge::reportHealth(const vehicle::Now& now) {
  health_.dialect = dialectName();
  health_.counters_before = std::exchange(health_.counters, session_.counters());
  health_.rates = rates_.take(now.steady);
  health_.taken = now.steady;
  health_.replay = replay_ != nullptr;
  health_.jumps = publisher_.builder().jumps();
  health_.clock = publisher_.builder().clock();
  if (last_navigation_) health_.navigation_age_s = seconds(now.steady - *last_navigation_);
  const auto& commanded = session_.commanded();
  health_.commanded = commanded ? toWords(*commanded) : "";
  health_.effect_complaint = session_.effectComplaint();
  const auto& refusal = session_.lastRefusal();
  const bool recent = refusal && now.steady - refusal->at < kRefusalTold;
  health_.vehicle_refusal = recent ? refusal->words : "";
  health_.unacknowledged = session_.unacknowledged();
  diagnostics_.set(health_);
}

const char* NmeaBridge::dialectName() const {
  const auto dialect = session_.dialect();
  return dialect ? protocol::toString(*dialect) : "";
}

}  // namespace frontseat_driver::ros_layer
