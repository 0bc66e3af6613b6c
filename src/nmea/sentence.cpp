#include "frontseat_driver/nmea/sentence.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace frontseat_driver::nmea {
namespace {

constexpr std::uint64_t kEach = 0x0101010101010101;  // one in each of eight bytes
constexpr std::uint64_t kTopBits = 0x80 * kEach;

/// What one pass over the bytes between `$` and `*` tells, eight bytes at a time.
class BodyScan {
 public:
  explicit BodyScan(std::string_view body) {
    const char* at = body.data();
    std::size_t left = body.size();
    for (; left >= 8; at += 8, left -= 8) {
      std::uint64_t word;
      std::memcpy(&word, at, 8);
      take(word);
    }
    takeLast({at, left});
  }

  std::uint8_t checksum() const {
    std::uint64_t sum = sum_ ^ (sum_ >> 32);
    sum ^= sum >> 16;
    sum ^= sum >> 8;
    return static_cast<std::uint8_t>(sum);
  }

  /// No byte is outside 0x20..0x7F, and none is `*`.
  bool clean() const { return (flags_ & kTopBits) == 0; }

 private:
  void take(std::uint64_t word) {
    sum_ ^= word;
    const std::uint64_t star = word ^ ('*' * kEach);
    flags_ |= word | (word - ' ' * kEach) | ((star - kEach) & ~star);
  }

  /// Less than eight bytes: blanks, whose sum is taken out again, stand in for the others.
  void takeLast(std::string_view bytes) {
    std::uint64_t word = ' ' * kEach;
    for (const char c : bytes) word = (word << 8) | static_cast<unsigned char>(c);
    take(word);
    sum_ ^= (' ' * kEach) << (8 * bytes.size());
  }

  std::uint64_t sum_ = 0;
  std::uint64_t flags_ = 0;
};

std::optional<std::uint8_t> hexDigit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint8_t>(c - '0');
  if (c >= 'A' && c <= 'F') return static_cast<std::uint8_t>(c - 'A' + 10);
  if (c >= 'a' && c <= 'f') return static_cast<std::uint8_t>(c - 'a' + 10);
  return std::nullopt;
}

bool isAddress(std::string_view text) {
  const auto allowed = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  return text.size() >= 3 && text.size() <= 8 && std::all_of(text.begin(), text.end(), allowed);
}

/// A line cut at its `*`; `sum` is what was written after it.
struct Parts {
  std::string_view body;
  std::optional<std::uint8_t> sum;
};

/// `line` without its `$`, with nothing but a checksum and blanks after the first `*`.
Decoded<Parts> cut(std::string_view line, ChecksumRule rule) {
  while (!line.empty() && line.back() == ' ') line.remove_suffix(1);
  const std::size_t size = line.size();
  const bool ends_as_usual = size >= 3 && line[size - 3] == '*';
  const std::size_t star = ends_as_usual ? size - 3 : line.find('*');
  const bool optional = rule == ChecksumRule::Optional;
  if (star == std::string_view::npos && optional) return Parts{line, std::nullopt};
  if (star == std::string_view::npos) return Fault::BadFrame;
  if (star + 1 == size && optional) return Parts{line.substr(0, star), std::nullopt};
  if (star + 1 == size) return Fault::MissingChecksum;
  if (!ends_as_usual) return Fault::BadFrame;
  const auto high = hexDigit(line[star + 1]);
  const auto low = hexDigit(line[star + 2]);
  if (!high || !low) return Fault::BadFrame;
  return Parts{line.substr(0, star), static_cast<std::uint8_t>(*high * 16 + *low)};
}

Sentence split(std::string_view body) {
  const std::size_t comma = body.substr(0, 9).find(',');
  if (comma == std::string_view::npos) return {body, {}, false};
  return {body.substr(0, comma), body.substr(comma + 1), true};
}

}  // namespace

std::uint8_t checksum(std::string_view bytes) { return BodyScan{bytes}.checksum(); }

Decoded<Sentence> parseSentence(std::string_view line, ChecksumRule rule) {
  if (line.empty() || line.front() != '$') return Fault::BadFrame;
  const auto parts = cut(line.substr(1), rule);
  if (!parts) return parts.failure();
  const BodyScan scan{parts->body};
  if (!scan.clean()) return Fault::BadFrame;
  if (parts->sum && *parts->sum != scan.checksum()) return Fault::BadChecksum;
  const Sentence sentence = split(parts->body);
  if (!isAddress(sentence.address)) return Fault::BadFrame;
  return sentence;
}

}  // namespace frontseat_driver::nmea
