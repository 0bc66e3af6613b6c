#include "command_words.h"

#include <cstdio>

namespace frontseat_driver::ros_layer {

namespace {

using vehicle::BehaviorCommand;

std::string figure(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string pair(const char* format, double first, double second) {
  char text[96];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

const char* formatFor(BehaviorCommand::Horizontal mode) {
  return mode == BehaviorCommand::Horizontal::Heading ? "heading %.1f deg" : "rudder %.1f deg";
}

const char* formatFor(BehaviorCommand::Vertical mode) {
  switch (mode) {
    case BehaviorCommand::Vertical::Depth:
      return "depth %.1f m";
    case BehaviorCommand::Vertical::Altitude:
      return "altitude %.1f m";
    case BehaviorCommand::Vertical::Pitch:
      return "pitch %.1f deg";
    case BehaviorCommand::Vertical::Elevator:
      break;
  }
  return "elevator %.1f deg";
}

const char* formatFor(BehaviorCommand::Speed mode) {
  return mode == BehaviorCommand::Speed::Rpm ? "%.0f rpm" : "speed %.2f m/s";
}

struct Words {
  std::string operator()(const BehaviorCommand& behavior) const {
    std::string text;
    const auto add = [&text](const auto& aspect) {
      if (!aspect) return;
      text += (text.empty() ? "" : ", ") + figure(formatFor(aspect->mode), aspect->value);
    };
    add(behavior.horizontal);
    add(behavior.vertical);
    add(behavior.speed);
    return text.empty() ? "everything as the vehicle has it" : text;
  }

  std::string operator()(const vehicle::DriveCommand& drive) const {
    return pair("port %.0f %%, starboard %.0f %%", 100.0 * drive.port, 100.0 * drive.starboard);
  }

  std::string operator()(const vehicle::HelmCommand& helm) const {
    return pair("thrust %.0f %%, turn %.2f rad/s clockwise", 100.0 * helm.thrust,
                helm.yaw_rate_rad_s);
  }

  std::string operator()(const vehicle::CourseCommand& course) const {
    return pair("heading %.1f deg, speed %.2f m/s", course.heading_deg, course.speed_m_s);
  }
};

}  // namespace

std::string toWords(const vehicle::Command& command) { return std::visit(Words{}, command); }

}  // namespace frontseat_driver::ros_layer
