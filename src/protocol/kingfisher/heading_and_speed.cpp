#include "frontseat_driver/protocol/kingfisher/heading_and_speed.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

HeadingAndSpeed HeadingAndSpeed::decode(nmea::FieldReader& in) {
  HeadingAndSpeed message;
  message.heading_deg = heading(in);
  message.speed_m_s = in.number();
  return message;
}

void HeadingAndSpeed::encode(nmea::SentenceWriter& out) const {
  writeHeading(heading_deg, 0, out);
  out.number(speed_m_s, kLengthDecimals);
}

void HeadingAndSpeed::describe(FieldVisitor& out) const {
  out.number({1, "heading", unit::kDegrees}, heading_deg);
  out.number({2, "speed", unit::kMetersPerSecond}, speed_m_s);
}

}  // namespace frontseat_driver::protocol::kingfisher
