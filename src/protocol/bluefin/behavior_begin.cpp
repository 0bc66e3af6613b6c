#include "frontseat_driver/protocol/bluefin/behavior_begin.h"

namespace frontseat_driver::protocol::bluefin {

BehaviorBegin BehaviorBegin::decode(nmea::FieldReader& in) {
  BehaviorBegin message;
  message.sent_at = in.timeOfDay();
  message.dive_file = in.text();
  message.number = in.text();
  message.payload_behavior_id = in.text();
  message.behavior_type = in.text();
  return message;
}

void BehaviorBegin::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(dive_file);
  out.text(number);
  out.text(payload_behavior_id);
  out.text(behavior_type);
}

void BehaviorBegin::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "dive_file"}, dive_file);
  out.text({3, "number"}, number);
  out.text({4, "payload_behavior_id"}, payload_behavior_id);
  out.text({5, "behavior_type"}, behavior_type);
}

}  // namespace frontseat_driver::protocol::bluefin
