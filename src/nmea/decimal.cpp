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

}  // namespace

const char* readExponent(const char* at, const char* end, Decimal& out) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !isDigit(*at)) return nullptr;
  int value = 0;
  while (at != end && isDigit(*at)) value = std::min(value * 10 + (*at++ - '0'), kExponentLimit);
  out.exponent += negative ? -value : value;
  return at;
}

double toDoubleExactly(const Decimal& decimal) {
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
