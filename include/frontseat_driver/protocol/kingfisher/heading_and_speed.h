#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $PYDEV: a heading and a speed, kept by the vehicle. Kingfisher 0.1, section 4.0.
///
/// $PYDEV,h,s.s*hh
struct HeadingAndSpeed {
  static constexpr std::string_view kTitle = "command: heading and speed";
  static constexpr std::string_view kTalker = "PY";
  static constexpr std::string_view kFormatter = "DEV";

  std::optional<double> heading_deg;  ///< from true north; sent as whole degrees 0..359
  std::optional<double> speed_m_s;    ///< 0 or more

  static HeadingAndSpeed decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
