#include "frontseat_driver/protocol/bluefin/payload_version.h"

namespace frontseat_driver::protocol::bluefin {

PayloadVersion PayloadVersion::decode(nmea::FieldReader& in) {
  PayloadVersion message;
  message.sent_at = in.timeOfDay();
  message.version = in.text();
  return message;
}

void PayloadVersion::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(version);
}

void PayloadVersion::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "version"}, version);
}

}  // namespace frontseat_driver::protocol::bluefin
