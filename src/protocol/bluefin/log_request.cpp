#include "frontseat_driver/protocol/bluefin/log_request.h"

namespace frontseat_driver::protocol::bluefin {

LogRequest LogRequest::decode(nmea::FieldReader& in) {
  LogRequest message;
  message.sentence = in.text();
  message.on = in.either("ON", "OFF");
  return message;
}

void LogRequest::encode(nmea::SentenceWriter& out) const {
  out.text(sentence);
  if (!on) return out.blank();
  out.text(*on ? "ON" : "OFF");
}

void LogRequest::describe(FieldVisitor& out) const {
  out.text({1, "sentence"}, sentence);
  out.flag({2, "on"}, on);
}

}  // namespace frontseat_driver::protocol::bluefin
