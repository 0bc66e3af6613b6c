#include "simulator_ros.h"

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

#include <algorithm>
#include <functional>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr const char* kActualPort = "actual_port";

/// A parameter as the command line would have it.
std::string toText(XmlRpc::XmlRpcValue& value) {
  using Value = XmlRpc::XmlRpcValue;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(15);
  switch (value.getType()) {
    case Value::TypeBoolean:
      out << (static_cast<bool>(value) ? "true" : "false");
      break;
    case Value::TypeInt:
      out << static_cast<int>(value);
      break;
    case Value::TypeDouble:
      out << static_cast<double>(value);
      break;
    case Value::TypeString:
      out << static_cast<std::string>(value);
      break;
    case Value::TypeArray:
      for (int i = 0; i < value.size(); ++i) out << (i == 0 ? "" : ", ") << toText(value[i]);
      break;
    case Value::TypeStruct:
      for (auto entry = value.begin(); entry != value.end(); ++entry) {
        out << (entry == value.begin() ? "" : ", ") << entry->first << ": "
            << toText(entry->second);
      }
      break;
    default:
      break;
  }
  return out.str();
}

void warnAboutUnknown(const ros::NodeHandle& node, const std::vector<ParameterHelp>& known,
                      const std::vector<std::string>& own_names) {
  std::vector<std::string> names;
  if (!node.getParamNames(names)) return;
  const std::string prefix = node.getNamespace() + "/";
  for (const std::string& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string own =
        name.substr(prefix.size(), name.find('/', prefix.size()) - prefix.size());
    const bool found = std::find(own_names.begin(), own_names.end(), own) != own_names.end() ||
                       std::any_of(known.begin(), known.end(),
                                   [&](const auto& parameter) { return parameter.name == own; });
    if (found) continue;
    ROS_WARN("%s", unknownParameter(known, own).c_str());
  }
}

ros::Time toTime(UtcTime utc) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(utc.count()));
  return time;
}

template <class Service>
using Callback = boost::function<bool(typename Service::Request&, typename Service::Response&)>;

/// A service that has `act` done by the vehicle's thread and answers at once.
ros::ServiceServer offer(ros::NodeHandle& node, SimulatorServer& server, const std::string& name,
                         std::function<void(SandsharkFrontseat&)> act) {
  const Callback<std_srvs::Trigger> callback = [&server, act = std::move(act)](auto&,
                                                                               auto& response) {
    server.post([act](Frontseat& vehicle) { act(dynamic_cast<SandsharkFrontseat&>(vehicle)); });
    response.success = true;
    return true;
  };
  return node.advertiseService(name, callback);
}

ros::ServiceServer offerPermission(ros::NodeHandle& node, SimulatorServer& server) {
  const Callback<std_srvs::SetBool> callback = [&server](auto& request, auto& response) {
    const bool allowed = request.data;
    server.post([allowed](Frontseat& vehicle) {
      dynamic_cast<SandsharkFrontseat&>(vehicle).setBackseatControl(allowed);
    });
    response.success = true;
    return true;
  };
  return node.advertiseService("allow_dynamic_requests", callback);
}

}  // namespace

nav_msgs::Odometry toOdometry(const Truth& truth) {
  const VehicleState& state = truth.state;
  nav_msgs::Odometry odometry;
  odometry.header.stamp = toTime(truth.stamp);
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  odometry.pose.pose.position.x = state.east_m;
  odometry.pose.pose.position.y = state.north_m;
  odometry.pose.pose.position.z = -state.depth_m;

  // Both frames change: the world swap turns heading into yaw from east, the body swap negates
  // pitch.
  tf2::Quaternion attitude;
  attitude.setRPY(state.roll_rad, -state.pitch_rad, kPi / 2.0 - state.heading_rad);
  odometry.pose.pose.orientation.x = attitude.x();
  odometry.pose.pose.orientation.y = attitude.y();
  odometry.pose.pose.orientation.z = attitude.z();
  odometry.pose.pose.orientation.w = attitude.w();

  const tf2::Vector3 enu{state.velocity_east_m_s, state.velocity_north_m_s,
                         -state.velocity_down_m_s};
  const tf2::Vector3 flu = tf2::Matrix3x3{attitude}.transpose() * enu;
  odometry.twist.twist.linear.x = flu.x();
  odometry.twist.twist.linear.y = flu.y();
  odometry.twist.twist.linear.z = flu.z();
  odometry.twist.twist.angular.x = state.roll_rate_rad_s;
  odometry.twist.twist.angular.y = -state.pitch_rate_rad_s;
  odometry.twist.twist.angular.z = -state.yaw_rate_rad_s;
  return odometry;
}

std::vector<std::pair<std::string, std::string>> privateParameters(
    const ros::NodeHandle& node, const std::vector<ParameterHelp>& known,
    const std::vector<std::string>& own) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const ParameterHelp& parameter : known) {
    XmlRpc::XmlRpcValue value;
    if (node.getParam(parameter.name, value)) values.emplace_back(parameter.name, toText(value));
  }
  warnAboutUnknown(node, known, own);
  return values;
}

std::vector<std::string> SimulatorNode::ownParameters() { return {kActualPort}; }

SimulatorNode::SimulatorNode(const ros::NodeHandle& node)
    : node_(node), odometry_(node_.advertise<nav_msgs::Odometry>("odom", 100)) {}

void SimulatorNode::offerControls(SimulatorServer& server, protocol::Dialect dialect) {
  node_.deleteParam(kActualPort);
  node_.setParam(kActualPort, static_cast<int>(server.port()));
  if (dialect != protocol::Dialect::Sandshark) return;
  services_.push_back(offerPermission(node_, server));
  services_.push_back(offer(node_, server, "restart_mission",
                            [](SandsharkFrontseat& vehicle) { vehicle.restartMission(); }));
  services_.push_back(offer(node_, server, "announce_shutdown",
                            [](SandsharkFrontseat& vehicle) { vehicle.announceShutdown(); }));
}

}  // namespace frontseat_driver::sim
