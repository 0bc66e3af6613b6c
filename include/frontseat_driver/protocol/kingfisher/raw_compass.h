#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $CPRCM: a compass as the vehicle read it. Kingfisher 0.1, section 3.0.
///
/// $CPRCM,hhmmss.sss,i,h.h,p.p,r.r,hhmmss.sss*hh
///        1          2 3   4   5   6
struct RawCompass {
  static constexpr std::string_view kTitle = "compass";
  static constexpr std::string_view kTalker = "CP";
  static constexpr std::string_view kFormatter = "RCM";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<std::int64_t> compass_id;  ///< from 1 by the document, 0 on field vehicles
  std::optional<double> heading_deg;
  std::optional<double> pitch_deg;
  std::optional<double> roll_deg;
  std::optional<nmea::TimeOfDay> measured_at;  ///< blank: sent_at

  static RawCompass decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
