#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BPLOG: turns one kind of sentence, or ALL but ACK, on or off. SPI 0.1, section 7.1. It has no
/// time.
///
/// $BPLOG,rrr,ON*hh
struct LogRequest {
  static constexpr std::string_view kTitle = "log request";
  static constexpr std::string_view kTalker = "BP";
  static constexpr std::string_view kFormatter = "LOG";

  std::string_view sentence;  ///< three letters, or "ALL"
  std::optional<bool> on;

  static LogRequest decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
