#include "frontseat_driver/protocol/bluefin/behavior_end.h"

namespace frontseat_driver::protocol::bluefin {

BehaviorEnd BehaviorEnd::decode(nmea::FieldReader& in) {
  BehaviorEnd message;
  message.sent_at = in.timeOfDay();
  message.dive_file = in.text();
  message.number = in.text();
  message.payload_behavior_id = in.text();
  message.behavior_type = in.text();
  return message;
}

void BehaviorEnd::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(dive_file);
  out.text(number);
  out.text(payload_behavior_id);
  out.text(behavior_type);
}

}  // namespace frontseat_driver::protocol::bluefin
