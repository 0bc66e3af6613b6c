#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <ros/wall_timer.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace frontseat_driver::ros_layer {

/// Lets whoever subscribed before the publishers were there connect to them, so that a recorder
/// that waits for a driver misses nothing of what the driver says first.
class ExpectedSubscribers {
 public:
  /// Calls `ready` once: here, if nobody is waited for, else from a timer, when all are there or
  /// after one second, since the master remembers subscribers that died.
  ExpectedSubscribers(ros::NodeHandle node, const std::vector<ros::Publisher>& publishers,
                      std::function<void()> ready);

  /// `ready` is not called any more.
  void close() { timer_.stop(); }

 private:
  struct Expected {
    ros::Publisher publisher;
    std::size_t subscribers = 0;
  };

  void look();
  bool complete() const;

  std::vector<Expected> expected_;
  std::function<void()> ready_;
  ros::SteadyTime give_up_;
  ros::WallTimer timer_;
};

}  // namespace frontseat_driver::ros_layer
