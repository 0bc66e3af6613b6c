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

}  // namespace frontseat_driver::protocol::bluefin
