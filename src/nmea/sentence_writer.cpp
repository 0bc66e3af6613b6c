#include "frontseat_driver/nmea/sentence_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::nmea {
namespace {

__extension__ using Wide = unsigned __int128;  // the word quiets -Wpedantic

constexpr std::size_t kTail = 5;  // `*`, two hex digits, CR, LF
constexpr double kTooLarge = 1e15;
/// 10^n for every n that 64 bits hold.
constexpr std::uint64_t kPowers[] = {1,
                                     10,
                                     100,
                                     1'000,
                                     10'000,
                                     100'000,
                                     1'000'000,
                                     10'000'000,
                                     100'000'000,
                                     1'000'000'000,
                                     10'000'000'000,
                                     100'000'000'000,
                                     1'000'000'000'000,
                                     10'000'000'000'000,
                                     100'000'000'000'000,
                                     1'000'000'000'000'000,
                                     10'000'000'000'000'000,
                                     100'000'000'000'000'000,
                                     1'000'000'000'000'000'000,
                                     10'000'000'000'000'000'000U};

/// A number as whole units and a count of `scale`-ths.
struct Fixed {
  std::uint64_t whole;
  std::uint64_t part;
};

/// `value` rounded to the nearest `scale`-th, ties to even; exact, because the bits of the double
/// are. `value` is from 0 to kTooLarge, `scale` at most 60 x 10^9.
Fixed toFixed(double value, std::uint64_t scale) {
  std::uint64_t pattern = 0;
  std::memcpy(&pattern, &value, sizeof value);
  const int shift = 1075 - static_cast<int>(pattern >> 52);  // value = bits / 2^shift; at least 3
  if (shift > 100) return {0, 0};                            // less than half of the smallest part
  constexpr std::uint64_t kHidden = std::uint64_t{1} << 52;
  const std::uint64_t bits = kHidden | (pattern & (kHidden - 1));
  const std::uint64_t whole = shift > 63 ? 0 : bits >> shift;
  const std::uint64_t rest = shift > 63 ? bits : bits - (whole << shift);
  const Wide scaled = Wide{rest} * scale;
  const Wide half = Wide{1} << (shift - 1);
  const auto floor = static_cast<std::uint64_t>(scaled >> shift);
  const Wide cut = scaled - (Wide{floor} << shift);
  const bool up = cut > half || (cut == half && ((floor + whole * scale) & 1) != 0);
  const std::uint64_t part = floor + (up ? 1 : 0);
  return part == scale ? Fixed{whole + 1, 0} : Fixed{whole, part};
}

bool areDecimals(int decimals) { return decimals >= 0 && decimals <= SentenceWriter::kMaxDecimals; }

bool isAddressPart(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

}  // namespace

SentenceWriter::SentenceWriter(std::string_view talker, std::string_view formatter) {
  put('$');
  put(talker);
  put(formatter);
  require(size_ >= 4 && size_ <= 9 && std::all_of(&buffer_[1], &buffer_[size_], isAddressPart));
}

void SentenceWriter::require(bool condition) {
  if (!condition) state_ = State::Invalid;
}

/// Makes room for so many characters and returns where they go; nowhere if there is none.
inline char* SentenceWriter::take(std::size_t count) {
  require(state_ == State::Open && count <= kCapacity - kTail - size_);
  if (state_ != State::Open) return nullptr;
  size_ += count;
  return buffer_.data() + size_ - count;
}

void SentenceWriter::put(char c) {
  if (char* const to = take(1)) *to = c;
}

void SentenceWriter::put(std::string_view text) {
  if (char* const to = take(text.size())) std::copy(text.begin(), text.end(), to);
}

/// `value` with leading zeros up to `width`.
void SentenceWriter::putDigits(std::uint64_t value, int width) {
  int count = 1;
  while (count < 20 && (count < width || value >= kPowers[count])) ++count;
  char* const to = take(static_cast<std::size_t>(count));
  if (to == nullptr) return;
  for (; count > 0; value /= 10) to[--count] = static_cast<char>('0' + value % 10);
}

void SentenceWriter::putFraction(std::uint64_t value, int decimals) {
  if (decimals == 0) return;
  put('.');
  putDigits(value, decimals);
}

void SentenceWriter::number(double value, int decimals) {
  blank();
  const double magnitude = std::fabs(value);
  if (!(magnitude < kTooLarge) || !areDecimals(decimals)) return require(false);
  const Fixed fixed = toFixed(magnitude, kPowers[decimals]);
  if (value < 0.0 && (fixed.whole != 0 || fixed.part != 0)) put('-');
  putDigits(fixed.whole, 1);
  putFraction(fixed.part, decimals);
}

void SentenceWriter::number(const std::optional<double>& value, int decimals) {
  if (!value) return blank();
  number(*value, decimals);
}

void SentenceWriter::integer(std::int64_t value) {
  blank();
  const auto bits = static_cast<std::uint64_t>(value);
  if (value < 0) put('-');
  putDigits(value < 0 ? 0 - bits : bits, 1);
}

void SentenceWriter::integer(const std::optional<std::int64_t>& value) {
  if (!value) return blank();
  integer(*value);
}

void SentenceWriter::timeOfDay(const std::optional<TimeOfDay>& time) {
  using std::chrono::hours;
  blank();
  if (!time) return;
  if (time->count() < 0 || *time >= hours{24} + std::chrono::seconds{1}) return require(false);
  const auto milliseconds = static_cast<std::uint64_t>(time->count()) / 1000;
  const std::uint64_t seconds = milliseconds / 1000;
  const bool leap = *time >= hours{24};
  const std::uint64_t minutes = leap ? 24 * 60 - 1 : seconds / 60;
  putDigits(minutes / 60, 2);
  putDigits(minutes % 60, 2);
  putDigits(seconds - minutes * 60, 2);
  putFraction(milliseconds % 1000, 3);
}

void SentenceWriter::date(const std::optional<Date>& date) {
  blank();
  if (!date) return;
  const bool valid = date->year >= 1980 && date->year < 2080 && date->month >= 1 &&
                     date->month <= 12 && date->day >= 1 && date->day <= 31;
  if (!valid) return require(false);
  putDigits(static_cast<std::uint64_t>(date->day), 2);
  putDigits(static_cast<std::uint64_t>(date->month), 2);
  putDigits(static_cast<std::uint64_t>(date->year % 100), 2);
}

void SentenceWriter::latLon(const std::optional<LatLon>& position, int minute_decimals) {
  if (!position) {
    for (int field = 0; field < 4; ++field) blank();
    return;
  }
  // Written so that NaN is refused.
  const bool on_earth =
      std::fabs(position->latitude_deg) <= 90.0 && std::fabs(position->longitude_deg) <= 180.0;
  if (!on_earth || !areDecimals(minute_decimals)) return require(false);
  degrees(position->latitude_deg, 2, minute_decimals, "NS");
  degrees(position->longitude_deg, 3, minute_decimals, "EW");
}

void SentenceWriter::degrees(double value, int degree_digits, int minute_decimals,
                             const char* signs) {
  const std::uint64_t minute = kPowers[minute_decimals];
  const Fixed fixed = toFixed(std::fabs(value), 60 * minute);
  blank();
  putDigits(fixed.whole, degree_digits);
  putDigits(fixed.part / minute, 2);
  putFraction(fixed.part % minute, minute_decimals);
  const bool negative = value < 0.0 && (fixed.whole != 0 || fixed.part != 0);
  blank();
  put(signs[negative ? 1 : 0]);
}

void SentenceWriter::text(std::string_view text) {
  blank();
  require(isFieldText(text));
  put(text);
}

/// Every field begins as an empty one.
void SentenceWriter::blank() { put(','); }

std::optional<std::string_view> SentenceWriter::finish() {
  if (state_ == State::Invalid) return std::nullopt;
  if (state_ == State::Open) {
    static constexpr char kHex[] = "0123456789ABCDEF";
    const std::uint8_t sum = checksum({&buffer_[1], size_ - 1});
    for (const char c : {'*', kHex[sum >> 4], kHex[sum & 15], '\r', '\n'}) buffer_[size_++] = c;
    state_ = State::Finished;
  }
  return std::string_view{buffer_.data(), size_};
}

bool isFieldText(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return c >= 0x20 && c <= 0x7E && c != ',' && c != '*' && c != '$';
  });
}

}  // namespace frontseat_driver::nmea
