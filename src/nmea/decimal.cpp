#include "decimal.h"

#include <algorithm>

#include "exact_ratio.h"

namespace frontseat_driver::nmea {
namespace {

constexpr int kExponentLimit = 100'000;  // far beyond any double, far from overflow

bool equalsIgnoringCase(std::string_view text, std::string_view lower) {
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; };
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), same);
}

const char* addDigits(const char* at, const char* end, Decimal& out) {
  for (; at != end && isDigit(*at); ++at, ++out.digit_count) {
    out.mantissa = out.mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
  }
  return at;
}

/// Adds the exponent at `at`, which follows the `e`, to that of `out`. Returns where it stopped,
/// nullptr if there is none.
const char* readExponent(const char* at, const char* end, Decimal& out) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !isDigit(*at)) return nullptr;
  int value = 0;
  while (at != end && isDigit(*at)) value = std::min(value * 10 + (*at++ - '0'), kExponentLimit);
  out.exponent += negative ? -value : value;
  return at;
}

}  // namespace

const char* readDigits(const char* at, const char* end, Decimal& out) {
  const char* stop = addDigits(at, end, out);
  if (stop != end && *stop == '.') {
    const char* const fraction = stop + 1;
    stop = addDigits(fraction, end, out);
    out.exponent = -static_cast<int>(stop - fraction);
  }
  out.digits = {at, static_cast<std::size_t>(stop - at)};
  return out.digit_count == 0 ? nullptr : stop;
}

const char* readDecimal(const char* at, const char* end, Decimal& out) {
  out.negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const char* const stop = readDigits(at, end, out);
  const bool has_exponent = stop != nullptr && stop != end && (*stop | 0x20) == 'e';
  return has_exponent ? readExponent(stop + 1, end, out) : stop;
}

double toDouble(const Decimal& decimal) {
  const bool quick = decimal.digit_count <= kMaxDigits && decimal.mantissa >> 53 == 0 &&
                     decimal.exponent <= 0 && decimal.exponent >= -22;
  if (quick) return toDouble(decimal.mantissa, -decimal.exponent, decimal.negative ? 1 : 0);
  const double magnitude = nearestDouble(decimal.digits, decimal.exponent);
  return decimal.negative ? -magnitude : magnitude;
}

bool isNotFinite(std::string_view text) {
  const bool sign = !text.empty() && (text.front() == '-' || text.front() == '+');
  if (sign) text.remove_prefix(1);
  return equalsIgnoringCase(text, "nan") || equalsIgnoringCase(text, "inf") ||
         equalsIgnoringCase(text, "infinity");
}

}  // namespace frontseat_driver::nmea
