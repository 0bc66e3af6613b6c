#include "decimal.h"

#include <algorithm>

#include "exact_ratio.h"

namespace frontseat_driver::nmea {
namespace {

// Powers of ten that a double holds exactly.
constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kMaxExactPower = 22;
constexpr std::uint64_t kMaxExactInteger = std::uint64_t{1} << 53;
constexpr int kExponentLimit = 100'000;  // far beyond any double, far from overflow

const char* readExponent(const char* at, const char* end, int& exponent) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !isDigit(*at)) return nullptr;
  int value = 0;
  while (at != end && isDigit(*at)) value = std::min(value * 10 + (*at++ - '0'), kExponentLimit);
  exponent += negative ? -value : value;
  return at;
}

/// Both operands are exact, so the one rounding of the operation is the right one.
double scaleExactly(double mantissa, int exponent) {
  return exponent < 0 ? mantissa / kExactPowers[-exponent] : mantissa * kExactPowers[exponent];
}

double magnitude(const Decimal& decimal) {
  const bool exact = decimal.digit_count <= kMaxDigits && decimal.mantissa <= kMaxExactInteger &&
                     decimal.exponent >= -kMaxExactPower && decimal.exponent <= kMaxExactPower;
  return exact ? scaleExactly(static_cast<double>(decimal.mantissa), decimal.exponent)
               : nearestDouble(decimal.digits, decimal.exponent);
}

bool equalsIgnoringCase(std::string_view text, std::string_view lower) {
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; };
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), same);
}

}  // namespace

const char* readDecimal(const DigitText& text, const char* at, Decimal& out) {
  const bool has_sign = at != text.end() && (*at == '-' || *at == '+');
  out.negative = has_sign && *at == '-';
  const char* const stop = readDigits(text, has_sign ? at + 1 : at, out);
  const bool has_exponent = stop && stop != text.end() && (*stop == 'e' || *stop == 'E');
  return has_exponent ? readExponent(stop + 1, text.end(), out.exponent) : stop;
}

double toDouble(const Decimal& decimal) {
  const double value = magnitude(decimal);
  return decimal.negative ? -value : value;
}

bool isNotFinite(std::string_view text) {
  const bool sign = !text.empty() && (text.front() == '-' || text.front() == '+');
  if (sign) text.remove_prefix(1);
  return equalsIgnoringCase(text, "nan") || equalsIgnoringCase(text, "inf") ||
         equalsIgnoringCase(text, "infinity");
}

}  // namespace frontseat_driver::nmea
