#include "frontseat_driver/protocol/bluefin/raw_vehicle_speed.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

RawVehicleSpeed RawVehicleSpeed::decode(nmea::FieldReader& in) {
  RawVehicleSpeed message;
  message.sent_at = in.timeOfDay();
  message.thruster_rpm = in.number();
  message.water_speed_m_s = in.number();
  return message;
}

void RawVehicleSpeed::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(thruster_rpm, kLengthDecimals);
  out.number(water_speed_m_s, kVelocityDecimals);
}

void RawVehicleSpeed::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "thruster", unit::kRpm}, thruster_rpm);
  out.number({3, "water_speed", unit::kMetersPerSecond}, water_speed_m_s);
}

}  // namespace frontseat_driver::protocol::bluefin
