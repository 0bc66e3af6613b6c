#include "frontseat_driver/protocol/bluefin/behavior_change.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {
namespace {

/// A mode counted from 0 up to `last`.
template <class Mode>
std::optional<Mode> code(nmea::FieldReader& in, Mode last) {
  const auto number = in.integer(0, static_cast<std::int64_t>(last));
  return number ? std::optional<Mode>{static_cast<Mode>(*number)} : std::nullopt;
}

template <class Mode>
std::optional<std::size_t> index(const std::optional<Mode>& mode) {
  return mode ? std::optional<std::size_t>{static_cast<std::size_t>(*mode)} : std::nullopt;
}

template <class Mode>
void writeCode(const std::optional<Mode>& mode, nmea::SentenceWriter& out) {
  if (!mode) return out.blank();
  out.integer(static_cast<std::int64_t>(*mode));
}

}  // namespace

BehaviorChange BehaviorChange::decode(nmea::FieldReader& in) {
  BehaviorChange message;
  message.sent_at = in.timeOfDay();
  message.horizontal = in.number();
  message.vertical = in.number();
  message.vertical_mode = code(in, VerticalMode::Elevator);
  message.speed = in.number();
  message.speed_mode = code(in, SpeedMode::Speed);
  message.horizontal_mode = code(in, HorizontalMode::Rudder);
  return message;
}

void BehaviorChange::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  if (horizontal_mode == HorizontalMode::Heading) {
    writeHeading(horizontal, kAngleDecimals, out);
  } else {
    out.number(horizontal, kAngleDecimals);
  }
  out.number(vertical, kLengthDecimals);
  writeCode(vertical_mode, out);
  out.number(speed, kLengthDecimals);
  writeCode(speed_mode, out);
  writeCode(horizontal_mode, out);
}

void BehaviorChange::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "horizontal"}, horizontal);
  out.number({3, "vertical"}, vertical);
  out.choice({4, "vertical_mode"}, index(vertical_mode),
             {"depth_m", "altitude_m", "pitch_deg", "elevator_deg"});
  out.number({5, "speed"}, speed);
  out.choice({6, "speed_mode"}, index(speed_mode), {"rpm", "m_s"});
  out.choice({7, "horizontal_mode"}, index(horizontal_mode), {"heading_deg", "rudder_deg"});
}

}  // namespace frontseat_driver::protocol::bluefin
