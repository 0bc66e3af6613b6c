#include "frontseat_driver/protocol/bluefin/ctd.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

Ctd Ctd::decode(nmea::FieldReader& in) {
  Ctd message;
  message.sent_at = in.timeOfDay();
  message.conductivity_us_cm = in.number();
  message.temperature_c = in.number();
  message.pressure_kpa = in.number();
  message.measured_at = in.timeOfDay();
  return message;
}

void Ctd::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(conductivity_us_cm, kLengthDecimals);
  out.number(temperature_c, kLengthDecimals);
  out.number(pressure_kpa, kLengthDecimals);
  out.timeOfDay(measured_at);
}

}  // namespace frontseat_driver::protocol::bluefin
