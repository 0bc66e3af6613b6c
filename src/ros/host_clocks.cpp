#include "host_clocks.h"

#include <ros/time.h>

#include <chrono>

#include "convert.h"

namespace frontseat_driver::ros_layer {

vehicle::Now HostClocks::read() {
  const ros::Time ros_time = ros::Time::now();
  const vehicle::UtcTime utc = ros::Time::isSimTime()
                                   ? std::chrono::system_clock::now().time_since_epoch()
                                   : toUtcTime(ros_time);
  return {std::chrono::steady_clock::now(), utc, toUtcTime(guard_.clamp(ros_time))};
}

}  // namespace frontseat_driver::ros_layer
