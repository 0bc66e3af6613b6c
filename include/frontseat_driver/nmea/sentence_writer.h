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
/// break the sentence, a value out of the range said with each call, a sentence that gets too long,
/// an address that is none) makes the whole sentence invalid: finish() returns nothing.
/// No allocation, no locale, and no exception.
class SentenceWriter {
 public:
  /// Longest sentence with its line end.
  static constexpr std::size_t kCapacity = 1026;

  /// Most decimals of a number.
  static constexpr int kMaxDecimals = 9;

  /// `talker` and `formatter` together are the address, such as "BF" and "NVG".
  SentenceWriter(std::string_view talker, std::string_view formatter);

  /// Rounded to the nearest with so many decimals, ties to even, from the exact value of the
  /// double. Finite, with at most 15 digits before the point; 0 to kMaxDecimals decimals.
  void number(double value, int decimals);
  void number(const std::optional<double>& value, int decimals);

  void integer(std::int64_t value);
  void integer(const std::optional<std::int64_t>& value);

  /// hhmmss.sss, cut off below the millisecond: a time that was rounded up could be one that is yet
  /// to come, or of the next day. 24 h up to 24 h 1 s is the leap second, 235960.sss; more, or a
  /// negative time, cannot be written.
  void timeOfDay(const std::optional<TimeOfDay>& time);

  void date(const std::optional<Date>& date);  ///< ddmmyy, for the years 1980 to 2079

  /// Four fields: ddmm.m, N or S, dddmm.m, E or W, with so many decimals of a minute, rounded as
  /// numbers are. Minutes that round up to 60 are carried into the degrees. Zero is N and E.
  void latLon(const std::optional<LatLon>& position, int minute_decimals);

  void text(std::string_view text);  ///< as isFieldText() allows
  void blank();

  /// The finished sentence with its CR LF, or nothing if it cannot be sent. Valid as long as the
  /// writer is. Nothing can be written after it.
  std::optional<std::string_view> finish();

 private:
  enum class State { Open, Finished, Invalid };

  void require(bool condition);
  char* take(std::size_t count);
  void put(char c);
  void put(std::string_view text);
  void putDigits(std::uint64_t value, int width);
  void putFraction(std::uint64_t value, int decimals);
  void degrees(double value, int degree_digits, int minute_decimals, const char* signs);

  State state_ = State::Open;
  std::size_t size_ = 0;
  std::array<char, kCapacity> buffer_;  // not cleared: only what was written is read
};

/// True for text that can stand in a field: 0x20..0x7E without comma, asterisk and `$`.
bool isFieldText(std::string_view text);

}  // namespace frontseat_driver::nmea
