#pragma once

#include <optional>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"

namespace frontseat_driver::protocol {

// How many decimals are written: finer than any vehicle measures.
constexpr int kMinuteDecimals = 6;  // 2 mm
constexpr int kAngleDecimals = 4;   // degrees
constexpr int kRateDecimals = 4;    // degrees or radians per second
constexpr int kVelocityDecimals = 4;
constexpr int kAccelerationDecimals = 6;  // older boats count in g
constexpr int kLengthDecimals = 3;        // metres; also of what has no name here
constexpr int kVoltageDecimals = 3;

/// Degrees clockwise from north in [0, 360); 360 itself, which rounding makes, reads as 0.
inline std::optional<double> heading(nmea::FieldReader& in) {
  const std::optional<double> value = in.numberIn(0.0, 360.0);
  return value == 360.0 ? 0.0 : value;
}

inline std::optional<double> roll(nmea::FieldReader& in) { return in.numberIn(-180.0, 180.0); }
inline std::optional<double> pitch(nmea::FieldReader& in) { return in.numberIn(-90.0, 90.0); }

/// 0 or 1.
inline std::optional<bool> flag(nmea::FieldReader& in) {
  const std::optional<std::int64_t> value = in.integer(0, 1);
  return value ? std::optional<bool>{*value == 1} : std::nullopt;
}

inline void writeFlag(const std::optional<bool>& value, nmea::SentenceWriter& out) {
  if (!value) return out.blank();
  out.integer(*value ? 1 : 0);
}

/// A heading of any number of turns as [0, 360), also after rounding: never `360`.
void writeHeading(const std::optional<double>& heading_deg, int decimals,
                  nmea::SentenceWriter& out);

}  // namespace frontseat_driver::protocol
