#include "frontseat_driver/nmea/field_reader.h"

#include <algorithm>
#include <cmath>

#include "decimal.h"

namespace frontseat_driver::nmea {
namespace {

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// Six digits as three numbers of two.
struct Pairs {
  int first, second, third;
};

Pairs pairs(std::uint64_t six_digits) {
  const auto number = static_cast<int>(six_digits);
  return {number / 10'000, number / 100 % 100, number % 100};
}

int daysIn(int month, int year) {
  static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  // Without the rule for centuries: two-digit years meet none but 2000, which is a leap year.
  const bool leap_day = month == 2 && year % 4 == 0;
  return kDays[month - 1] + (leap_day ? 1 : 0);
}

/// A whole number with a sign at most and no decimals but zeros. Returns where it ends, nullptr if
/// there is none; sets `value`, or nothing in it if it does not fit.
const char* readInteger(const char* at, const char* end, std::optional<std::int64_t>& value) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !isDigit(*at)) return nullptr;
  const std::uint64_t limit = kLargest + (negative ? 1 : 0);
  std::uint64_t magnitude = 0;
  bool fits = true;
  for (; at != end && isDigit(*at); ++at) {
    const auto digit = static_cast<std::uint64_t>(*at - '0');
    fits = fits && magnitude <= (limit - digit) / 10;
    magnitude = magnitude * 10 + digit;
  }
  if (at != end && *at == '.') at = std::find_if(at + 1, end, [](char c) { return c != '0'; });
  if (fits) value = static_cast<std::int64_t>(negative ? 0 - magnitude : magnitude);
  return at;
}

/// Decimals of a second as microseconds, cut off.
std::uint64_t toMicroseconds(const char* at, const Digits& decimals) {
  if (decimals.count <= 6) return decimals.value * kPowersOfTen[6 - decimals.count];
  return DigitText{{at, 6}}.digits(at).value;
}

/// How many of the digits before the point are of the minutes; negative if that cannot be told.
int minuteDigits(int whole_digits, DegreeSplit split, int degree_digits) {
  if (split == DegreeSplit::FromPoint) return std::min(whole_digits, 2);
  return whole_digits > degree_digits ? whole_digits - degree_digits : -1;
}

}  // namespace

FieldReader::FieldReader(const Sentence& sentence)
    : fields_(sentence.fields),
      at_(fields_.data()),
      end_(at_ + fields_.size()),
      ended_(!sentence.has_fields) {}

/// Takes the field that was read up to `at` if nothing but blanks is left of it.
inline bool FieldReader::finish(const char* at) {
  while (at != end_ && *at == ' ') ++at;
  if (at != end_ && *at != ',') return false;
  ended_ = at == end_;
  at_ = ended_ ? at : at + 1;
  return true;
}

/// Goes to the first character of the next field that is no blank; false if there is none.
inline bool FieldReader::begin() {
  ++field_;
  if (ended_) {
    if (!optional_) note(Fault::MissingField);
    return false;
  }
  while (at_ != end_ && *at_ == ' ') ++at_;
  const bool blank = at_ == end_ || *at_ == ',';
  if (blank) finish(at_);
  return !blank;
}

/// Takes the field whatever it holds.
std::string_view FieldReader::take() {
  const char* const from = at_;
  const char* const comma = std::find(at_, end_, ',');
  finish(comma);
  return withoutBlanks({from, static_cast<std::size_t>(comma - from)});
}

void FieldReader::note(Fault fault) {
  if (faults_.count++ == 0) faults_.first = {fault, field_};
}

std::nullopt_t FieldReader::refuse(Fault fault) {
  note(fault);
  return std::nullopt;
}

/// Takes a field that is not of the type asked for.
std::nullopt_t FieldReader::refuseField() {
  if (!isNotFinite(take())) note(Fault::BadValue);
  return std::nullopt;
}

std::optional<double> FieldReader::number() {
  if (!begin()) return std::nullopt;
  Decimal decimal;
  const char* const stop = readDecimal(DigitText{fields_}, at_, decimal);
  if (stop == nullptr || !finish(stop)) return refuseField();
  const double value = toDouble(decimal);
  if (!std::isfinite(value)) return refuse(Fault::OutOfRange);
  return value;
}

std::optional<double> FieldReader::numberIn(double low, double high) {
  const std::optional<double> value = number();
  const bool outside = value && !(*value >= low && *value <= high);
  if (outside) return refuse(Fault::OutOfRange);
  return value;
}

std::optional<std::int64_t> FieldReader::integer(std::int64_t low, std::int64_t high) {
  if (!begin()) return std::nullopt;
  std::optional<std::int64_t> value;
  const char* const stop = readInteger(at_, end_, value);
  if (stop == nullptr || !finish(stop)) return refuseField();
  if (!value || *value < low || *value > high) return refuse(Fault::OutOfRange);
  return value;
}

std::optional<bool> FieldReader::either(std::string_view yes, std::string_view no) {
  if (!begin()) return std::nullopt;
  const std::string_view field = take();
  if (field != yes && field != no) return refuse(Fault::BadValue);
  return field == yes;
}

std::optional<TimeOfDay> FieldReader::timeOfDay() {
  if (!begin()) return std::nullopt;
  const DigitText text{fields_};
  const Digits digits = text.digits(at_);
  if (digits.count != 6) return refuseField();
  const char* stop = at_ + 6;
  std::uint64_t microseconds = 0;
  if (stop != end_ && *stop == '.') {
    const Digits decimals = text.digits(++stop);
    microseconds = toMicroseconds(stop, decimals);
    stop += decimals.count;
  }
  if (!finish(stop)) return refuseField();
  const auto [hours, minutes, seconds] = pairs(digits.value);
  if (hours > 23 || minutes > 59 || seconds > 60) return refuse(Fault::OutOfRange);
  const std::int64_t whole_seconds = (hours * 60 + minutes) * 60 + seconds;
  return TimeOfDay{whole_seconds * 1'000'000 + static_cast<std::int64_t>(microseconds)};
}

std::optional<Date> FieldReader::date() {
  if (!begin()) return std::nullopt;
  const Digits digits = DigitText{fields_}.digits(at_);
  if (digits.count != 6 || !finish(at_ + 6)) return refuseField();
  const auto [day, month, short_year] = pairs(digits.value);
  const int year = short_year + (short_year < 80 ? 2000 : 1900);
  if (month < 1 || month > 12 || day < 1) return refuse(Fault::OutOfRange);
  if (day > daysIn(month, year)) return refuse(Fault::OutOfRange);
  return Date{year, month, day};
}

std::optional<LatLon> FieldReader::latLon(DegreeSplit split) {
  const std::optional<double> latitude = degrees(split, 2, 90.0);
  const std::optional<bool> north = either("N", "S");
  const std::optional<double> longitude = degrees(split, 3, 180.0);
  const std::optional<bool> east = either("E", "W");
  if (!latitude || !north || !longitude || !east) return std::nullopt;
  return LatLon{*north ? *latitude : -*latitude, *east ? *longitude : -*longitude};
}

/// One field of degrees and minutes without a sign.
std::optional<double> FieldReader::degrees(DegreeSplit split, int degree_digits, double limit) {
  if (!begin()) return std::nullopt;
  const DigitText text{fields_};
  const Digits whole = text.digits(at_);
  const int minute_digits = minuteDigits(whole.count, split, degree_digits);
  Decimal minutes;
  const char* const cut = at_ + whole.count - std::max(minute_digits, 0);
  const char* const stop = readDigits(text, cut, minutes);
  if (stop == nullptr || !finish(stop)) return refuseField();
  const double minute_value = toDouble(minutes);
  const bool zero = whole.value == 0 && minute_value == 0.0;  // however many zeros are left out
  if (minute_digits < 0) return zero ? std::optional<double>{0.0} : refuse(Fault::BadValue);
  if (whole.count > kMaxDigits || minute_value > 60.0) return refuse(Fault::OutOfRange);
  const std::uint64_t whole_degrees = whole.value / kPowersOfTen[minute_digits];
  const double value = static_cast<double>(whole_degrees) + minute_value / 60.0;
  if (value > limit) return refuse(Fault::OutOfRange);
  return value;
}

std::string_view FieldReader::text() { return begin() ? take() : std::string_view{}; }

int FieldReader::remaining() const {
  return ended_ ? 0 : 1 + static_cast<int>(std::count(at_, end_, ','));
}

}  // namespace frontseat_driver::nmea
