#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace frontseat_driver::nmea {

/// 10^n for every n that 64 bits hold.
constexpr std::uint64_t kPowersOfTen[] = {1,
                                          10,
                                          100,
                                          1'000,
                                          10'000,
                                          100'000,
                                          1'000'000,
                                          10'000'000,
                                          100'000'000,
                                          1'000'000'000,
                                          10'000'000'000,
                                          100'000'000'000,
                                          1'000'000'000'000,
                                          10'000'000'000'000,
                                          100'000'000'000'000,
                                          1'000'000'000'000'000,
                                          10'000'000'000'000'000,
                                          100'000'000'000'000'000,
                                          1'000'000'000'000'000'000,
                                          10'000'000'000'000'000'000U};
constexpr int kMaxDigits = 19;  ///< that a 64-bit mantissa surely holds

/// A decimal number as it was written: digits, power of ten, sign. Nothing is lost in it.
struct Decimal {
  std::string_view digits;     ///< as written, with at most one point
  std::uint64_t mantissa = 0;  ///< the digits as one number, if there are no more than 19
  int digit_count = 0;         ///< leading zeros included
  int exponent = 0;            ///< value = digits without the point x 10^exponent
  bool negative = false;
};

/// Digits that follow each other, as one number; modulo 2^64 if there are more than 19.
struct Digits {
  std::uint64_t value = 0;
  int count = 0;
};

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Text that is read from the left, eight characters at a time. Fields are short and of any length,
/// so a loop over their characters would mostly wait for branches that were guessed wrong.
class DigitText {
 public:
  explicit DigitText(std::string_view text) : begin_(text.data()), end_(begin_ + text.size()) {}

  const char* end() const { return end_; }

  /// The digits at `at`, which may be none.
  Digits digits(const char* at) const {
    Digits all = upToEight(eight(at));
    for (Digits more = all; more.count == 8;) {
      more = upToEight(eight(at + all.count));
      all = {all.value * kPowersOfTen[more.count] + more.value, all.count + more.count};
    }
    return all;
  }

 private:
  static constexpr std::uint64_t kEach = 0x0101010101010101;

  /// Eight characters, the first in the lowest byte; zeros in place of those after the end.
  std::uint64_t eight(const char* at) const {
    const std::ptrdiff_t left = end_ - at;
    if (left >= 8) return load(at);
    if (left <= 0) return 0;
    if (end_ - begin_ >= 8) return load(end_ - 8) >> (8 * (8 - left));
    std::uint64_t word = 0;
    for (const char* last = end_; last != at;) {
      word = (word << 8) | static_cast<unsigned char>(*--last);
    }
    return word;
  }

  static std::uint64_t load(const char* at) {
    std::uint64_t word;
    std::memcpy(&word, at, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    return word;
  }

  /// The digits that `word` begins with.
  static Digits upToEight(std::uint64_t word) {
    const std::uint64_t values = word ^ ('0' * kEach);  // 0 to 9 where there is a digit
    // A sum beyond 0x7F carries at most into bytes after the first that is no digit.
    const std::uint64_t others = ((values + 0x76 * kEach) | values) & (0x80 * kEach);
    if (others == 0) return {sum(values), 8};
    const int count = __builtin_ctzll(others) / 8;
    if (count == 0) return {};
    return {sum(values << (64 - 8 * count)), count};
  }

  /// Eight digits in eight bytes, the most significant one lowest: first by pairs, then by fours.
  static std::uint64_t sum(std::uint64_t values) {
    constexpr std::uint64_t kMask = 0x000000FF000000FF;
    const std::uint64_t pairs = values * 10 + (values >> 8);
    const std::uint64_t high = (pairs & kMask) * (100 + (std::uint64_t{1'000'000} << 32));
    const std::uint64_t low = ((pairs >> 16) & kMask) * (1 + (std::uint64_t{10'000} << 32));
    return (high + low) >> 32;
  }

  const char* begin_;
  const char* end_;
};

/// Reads digits with at most one point and at least one digit, without sign or exponent. Returns
/// where it stopped, nullptr if there is no number.
inline const char* readDigits(const DigitText& text, const char* at, Decimal& out) {
  const Digits whole = text.digits(at);
  const char* stop = at + whole.count;
  Digits fraction;
  if (stop != text.end() && *stop == '.') {
    fraction = text.digits(++stop);
    stop += fraction.count;
  }
  out.digits = {at, static_cast<std::size_t>(stop - at)};
  out.mantissa = whole.value * kPowersOfTen[std::min(fraction.count, kMaxDigits)] + fraction.value;
  out.digit_count = whole.count + fraction.count;
  out.exponent = -fraction.count;
  return out.digit_count == 0 ? nullptr : stop;
}

/// Adds the exponent at `at`, which follows the `e`, to that of `out`. Returns where it stopped,
/// nullptr if there is none.
const char* readExponent(const char* at, const char* end, Decimal& out);

/// As readDigits(), with an optional sign before and an optional exponent after.
inline const char* readDecimal(const DigitText& text, const char* at, Decimal& out) {
  const char first = at == text.end() ? '\0' : *at;
  out.negative = first == '-';
  // Not a branch: half of the signs would be guessed wrong.
  const int sign_length = static_cast<int>(out.negative) | static_cast<int>(first == '+');
  const char* const stop = readDigits(text, at + sign_length, out);
  const bool has_exponent = stop != nullptr && stop != text.end() && (*stop | 0x20) == 'e';
  return has_exponent ? readExponent(stop + 1, text.end(), out) : stop;
}

/// As toDouble(), for any number of digits and any exponent; slow.
double toDoubleExactly(const Decimal& decimal);

/// The nearest double, ties to even, as strtod gives in the C locale; infinite if there is none.
inline double toDouble(const Decimal& decimal) {
  // A mantissa of 53 bits and these powers are exact as doubles: only the division rounds.
  static constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  static constexpr double kSigns[] = {1.0, -1.0};
  const bool quick = decimal.digit_count <= kMaxDigits && decimal.mantissa >> 53 == 0 &&
                     decimal.exponent <= 0 && decimal.exponent >= -22;
  if (!quick) return toDoubleExactly(decimal);
  const auto mantissa = static_cast<double>(static_cast<std::int64_t>(decimal.mantissa));
  return mantissa / kExactPowers[-decimal.exponent] * kSigns[decimal.negative ? 1 : 0];
}

/// True for `nan` and `inf` or `infinity` with or without sign, of any case.
bool isNotFinite(std::string_view text);

}  // namespace frontseat_driver::nmea
