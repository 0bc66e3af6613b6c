#include "frontseat_driver/nmea/sentence.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "bytes.h"

namespace frontseat_driver::nmea {
namespace {

/// What one pass over the bytes between `$` and `*` tells.
class BodyScan {
 public:
  explicit BodyScan(std::string_view body) {
    const char* at = body.data();
    const char* const end = at + body.size();
    for (; end - at >= kWidth; at += kWidth) take(load(at));
    if (at == end) return;
    // Blanks, which are well-formed, stand in for what is missing to sixteen.
    const bool few = body.size() < static_cast<std::size_t>(kWidth);
    take(few ? loadFirst(at, end, ' ') : loadLast(end, end - at, ' '));
    if ((kWidth - (end - at)) % 2 != 0) odd_blanks_ = ' ';
  }

  std::uint8_t checksum() const {
    std::uint64_t halves[2];
    std::memcpy(halves, &sum_, sizeof halves);
    std::uint64_t sum = halves[0] ^ halves[1];
    for (const int half : {32, 16, 8}) sum ^= sum >> half;
    return static_cast<std::uint8_t>(sum) ^ odd_blanks_;
  }

  /// No byte is outside 0x20..0x7F, and none is `*`.
  bool clean() const { return bitsOf(faults_) == 0; }

 private:
  using Signed = signed char __attribute__((vector_size(kWidth)));

  void take(Bytes text) {
    sum_ ^= text;
    faults_ |=
        (reinterpret_cast<Signed>(text) < ' ') | (text == '*');  // 0x80 and more are negative
  }

  Bytes sum_{};
  Signed faults_{};
  std::uint8_t odd_blanks_ = 0;
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

/// The same for the address that `body` begins with, if it is five letters and a comma.
bool beginsAsUsual(std::string_view body) {
  if (body.size() < 8 || body[5] != ',') return false;
  constexpr std::uint64_t kEach = 0x0101010101;
  const std::uint64_t letters = loadEight(body.data()) & (0xFF * kEach);
  const std::uint64_t from_a = letters + (0x80 - 'A') * kEach;
  const std::uint64_t beyond_z = letters + (0x7F - 'Z') * kEach;
  return ((from_a & ~beyond_z) & (0x80 * kEach)) == 0x80 * kEach;
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

bool endsWith(std::string_view line, std::uint8_t checksum) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  const char* const star = line.data() + line.size() - 3;
  return star[0] == '*' && star[1] == kHex[checksum >> 4] && star[2] == kHex[checksum & 15];
}

/// For lines that are not as all vehicles send them.
Decoded<Sentence> parseTheLongWay(std::string_view line, ChecksumRule rule) {
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

}  // namespace

std::uint8_t checksum(std::string_view bytes) { return BodyScan{bytes}.checksum(); }

Decoded<Sentence> parseSentence(std::string_view line, ChecksumRule rule) {
  constexpr std::size_t kAround = 4;  // `$`, `*`, two digits
  if (line.size() > kAround && line.front() == '$') {
    const std::string_view body = line.substr(1, line.size() - kAround);
    const BodyScan scan{body};
    const bool usual = scan.clean() && endsWith(line, scan.checksum()) && beginsAsUsual(body);
    if (usual) return Sentence{body.substr(0, 5), body.substr(6), true};
  }
  return parseTheLongWay(line, rule);
}

}  // namespace frontseat_driver::nmea
