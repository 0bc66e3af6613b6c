#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFSVS: speed of sound in water. Public extra Bluefin sentence; named in Kingfisher 0.1,
/// Appendix A.
///
/// $BFSVS,hhmmss.sss,s.s*hh
struct SoundSpeed {
  static constexpr std::string_view kTitle = "speed of sound";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "SVS";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> sound_speed_m_s;

  static SoundSpeed decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
