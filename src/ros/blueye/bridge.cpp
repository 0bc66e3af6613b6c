#include "blueye/bridge.h"

#include <frontseat_driver/BlueyeClients.h>
#include <frontseat_driver/ControlStatus.h>
#include <frontseat_driver/LinkStatus.h>
#include <frontseat_driver/MissionStatus.h>
#include <ros/console.h>

#include <utility>

#include "blueye/topics.h"
#include "convert.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using diagnostic_updater::DiagnosticStatusWrapper;

constexpr std::uint32_t kQueue = 10;
constexpr std::uint32_t kReplayQueue = 2000;
constexpr bool kLatched = true;
constexpr std::chrono::seconds kLately{5};
// A record that begins anew goes back further than what a network puts out of order.
constexpr std::chrono::seconds kRestart{1};

/// Nothing is ever sent while a record is played; the session knows, this makes sure.
class Mute : public session::BlueyeOutput {
 public:
  bool publish(const vehicle::Now&, std::string_view, std::string_view) override { return false; }
  bool request(const vehicle::Now&, std::string_view, std::string_view,
               std::chrono::milliseconds) override {
    return false;
  }
  void reconnect(const vehicle::Now&, const std::string&) override {}
};

Mute mute;

void logNotification(const std::string& name, const BlueyeNotification& told) {
  const std::string text = told.name + (told.value.empty() ? "" : " " + told.value);
  if (told.level == BlueyeNotification::ERROR) {
    ROS_ERROR("%s: the drone tells: %s", name.c_str(), text.c_str());
  } else if (told.level == BlueyeNotification::WARNING) {
    ROS_WARN("%s: the drone tells: %s", name.c_str(), text.c_str());
  } else {
    ROS_INFO("%s: the drone tells: %s", name.c_str(), text.c_str());
  }
}

}  // namespace

Bridge::Bridge(ros::NodeHandle node, ros::NodeHandle private_node, std::string name,
               const Parameters& parameters)
    : name_(std::move(name)),
      parameters_(parameters),
      session_(parameters.session, *this),
      publisher_(
          node, parameters.publisher, catalogue_,
          [this](const std::string& text) { ROS_WARN("%s: %s", name_.c_str(), text.c_str()); },
          [this](const BlueyeNotification& told) { logNotification(name_, told); }),
      link_(node.advertise<LinkStatus>(topics::kLink, kQueue, kLatched)),
      control_(node.advertise<ControlStatus>(topics::kControl, kQueue, kLatched)),
      clients_(node.advertise<BlueyeClients>(topics::kClients, kQueue, kLatched)),
      mission_(node.advertise<MissionStatus>(topics::kMissionStatus, kQueue, kLatched)),
      endpoint_(parameters.source == Source::Topic
                    ? node.resolveName(topics::kTelemetryReplay)
                    : parameters.link.host + ":" + std::to_string(parameters.link.telemetry_port)),
      configured_endpoint_(endpoint_) {
  if (parameters.source == Source::Topic) {
    Bridge::onConnected(clocks_.read(), endpoint_);
    session_.connected(clocks_.read(), mute);
    replay_ = node.subscribe(topics::kTelemetryReplay, kReplayQueue, &Bridge::replay, this);
  } else {
    driver::BlueyeLinkListener& listener = *this;
    driver_ = std::make_unique<driver::BlueyeDriver>(parameters.link, session_, listener,
                                                     [this] { return clocks_.read(); });
  }
  const auto post_task = [this](Task task) { post(std::move(task)); };
  input_ = std::make_unique<Input>(node, name_, parameters, session_, catalogue_, post_task);
  services_ =
      std::make_unique<Services>(node, parameters, session_, publisher_, catalogue_, post_task);
  addDiagnostics(node, private_node);
  if (!driver_) return;
  // The publisher's own topic once more, to see who listens.
  const auto record = node.advertise<BlueyeMessage>(topics::kTelemetry, kReplayQueue);
  expected_ = std::make_unique<ExpectedSubscribers>(node, std::vector{record},
                                                    [this] { driver_->start(); });
}

// Tasks refer to the input and the services, so these stay until no task can run any more.
Bridge::~Bridge() {
  diagnostics_timer_.stop();
  if (expected_) expected_->close();
  if (driver_) driver_->stop();  // the rest waits for the master, which may be silent
  services_->close();
  input_->close();
  replay_.shutdown();
}

void Bridge::post(Task task) {
  if (driver_) {
    return driver_->post(
        [this, task = std::move(task)](const vehicle::Now& now) { task(now, driver_->output()); });
  }
  const std::lock_guard<std::mutex> lock(replay_mutex_);
  task(clocks_.read(), mute);
}

// All times are those of the record, so that a replay gives what the dive gave at any speed.
void Bridge::replay(const BlueyeMessage::ConstPtr& message) {
  const std::lock_guard<std::mutex> lock(replay_mutex_);
  const vehicle::UtcTime stamp = toUtcTime(message->header.stamp);
  const vehicle::Now now{vehicle::SteadyTime{stamp}, stamp, stamp};
  if (recorded_at_ && stamp + kRestart < *recorded_at_) {
    publisher_.beginAnew();
    next_health_ = {};
  }
  recorded_at_ = stamp;
  const std::string_view payload{reinterpret_cast<const char*>(message->data.data()),
                                 message->data.size()};
  session_.telemetry(now, message->type, payload, mute);
  session_.step(now, mute);
  if (now.steady < next_health_) return;
  next_health_ = now.steady + std::chrono::seconds(1);
  onTick(now);
}

// --- What the link tells ---

void Bridge::onConnected(const vehicle::Now& now, const std::string& endpoint) {
  ROS_INFO("%s: connected to %s", name_.c_str(), endpoint.c_str());
  ++connects_;
  connected_ = true;
  failure_logged_ = false;
  endpoint_ = endpoint;
  publishLink(now);
}

void Bridge::onDisconnected(const vehicle::Now& now, const std::string& reason) {
  ROS_WARN("%s: disconnected from %s: %s", name_.c_str(), endpoint_.c_str(), reason.c_str());
  connected_ = false;
  last_failure_ = reason;
  publisher_.forget();
  publishLink(now);
}

void Bridge::onConnectFailed(const vehicle::Now& now, const std::string& reason) {
  last_failure_ = reason;
  if (std::exchange(failure_logged_, true)) {
    ROS_DEBUG("%s: %s", name_.c_str(), reason.c_str());
    return;
  }
  ROS_WARN("%s: cannot connect to the drone: %s; trying again until it answers", name_.c_str(),
           reason.c_str());
  publishLink(now);
}

void Bridge::onControlSent(const vehicle::Now& now, std::string_view type,
                           std::string_view payload) {
  ++sent_;
  sent_bytes_ += type.size() + payload.size();
  publisher_.publishControl(now, type, payload);
}

void Bridge::onRequestSent(const vehicle::Now&, std::string_view type, std::string_view payload) {
  ++sent_;
  sent_bytes_ += type.size() + payload.size();
}

void Bridge::onTick(const vehicle::Now& now) {
  publishLink(now);
  takeHealth(now);
}

// --- What the session tells ---

void Bridge::telemetry(const vehicle::Now& now, std::string_view type, std::string_view payload) {
  heard_ = now.steady;
  if (!publisher_.publish(now, type, payload)) ++unreadable_;
  if (!publisher_.handles(type) && !catalogue_.knows(type)) ++unknown_;
}

void Bridge::event(const vehicle::Now& now, const vehicle::Event& event) {
  if (const auto* control = std::get_if<vehicle::Control>(&event)) {
    ControlStatus out;
    out.header.stamp = toRosTime(now.stamp);
    out.grant = static_cast<std::uint8_t>(control->grant);
    out.commands_enabled = control->commands_enabled;
    out.commanding = control->commanding;
    out.reason = std::string{control->reason};
    commanding_ = control->commanding;
    control_.publish(out);
  } else if (const auto* mission = std::get_if<vehicle::MissionStatus>(&event)) {
    MissionStatus out;
    out.header.stamp = toRosTime(now.stamp);
    out.state = static_cast<std::uint8_t>(mission->state);
    out.status = std::string{mission->status};
    mission_.publish(out);
  }
}

void Bridge::clients(const vehicle::Now& now) {
  BlueyeClients out;
  out.header.stamp = toRosTime(now.stamp);
  out.own_id = session_.id();
  out.id_in_control = session_.idInControl();
  for (const session::BlueyeClient& client : session_.clients()) {
    BlueyeClient& one = out.clients.emplace_back();
    one.id = client.id;
    one.name = client.name;
    one.type = client.type;
    one.observer = client.observer;
  }
  clients_.publish(out);
}

void Bridge::note(const std::string& text) { ROS_WARN("%s: %s", name_.c_str(), text.c_str()); }

void Bridge::publishLink(const vehicle::Now& now) {
  const session::BlueyeCounters& counters = session_.counters();
  LinkStatus status;
  status.header.stamp = toRosTime(now.stamp);
  status.connected = connected_;
  status.endpoint = endpoint_;
  status.dialect = "blueye";
  status.connects = connects_;
  status.bytes_received = counters.bytes_received;
  status.bytes_sent = sent_bytes_;
  status.sentences_received = counters.telemetry_received + counters.replies_received;
  status.sentences_sent = sent_;
  status.malformed = counters.malformed + unreadable_;
  status.unknown = unknown_;
  status.refused_commands = counters.refused_commands;
  if (heard_) status.since_received.fromNSec((now.steady - *heard_).count());
  link_.publish(status);
}

// --- Diagnostics ---

void Bridge::addDiagnostics(ros::NodeHandle node, ros::NodeHandle private_node) {
  updater_ = std::make_unique<diagnostic_updater::Updater>(node, private_node, name_);
  updater_->setHardwareID(endpoint_);
  for (const auto& [name, report] : kReports) {
    updater_->add(name, [this, report = report](DiagnosticStatusWrapper& status) {
      report(told_health_, status);
    });
  }
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updateDiagnostics(); });
}

void Bridge::updateDiagnostics() {
  if (parameters_.source == Source::Topic) {  // a record that stands still makes no ticks
    const std::lock_guard<std::mutex> lock(replay_mutex_);
    takeHealth(clocks_.read());
  }
  {
    const std::lock_guard<std::mutex> lock(health_mutex_);
    told_health_ = health_;
  }
  if (told_health_.endpoint.empty()) told_health_.endpoint = configured_endpoint_;
  if (told_health_.taken_at) {
    const auto age = std::chrono::steady_clock::now() - *told_health_.taken_at;
    told_health_.unreported_s = std::chrono::duration<double>(age).count();
  }
  updater_->setHardwareID(told_health_.endpoint);
  updater_->force_update();
}

void Bridge::takeHealth(const vehicle::Now& now) {
  Health health;
  health.replay = parameters_.source == Source::Topic;
  health.taken_at = now.steady;
  health.connected = connected_;
  health.endpoint = endpoint_;
  health.last_failure = last_failure_;
  health.counters = session_.counters();
  health.unknown = unknown_;
  health.unreadable = unreadable_;
  health.refusal = session_.refusal();
  health.commanding = commanding_;
  health.id = session_.id();
  health.id_in_control = session_.idInControl();
  health.error_flags = publisher_.errorFlags();
  health.values = publisher_.diagnostics();
  if (const auto& battery = publisher_.battery()) {
    health.battery_level = battery->level();
    health.battery_v = battery->voltage();
  }
  if (health.counters.refused_commands >
      std::exchange(refused_, health.counters.refused_commands)) {
    refused_at_ = now.steady;
  }
  health.refused_lately = refused_at_ && now.steady - *refused_at_ < kLately;
  const std::lock_guard<std::mutex> lock(health_mutex_);
  health_ = std::move(health);
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
