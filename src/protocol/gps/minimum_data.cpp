#include "frontseat_driver/protocol/gps/minimum_data.h"

#include "../fields.h"

namespace frontseat_driver::protocol::gps {

MinimumData MinimumData::decode(nmea::FieldReader& in) {
  MinimumData message;
  message.measured_at = in.timeOfDay();
  message.valid = in.either('A', 'V').value_or(false);
  message.position = in.latLon(nmea::DegreeSplit::FromPoint);
  message.speed_kn = in.number();
  message.course_deg = heading(in);
  message.date = in.date();
  return message;
}

void MinimumData::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(measured_at);
  out.text(valid ? "A" : "V");
  out.latLon(position, kMinuteDecimals);
  out.number(speed_kn, 3);
  writeHeading(course_deg, 2, out);
  out.date(date);
  out.blank();
  out.blank();
  out.text(valid ? "A" : "N");
}

void MinimumData::describe(FieldVisitor& out) const {
  out.time({1, "measured_at"}, measured_at);
  out.flag({2, "valid"}, valid);
  out.position({3, "position"}, position);
  out.number({7, "speed", unit::kKnots}, speed_kn);
  out.number({8, "course", unit::kDegrees}, course_deg);
  out.date({9, "date"}, date);
}

}  // namespace frontseat_driver::protocol::gps
