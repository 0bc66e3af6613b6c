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

void MotorThrust::describe(FieldVisitor& out) const {
  out.number({1, "port", unit::kPercent}, port_pct);
  out.number({2, "starboard", unit::kPercent}, starboard_pct);
}

}  // namespace frontseat_driver::protocol::kingfisher
