#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <memory>
#include <vector>

#include "write_times.h"

namespace frontseat_driver::bench {

/// Subscribes to what a driver publishes and reports how late each odometry came and how many
/// messages of each topic: service `~report`, JSON in its message, which also begins anew.
class Subscriber {
 public:
  /// Private parameters: `times` and `count` as given to the vehicle, `all` topics or only `odom`,
  /// `vehicles`: how many, in the namespaces v0, v1…; 0: one, in this namespace.
  Subscriber(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  template <class Message>
  void count(ros::NodeHandle node, const std::string& topic);
  void subscribeToOdometry(ros::NodeHandle node);
  void subscribeToTheRest(ros::NodeHandle node);
  void take(const nav_msgs::Odometry& odometry);
  bool report(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  struct Count {
    std::string topic;
    std::size_t messages = 0;
  };

  std::unique_ptr<WriteTimes> times_;
  std::vector<double> latencies_s_;
  double last_z_ = 0.0;
  std::size_t disorder_ = 0;
  std::vector<std::shared_ptr<Count>> counts_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer service_;
};

}  // namespace frontseat_driver::bench
