#include "frontseat_driver/protocol/gps/fix.h"

#include "../fields.h"

namespace frontseat_driver::protocol::gps {

Fix Fix::decode(nmea::FieldReader& in) {
  Fix message;
  message.measured_at = in.timeOfDay();
  message.position = in.latLon(nmea::DegreeSplit::FromPoint);
  message.quality = in.integer(0, 9);
  message.satellites = in.integer(0, 999);
  message.hdop = in.number();
  message.altitude_m = in.number();
  in.text();  // M
  message.geoid_separation_m = in.number();
  return message;
}

void Fix::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(measured_at);
  out.latLon(position, kMinuteDecimals);
  out.integer(quality);
  out.integer(satellites);
  out.number(hdop, 2);
  out.number(altitude_m, 1);
  out.text("M");
  out.number(geoid_separation_m, 1);
  out.text("M");
  out.blank();
  out.blank();
}

void Fix::describe(FieldVisitor& out) const {
  out.time({1, "measured_at"}, measured_at);
  out.position({2, "position"}, position);
  out.integer({6, "quality"}, quality);
  out.integer({7, "satellites"}, satellites);
  out.number({8, "hdop"}, hdop);
  out.number({9, "altitude", unit::kMeters}, altitude_m);
  out.number({11, "geoid_separation", unit::kMeters}, geoid_separation_m);
}

}  // namespace frontseat_driver::protocol::gps
