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

void BehaviorEnd::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "dive_file"}, dive_file);
  out.text({3, "number"}, number);
  out.text({4, "payload_behavior_id"}, payload_behavior_id);
  out.text({5, "behavior_type"}, behavior_type);
}

}  // namespace frontseat_driver::protocol::bluefin
