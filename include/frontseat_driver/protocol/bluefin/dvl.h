#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFDVL: raw data of a Doppler velocity log. Public extra Bluefin sentence; named in Kingfisher
/// 0.1, Appendix A.
///
/// $BFDVL,hhmmss.sss,x.x,y.y,z.z,r.r,r.r,r.r,r.r,t.t,hhmmss.sss*hh
///        1          2   3   4   5   6   7   8   9   10
struct Dvl {
  static constexpr std::string_view kTitle = "Doppler velocity log";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "DVL";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> bow_m_s;
  std::optional<double> starboard_m_s;
  std::optional<double> down_m_s;
  std::array<std::optional<double>, 4> beam_range_m;
  std::optional<double> temperature_c;
  std::optional<nmea::TimeOfDay> measured_at;

  static Dvl decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
