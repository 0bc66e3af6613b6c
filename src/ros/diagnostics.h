#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <mutex>
#include <string>

#include "diagnosis/diagnosis.h"
#include "diagnosis/health.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Publishes on /diagnostics, once a second, what each layer says of the newest health. On a timer
/// of its own, so that a driver that hangs is reported too.
class Diagnostics {
 public:
  Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node, const std::string& name);

  /// The newest health, true at `now`; from any thread.
  void set(const Health& health, vehicle::SteadyTime now);

 private:
  void update();

  std::mutex mutex_;
  Health newest_;                    ///< guarded by mutex_
  vehicle::SteadyTime newest_at_{};  ///< guarded by mutex_
  Diagnoses diagnoses_;              ///< what update() publishes
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;  ///< ros::Timer would stand still with the simulated clock
};

}  // namespace frontseat_driver::ros_layer
