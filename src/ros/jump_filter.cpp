#include "jump_filter.h"

#include <algorithm>
#include <chrono>

#include "convert.h"

namespace frontseat_driver::ros_layer {

bool JumpFilter::accept(const vehicle::Position& position, vehicle::SteadyTime arrival) {
  const geometry_msgs::Point place = fromEarthCentre_m(position);
  if (last_) {
    const double elapsed_s = std::chrono::duration<double>(arrival - last_arrival_).count();
    const double moved_m = distance_m(last_place_, place);
    const bool jumped = moved_m > max_speed_m_s_ * std::max(elapsed_s, kLeastElapsed_s);
    if (jumped && ++in_a_row_ < kBelieved) {
      ++jumps_;
      latest_jump_m_ = moved_m;
      return false;
    }
  }
  last_ = position;
  last_place_ = place;
  last_arrival_ = arrival;
  in_a_row_ = 0;
  return true;
}

void JumpFilter::reset() {
  last_.reset();
  in_a_row_ = 0;
}

}  // namespace frontseat_driver::ros_layer
