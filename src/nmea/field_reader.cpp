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

/// Two digits as a number, or -1.
int twoDigits(const char* at) {
  return isDigit(at[0]) && isDigit(at[1]) ? (at[0] - '0') * 10 + (at[1] - '0') : -1;
}

/// Six characters as three numbers of two digits.
struct SixDigits {
  int first, second, third;  ///< negative where there are no digits
};

SixDigits sixDigits(const char* at) {
  return {twoDigits(at), twoDigits(at + 2), twoDigits(at + 4)};
}

int daysIn(int month, int year) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
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

/// Decimals of a second as microseconds, cut off. Returns where the digits end.
const char* readMicroseconds(const char* at, const char* end, int& microseconds) {
  microseconds = 0;
  int unit = 100'000;
  for (; at != end && isDigit(*at); ++at, unit /= 10) microseconds += (*at - '0') * unit;
  return at;
}

/// Where the minutes begin in digits whose whole part ends at `whole_end`; nullptr if nowhere.
const char* minutesBegin(const char* digits, const char* whole_end, DegreeSplit split,
                         int degree_digits) {
  const auto whole_digits = whole_end - digits;
  if (split == DegreeSplit::FromPoint) return whole_digits < 2 ? digits : whole_end - 2;
  return whole_digits <= degree_digits ? nullptr : digits + degree_digits;
}

}  // namespace

FieldReader::FieldReader(const Sentence& sentence)
    : at_(sentence.fields.data()),
      end_(at_ + sentence.fields.size()),
      ended_(!sentence.has_fields) {}

/// Goes to the first character of the next field that is no blank; false if there is none.
bool FieldReader::begin() {
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

/// Takes the field that was read up to `at` if nothing but blanks is left of it.
bool FieldReader::finish(const char* at) {
  while (at != end_ && *at == ' ') ++at;
  if (at != end_ && *at != ',') return false;
  ended_ = at == end_;
  at_ = ended_ ? at : at + 1;
  return true;
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
  const char* const stop = readDecimal(at_, end_, decimal);
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
  if (end_ - at_ < 6) return refuseField();
  const auto [hours, minutes, seconds] = sixDigits(at_);
  if (hours < 0 || minutes < 0 || seconds < 0) return refuseField();
  const char* stop = at_ + 6;
  int microseconds = 0;
  if (stop != end_ && *stop == '.') stop = readMicroseconds(stop + 1, end_, microseconds);
  if (!finish(stop)) return refuseField();
  if (hours > 23 || minutes > 59 || seconds > 60) return refuse(Fault::OutOfRange);
  const std::int64_t whole_seconds = (hours * 60 + minutes) * 60 + seconds;
  return TimeOfDay{whole_seconds * 1'000'000 + microseconds};
}

std::optional<Date> FieldReader::date() {
  if (!begin()) return std::nullopt;
  if (end_ - at_ < 6) return refuseField();
  const auto [day, month, short_year] = sixDigits(at_);
  if (day < 0 || month < 0 || short_year < 0 || !finish(at_ + 6)) return refuseField();
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
  Decimal whole;
  const char* const digits = at_;
  const char* const stop = readDigits(digits, end_, whole);
  if (stop == nullptr || !finish(stop)) return refuseField();
  const char* const point = std::find(digits, stop, '.');
  const char* const cut = minutesBegin(digits, point, split, degree_digits);
  if (cut == nullptr && toDouble(whole) == 0.0) return 0.0;  // however many zeros are left out
  if (cut == nullptr) return refuse(Fault::BadValue);
  double degrees = 0.0;
  for (const char* at = digits; at != cut; ++at) degrees = degrees * 10.0 + (*at - '0');
  Decimal minutes;
  readDigits(cut, stop, minutes);
  const double value = degrees + toDouble(minutes) / 60.0;
  if (toDouble(minutes) > 60.0 || value > limit) return refuse(Fault::OutOfRange);
  return value;
}

std::string_view FieldReader::text() { return begin() ? take() : std::string_view{}; }

int FieldReader::remaining() const {
  return ended_ ? 0 : 1 + static_cast<int>(std::count(at_, end_, ','));
}

}  // namespace frontseat_driver::nmea
