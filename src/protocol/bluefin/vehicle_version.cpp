#include "frontseat_driver/protocol/bluefin/vehicle_version.h"

namespace frontseat_driver::protocol::bluefin {

VehicleVersion VehicleVersion::decode(nmea::FieldReader& in) {
  VehicleVersion message;
  message.sent_at = in.timeOfDay();
  message.version = in.text();
  return message;
}

void VehicleVersion::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.text(version);
}

void VehicleVersion::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.text({2, "version"}, version);
}

}  // namespace frontseat_driver::protocol::bluefin
