#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFVER: version of the interface the vehicle speaks; sent first. SPI 0.1, section 5.2.
///
/// $BFVER,hhmmss.sss,v-v*hh
struct VehicleVersion {
  static constexpr std::string_view kTitle = "interface version of the vehicle";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "VER";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view version;  ///< "SS_0.0" on a field vehicle

  static VehicleVersion decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
