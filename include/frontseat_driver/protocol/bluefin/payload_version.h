#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BPVER: version of the interface the payload speaks; must be sent first. SPI 0.1, section 7.5.
///
/// $BPVER,hhmmss.sss,v-v*hh
struct PayloadVersion {
  static constexpr std::string_view kTitle = "interface version of the payload";
  static constexpr std::string_view kTalker = "BP";
  static constexpr std::string_view kFormatter = "VER";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view version;

  static PayloadVersion decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
