#include "host_clocks.h"

#include <ros/time.h>

#include <chrono>

#include "convert.h"

namespace frontseat_driver::ros_layer {

vehicle::Now HostClocks::read() {
  const ros::Time ros_time = ros::Time::now();
  const bool simulated = ros::Time::isSimTime();
  const vehicle::UtcTime utc =
      simulated ? std::chrono::system_clock::now().time_since_epoch() : toUtcTime(ros_time);
  const vehicle::UtcTime stamp = toUtcTime(guard_.clamp(ros_time));
  simulated_behind_ = simulated ? stamp - toUtcTime(ros_time) : std::chrono::nanoseconds{0};
  return {std::chrono::steady_clock::now(), utc, stamp};
}

}  // namespace frontseat_driver::ros_layer
