#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $PYDIR: thrust of each motor. Kingfisher 0.1, section 4.0.
///
/// $PYDIR,l.l,r.r*hh
struct MotorThrust {
  static constexpr std::string_view kTitle = "command: thrust of each motor";
  static constexpr std::string_view kTalker = "PY";
  static constexpr std::string_view kFormatter = "DIR";

  std::optional<double> port_pct;       ///< -100..100
  std::optional<double> starboard_pct;  ///< -100..100
  int decimals = 0;                     ///< how many encode() writes; the document knows none

  static MotorThrust decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
