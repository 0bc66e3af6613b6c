#include "frontseat_driver/protocol/kingfisher/motor_thrust.h"

namespace frontseat_driver::protocol::kingfisher {

MotorThrust MotorThrust::decode(nmea::FieldReader& in) {
  MotorThrust message;
  message.port_pct = in.numberIn(-100.0, 100.0);
  message.starboard_pct = in.numberIn(-100.0, 100.0);
  return message;
}

void MotorThrust::encode(nmea::SentenceWriter& out) const {
  out.number(port_pct, decimals);
  out.number(starboard_pct, decimals);
}

}  // namespace frontseat_driver::protocol::kingfisher
