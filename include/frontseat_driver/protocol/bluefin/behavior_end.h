#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFMBE: a behavior of the dive file ended. Public extra Bluefin sentence; named in Kingfisher
/// 0.1, Appendix A.
///
/// $BFMBE,hhmmss.sss,d--d,n,i--i,t--t*hh
struct BehaviorEnd {
  static constexpr std::string_view kTitle = "behavior ends";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "MBE";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view dive_file;
  std::string_view number;  ///< deprecated
  std::string_view payload_behavior_id;
  std::string_view behavior_type;

  static BehaviorEnd decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
