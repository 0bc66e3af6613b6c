#include "frontseat_driver/protocol/bluefin/mission_status.h"

namespace frontseat_driver::protocol::bluefin {

MissionStatus MissionStatus::decode(nmea::FieldReader& in) {
  MissionStatus message;
  message.sent_at = in.timeOfDay();
  message.dive_file = in.text();
  message.status = in.text();
  message.details = in.text();
  return message;
}

void MissionStatus::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(dive_file);
  out.text(status);
  out.text(details);
}

void MissionStatus::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "dive_file"}, dive_file);
  out.text({3, "status"}, status);
  out.text({4, "details"}, details);
}

}  // namespace frontseat_driver::protocol::bluefin
