#include "frontseat_driver/protocol/bluefin/backseat_control.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

BackseatControl BackseatControl::decode(nmea::FieldReader& in) {
  BackseatControl message;
  message.sent_at = in.timeOfDay();
  message.backseat_in_control = flag(in);
  return message;
}

void BackseatControl::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  writeFlag(backseat_in_control, out);
}

void BackseatControl::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.flag({2, "backseat_in_control"}, backseat_in_control);
}

}  // namespace frontseat_driver::protocol::bluefin
