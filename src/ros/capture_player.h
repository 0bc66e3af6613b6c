#pragma once

#include <frontseat_driver/Sentence.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Publishes lines on `nmea/replay` at a rate, and the time on /clock where use_sim_time asks for
/// one. Goes no faster than the driver, whose `nmea/rx` tells how far it is: so nothing is lost,
/// and no more than kAhead lines wait, however long the capture is.
class CapturePlayer {
 public:
  static constexpr std::size_t kAhead = 2000;

  /// `rate`: times the speed it was recorded at; 0: as fast as the driver takes it.
  CapturePlayer(ros::NodeHandle node, double rate);

  /// Waits until somebody listens, and a driver that does has its `nmea/rx` connected; false if the
  /// program was ended.
  bool awaitListener();

  /// Publishes the line when it is due; false if the program was ended.
  bool play(const Sentence& sentence);

  /// Waits until the driver has taken all lines.
  void finish();

  std::uint64_t played() const { return played_; }

 private:
  using Steady = std::chrono::steady_clock;

  void taken(const Sentence& sentence);
  bool awaitDue(const ros::Time& stamp);
  bool awaitRoom(std::size_t most_waiting);
  void tell(const ros::Time& time);

  const double rate_;
  ros::Publisher lines_;
  ros::Publisher clock_;
  std::optional<ros::Time> first_;
  Steady::time_point began_{};
  Steady::time_point clock_due_{};
  std::uint64_t played_ = 0;

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::deque<Sentence> waiting_;  ///< published, and not heard back yet
  ros::Subscriber echo_;
};

}  // namespace frontseat_driver::ros_layer
