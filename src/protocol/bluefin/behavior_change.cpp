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

}  // namespace frontseat_driver::protocol::bluefin
