#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::gps {

/// GGA of any talker: position and its quality. NMEA 0183, sentence GGA; Kingfisher 0.1,
/// section 3.0.
///
/// $GPGGA,hhmmss.ss,llll.ll,a,yyyyy.yy,b,q,nn,h.h,a.a,M,g.g,M,t.t,iiii*hh
///        1         2       3 4        5 6 7  8   9  10 11 12 13  14
struct Fix {
  static constexpr std::string_view kTitle = "GPS fix";
  static constexpr std::string_view kFormatter = "GGA";

  std::optional<nmea::TimeOfDay> measured_at;  ///< UTC
  std::optional<nmea::LatLon> position;
  std::optional<std::int64_t>
      quality;  ///< 0 no fix, 1 GPS, 2 differential, 4 and 5 RTK, 6 estimated
  std::optional<std::int64_t> satellites;
  std::optional<double> hdop;
  std::optional<double> altitude_m;          ///< above the geoid
  std::optional<double> geoid_separation_m;  ///< geoid above the ellipsoid

  static Fix decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::gps
