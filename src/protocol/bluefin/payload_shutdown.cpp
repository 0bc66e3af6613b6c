#include "frontseat_driver/protocol/bluefin/payload_shutdown.h"

namespace frontseat_driver::protocol::bluefin {

PayloadShutdown PayloadShutdown::decode(nmea::FieldReader& in) {
  PayloadShutdown message;
  message.sent_at = in.timeOfDay();
  return message;
}

void PayloadShutdown::encode(nmea::SentenceWriter& out) const { out.timeOfDay(sent_at); }

void PayloadShutdown::describe(FieldVisitor& out) const { out.time({1, "sent_at"}, sent_at); }

}  // namespace frontseat_driver::protocol::bluefin
