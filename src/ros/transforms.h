#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include <array>
#include <string>

namespace frontseat_driver::ros_layer {

/// The pose of an odometry, as a transform between its frames.
inline geometry_msgs::TransformStamped toTransform(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped out;
  out.header = odometry.header;
  out.child_frame_id = odometry.child_frame_id;
  out.transform.translation.x = odometry.pose.pose.position.x;
  out.transform.translation.y = odometry.pose.pose.position.y;
  out.transform.translation.z = odometry.pose.pose.position.z;
  out.transform.rotation = odometry.pose.pose.orientation;
  return out;
}

/// Forward-right-down and north-east-down twins of the two frames, `_frd` and `_ned` at the end of
/// their names.
inline std::array<geometry_msgs::TransformStamped, 2> frdFrames(const ros::Time& stamp,
                                                                const std::string& base_frame,
                                                                const std::string& odom_frame) {
  // Half a turn about the axis (x, y, 0).
  const auto half_turn = [&](const std::string& parent, const char* end, double x, double y) {
    geometry_msgs::TransformStamped out;
    out.header.stamp = stamp;
    out.header.frame_id = parent;
    out.child_frame_id = parent + end;
    out.transform.rotation.x = x;
    out.transform.rotation.y = y;
    return out;
  };
  constexpr double kHalfRoot = 0.70710678118654752440;
  // About the bow, and about north-east.
  return {half_turn(base_frame, "_frd", 1.0, 0.0),
          half_turn(odom_frame, "_ned", kHalfRoot, kHalfRoot)};
}

}  // namespace frontseat_driver::ros_layer
