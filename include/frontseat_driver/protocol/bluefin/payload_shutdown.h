#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFSHT: the payload loses its power, one minute from now at the earliest. SPI 0.1, section 5.1.
///
/// $BFSHT,hhmmss.sss*hh
struct PayloadShutdown {
  static constexpr std::string_view kTitle = "payload power goes off";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "SHT";

  std::optional<nmea::TimeOfDay> sent_at;

  static PayloadShutdown decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
