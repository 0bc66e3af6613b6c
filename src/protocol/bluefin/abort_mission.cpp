#include "frontseat_driver/protocol/bluefin/abort_mission.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

AbortMission AbortMission::decode(nmea::FieldReader& in) {
  AbortMission message;
  message.sent_at = in.timeOfDay();
  message.message = in.text();
  in.optionalFromHere();
  message.with_errors = flag(in);
  return message;
}

void AbortMission::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(message);
  writeFlag(with_errors, out);
}

void AbortMission::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "message"}, message);
  out.flag({3, "with_errors"}, with_errors);
}

}  // namespace frontseat_driver::protocol::bluefin
