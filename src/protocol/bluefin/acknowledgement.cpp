#include "frontseat_driver/protocol/bluefin/acknowledgement.h"

namespace frontseat_driver::protocol::bluefin {

Acknowledgement Acknowledgement::decode(nmea::FieldReader& in) {
  Acknowledgement message;
  message.sent_at = in.timeOfDay();
  message.command = in.text();
  message.command_time = in.timeOfDay();
  message.behavior_id = in.text();
  message.status = in.integer(0, 3);
  in.text();
  in.optionalFromHere();
  message.message = in.text();
  return message;
}

void Acknowledgement::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(command);
  out.timeOfDay(command_time);
  out.text(behavior_id);
  out.integer(status);
  out.integer(0);
  out.text(message);
  out.blank();
}

}  // namespace frontseat_driver::protocol::bluefin
