#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontseat_driver/sim/simulator_config.h"

namespace frontseat_driver::sim {

/// The truth as the driver would publish it with the same datum: `odom` (ENU) to `base_link` (FLU),
/// z = -depth, stamp = UTC by the vehicle's clock. Covariances are zero: it is the truth.
nav_msgs::Odometry toOdometry(const Truth& truth);

/// Takes every private parameter that is set into `config` and warns about those nobody knows.
/// Returns the line that tells what cannot be used, if anything is.
std::optional<std::string> readParameters(const ros::NodeHandle& node, SimulatorConfig& config);

/// Publishes the truth and lets ROS call the vehicle's controls.
class SimulatorNode {
 public:
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
