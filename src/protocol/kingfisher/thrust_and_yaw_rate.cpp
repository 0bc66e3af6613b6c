#include "frontseat_driver/protocol/kingfisher/thrust_and_yaw_rate.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

ThrustAndYawRate ThrustAndYawRate::decode(nmea::FieldReader& in) {
  ThrustAndYawRate message;
  message.yaw_rate = in.number();
  message.thrust_pct = in.numberIn(-100.0, 100.0);
  return message;
}

void ThrustAndYawRate::encode(nmea::SentenceWriter& out) const {
  out.number(yaw_rate, kRateDecimals);
  out.number(thrust_pct, decimals);
}

void ThrustAndYawRate::describe(FieldVisitor& out) const {
  out.number({1, "yaw_rate", unit::kTurnRate}, yaw_rate);
  out.number({2, "thrust", unit::kPercent}, thrust_pct);
}

}  // namespace frontseat_driver::protocol::kingfisher
