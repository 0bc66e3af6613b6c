#include "frontseat_driver/protocol/kingfisher/battery_voltage.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

BatteryVoltage BatteryVoltage::decode(nmea::FieldReader& in) {
  BatteryVoltage message;
  message.sent_at = in.timeOfDay();
  const bool has_id = in.remaining() > 4;  // without it, three voltages and a temperature
  if (has_id) message.battery_id = in.integer();
  message.stack_v = in.number();
  message.lowest_cell_v = in.number();
  message.highest_cell_v = in.number();
  message.temperature_c = in.number();
  return message;
}

void BatteryVoltage::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  if (battery_id) out.integer(*battery_id);
  out.number(stack_v, kVoltageDecimals);
  out.number(lowest_cell_v, kVoltageDecimals);
  out.number(highest_cell_v, kVoltageDecimals);
  out.number(temperature_c, kLengthDecimals);
}

}  // namespace frontseat_driver::protocol::kingfisher
