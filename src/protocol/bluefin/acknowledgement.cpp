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

void Acknowledgement::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "command"}, command);
  out.time({3, "command_time"}, command_time);
  out.text({4, "behavior_id"}, behavior_id);
  const auto index =
      status ? std::optional<std::size_t>{static_cast<std::size_t>(*status)} : std::nullopt;
  out.choice({5, "status"}, index, {"invalid", "failed", "done", "pending"});
  out.text({7, "message"}, message);
}

}  // namespace frontseat_driver::protocol::bluefin
