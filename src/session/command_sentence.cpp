#include "frontseat_driver/session/command_sentence.h"

#include <algorithm>
#include <cmath>

namespace frontseat_driver::session {

namespace {

using protocol::Dialect;
using protocol::bluefin::BehaviorChange;
using vehicle::BehaviorCommand;

constexpr double kPercent = 100.0;
constexpr double kDegreesPerRadian = 180.0 / M_PI;

BehaviorChange::HorizontalMode toWire(BehaviorCommand::Horizontal mode) {
  return mode == BehaviorCommand::Horizontal::Heading ? BehaviorChange::HorizontalMode::Heading
                                                      : BehaviorChange::HorizontalMode::Rudder;
}

BehaviorChange::VerticalMode toWire(BehaviorCommand::Vertical mode) {
  switch (mode) {
    case BehaviorCommand::Vertical::Depth:
      return BehaviorChange::VerticalMode::Depth;
    case BehaviorCommand::Vertical::Altitude:
      return BehaviorChange::VerticalMode::Altitude;
    case BehaviorCommand::Vertical::Pitch:
      return BehaviorChange::VerticalMode::Pitch;
    case BehaviorCommand::Vertical::Elevator:
      break;
  }
  return BehaviorChange::VerticalMode::Elevator;
}

using SpeedAspect = BehaviorCommand::Aspect<BehaviorCommand::Speed>;

SpeedAspect asTableSays(const SpeedAspect& speed, const std::vector<SpeedPoint>& table) {
  if (table.empty() || speed.mode == BehaviorCommand::Speed::Rpm) return speed;
  return {BehaviorCommand::Speed::Rpm, rpmFor(speed.value, table)};
}

// A frontseat that cannot take an empty field gets what the vehicle does already. What is not known
// stays empty: a made-up value would be a command.
BehaviorCommand filled(BehaviorCommand command, const PresentState& present) {
  if (!command.horizontal && present.heading_deg) {
    command.horizontal = {BehaviorCommand::Horizontal::Heading, *present.heading_deg};
  }
  if (!command.vertical && present.depth_m) {
    command.vertical = {BehaviorCommand::Vertical::Depth, std::max(0.0, *present.depth_m)};
  }
  if (!command.speed && present.speed_m_s) {
    command.speed = {BehaviorCommand::Speed::MetresPerSecond, *present.speed_m_s};
  }
  return command;
}

struct Sentence {
  const CommandFormat& format;
  const PresentState& present;
  nmea::TimeOfDay time;

  nmea::SentenceWriter operator()(const BehaviorCommand& command) const {
    const BehaviorCommand wanted = format.fill_behavior_fields ? filled(command, present) : command;
    BehaviorChange change;
    change.sent_at = time;
    if (wanted.horizontal) {
      change.horizontal = wanted.horizontal->value;
      change.horizontal_mode = toWire(wanted.horizontal->mode);
    }
    if (wanted.vertical) {
      change.vertical = wanted.vertical->value;
      change.vertical_mode = toWire(wanted.vertical->mode);
    }
    if (wanted.speed) {
      const SpeedAspect speed = asTableSays(*wanted.speed, format.speed_table);
      change.speed = speed.value;
      change.speed_mode = speed.mode == BehaviorCommand::Speed::Rpm
                              ? BehaviorChange::SpeedMode::Rpm
                              : BehaviorChange::SpeedMode::Speed;
    }
    return protocol::write(change);
  }

  nmea::SentenceWriter operator()(const vehicle::DriveCommand& command) const {
    protocol::kingfisher::MotorThrust thrust;
    thrust.port_pct = command.port * kPercent;
    thrust.starboard_pct = command.starboard * kPercent;
    thrust.decimals = format.thrust_decimals;
    return protocol::write(thrust);
  }

  nmea::SentenceWriter operator()(const vehicle::HelmCommand& command) const {
    protocol::kingfisher::ThrustAndYawRate helm;
    helm.yaw_rate = command.yaw_rate_rad_s * (format.yaw_rate_in_degrees ? kDegreesPerRadian : 1.0);
    helm.thrust_pct = command.thrust * kPercent;
    helm.decimals = format.thrust_decimals;
    return protocol::write(helm);
  }

  nmea::SentenceWriter operator()(const vehicle::CourseCommand& command) const {
    protocol::kingfisher::HeadingAndSpeed course;
    course.heading_deg = command.heading_deg;
    course.speed_m_s = command.speed_m_s;
    return protocol::write(course);
  }
};

}  // namespace

Dialect dialectOf(const vehicle::Command& command) {
  return std::holds_alternative<BehaviorCommand>(command) ? Dialect::Sandshark
                                                          : Dialect::Kingfisher;
}

nmea::SentenceWriter commandSentence(const vehicle::Command& command, const CommandFormat& format,
                                     const PresentState& present, nmea::TimeOfDay time) {
  return std::visit(Sentence{format, present, time}, command);
}

bool canBeSent(const vehicle::Command& command, const CommandFormat& format,
               const PresentState& present) {
  const auto* behavior = std::get_if<BehaviorCommand>(&command);
  if (!behavior || !format.fill_behavior_fields) return true;
  const BehaviorCommand wanted = filled(*behavior, present);
  return wanted.horizontal && wanted.vertical && wanted.speed;
}

nmea::SentenceWriter zeroThrust() {
  protocol::kingfisher::MotorThrust thrust;
  thrust.port_pct = 0.0;
  thrust.starboard_pct = 0.0;
  return protocol::write(thrust);
}

double rpmFor(double speed_m_s, const std::vector<SpeedPoint>& table) {
  SpeedPoint below;
  for (const SpeedPoint& point : table) {
    if (speed_m_s <= point.speed_m_s) {
      const double span_m_s = point.speed_m_s - below.speed_m_s;
      if (span_m_s <= 0.0) return point.rpm;
      return below.rpm + (point.rpm - below.rpm) * (speed_m_s - below.speed_m_s) / span_m_s;
    }
    below = point;
  }
  return below.rpm;
}

}  // namespace frontseat_driver::session
