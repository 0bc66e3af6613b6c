#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $CPRIM, which field vehicles call $CPIMU: the inertial sensor in body axes, x bow, y starboard,
/// z down. Kingfisher 0.1, section 3.0.
///
/// $CPRIM,hhmmss.sss,x.x,y.y,z.z,x.x,y.y,z.z,hhmmss.sss*hh
///        1          2   3   4   5   6   7   8
struct RawImu {
  static constexpr std::string_view kTitle = "inertial sensor";
  static constexpr std::string_view kTalker = "CP";
  static constexpr std::string_view kFormatter = "RIM";

  static constexpr std::string_view kFieldFormatter = "IMU";  ///< what field vehicles send

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> rate_x_deg_s;
  std::optional<double> rate_y_deg_s;
  std::optional<double> rate_z_deg_s;
  std::optional<double> acceleration_x;  ///< m/s^2 by the document; older boats send g
  std::optional<double> acceleration_y;
  std::optional<double> acceleration_z;
  std::optional<nmea::TimeOfDay> measured_at;  ///< blank or missing: sent_at

  static RawImu decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
