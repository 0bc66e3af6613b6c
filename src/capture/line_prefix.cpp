#include <cstdint>
#include <limits>

#include "frontseat_driver/capture/text_reader.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::capture {
namespace {

using std::chrono::nanoseconds;
using vehicle::UtcTime;

constexpr std::string_view kSeparators = " \t[](){},;|\"'";

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/// A text that is read from the left.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}

  std::string_view rest() const { return rest_; }
  bool at(char c) const { return !rest_.empty() && rest_.front() == c; }
  bool atDigit() const { return !rest_.empty() && isDigit(rest_.front()); }
  bool atEnd() const {
    return rest_.empty() || rest_.front() == ':' ||
           kSeparators.find(rest_.front()) != std::string_view::npos;
  }

  bool take(char c) {
    if (!at(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool takeAny(std::string_view characters) {
    if (rest_.empty() || characters.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void skip(std::string_view characters) {
    while (takeAny(characters)) continue;
  }

  std::string_view takeDigits() { return takeWhile(isDigit); }
  std::string_view takeLetters() { return takeWhile(isLetter); }

  /// Exactly so many digits as a number.
  std::optional<int> number(std::size_t digits) {
    if (rest_.size() < digits) return std::nullopt;
    int value = 0;
    for (const char c : rest_.substr(0, digits)) {
      if (!isDigit(c)) return std::nullopt;
      value = value * 10 + (c - '0');
    }
    rest_.remove_prefix(digits);
    return value;
  }

 private:
  template <class Condition>
  std::string_view takeWhile(Condition condition) {
    std::size_t size = 0;
    while (size < rest_.size() && condition(rest_[size])) ++size;
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
};

/// Digits after a point, as nanoseconds; what is finer is cut off.
nanoseconds fraction(std::string_view digits) {
  nanoseconds::rep value = 0;
  for (std::size_t i = 0; i < 9; ++i)
    value = value * 10 + (i < digits.size() ? digits[i] - '0' : 0);
  return nanoseconds{value};
}

nanoseconds takeFraction(Cursor& in, std::string_view points) {
  Cursor ahead = in;
  if (!ahead.takeAny(points) || !ahead.atDigit()) return nanoseconds::zero();
  const nanoseconds value = fraction(ahead.takeDigits());
  in = ahead;
  return value;
}

/// Nanoseconds in one of what a whole number of this size counts since 1970: none has meant seconds
/// of the year 5138 yet.
nanoseconds::rep unitOf(std::uint64_t number) {
  if (number < 100'000'000'000) return 1'000'000'000;
  if (number < 100'000'000'000'000) return 1'000'000;
  return number < 100'000'000'000'000'000 ? 1'000 : 1;
}

std::optional<UtcTime> unixTime(Cursor& in) {
  const std::string_view digits = in.takeDigits();
  if (digits.empty() || digits.size() > 19) return std::nullopt;
  std::uint64_t number = 0;
  for (const char c : digits) number = number * 10 + static_cast<std::uint64_t>(c - '0');
  const nanoseconds::rep unit = unitOf(number);
  // One second less, so that a fraction still fits.
  const auto most = static_cast<std::uint64_t>((nanoseconds::max().count() - 1'000'000'000) / unit);
  if (number > most) return std::nullopt;
  const nanoseconds part = takeFraction(in, ".") / (1'000'000'000 / unit);
  return nanoseconds{static_cast<nanoseconds::rep>(number) * unit} + part;
}

int daysIn(int year, int month) {
  if (month == 2) return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

std::optional<UtcTime> date(Cursor& in) {
  const auto year = in.number(4);
  if (!year || !in.takeAny("-/")) return std::nullopt;
  const auto month = in.number(2);
  if (!month || !in.takeAny("-/")) return std::nullopt;
  const auto day = in.number(2);
  // Nanoseconds since 1970 end in the year 2262.
  const bool valid = day && *year >= 1970 && *year <= 2261 && *month >= 1 && *month <= 12 &&
                     *day >= 1 && *day <= daysIn(*year, *month);
  if (!valid) return std::nullopt;
  return vehicle::midnightOf(*year, *month, *day);
}

std::optional<nanoseconds> clock(Cursor& in) {
  const auto hours = in.number(2);
  if (!hours || !in.take(':')) return std::nullopt;
  const auto minutes = in.number(2);
  if (!minutes || !in.take(':')) return std::nullopt;
  const auto seconds = in.number(2);
  if (!seconds || *hours > 23 || *minutes > 59 || *seconds > 60) return std::nullopt;
  return std::chrono::hours{*hours} + std::chrono::minutes{*minutes} +
         std::chrono::seconds{*seconds} + takeFraction(in, ".,");
}

/// `Z`, `+hh:mm`, `+hhmm`, `+hh`, or nothing, which is UTC: how far that clock is ahead of UTC.
std::optional<nanoseconds> zone(Cursor& in) {
  if (in.takeAny("Zz")) return nanoseconds::zero();
  const bool ahead = in.at('+');
  if (!in.takeAny("+-")) return nanoseconds::zero();
  const auto hours = in.number(2);
  if (!hours) return std::nullopt;
  in.take(':');
  const auto minutes = in.number(2);
  const nanoseconds offset = std::chrono::hours{*hours} + std::chrono::minutes{minutes.value_or(0)};
  return ahead ? offset : -offset;
}

std::optional<UtcTime> isoTime(Cursor& in) {
  const auto day = date(in);
  if (!day || !in.takeAny("Tt _")) return std::nullopt;
  const auto time = clock(in);
  if (!time) return std::nullopt;
  const auto offset = zone(in);
  if (!offset) return std::nullopt;
  return *day + *time - *offset;
}

bool startsWithDate(std::string_view text) {
  return text.size() > 4 && (text[4] == '-' || text[4] == '/');
}

bool takeTime(Cursor& in, LinePrefix& prefix) {
  if (prefix.time) return false;
  const auto time = startsWithDate(in.rest()) ? isoTime(in) : unixTime(in);
  if (!time || !in.atEnd()) return false;
  prefix.time = time;
  return true;
}

std::optional<Direction> directionOf(std::string_view word) {
  if (word == "tx" || word == "TX") return Direction::ToVehicle;
  if (word == "rx" || word == "RX") return Direction::FromVehicle;
  return std::nullopt;
}

bool takeDirection(Cursor& in, LinePrefix& prefix) {
  const Direction direction = in.at('>') ? Direction::ToVehicle : Direction::FromVehicle;
  if (prefix.direction || !in.takeAny("<>")) return false;
  in.skip("<>");
  prefix.direction = direction;
  return true;
}

/// `rx`, or a word in brackets, such as the level of a log.
bool takeWord(Cursor& in, bool bracketed, LinePrefix& prefix) {
  const std::string_view word = in.takeLetters();
  if (word.empty() || !in.atEnd()) return false;
  const auto direction = directionOf(word);
  if (direction && !prefix.direction) prefix.direction = direction;
  return direction || bracketed;
}

}  // namespace

LinePrefix readPrefix(std::string_view text) {
  LinePrefix prefix;
  Cursor in{text};
  in.skip(" \t");
  prefix.comment = in.at('#') || in.at('%');
  if (prefix.comment) return prefix;
  for (bool bracketed = false; !in.rest().empty() && !in.at('$');) {
    if (in.take('[')) {
      bracketed = true;
    } else if (!in.takeAny(kSeparators) && !in.take(':')) {
      const bool understood = in.atDigit()
                                  ? takeTime(in, prefix)
                                  : takeDirection(in, prefix) || takeWord(in, bracketed, prefix);
      if (!understood) break;
      bracketed = false;
    }
  }
  return prefix;
}

}  // namespace frontseat_driver::capture
