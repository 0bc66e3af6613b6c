#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::nmea {

/// Writes one sentence into a buffer of its own: `$`, address, fields, `*`, checksum, CR LF.
///
/// Numbers are fixed-point, never with `+`, exponent, or `-0`; times have exactly three decimals;
/// a missing value is an empty field. What cannot be written (a text with a character that would
/// break the sentence, a number that is not finite or has more than 15 digits before the point, a
/// sentence that gets too long) makes the whole sentence invalid: finish() returns nothing.
/// No allocation, no locale.
class SentenceWriter {
 public:
  /// Longest sentence with its line end.
  static constexpr std::size_t kCapacity = 1026;

  /// `talker` and `formatter` together are the address, such as "BF" and "NVG".
  SentenceWriter(std::string_view talker, std::string_view formatter);

  void number(double value, int decimals);
  void number(const std::optional<double>& value, int decimals);
  void integer(std::int64_t value);
  void integer(const std::optional<std::int64_t>& value);
  void timeOfDay(const std::optional<TimeOfDay>& time);  ///< hhmmss.sss
  void date(const std::optional<Date>& date);            ///< ddmmyy
  void latLon(const std::optional<LatLon>& position, int minute_decimals);  ///< four fields
  void text(std::string_view text);
  void blank();

  /// The finished sentence with its CR LF, or nothing if it cannot be sent. Valid as long as the
  /// writer is.
  std::optional<std::string_view> finish();
};

/// True for text that can stand in a field: 0x20..0x7E without comma, asterisk and `$`.
bool isFieldText(std::string_view text);

}  // namespace frontseat_driver::nmea
