#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol {

/// $BFNVG and $CPNVG: where the frontseat believes it is. SPI 0.1, section 6.1; Kingfisher 0.1,
/// section 3.0.
///
/// $BFNVG,hhmmss.sss,llll.ll,a,yyyyy.yy,b,g,c.c,d.d,h.h,r.r,p.p,hhmmss.sss*hh
///        1          2       3 4        5 6 7   8   9   10  11  12
struct NavigationUpdate {
  static constexpr std::string_view kTitle = "navigation update";
  static constexpr std::string_view kFormatter = "NVG";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<nmea::LatLon> position;  ///< WGS-84
  std::optional<bool> from_gps;          ///< false: dead reckoning
  std::optional<double> altitude_m;      ///< above the bottom; 0 from a Sandshark: no bottom found
  std::optional<double> depth_m;         ///< below the surface
  std::optional<double> heading_deg;     ///< [0, 360); BF: from grid north, CP: from true north
  std::optional<double> roll_deg;        ///< positive port side up
  std::optional<double> pitch_deg;       ///< positive bow up
  std::optional<nmea::TimeOfDay> computed_at;  ///< when the solution was valid; blank: sent_at

  static NavigationUpdate decode(nmea::FieldReader& in, nmea::DegreeSplit split);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol
