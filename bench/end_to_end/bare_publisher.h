#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include <thread>

namespace frontseat_driver::bench {

/// The least that a program between a vehicle and ROS can do, and so the floor for the driver: one
/// read, then one prepared nav_msgs/Odometry for each line end in it. It decodes nothing, but
/// counts, so that the subscriber knows which line the message is for.
class BarePublisher {
 public:
  /// Private parameters `host` and `port`, as the driver's.
  BarePublisher(ros::NodeHandle node, ros::NodeHandle private_node);
  ~BarePublisher();

 private:
  void run();
  void publish();

  ros::Publisher odom_;
  nav_msgs::Odometry prepared_;
  double lines_ = -1.0;  ///< the first one only tells the dialect
  int socket_;
  std::thread thread_;
};

}  // namespace frontseat_driver::bench
