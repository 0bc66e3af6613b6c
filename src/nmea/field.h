#pragma once

#include <cstdint>
#include <string_view>

#include "bytes.h"

namespace frontseat_driver::nmea {

/// One field as it stands in the sentence.
struct Field {
  const char* begin;
  const char* point;  ///< its first `.`, or `end` if there is none
  const char* end;

  bool blank() const { return begin == end; }
  std::ptrdiff_t hasPoint() const { return point == end ? 0 : 1; }
  std::ptrdiff_t decimals() const { return end - point - hasPoint(); }

  /// Without the blanks around it.
  std::string_view text() const {
    std::string_view out{begin, static_cast<std::size_t>(end - begin)};
    while (!out.empty() && out.front() == ' ') out.remove_prefix(1);
    while (!out.empty() && out.back() == ' ') out.remove_suffix(1);
    return out;
  }
};

/// Eight digits in a word, the first in the lowest byte, each from 0 to 9; what was no digit is
/// larger.
class Digits {
 public:
  explicit Digits(std::uint64_t values) : values_(values) {}

  /// The eight characters from `at` on.
  static Digits at(const char* at) { return Digits{loadEight(at) ^ ('0' * kEach)}; }

  /// The last `count` digits of a field, up to eight, the point left out; zeros in front. The nine
  /// characters before the end of the field can be read.
  static Digits last(std::ptrdiff_t count, const Field& field) {
    const std::uint64_t after_point = at(field.end - 8).values_;
    const std::uint64_t before_point = at(field.end - 8 - field.hasPoint()).values_;
    const std::uint64_t decimals = kLast[field.decimals()];
    return Digits{((after_point & decimals) | (before_point & ~decimals)) & kLast[count]};
  }

  /// Zeros in place of all but the first `count`, from one to seven, which move to the end.
  Digits first(std::ptrdiff_t count) const { return Digits{values_ << (64 - 8 * count)}; }

  bool good() const { return (((values_ + 0x76 * kEach) | values_) & (0x80 * kEach)) == 0; }

  /// Each digit of an even place, counted from 0, and the next one as a number from 0 to 99.
  int pair(int place) const {
    return static_cast<int>((values_ * 10 + (values_ >> 8)) >> (8 * place)) & 0xFF;
  }

  /// All of them as one number: added by pairs, then by fours, then all.
  std::uint64_t number() const {
    constexpr std::uint64_t kMask = 0x000000FF000000FF;
    const std::uint64_t pairs = values_ * 10 + (values_ >> 8);
    const std::uint64_t high = (pairs & kMask) * (100 + (std::uint64_t{1'000'000} << 32));
    const std::uint64_t low = ((pairs >> 16) & kMask) * (1 + (std::uint64_t{10'000} << 32));
    return (high + low) >> 32;
  }

 private:
  static constexpr std::uint64_t kEach = 0x0101010101010101;
  static constexpr std::uint64_t kLast[] = {0,
                                            0xFF00000000000000,
                                            0xFFFF000000000000,
                                            0xFFFFFF0000000000,
                                            0xFFFFFFFF00000000,
                                            0xFFFFFFFFFF000000,
                                            0xFFFFFFFFFFFF0000,
                                            0xFFFFFFFFFFFFFF00,
                                            0xFFFFFFFFFFFFFFFF};

  std::uint64_t values_;
};

}  // namespace frontseat_driver::nmea
