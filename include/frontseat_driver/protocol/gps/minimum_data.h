#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::gps {

/// RMC of any talker: position, velocity, date. NMEA 0183, sentence RMC; Kingfisher 0.1,
/// section 3.0.
///
/// $GPRMC,hhmmss.ss,A,llll.ll,a,yyyyy.yy,b,s.s,c.c,ddmmyy,v.v,e,m*hh
///        1         2 3       4 5        6 7   8   9      10  11 12
struct MinimumData {
  static constexpr std::string_view kTitle = "GPS position, velocity, date";
  static constexpr std::string_view kFormatter = "RMC";

  std::optional<nmea::TimeOfDay> measured_at;  ///< UTC
  bool valid = false;                          ///< status A
  std::optional<nmea::LatLon> position;
  std::optional<double> speed_kn;
  std::optional<double> course_deg;  ///< over ground, from true north
  std::optional<nmea::Date> date;

  static MinimumData decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::gps
