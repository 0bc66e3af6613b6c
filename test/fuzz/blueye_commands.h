#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <variant>

#include "frontseat_driver/session/blueye_session.h"
#include "fuzz.h"

// What a user of a Blueye may want, and how it must be on the wire.

namespace frontseat_driver::fuzz {

inline session::BlueyeOptions anyBlueyeOptions(Dice& dice) {
  session::BlueyeOptions options;
  const unsigned flags = dice.byte();
  options.observer = (flags & 1U) == 0;
  options.commands_enabled = (flags & 2U) == 0;
  options.clockwise_yaw = (flags & 4U) == 0;
  options.sync_time = (flags & 8U) == 0;
  options.allow_format = (flags & 16U) != 0;
  options.listen_only = (flags & 96U) == 96U;
  if ((flags & 128U) != 0) {
    options.rates_hz = {{"DepthTel", 40.0}, {"AttitudeTel", 0.0}};
    options.water_density_kg_m3 = 1000.0;
    options.pinger_mounting = session::PingerMounting::Downwards;
  }
  options.command_timeout = std::chrono::milliseconds{1 + dice.byte() * 8};
  options.command_rate_hz = 1.0 + dice.byte() % 30;
  return options;
}

/// A command as the wire must say it; zero in the first `moving` of them is rest.
struct Said {
  std::array<float, 8> values{};
  std::size_t moving = 6;

  bool rests() const {
    return std::all_of(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(moving),
                       [](float value) { return value == 0.0F; });
  }
};

/// -1 to 1, both and 0 among them.
inline double part(Dice& dice) {
  return std::max(-1.0, (static_cast<double>(dice.byte()) - 128.0) / 127.0);
}

inline vehicle::DroneCommand anyDroneCommand(Dice& dice) {
  const unsigned kind = dice.byte() % 4;
  if (kind == 2) return vehicle::TiltCommand{part(dice)};
  if (kind == 3) return vehicle::GripperCommand{part(dice), part(dice)};
  vehicle::MotionCommand motion;
  motion.surge = part(dice);
  motion.sway = part(dice);
  motion.heave = part(dice);
  motion.yaw = part(dice);
  if (kind == 0) return motion;
  motion.roll = part(dice);
  motion.pitch = part(dice);
  motion.slow = std::abs(part(dice));
  motion.boost = std::abs(part(dice));
  return motion;
}

inline Said toWire(const vehicle::DroneCommand& command, bool clockwise_yaw) {
  const auto f = [](double value) { return static_cast<float>(value); };
  if (const auto* tilt = std::get_if<vehicle::TiltCommand>(&command)) {
    return {{f(tilt->velocity)}, 1};
  }
  if (const auto* gripper = std::get_if<vehicle::GripperCommand>(&command)) {
    return {{f(gripper->grip), f(gripper->rotate)}, 2};
  }
  const auto& motion = std::get<vehicle::MotionCommand>(command);
  const double yaw = clockwise_yaw ? motion.yaw : -motion.yaw;
  return {{f(motion.surge), f(motion.sway), f(motion.heave), f(motion.roll), f(motion.pitch),
           f(yaw), f(motion.slow), f(motion.boost)},
          6};
}

}  // namespace frontseat_driver::fuzz
