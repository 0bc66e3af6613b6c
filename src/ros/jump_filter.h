#pragma once

#include <geometry_msgs/Point.h>

#include <cstdint>
#include <optional>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::ros_layer {

/// Keeps out positions that the vehicle cannot have reached since the last one.
class JumpFilter {
 public:
  /// Arrivals closer together than this count as this far apart: the network bundles sentences.
  static constexpr double kLeastElapsed_s = 0.1;

  /// So many positions in a row that are too far away are where the vehicle is.
  static constexpr int kBelieved = 5;

  explicit JumpFilter(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  /// False: dropped and counted.
  bool accept(const vehicle::Position& position, vehicle::SteadyTime arrival);

  /// The last position that was accepted.
  const std::optional<vehicle::Position>& last() const { return last_; }

  std::uint64_t jumps() const { return jumps_; }  ///< positions dropped so far

  /// How far the latest dropped one was from the last accepted one; 0 if none was dropped.
  double latestJump_m() const { return latest_jump_m_; }

  /// The next position is accepted wherever it is. The count goes on.
  void reset();

 private:
  double max_speed_m_s_;
  std::optional<vehicle::Position> last_;
  geometry_msgs::Point last_place_;  ///< the same from the centre of the Earth
  vehicle::SteadyTime last_arrival_{};
  int in_a_row_ = 0;
  std::uint64_t jumps_ = 0;
  double latest_jump_m_ = 0.0;
};

}  // namespace frontseat_driver::ros_layer
