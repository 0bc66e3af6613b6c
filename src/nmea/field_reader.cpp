#include "frontseat_driver/nmea/field_reader.h"

#include <algorithm>
#include <cmath>

#include "decimal.h"
#include "field.h"

namespace frontseat_driver::nmea {
namespace {

constexpr std::ptrdiff_t kBlock = 64;

bool allDigits(std::string_view text) { return std::all_of(text.begin(), text.end(), isDigit); }

std::uint64_t toNumber(std::string_view digits) {
  std::uint64_t sum = 0;
  for (const char c : digits) sum = sum * 10 + static_cast<std::uint64_t>(c - '0');
  return sum;
}

/// Six digits as three numbers of two.
struct Pairs {
  int first, second, third;
};

constexpr std::uint64_t kPowersOfTen[] = {1, 10, 100, 1'000, 10'000, 100'000, 1'000'000};

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

/// A whole number with a sign at most and no decimals but zeros. False if that is not what `text`
/// is; sets `value`, or nothing in it if it does not fit.
bool readInteger(std::string_view text, std::optional<std::int64_t>& value) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !isDigit(*at)) return false;
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
  return at == end;
}

/// How many of the digits before the point are of the minutes; negative if that cannot be told.
int minuteDigits(int whole_digits, DegreeSplit split, int degree_digits) {
  if (split == DegreeSplit::FromPoint) return std::min(whole_digits, 2);
  return whole_digits > degree_digits ? whole_digits - degree_digits : -1;
}

}  // namespace

// Behind the last field is one place more, which a null pointer does not have.
FieldReader::FieldReader(const Sentence& sentence)
    : begin_(sentence.has_fields ? sentence.fields.data() : ""),
      end_(sentence.has_fields ? begin_ + sentence.fields.size() : begin_),
      at_(sentence.has_fields ? begin_ : end_ + 1),
      block_(begin_) {
  findMarks();
}

/// Notes where the commas and points of the block are.
void FieldReader::findMarks() {
  commas_ = 0;
  marks_ = 0;
  const auto note = [this](Bytes text, std::ptrdiff_t place, std::ptrdiff_t before) {
    commas_ |= bitsOf(text == ',') >> before << place;
    marks_ |= bitsOf((text | 2) == '.') >> before << place;  // `,` differs from `.` in one bit
  };
  const std::ptrdiff_t size = end_ - block_;
  std::ptrdiff_t place = 0;
  for (; place < kBlock && size - place >= kWidth; place += kWidth) {
    note(load(block_ + place), place, 0);
  }
  if (place == kBlock) return;
  if (end_ - begin_ < kWidth) {
    note(loadFirst(block_ + place, end_, ' '), place, 0);
  } else {
    note(load(end_ - kWidth), place, kWidth - (size - place));
  }
  commas_ |= std::uint64_t{1} << size;
  marks_ |= std::uint64_t{1} << size;
}

/// Goes to the next field, which is empty if there is none.
inline Field FieldReader::take() {
  ++field_;
  const char* const begin = at_;
  if (begin > end_) return missing();
  if (commas_ == 0) return takeOverBlocks();
  const char* const end = block_ + __builtin_ctzll(commas_);
  const char* const point = block_ + __builtin_ctzll(marks_);
  const std::uint64_t below = commas_ - 1;
  marks_ &= ~(commas_ ^ below);
  commas_ &= below;
  at_ = end + 1;
  return {begin, point, end};
}

Field FieldReader::missing() {
  if (!optional_) note(Fault::MissingField);
  return {end_, end_, end_};
}

/// For a field that ends in a later block.
Field FieldReader::takeOverBlocks() {
  const char* const point = marks_ != 0 ? block_ + __builtin_ctzll(marks_) : nullptr;
  while (commas_ == 0) {
    block_ += kBlock;
    findMarks();
  }
  --field_;
  Field field = take();
  if (point != nullptr) field.point = point;
  return field;
}

void FieldReader::note(Fault fault) {
  if (faults_.count++ == 0) faults_.first = {fault, field_};
}

bool FieldReader::refuse(Fault fault) {
  note(fault);
  return false;
}

/// For a field that is not of the type asked for.
bool FieldReader::refuseField(std::string_view text) {
  if (!text.empty() && !isNotFinite(text)) note(Fault::BadValue);
  return false;
}

/// Whether `digits` of the field, and what it takes to read them, are in reach of Digits::last().
inline bool FieldReader::isShort(const Field& field, std::ptrdiff_t digits) const {
  return digits >= 1 && digits <= 8 && field.end - begin_ >= 9;
}

bool FieldReader::read(double& out) {
  const Field field = take();
  if (field.blank()) return false;
  const std::ptrdiff_t sign = *field.begin == '-' ? 1 : 0;
  const std::ptrdiff_t digit_count = field.end - field.begin - sign - field.hasPoint();
  if (isShort(field, digit_count)) {
    const Digits digits = Digits::last(digit_count, field);
    out = toDouble(digits.number(), field.decimals(), sign);
    if (digits.good()) return true;
  }
  return readTheLongWay(field.text(), out);
}

bool FieldReader::readTheLongWay(std::string_view text, double& out) {
  Decimal decimal;
  const char* const end = text.data() + text.size();
  if (text.empty() || readDecimal(text.data(), end, decimal) != end) return refuseField(text);
  out = toDouble(decimal);
  return std::abs(out) <= kLargest || refuse(Fault::OutOfRange);
}

bool FieldReader::read(std::int64_t& out, std::int64_t low, std::int64_t high) {
  const Field field = take();
  if (field.end - field.begin == 1 && isDigit(*field.begin)) {
    out = *field.begin - '0';
    return (out >= low && out <= high) || refuse(Fault::OutOfRange);
  }
  const std::string_view text = field.text();
  std::optional<std::int64_t> value;
  if (text.empty() || !readInteger(text, value)) return refuseField(text);
  if (!value || *value < low || *value > high) return refuse(Fault::OutOfRange);
  out = *value;
  return true;
}

bool FieldReader::read(TimeOfDay& out) {
  const Field field = take();
  const std::ptrdiff_t decimals = field.decimals();
  const bool usual = field.point - field.begin == 6 && decimals >= 2 && decimals <= 6;
  if (!usual || field.end - begin_ < 9) return readTheLongWay(field.text(), out);
  const Digits clock = Digits::at(field.begin).first(4);
  const Digits seconds = Digits::last(2 + decimals, field);
  if (!clock.good() || !seconds.good()) return readTheLongWay(field.text(), out);
  const std::uint64_t microseconds = seconds.number() * kPowersOfTen[6 - decimals];
  return set(out, clock.pair(4), clock.pair(6), static_cast<std::int64_t>(microseconds));
}

bool FieldReader::readTheLongWay(std::string_view text, TimeOfDay& out) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view decimals = text.substr(std::min(point + 1, text.size()));
  if (point != 6 || !allDigits(text.substr(0, 6)) || !allDigits(decimals)) return refuseField(text);
  const std::string_view microseconds = decimals.substr(0, 6);
  const Pairs clock = pairs(toNumber(text.substr(0, 6)));
  const auto decimals_us = toNumber(microseconds) * kPowersOfTen[6 - microseconds.size()];
  return set(out, clock.first, clock.second,
             std::int64_t{clock.third} * 1'000'000 + static_cast<std::int64_t>(decimals_us));
}

/// The seconds may read 60 and a part.
inline bool FieldReader::set(TimeOfDay& out, int hours, int minutes, std::int64_t microseconds) {
  if (hours > 23 || minutes > 59 || microseconds >= 61'000'000) return refuse(Fault::OutOfRange);
  out = TimeOfDay{(hours * 60 + minutes) * std::int64_t{60'000'000} + microseconds};
  return true;
}

std::optional<Date> FieldReader::date() {
  const std::string_view field = text();
  if (field.size() != 6 || !allDigits(field)) return refuseField(field), std::nullopt;
  const auto [day, month, short_year] = pairs(toNumber(field));
  const int year = short_year + (short_year < 80 ? 2000 : 1900);
  const bool exists = month >= 1 && month <= 12 && day >= 1 && day <= daysIn(month, year);
  if (!exists) return refuse(Fault::OutOfRange), std::nullopt;
  return Date{year, month, day};
}

/// One field of degrees and minutes without a sign.
bool FieldReader::readDegrees(double& out, DegreeSplit split, int degree_digits, double limit) {
  const Field field = take();
  const std::ptrdiff_t count = field.point - field.begin - 2;  // of degrees, if two are of minutes
  const bool usual = count == degree_digits || (split == DegreeSplit::FromPoint && count == 2);
  const std::ptrdiff_t decimals = field.decimals();
  if (usual && end_ - field.begin >= 8 && isShort(field, 2 + decimals)) {
    const Digits degrees = Digits::at(field.begin).first(count);
    const Digits minutes = Digits::last(2 + decimals, field);
    if (degrees.good() && minutes.good()) {
      return set(out, degrees.number(), toDouble(minutes.number(), decimals, 0), limit);
    }
  }
  return readDegreesTheLongWay(field.text(), out, split, degree_digits, limit);
}

bool FieldReader::readDegreesTheLongWay(std::string_view text, double& out, DegreeSplit split,
                                        int degree_digits, double limit) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const int whole_digits = static_cast<int>(point);
  const int minute_digits = minuteDigits(whole_digits, split, degree_digits);
  const std::string_view degrees =
      text.substr(0, point - static_cast<std::size_t>(std::max(minute_digits, 0)));
  Decimal minutes;
  const char* const end = text.data() + text.size();
  const bool read =
      allDigits(degrees) && readDigits(degrees.data() + degrees.size(), end, minutes) == end;
  if (!read || text.empty()) return refuseField(text);
  const double minute_value = toDouble(minutes);
  if (minute_digits < 0) {  // not a position, but the zero of one that is not known yet
    out = 0.0;
    return minute_value == 0.0 || refuse(Fault::BadValue);
  }
  if (whole_digits > kMaxDigits) return refuse(Fault::OutOfRange);
  return set(out, toNumber(degrees), minute_value, limit);
}

inline bool FieldReader::set(double& out, std::uint64_t degrees, double minutes, double limit) {
  out = static_cast<double>(degrees) + minutes / 60.0;
  return (minutes <= 60.0 && out <= limit) || refuse(Fault::OutOfRange);
}

std::string_view FieldReader::text() { return take().text(); }

char FieldReader::letter() {
  const Field field = take();
  if (field.end - field.begin == 1) return *field.begin;
  const std::string_view text = field.text();
  if (text.empty()) return ' ';
  return text.size() == 1 ? text.front() : '\0';
}

int FieldReader::remaining() const {
  return at_ > end_ ? 0 : 1 + static_cast<int>(std::count(at_, end_, ','));
}

}  // namespace frontseat_driver::nmea
