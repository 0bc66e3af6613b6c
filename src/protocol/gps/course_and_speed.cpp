#include "frontseat_driver/protocol/gps/course_and_speed.h"

#include "../fields.h"

namespace frontseat_driver::protocol::gps {

CourseAndSpeed CourseAndSpeed::decode(nmea::FieldReader& in) {
  CourseAndSpeed message;
  message.course_true_deg = heading(in);
  in.text();
  message.course_magnetic_deg = heading(in);
  in.text();
  message.speed_kn = in.number();
  in.text();
  message.speed_km_h = in.number();
  return message;
}

void CourseAndSpeed::encode(nmea::SentenceWriter& out) const {
  writeHeading(course_true_deg, 2, out);
  out.text("T");
  writeHeading(course_magnetic_deg, 2, out);
  out.text("M");
  out.number(speed_kn, 3);
  out.text("N");
  out.number(speed_km_h, 3);
  out.text("K");
  out.text(speed_kn ? "A" : "N");
}

void CourseAndSpeed::describe(FieldVisitor& out) const {
  out.number({1, "course_true", unit::kDegrees}, course_true_deg);
  out.number({3, "course_magnetic", unit::kDegrees}, course_magnetic_deg);
  out.number({5, "speed", unit::kKnots}, speed_kn);
  out.number({7, "speed", unit::kKilometersPerHour}, speed_km_h);
}

}  // namespace frontseat_driver::protocol::gps
