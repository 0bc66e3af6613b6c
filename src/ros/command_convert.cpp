#include "command_convert.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "check.h"
#include "convert.h"

namespace frontseat_driver::ros_layer {

namespace {

using vehicle::BehaviorCommand;

constexpr double kRightAngle = M_PI_2;
constexpr double kMostDepth_m = 6000.0;
constexpr double kMostRpm = 10000.0;
constexpr double kMostSpeed_m_s = 10.0;
constexpr double kMostYawRate_rad_s = M_PI;

/// From the vehicle's north, [0, 360).
double heading_deg(const char* field, double yaw_rad, NorthOffset north_offset_deg, Check& check) {
  check.angle_rad(field, yaw_rad);
  if (!north_offset_deg) {
    check.refuse(std::string{field} +
                 " is a heading, and no position of the vehicle is known yet to tell how its grid "
                 "north lies");
  }
  return wrapHeading_deg(90.0 - degrees(yaw_rad) - north_offset_deg.value_or(0.0));
}

Converted resultOf(const Check& check, vehicle::Command command) {
  if (check.refusal().empty()) return command;
  return check.refusal();
}

void convertHorizontal(const Behavior& behavior, NorthOffset north_offset_deg,
                       BehaviorCommand& command, Check& check) {
  switch (behavior.horizontal_mode) {
    case Behavior::HORIZONTAL_NONE:
      return check.finite("horizontal", behavior.horizontal);
    case Behavior::HORIZONTAL_HEADING:
      command.horizontal = {
          BehaviorCommand::Horizontal::Heading,
          heading_deg("horizontal", behavior.horizontal, north_offset_deg, check)};
      return;
    case Behavior::HORIZONTAL_RUDDER:
      check.within("horizontal", behavior.horizontal, -kRightAngle, kRightAngle);
      command.horizontal = {BehaviorCommand::Horizontal::Rudder, degrees(behavior.horizontal)};
      return;
    default:
      check.oneOf("horizontal_mode", behavior.horizontal_mode, 0, 2,
                  "0 (none), 1 (heading) or 2 (rudder)");
  }
}

void convertVertical(const Behavior& behavior, BehaviorCommand& command, Check& check) {
  const double value = behavior.vertical;
  switch (behavior.vertical_mode) {
    case Behavior::VERTICAL_NONE:
      return check.finite("vertical", behavior.vertical);
    case Behavior::VERTICAL_DEPTH:
      check.within("vertical", value, 0.0, kMostDepth_m);
      command.vertical = {BehaviorCommand::Vertical::Depth, value};
      return;
    case Behavior::VERTICAL_ALTITUDE:
      check.within("vertical", value, 0.0, kMostDepth_m);
      command.vertical = {BehaviorCommand::Vertical::Altitude, value};
      return;
    case Behavior::VERTICAL_PITCH:
      check.within("vertical", value, -kRightAngle, kRightAngle);
      command.vertical = {BehaviorCommand::Vertical::Pitch, degrees(value)};
      return;
    case Behavior::VERTICAL_ELEVATOR:
      check.within("vertical", value, -kRightAngle, kRightAngle);
      command.vertical = {BehaviorCommand::Vertical::Elevator, degrees(value)};
      return;
    default:
      check.oneOf("vertical_mode", behavior.vertical_mode, 0, 4,
                  "0 (none), 1 (depth), 2 (altitude), 3 (pitch) or 4 (elevator)");
  }
}

void convertSpeed(const Behavior& behavior, BehaviorCommand& command, Check& check) {
  switch (behavior.speed_mode) {
    case Behavior::SPEED_NONE:
      return check.finite("speed", behavior.speed);
    case Behavior::SPEED_RPM:
      check.within("speed", behavior.speed, -kMostRpm, kMostRpm);
      command.speed = {BehaviorCommand::Speed::Rpm, behavior.speed};
      return;
    case Behavior::SPEED_SPEED:
      check.within("speed", behavior.speed, 0.0, kMostSpeed_m_s);
      command.speed = {BehaviorCommand::Speed::MetresPerSecond, behavior.speed};
      return;
    default:
      check.oneOf("speed_mode", behavior.speed_mode, 0, 2, "0 (none), 1 (rpm) or 2 (speed)");
  }
}

}  // namespace

Converted toCommand(const Behavior& behavior, NorthOffset north_offset_deg) {
  BehaviorCommand command;
  Check check;
  convertHorizontal(behavior, north_offset_deg, command, check);
  convertVertical(behavior, command, check);
  convertSpeed(behavior, command, check);
  return resultOf(check, command);
}

std::string tooOld(const Behavior& behavior, const ros::Time& now,
                   std::chrono::nanoseconds max_command_age) {
  if (behavior.header.stamp.isZero()) return {};
  const double age_s = std::chrono::duration<double>(timeFrom(behavior.header.stamp, now)).count();
  const double limit_s = std::chrono::duration<double>(max_command_age).count();
  const double apart_s = std::fabs(age_s);
  if (apart_s <= limit_s) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "header.stamp is %.3f s %s; at most %.3f s (max_command_age) is accepted", apart_s,
                age_s > 0.0 ? "old" : "ahead of this computer's clock", limit_s);
  return text;
}

Converted toCommand(const Drive& drive) {
  Check check;
  check.within("left", drive.left, -1.0, 1.0);
  check.within("right", drive.right, -1.0, 1.0);
  return resultOf(check, vehicle::DriveCommand{drive.left, drive.right});
}

Converted toCommand(const Helm& helm) {
  Check check;
  check.within("thrust", helm.thrust, -1.0, 1.0);
  check.within("yaw_rate", helm.yaw_rate, -kMostYawRate_rad_s, kMostYawRate_rad_s);
  return resultOf(check, vehicle::HelmCommand{helm.thrust, 0.0 - helm.yaw_rate});
}

Converted toCommand(const Course& course, NorthOffset north_offset_deg) {
  Check check;
  const double heading = heading_deg("yaw", course.yaw, north_offset_deg, check);
  check.within("speed", course.speed, 0.0, kMostSpeed_m_s);
  return resultOf(check, vehicle::CourseCommand{heading, course.speed});
}

Converted toCommand(const geometry_msgs::Twist& velocity, double max_speed_m_s,
                    double max_yaw_rate_rad_s) {
  Check check;
  check.finite(velocity);
  const double thrust = std::clamp(velocity.linear.x / max_speed_m_s, -1.0, 1.0);
  const double yaw_rate = std::clamp(velocity.angular.z, -max_yaw_rate_rad_s, max_yaw_rate_rad_s);
  return resultOf(check, vehicle::HelmCommand{thrust, 0.0 - yaw_rate});
}

}  // namespace frontseat_driver::ros_layer
