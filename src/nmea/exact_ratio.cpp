#include "exact_ratio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace frontseat_driver::nmea {
namespace {

// A double is told apart from its neighbours by 768 digits at most; of further ones it only matters
// whether any is not zero.
constexpr int kMaxDigits = 780;
constexpr int kLargestPower = 310;    // 10^310 and more is infinite
constexpr int kSmallestPower = -345;  // less than 10^-345 is zero

/// A whole number of up to 4096 bits: 10^(780 + 345) with room to be shifted.
class BigNumber {
 public:
  explicit BigNumber(std::uint32_t value) : size_(value == 0 ? 0 : 1) { words_[0] = value; }

  bool zero() const { return size_ == 0; }

  int bits() const {
    if (zero()) return 0;
    int top = 0;
    for (std::uint32_t word = words_[size_ - 1]; word != 0; word >>= 1) ++top;
    return static_cast<int>(size_ - 1) * 32 + top;
  }

  void multiplyAndAdd(std::uint32_t factor, std::uint32_t addend) {
    std::uint64_t carry = addend;
    for (std::size_t i = 0; i < size_; ++i) {
      carry += std::uint64_t{words_[i]} * factor;
      words_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) words_[size_++] = static_cast<std::uint32_t>(carry);
  }

  void multiplyByTenTo(int power) {
    for (; power >= 9; power -= 9) multiplyAndAdd(1'000'000'000, 0);
    for (; power > 0; --power) multiplyAndAdd(10, 0);
  }

  void shiftLeft(int count) {
    for (; count >= 31; count -= 31) multiplyAndAdd(std::uint32_t{1} << 31, 0);
    multiplyAndAdd(std::uint32_t{1} << count, 0);
  }

  bool less(const BigNumber& other) const {
    if (size_ != other.size_) return size_ < other.size_;
    for (std::size_t i = size_; i-- > 0;) {
      if (words_[i] != other.words_[i]) return words_[i] < other.words_[i];
    }
    return false;
  }

  /// `other` must not be larger.
  void subtract(const BigNumber& other) {
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::int64_t taken = i < other.size_ ? other.words_[i] : 0;
      const std::int64_t difference = words_[i] - taken + borrow;
      words_[i] = static_cast<std::uint32_t>(difference);
      borrow = difference < 0 ? -1 : 0;
    }
    while (size_ > 0 && words_[size_ - 1] == 0) --size_;
  }

 private:
  std::array<std::uint32_t, 128> words_{};
  std::size_t size_;
};

/// Whole digits without leading zeros, and the power of ten that they are to be taken times.
struct Digits {
  BigNumber number{0};
  int count = 0;
  int exponent = 0;
};

Digits collect(std::string_view text, int exponent) {
  Digits digits;
  digits.exponent = exponent;
  bool more = false;
  for (const char c : text) {
    if (c == '.' || (c == '0' && digits.count == 0)) continue;
    if (digits.count == kMaxDigits) {
      ++digits.exponent;
      more = more || c != '0';
      continue;
    }
    digits.number.multiplyAndAdd(10, static_cast<std::uint32_t>(c - '0'));
    ++digits.count;
  }
  if (!more) return digits;
  // One last digit stands for all that were left out: enough to break a tie.
  digits.number.multiplyAndAdd(10, 1);
  return {digits.number, digits.count + 1, digits.exponent - 1};
}

/// The double nearest to (`quotient` + a bit less than one if `rest`) x 2^`exponent`.
double nearest(std::uint64_t quotient, bool rest, int exponent, int quotient_bits) {
  constexpr int kDigits = std::numeric_limits<double>::digits;                  // 53
  constexpr int kLowest = std::numeric_limits<double>::min_exponent - kDigits;  // 2^-1074
  const int lowest = std::max(exponent + quotient_bits - kDigits, kLowest);
  const int dropped = lowest - exponent;
  if (dropped > 64) return 0.0;
  const std::uint64_t kept = dropped == 64 ? 0 : quotient >> dropped;
  const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
  const std::uint64_t cut = dropped == 64 ? quotient : quotient & (2 * half - 1);
  const bool up = cut > half || (cut == half && (rest || (kept & 1) != 0));
  return std::ldexp(static_cast<double>(kept + (up ? 1 : 0)), lowest);
}

/// `numerator` / `denominator`, neither of them zero, by long division to 63 or 64 bits.
double divide(BigNumber numerator, BigNumber denominator) {
  const int shift = numerator.bits() - denominator.bits();
  if (shift < 0) numerator.shiftLeft(-shift);
  if (shift > 0) denominator.shiftLeft(shift);
  std::uint64_t quotient = 0;  // of a ratio between a half and two, times 2^63
  for (int i = 0; i < 64; ++i) {
    quotient <<= 1;
    if (!numerator.less(denominator)) {
      numerator.subtract(denominator);
      quotient |= 1;
    }
    numerator.shiftLeft(1);
  }
  const int quotient_bits = (quotient >> 63) != 0 ? 64 : 63;
  return nearest(quotient, !numerator.zero(), shift - 63, quotient_bits);
}

}  // namespace

double nearestDouble(std::string_view text, int exponent) {
  Digits digits = collect(text, exponent);
  const int power = digits.count + digits.exponent;  // 10^(power - 1) <= value < 10^power
  if (digits.count == 0 || power < kSmallestPower) return 0.0;
  if (power > kLargestPower) return std::numeric_limits<double>::infinity();
  BigNumber denominator{1};
  if (digits.exponent > 0) digits.number.multiplyByTenTo(digits.exponent);
  if (digits.exponent < 0) denominator.multiplyByTenTo(-digits.exponent);
  return divide(digits.number, denominator);
}

}  // namespace frontseat_driver::nmea
