#include "field_text.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace frontseat_driver::decode {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint64_t kPowers[] = {1,       10,        100,        1'000,       10'000,
                                     100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};

void appendUnsigned(std::string& out, std::uint64_t value) {
  char digits[20];
  char* at = digits + sizeof digits;
  do {
    *--at = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  out.append(at, static_cast<std::size_t>(digits + sizeof digits - at));
}

/// With zeros in front up to the width.
void appendPadded(std::string& out, std::uint64_t value, int width) {
  for (int digits = width - 1; digits > 0 && value < kPowers[digits]; --digits) out += '0';
  appendUnsigned(out, value);
}

/// A point and the decimals without the zeros at their end; nothing if all are zeros.
void appendFraction(std::string& out, std::uint64_t fraction, int decimals) {
  if (fraction == 0) return;
  for (; fraction % 10 == 0; --decimals) fraction /= 10;
  out += '.';
  appendPadded(out, fraction, decimals);
}

/// How many decimals a double of this size holds for sure, up to 9.
int decimalsOf(double magnitude) { return magnitude < 1e6 ? 9 : magnitude < 1e9 ? 6 : 0; }

void appendAnyNumber(std::string& out, double value) {
  char text[32];
  for (int precision = 15; precision <= 17; ++precision) {
    std::snprintf(text, sizeof text, "%.*g", precision, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  out += text;
}

/// Year, month and day are the same for a whole day, and most lines are of the same one.
const std::string& dateText(std::int64_t day) {
  thread_local std::int64_t last = -1;
  thread_local std::string text = "1969-12-31";
  if (day == last) return text;
  last = day;
  const std::time_t seconds = day * 86'400;
  std::tm date{};
  gmtime_r(&seconds, &date);
  char written[32];
  const std::size_t size = std::strftime(written, sizeof written, "%Y-%m-%d", &date);
  return text.assign(written, size);
}

}  // namespace

void appendInteger(std::string& out, std::int64_t value) {
  if (value < 0) out += '-';
  const auto bits = static_cast<std::uint64_t>(value);
  appendUnsigned(out, value < 0 ? std::uint64_t{0} - bits : bits);
}

void appendNumber(std::string& out, double value) {
  const double magnitude = std::fabs(value);
  const int decimals = decimalsOf(magnitude);
  const auto units = static_cast<double>(kPowers[decimals]);
  const double scaled = magnitude < 1e15 ? std::nearbyint(magnitude * units) : 0.0;
  // Both are whole and below 2^53, so the quotient is the double nearest to the decimal number.
  if (scaled / units != magnitude) return appendAnyNumber(out, value);
  if (value < 0.0) out += '-';
  const auto whole = static_cast<std::uint64_t>(scaled);
  appendUnsigned(out, whole / kPowers[decimals]);
  appendFraction(out, whole % kPowers[decimals], decimals);
}

void appendFixed(std::string& out, double value, int decimals) {
  const auto scaled = static_cast<std::uint64_t>(
      std::nearbyint(std::fabs(value) * static_cast<double>(kPowers[decimals])));
  if (value < 0.0 && scaled != 0) out += '-';
  appendUnsigned(out, scaled / kPowers[decimals]);
  out += '.';
  appendPadded(out, scaled % kPowers[decimals], decimals);
}

void appendClock(std::string& out, nmea::TimeOfDay time) {
  const auto microseconds = static_cast<std::uint64_t>(time.count());
  std::uint64_t seconds = microseconds / kPowers[6];
  const bool leap = seconds >= 86'400;
  if (leap) --seconds;
  appendPadded(out, seconds / 3600, 2);
  out += ':';
  appendPadded(out, seconds / 60 % 60, 2);
  out += ':';
  appendPadded(out, seconds % 60 + (leap ? 1 : 0), 2);
  out += '.';
  const std::uint64_t fraction = microseconds % kPowers[6];
  const bool milliseconds = fraction % 1000 == 0;
  appendPadded(out, milliseconds ? fraction / 1000 : fraction, milliseconds ? 3 : 6);
}

void appendSeconds(std::string& out, nanoseconds time) {
  if (time.count() < 0) out += '-';
  const auto bits = static_cast<std::uint64_t>(time.count());
  const std::uint64_t count = time.count() < 0 ? std::uint64_t{0} - bits : bits;
  appendUnsigned(out, count / kPowers[9]);
  appendFraction(out, count % kPowers[9], 9);
}

void appendUtc(std::string& out, vehicle::UtcTime time) {
  const auto microseconds = static_cast<std::uint64_t>(time.count() / 1000);
  const std::uint64_t of_day = microseconds % (86'400 * kPowers[6]);
  out += dateText(static_cast<std::int64_t>(microseconds / (86'400 * kPowers[6])));
  out += 'T';
  appendPadded(out, of_day / (3600 * kPowers[6]), 2);
  out += ':';
  appendPadded(out, of_day / (60 * kPowers[6]) % 60, 2);
  out += ':';
  appendPadded(out, of_day / kPowers[6] % 60, 2);
  out += '.';
  appendPadded(out, of_day % kPowers[6], 6);
  out += 'Z';
}

void appendDate(std::string& out, const nmea::Date& date) {
  appendPadded(out, static_cast<std::uint64_t>(date.year), 4);
  out += '-';
  appendPadded(out, static_cast<std::uint64_t>(date.month), 2);
  out += '-';
  appendPadded(out, static_cast<std::uint64_t>(date.day), 2);
}

void appendVisible(std::string& out, std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\\') {
      out += "\\\\";
    } else if (byte >= 0x20 && byte < 0x7F) {
      out += c;
    } else {
      out += "\\x";
      out += kHex[byte >> 4];
      out += kHex[byte & 0xF];
    }
  }
}

std::string visible(std::string_view text) {
  std::string out;
  appendVisible(out, text);
  return out;
}

}  // namespace frontseat_driver::decode
