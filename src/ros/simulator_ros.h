#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/sim/parameter.h"
#include "frontseat_driver/sim/simulator_config.h"

namespace frontseat_driver::sim {

/// The truth as the driver would publish it with the same datum: `odom` (ENU) to `base_link` (FLU),
/// z = -depth, stamp = UTC by the vehicle's clock. Covariances are zero: it is the truth.
nav_msgs::Odometry toOdometry(const Truth& truth);

/// The private parameters that are set, as a command line would have them; warns about those that
/// are neither `known` nor `own`, which the simulator itself sets.
std::vector<std::pair<std::string, std::string>> privateParameters(
    const ros::NodeHandle& node, const std::vector<ParameterHelp>& known,
    const std::vector<std::string>& own);

/// Publishes the truth and lets ROS call the vehicle's controls.
class SimulatorNode {
 public:
  /// Parameters that the simulator of an NMEA vehicle sets.
  static std::vector<std::string> ownParameters();

  explicit SimulatorNode(const ros::NodeHandle& node);

  void publish(const Truth& truth) { odometry_.publish(toOdometry(truth)); }

  /// Offers what an operator can do to the vehicle of `server`, which must outlive this.
  void offerControls(SimulatorServer& server, protocol::Dialect dialect);

 private:
  ros::NodeHandle node_;
  ros::Publisher odometry_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace frontseat_driver::sim
