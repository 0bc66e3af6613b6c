#include "frontseat_driver/protocol/bluefin/sound_speed.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

SoundSpeed SoundSpeed::decode(nmea::FieldReader& in) {
  SoundSpeed message;
  message.sent_at = in.timeOfDay();
  message.sound_speed_m_s = in.number();
  return message;
}

void SoundSpeed::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(sound_speed_m_s, kLengthDecimals);
}

void SoundSpeed::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "sound_speed", unit::kMetersPerSecond}, sound_speed_m_s);
}

}  // namespace frontseat_driver::protocol::bluefin
