#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFCTL: the backseat was given or lost control. SPI 0.1, section 6.5 (whose table heads it BFVER
/// by mistake). Sent on change only.
///
/// $BFCTL,hhmmss.sss,c*hh
struct BackseatControl {
  static constexpr std::string_view kTitle = "backseat control";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "CTL";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<bool> backseat_in_control;

  static BackseatControl decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
