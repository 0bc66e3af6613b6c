#include "subscriber.h"

#include <frontseat_driver/CommandAck.h>
#include <frontseat_driver/ControlStatus.h>
#include <frontseat_driver/InterfaceVersion.h>
#include <frontseat_driver/LinkStatus.h>
#include <frontseat_driver/MissionStatus.h>
#include <frontseat_driver/Sentence.h>
#include <frontseat_driver/ShutdownNotice.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/TimeReference.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace frontseat_driver::bench {
namespace {

constexpr std::uint32_t kQueue = 100'000;

double quantile(const std::vector<double>& sorted, double part) {
  if (sorted.empty()) return std::nan("");
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

Subscriber::Subscriber(ros::NodeHandle node, ros::NodeHandle private_node) {
  const auto count = static_cast<std::size_t>(private_node.param("count", 1));
  const int vehicles = private_node.param("vehicles", 0);
  times_ = std::make_unique<WriteTimes>(private_node.param<std::string>("times", ""), count);
  latencies_s_.reserve(count);
  const bool all = private_node.param("all", false);
  for (int i = 0; i < std::max(vehicles, 1); ++i) {
    ros::NodeHandle vehicle = vehicles > 0 ? ros::NodeHandle{"v" + std::to_string(i)} : node;
    subscribeToOdometry(vehicle);
    if (all) subscribeToTheRest(vehicle);
  }
  if (vehicles > 0 || all) this->count<tf2_msgs::TFMessage>(node, "/tf");
  service_ = private_node.advertiseService("report", &Subscriber::report, this);
}

void Subscriber::subscribeToOdometry(ros::NodeHandle node) {
  const boost::function<void(const nav_msgs::Odometry::ConstPtr&)> callback =
      [this](const nav_msgs::Odometry::ConstPtr& message) { take(*message); };
  subscribers_.push_back(
      node.subscribe("odom", kQueue, callback, {}, ros::TransportHints().tcpNoDelay()));
}

void Subscriber::take(const nav_msgs::Odometry& odometry) {
  const double z = -odometry.pose.pose.position.z;
  latencies_s_.push_back(times_->since(static_cast<std::size_t>(z)));
  disorder_ += z < last_z_ ? 1 : 0;
  last_z_ = z;
}

template <class Message>
void Subscriber::count(ros::NodeHandle node, const std::string& topic) {
  const auto counted = std::make_shared<Count>(Count{topic});
  counts_.push_back(counted);
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [counted](const boost::shared_ptr<const Message>&) { ++counted->messages; };
  subscribers_.push_back(
      node.subscribe(topic, kQueue, callback, {}, ros::TransportHints().tcpNoDelay()));
}

void Subscriber::subscribeToTheRest(ros::NodeHandle node) {
  count<sensor_msgs::Imu>(node, "imu/data");
  count<sensor_msgs::Imu>(node, "imu/data_raw");
  count<sensor_msgs::Imu>(node, "compass/data");
  count<sensor_msgs::NavSatFix>(node, "nav/fix");
  count<geometry_msgs::TwistStamped>(node, "nav/velocity");
  count<geometry_msgs::PoseWithCovarianceStamped>(node, "depth");
  count<sensor_msgs::Range>(node, "altitude");
  count<sensor_msgs::BatteryState>(node, "battery");
  count<sensor_msgs::NavSatFix>(node, "gps/fix");
  count<geometry_msgs::TwistStamped>(node, "gps/velocity");
  count<sensor_msgs::TimeReference>(node, "gps/time_reference");
  count<sensor_msgs::TimeReference>(node, "vehicle_time");
  count<MissionStatus>(node, "mission_status");
  count<ControlStatus>(node, "control");
  count<InterfaceVersion>(node, "interface_version");
  count<ShutdownNotice>(node, "shutdown");
  count<CommandAck>(node, "ack");
  count<LinkStatus>(node, "link");
  count<Sentence>(node, "nmea/rx");
  count<Sentence>(node, "nmea/tx");
}

bool Subscriber::report(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  std::sort(latencies_s_.begin(), latencies_s_.end());
  std::ostringstream out;
  out << "{\"odom\": " << latencies_s_.size() << ", \"disorder\": " << disorder_;
  if (!latencies_s_.empty()) {
    out << ", \"p50_us\": " << 1e6 * quantile(latencies_s_, 0.5)
        << ", \"p99_us\": " << 1e6 * quantile(latencies_s_, 0.99)
        << ", \"max_us\": " << 1e6 * latencies_s_.back();
  }
  out << ", \"topics\": {";
  const char* separator = "";
  for (const auto& counted : counts_) {
    out << separator << '"' << counted->topic << "\": " << counted->messages;
    separator = ", ";
    counted->messages = 0;
  }
  out << "}}";
  latencies_s_.clear();
  disorder_ = 0;
  response.success = true;
  response.message = out.str();
  return true;
}

}  // namespace frontseat_driver::bench
