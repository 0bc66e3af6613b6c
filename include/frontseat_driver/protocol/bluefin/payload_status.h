#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BPSTS: how the payload is. SPI 0.1, section 7.2.
///
/// $BPSTS,hhmmss.sss,f,m--m*hh
struct PayloadStatus {
  static constexpr std::string_view kTitle = "status of the payload";
  static constexpr std::string_view kTalker = "BP";
  static constexpr std::string_view kFormatter = "STS";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<bool> ok;
  std::string_view message;

  static PayloadStatus decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
