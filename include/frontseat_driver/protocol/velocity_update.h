#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol {

/// $BFNVR and $CPNVR: velocity over ground and body rates. SPI 0.1, section 6.2; Kingfisher 0.1,
/// section 3.0. Mind the order on the wire: pitch, roll, yaw.
///
/// $BFNVR,hhmmss.sss,e.e,n.n,v.v,s.s,t.t,g.g*hh
///        1          2   3   4   5   6   7
struct VelocityUpdate {
  static constexpr std::string_view kTitle = "velocity and rates";
  static constexpr std::string_view kFormatter = "NVR";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> east_m_s;
  std::optional<double> north_m_s;
  std::optional<double> down_m_s;
  std::optional<double> pitch_rate_deg_s;  ///< about starboard, positive bow rising
  std::optional<double> roll_rate_deg_s;   ///< about the bow, positive port side rising
  std::optional<double> yaw_rate_deg_s;    ///< about down, positive clockwise from above

  static VelocityUpdate decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol
