#pragma once

#include <cstdint>
#include <string_view>

namespace frontseat_driver::nmea {

/// A decimal number as it was written: sign, digits, power of ten. Nothing is lost in it.
struct Decimal {
  const char* digits = nullptr;  ///< first digit or point; up to `digits_end`, at most one point
  const char* digits_end = nullptr;
  std::uint64_t mantissa = 0;  ///< the digits as one number, if there are no more than 19
  int digit_count = 0;         ///< leading zeros included
  int exponent = 0;            ///< value = digits without the point x 10^exponent
  bool negative = false;
};

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Reads digits with at most one point and at least one digit, without sign or exponent. Returns
/// where it stopped, nullptr if there is no number. Inline: most of decoding is spent here.
inline const char* readDigits(const char* at, const char* end, Decimal& out) {
  out.digits = at;
  while (at != end && isDigit(*at)) {
    out.mantissa = out.mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
  }
  out.digit_count = static_cast<int>(at - out.digits);
  if (at != end && *at == '.') {
    const char* const fraction = ++at;
    while (at != end && isDigit(*at)) {
      out.mantissa = out.mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
    }
    out.exponent = -static_cast<int>(at - fraction);
    out.digit_count -= out.exponent;
  }
  out.digits_end = at;
  return out.digit_count == 0 ? nullptr : at;
}

/// As readDigits(), with an optional sign before and an optional exponent after.
const char* readDecimal(const char* at, const char* end, Decimal& out);

/// The nearest double, ties to even, as strtod gives in the C locale; infinite if there is none.
double toDouble(const Decimal& decimal);

/// True for `nan` and `inf` or `infinity` with or without sign, of any case.
bool isNotFinite(std::string_view text);

}  // namespace frontseat_driver::nmea
