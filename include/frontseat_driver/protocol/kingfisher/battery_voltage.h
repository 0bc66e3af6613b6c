#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::kingfisher {

/// $CPRBS: one bank of cells. Kingfisher 0.1, section 3.0. Field vehicles leave the id out.
///
/// $CPRBS,hhmmss.sss,i,v.v,l.l,h.h,t.t*hh
///        1          2 3   4   5   6
struct BatteryVoltage {
  static constexpr std::string_view kTitle = "battery";
  static constexpr std::string_view kTalker = "CP";
  static constexpr std::string_view kFormatter = "RBS";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<std::int64_t> battery_id;
  std::optional<double> stack_v;
  std::optional<double> lowest_cell_v;
  std::optional<double> highest_cell_v;
  std::optional<double> temperature_c;
  bool blank_id = false;  ///< the field of the id is there, without a value

  static BatteryVoltage decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::kingfisher
