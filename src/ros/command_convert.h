#pragma once

#include <frontseat_driver/Behavior.h>
#include <frontseat_driver/Course.h>
#include <frontseat_driver/Drive.h>
#include <frontseat_driver/Helm.h>
#include <geometry_msgs/Twist.h>

#include <chrono>
#include <optional>
#include <string>
#include <variant>

#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::ros_layer {

/// A command in the vehicle's words, or why it was refused: one line with field, value and what is
/// accepted.
using Converted = std::variant<vehicle::Command, std::string>;

/// How far the north that the vehicle's headings count from lies clockwise of true north, in
/// degrees; empty while that takes a position and none is known.
using NorthOffset = std::optional<double>;

/// BPRMB. Yaw becomes a heading from the vehicle's north, radians become degrees; the vertical
/// group is nautical on both sides.
Converted toCommand(const Behavior& behavior, NorthOffset north_offset_deg);

/// Why a stamped command is too old to be sent; empty if it is not, or carries no stamp. One from a
/// clock that is as far ahead may be of any age.
std::string tooOld(const Behavior& behavior, const ros::Time& now,
                   std::chrono::nanoseconds max_command_age);

/// PYDIR. Left is port.
Converted toCommand(const Drive& drive);

/// PYDEP. Counter-clockwise becomes clockwise.
Converted toCommand(const Helm& helm);

/// PYDEV. Yaw from east becomes a heading from the vehicle's north.
Converted toCommand(const Course& course, NorthOffset north_offset_deg);

/// PYDEP: linear.x over max_speed_m_s is thrust, angular.z the rate of turn, each clamped to its
/// limit. The other axes are nothing a boat can follow; they must be finite.
Converted toCommand(const geometry_msgs::Twist& velocity, double max_speed_m_s,
                    double max_yaw_rate_rad_s);

}  // namespace frontseat_driver::ros_layer
