#pragma once

#include <frontseat_driver/Sentence.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <functional>
#include <mutex>
#include <string>

#include "record_player.h"

namespace frontseat_driver::ros_layer {

/// Plays what is published on `nmea/replay`, and loses none of it however fast it comes.
class Replay {
 public:
  /// As RecordPlayer; begins to listen at start().
  Replay(session::Session& session, driver::Listener& listener,
         std::function<void(Restart)> on_restart);

  void start(ros::NodeHandle node);

  /// Runs a task on the session at the record's time, here and now.
  void post(const std::function<void(const vehicle::Now& now, session::Output& out)>& task);

  /// The recorded connection that is being played; for the listener, while it is told something.
  const std::string& connection() const { return player_.connection(); }

  /// Hears nothing more.
  void close() { subscriber_.shutdown(); }

 private:
  void take(const Sentence& sentence);

  std::mutex mutex_;  ///< of the player: services come on threads of their own
  RecordPlayer player_;
  ros::Subscriber subscriber_;
};

}  // namespace frontseat_driver::ros_layer
