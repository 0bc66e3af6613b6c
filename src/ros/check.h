#pragma once

#include <geometry_msgs/Twist.h>

#include <string>

namespace frontseat_driver::ros_layer {

/// Why a field is refused, with its value and what would be right; empty if it lies from `low` to
/// `high`.
std::string outside(const char* field, double value, double low, double high);

/// Collects the first thing that is wrong with a message.
class Check {
 public:
  void within(const char* field, double value, double low, double high);

  void finite(const char* field, double value);
  void finite(const geometry_msgs::Twist& twist);

  /// Any number of turns, but no angle that nobody meant.
  void angle_rad(const char* field, double value);

  /// `accepted` names the choices from `low` to `high`.
  void oneOf(const char* field, int value, int low, int high, const char* accepted);

  void refuse(std::string text);

  /// Empty if nothing is wrong.
  const std::string& refusal() const { return refusal_; }

 private:
  std::string refusal_;
};

}  // namespace frontseat_driver::ros_layer
