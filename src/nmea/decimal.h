#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frontseat_driver::nmea {

constexpr int kMaxDigits = 19;  ///< that a 64-bit mantissa surely holds

/// A decimal number as it was written: digits, power of ten, sign. Nothing is lost in it.
struct Decimal {
  std::string_view digits;     ///< as written, with at most one point
  std::uint64_t mantissa = 0;  ///< the digits as one number, if there are no more than 19
  int digit_count = 0;         ///< leading zeros included
  int exponent = 0;            ///< value = digits without the point x 10^exponent
  bool negative = false;
};

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Reads digits with at most one point and at least one digit, without sign or exponent. Returns
/// where it stopped, nullptr if there is no number.
const char* readDigits(const char* at, const char* end, Decimal& out);

/// As readDigits(), with an optional sign before and an optional exponent after.
const char* readDecimal(const char* at, const char* end, Decimal& out);

/// The nearest double, ties to even, as strtod gives in the C locale; infinite if there is none.
double toDouble(const Decimal& decimal);

/// `mantissa` / 10^`decimals`, with the sign turned if `negative` is 1; rounded once, because both
/// are exact as doubles. `mantissa` is below 2^53, `decimals` from 0 to 22.
inline double toDouble(std::uint64_t mantissa, std::ptrdiff_t decimals, std::ptrdiff_t negative) {
  static constexpr double kPowers[2][23] = {
      {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
       1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22},
      {-1e0,  -1e1,  -1e2,  -1e3,  -1e4,  -1e5,  -1e6,  -1e7,  -1e8,  -1e9,  -1e10, -1e11,
       -1e12, -1e13, -1e14, -1e15, -1e16, -1e17, -1e18, -1e19, -1e20, -1e21, -1e22}};
  return static_cast<double>(static_cast<std::int64_t>(mantissa)) / kPowers[negative][decimals];
}

/// True for `nan` and `inf` or `infinity` with or without sign, of any case.
bool isNotFinite(std::string_view text);

}  // namespace frontseat_driver::nmea
