#include "frontseat_driver/protocol/kingfisher/raw_compass.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

RawCompass RawCompass::decode(nmea::FieldReader& in) {
  RawCompass message;
  message.sent_at = in.timeOfDay();
  message.compass_id = in.integer();
  message.heading_deg = heading(in);
  message.pitch_deg = pitch(in);
  message.roll_deg = roll(in);
  message.measured_at = in.timeOfDay();
  return message;
}

void RawCompass::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.integer(compass_id);
  writeHeading(heading_deg, kAngleDecimals, out);
  out.number(pitch_deg, kAngleDecimals);
  out.number(roll_deg, kAngleDecimals);
  out.timeOfDay(measured_at);
}

void RawCompass::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.integer({2, "compass_id"}, compass_id);
  out.number({3, "heading", unit::kDegrees}, heading_deg);
  out.number({4, "pitch", unit::kDegrees}, pitch_deg);
  out.number({5, "roll", unit::kDegrees}, roll_deg);
  out.time({6, "measured_at"}, measured_at);
}

}  // namespace frontseat_driver::protocol::kingfisher
