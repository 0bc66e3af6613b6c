#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFRVL: thruster and water speed. Public extra Bluefin sentence; named in Kingfisher 0.1,
/// Appendix A.
///
/// $BFRVL,hhmmss.sss,r.r,s.s*hh
struct RawVehicleSpeed {
  static constexpr std::string_view kTitle = "thruster and water speed";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "RVL";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> thruster_rpm;
  std::optional<double> water_speed_m_s;  ///< through the water; may be empty

  static RawVehicleSpeed decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
