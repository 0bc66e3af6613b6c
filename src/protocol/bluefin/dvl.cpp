#include "frontseat_driver/protocol/bluefin/dvl.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

Dvl Dvl::decode(nmea::FieldReader& in) {
  Dvl message;
  message.sent_at = in.timeOfDay();
  message.bow_m_s = in.number();
  message.starboard_m_s = in.number();
  message.down_m_s = in.number();
  for (auto& range : message.beam_range_m) range = in.number();
  message.temperature_c = in.number();
  message.measured_at = in.timeOfDay();
  return message;
}

void Dvl::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(bow_m_s, kVelocityDecimals);
  out.number(starboard_m_s, kVelocityDecimals);
  out.number(down_m_s, kVelocityDecimals);
  for (const auto& range : beam_range_m) out.number(range, kLengthDecimals);
  out.number(temperature_c, kLengthDecimals);
  out.timeOfDay(measured_at);
}

}  // namespace frontseat_driver::protocol::bluefin
