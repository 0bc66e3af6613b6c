#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $PYDEP: a rate of turn and a thrust. Kingfisher 0.1, section 4.0.
///
/// $PYDEP,y.y,t.t*hh
struct ThrustAndYawRate {
  static constexpr std::string_view kTitle = "command: thrust and rate of turn";
  static constexpr std::string_view kTalker = "PY";
  static constexpr std::string_view kFormatter = "DEP";

  std::optional<double> yaw_rate;    ///< positive clockwise; rad/s, on Heron firmware deg/s
  std::optional<double> thrust_pct;  ///< -100..100
  int decimals = 0;  ///< of the thrust, how many encode() writes; the document knows none

  static ThrustAndYawRate decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
