#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BPABT: end the mission, run its wrap-up. SPI 0.1, section 7.4.
///
/// $BPABT,hhmmss.sss,c--c,a*hh
struct AbortMission {
  static constexpr std::string_view kTitle = "abort of the mission";
  static constexpr std::string_view kTalker = "BP";
  static constexpr std::string_view kFormatter = "ABT";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view message;
  std::optional<bool> with_errors;  ///< blank: true, the default of the document

  static AbortMission decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
