#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFMIS: the mission changed its state. SPI 0.1, section 6.3.
///
/// $BFMIS,hhmmss.sss,d--d,t--t,a--a*hh
///        1          2    3    4
struct MissionStatus {
  static constexpr std::string_view kTitle = "mission status";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "MIS";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view dive_file;  ///< may be empty
  std::string_view status;     ///< as sent; "Running" may go on with the log directory
  std::string_view details;    ///< for people

  static MissionStatus decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
