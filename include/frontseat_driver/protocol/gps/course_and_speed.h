#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::gps {

/// VTG of any talker: course and speed over ground. NMEA 0183, sentence VTG.
///
/// $GPVTG,c.c,T,c.c,M,s.s,N,s.s,K,m*hh
///        1   2 3   4 5   6 7   8 9
struct CourseAndSpeed {
  static constexpr std::string_view kTitle = "GPS course and speed";
  static constexpr std::string_view kFormatter = "VTG";

  std::optional<double> course_true_deg;
  std::optional<double> course_magnetic_deg;
  std::optional<double> speed_kn;
  std::optional<double> speed_km_h;

  static CourseAndSpeed decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::gps
