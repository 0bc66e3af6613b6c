#include "check.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace frontseat_driver::ros_layer {

namespace {

constexpr double kMostAngle_rad = 1e6;

}  // namespace

std::string outside(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return {};  // false for NaN
  char text[160];
  std::snprintf(text, sizeof text, "%s is %.10g; %.10g..%.10g is accepted", field, value, low,
                high);
  return text;
}

void Check::within(const char* field, double value, double low, double high) {
  refuse(outside(field, value, low, high));
}

void Check::finite(const char* field, double value) {
  if (std::isfinite(value)) return;
  refuse(std::string{field} + " is " + std::to_string(value) + "; a finite number is accepted");
}

void Check::finite(const geometry_msgs::Twist& twist) {
  finite("linear.x", twist.linear.x);
  finite("linear.y", twist.linear.y);
  finite("linear.z", twist.linear.z);
  finite("angular.x", twist.angular.x);
  finite("angular.y", twist.angular.y);
  finite("angular.z", twist.angular.z);
}

void Check::angle_rad(const char* field, double value) {
  finite(field, value);
  within(field, value, -kMostAngle_rad, kMostAngle_rad);
}

void Check::oneOf(const char* field, int value, int low, int high, const char* accepted) {
  if (value >= low && value <= high) return;
  refuse(std::string{field} + " is " + std::to_string(value) + "; " + accepted + " is accepted");
}

void Check::refuse(std::string text) {
  if (refusal_.empty()) refusal_ = std::move(text);
}

}  // namespace frontseat_driver::ros_layer
