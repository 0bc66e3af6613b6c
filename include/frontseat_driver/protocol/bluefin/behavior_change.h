#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BPRMB: another heading, depth or speed for the current behavior, for five seconds. SPI 0.1,
/// section 7.3. An empty value leaves that aspect alone; its mode is then empty too.
///
/// $BPRMB,hhmmss.sss,h.h,d.d,dm,v.v,vm,hm*hh
///        1          2   3   4  5   6  7
struct BehaviorChange {
  static constexpr std::string_view kTitle = "change of behavior";
  static constexpr std::string_view kTalker = "BP";
  static constexpr std::string_view kFormatter = "RMB";

  enum class HorizontalMode : std::uint8_t { Heading = 0, Rudder = 1 };
  enum class VerticalMode : std::uint8_t { Depth = 0, Altitude = 1, Pitch = 2, Elevator = 3 };
  enum class SpeedMode : std::uint8_t { Rpm = 0, Speed = 1 };

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> horizontal;  ///< degrees: grid heading, or rudder to starboard
  std::optional<double>
      vertical;  ///< metres of depth or altitude; degrees of pitch or elevator, bow up
  std::optional<VerticalMode> vertical_mode;
  std::optional<double> speed;  ///< rpm or m/s
  std::optional<SpeedMode> speed_mode;
  std::optional<HorizontalMode> horizontal_mode;

  static BehaviorChange decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
