#include "frontseat_driver/protocol/kingfisher/battery_voltage.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

BatteryVoltage BatteryVoltage::decode(nmea::FieldReader& in) {
  BatteryVoltage message;
  message.sent_at = in.timeOfDay();
  const bool has_id = in.remaining() > 4;  // without it, three voltages and a temperature
  if (has_id) message.battery_id = in.integer();
  message.blank_id = has_id && !message.battery_id;
  message.stack_v = in.number();
  message.lowest_cell_v = in.number();
  message.highest_cell_v = in.number();
  message.temperature_c = in.number();
  return message;
}

void BatteryVoltage::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  if (battery_id) out.integer(*battery_id);
  if (blank_id) out.blank();
  out.number(stack_v, kVoltageDecimals);
  out.number(lowest_cell_v, kVoltageDecimals);
  out.number(highest_cell_v, kVoltageDecimals);
  out.number(temperature_c, kLengthDecimals);
}

void BatteryVoltage::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  // Without id, which field vehicles leave out, the others are one field nearer.
  const int first = battery_id || blank_id ? 3 : 2;
  out.integer({2, "battery_id"}, battery_id);
  out.number({first, "stack", unit::kVolts}, stack_v);
  out.number({first + 1, "lowest_cell", unit::kVolts}, lowest_cell_v);
  out.number({first + 2, "highest_cell", unit::kVolts}, highest_cell_v);
  out.number({first + 3, "temperature", unit::kCelsius}, temperature_c);
}

}  // namespace frontseat_driver::protocol::kingfisher
