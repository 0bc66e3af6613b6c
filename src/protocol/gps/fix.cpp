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

}  // namespace frontseat_driver::protocol::gps
