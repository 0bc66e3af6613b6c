#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFMBS: a behavior of the dive file begins. Public extra Bluefin sentence; named in Kingfisher
/// 0.1, Appendix A.
///
/// $BFMBS,hhmmss.sss,d--d,n,i--i,t--t*hh
struct BehaviorBegin {
  static constexpr std::string_view kTitle = "behavior begins";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "MBS";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view dive_file;
  std::string_view number;  ///< deprecated
  std::string_view payload_behavior_id;
  std::string_view behavior_type;

  static BehaviorBegin decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
