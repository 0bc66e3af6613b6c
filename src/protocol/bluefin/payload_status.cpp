#include "frontseat_driver/protocol/bluefin/payload_status.h"

#include "../fields.h"

namespace frontseat_driver::protocol::bluefin {

PayloadStatus PayloadStatus::decode(nmea::FieldReader& in) {
  PayloadStatus message;
  message.sent_at = in.timeOfDay();
  message.ok = flag(in);
  message.message = in.text();
  return message;
}

void PayloadStatus::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  writeFlag(ok, out);
  out.text(message);
}

}  // namespace frontseat_driver::protocol::bluefin
