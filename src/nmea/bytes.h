#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Text sixteen characters at a time: sentences are short and their fields of any length, so a loop
// over single characters would mostly wait for branches that were guessed wrong.
namespace frontseat_driver::nmea {

/// One register of SSE2 or NEON; where there is neither, the compiler makes do with two words.
using Bytes = unsigned char __attribute__((vector_size(16)));
constexpr std::ptrdiff_t kWidth = sizeof(Bytes);

inline Bytes load(const char* at) {
  Bytes bytes;
  std::memcpy(&bytes, at, sizeof bytes);
  return bytes;
}

/// Less than sixteen characters, `fill` after them.
inline Bytes loadFirst(const char* at, const char* end, char fill) {
  char text[kWidth];
  std::memset(text, fill, sizeof text);
  std::copy(at, end, text);
  return load(text);
}

/// The last `count` of the sixteen characters before `end`, `fill` in place of the others.
inline Bytes loadLast(const char* end, std::ptrdiff_t count, char fill) {
  static constexpr unsigned char kWindow[2 * kWidth] = {255, 255, 255, 255, 255, 255, 255, 255,
                                                        255, 255, 255, 255, 255, 255, 255, 255};
  const Bytes others = load(reinterpret_cast<const char*>(kWindow) + count);
  return (load(end - kWidth) & ~others) | (others & static_cast<unsigned char>(fill));
}

/// Eight characters as a number, the first one lowest.
inline std::uint64_t loadEight(const char* at) {
  std::uint64_t word;
  std::memcpy(&word, at, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  word = __builtin_bswap64(word);
#endif
  return word;
}

/// What a comparison of Bytes found, a bit for each, the first one lowest.
template <class Flags>
std::uint64_t bitsOf(Flags flags) {
#ifdef __SSE2__
  return static_cast<std::uint64_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(flags)));
#else
  constexpr std::uint64_t kGather = 0x0102040810204080;  // bit 8 i goes to bit 56 + i
  const char* const text = reinterpret_cast<const char*>(&flags);
  const std::uint64_t ones = 0x0101010101010101;
  const std::uint64_t low = ((loadEight(text) & ones) * kGather) >> 56;
  const std::uint64_t high = ((loadEight(text + 8) & ones) * kGather) >> 56;
  return low | (high << 8);
#endif
}

}  // namespace frontseat_driver::nmea
