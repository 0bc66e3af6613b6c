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

void PayloadStatus::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.flag({2, "ok"}, ok);
  out.text({3, "message"}, message);
}

}  // namespace frontseat_driver::protocol::bluefin
