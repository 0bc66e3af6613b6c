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

void Ctd::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "conductivity", unit::kMicrosiemensPerCentimeter}, conductivity_us_cm);
  out.number({3, "temperature", unit::kCelsius}, temperature_c);
  out.number({4, "pressure", unit::kKilopascals}, pressure_kpa);
  out.time({5, "measured_at"}, measured_at);
}

}  // namespace frontseat_driver::protocol::bluefin
