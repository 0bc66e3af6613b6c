#include "packet_file.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace frontseat_driver::capture {
namespace {

constexpr std::size_t kLargest = 1 << 20;  // of a packet or block; interfaces give 256 KB at most
constexpr std::size_t kChunk = 64UL * 1024;
constexpr std::size_t kMostInterfaces = 256;
constexpr std::string_view kSection{"\x0A\x0D\x0D\x0A"};

constexpr std::uint32_t kInterfaceBlock = 1;
constexpr std::uint32_t kOldPacketBlock = 2;
constexpr std::uint32_t kSimplePacketBlock = 3;
constexpr std::uint32_t kPacketBlock = 6;

struct Magic {
  std::string_view bytes;
  bool big_endian;
  bool nanoseconds;
};

constexpr Magic kMagics[] = {{"\xD4\xC3\xB2\xA1", false, false},
                             {"\xA1\xB2\xC3\xD4", true, false},
                             {"\x4D\x3C\xB2\xA1", false, true},
                             {"\xA1\xB2\x3C\x4D", true, true}};

const Magic* magicOf(std::string_view first) {
  for (const Magic& magic : kMagics) {
    if (first.substr(0, 4) == magic.bytes) return &magic;
  }
  return nullptr;
}

std::uint8_t byteAt(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

std::uint64_t powerOfTen(int exponent) {
  std::uint64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

struct Split {
  std::uint64_t seconds;
  std::uint64_t nanoseconds;
};

/// A count of units of 10^-n s, or with the top bit of the resolution set of 2^-n s.
std::optional<Split> split(std::uint64_t count, std::uint8_t resolution) {
  const int exponent = resolution & 0x7F;
  if ((resolution & 0x80) == 0) {
    if (exponent > 19) return std::nullopt;
    const std::uint64_t units = powerOfTen(exponent);
    const std::uint64_t rest = count % units;
    const bool fine = exponent > 9;
    return Split{count / units,
                 fine ? rest / powerOfTen(exponent - 9) : rest * powerOfTen(9 - exponent)};
  }
  if (exponent > 63) return std::nullopt;
  const std::uint64_t rest = count & ((std::uint64_t{1} << exponent) - 1);
  const double part = std::ldexp(static_cast<double>(rest), -exponent);
  return Split{count >> exponent, static_cast<std::uint64_t>(part * 1e9)};
}

}  // namespace

PacketFile::PacketFile(std::unique_ptr<ByteSource> source)
    : source_(std::move(source)), buffer_(kChunk) {
  readHeader();
}

bool PacketFile::recognizes(std::string_view first_bytes) {
  return magicOf(first_bytes) != nullptr || first_bytes.substr(0, 4) == kSection;
}

std::optional<Packet> PacketFile::next() {
  if (breaks_off_) return std::nullopt;
  return blocks_ ? nextBlock() : nextRecord();
}

/// Brings so many bytes into the buffer. False: the file has no more.
bool PacketFile::require(std::size_t size) {
  if (filled_ - at_ >= size) return true;
  std::memmove(buffer_.data(), buffer_.data() + at_, filled_ - at_);
  filled_ -= at_;
  at_ = 0;
  if (size > buffer_.size()) buffer_.resize(size);
  while (filled_ < size && !ended_) {
    const std::size_t count = source_->read(buffer_.data() + filled_, buffer_.size() - filled_);
    ended_ = count == 0;
    filled_ += count;
    bytes_read_ += count;
  }
  return filled_ >= size;
}

/// Bytes that were required before.
std::string_view PacketFile::take(std::size_t size) {
  at_ += size;
  return {buffer_.data() + at_ - size, size};
}

std::optional<Packet> PacketFile::end(bool damaged) {
  breaks_off_ = damaged || filled_ != at_;
  return std::nullopt;
}

std::uint16_t PacketFile::u16(std::string_view bytes, std::size_t at) const {
  const int first = byteAt(bytes, at);
  const int second = byteAt(bytes, at + 1);
  return static_cast<std::uint16_t>(big_endian_ ? first << 8 | second : second << 8 | first);
}

std::uint32_t PacketFile::u32(std::string_view bytes, std::size_t at) const {
  const std::uint32_t first = u16(bytes, at);
  const std::uint32_t second = u16(bytes, at + 2);
  return big_endian_ ? first << 16 | second : second << 16 | first;
}

void PacketFile::readHeader() {
  const bool whole = require(4);
  const std::string_view first{buffer_.data(), whole ? 4U : 0U};
  if (!recognizes(first)) throw std::runtime_error("no packet capture");
  blocks_ = first == kSection;
  if (blocks_) return;
  const Magic& magic = *magicOf(first);
  big_endian_ = magic.big_endian;
  nanoseconds_ = magic.nanoseconds;
  constexpr std::size_t kHeader = 24;
  if (!require(kHeader)) {
    end(true);
    return;
  }
  link_type_ = u32(take(kHeader), 20) & 0xFFFF;  // above it: about frame check sequences
}

std::optional<Packet> PacketFile::nextRecord() {
  if (!require(kBlockHeader)) return end(false);
  const std::string_view header = take(kBlockHeader);
  const std::uint32_t seconds = u32(header, 0);
  const std::uint32_t part = u32(header, 4);
  const std::uint32_t size = u32(header, 8);
  if (size > kLargest || !require(size)) return end(true);
  const auto time = std::chrono::seconds{seconds} +
                    std::chrono::nanoseconds{std::int64_t{part} * (nanoseconds_ ? 1 : 1000)};
  return Packet{time, link_type_, take(size)};
}

std::optional<Packet> PacketFile::nextBlock() {
  constexpr std::size_t kFrame = 12;  // type and length in front, the length again behind
  while (require(kFrame)) {
    const std::string_view head{buffer_.data() + at_, kFrame};
    if (head.substr(0, 4) == kSection && !beginSection()) return end(true);
    const std::uint32_t type = u32(head, 0);
    const std::uint32_t size = u32(head, 4);
    if (size < kFrame || size % 4 != 0 || size > kLargest || !require(size)) return end(true);
    const std::string_view body = take(size).substr(8, size - kFrame);
    if (type == kInterfaceBlock) addInterface(body);
    if (const auto packet = packetOf(type, body)) return packet;
  }
  return end(false);
}

/// A section has its own byte order and its own interfaces.
bool PacketFile::beginSection() {
  interfaces_.clear();
  const std::string_view magic{buffer_.data() + at_ + 8, 4};
  big_endian_ = magic == "\x1A\x2B\x3C\x4D";
  return big_endian_ || magic == "\x4D\x3C\x2B\x1A";
}

void PacketFile::addInterface(std::string_view body) {
  if (body.size() < 8 || interfaces_.size() == kMostInterfaces) return;
  Interface interface;
  interface.link_type = u16(body, 0);
  constexpr int kResolution = 9, kOffset = 14;
  for (std::size_t at = 8; at + 4 <= body.size();) {
    const int code = u16(body, at);
    const std::size_t size = u16(body, at + 2);
    at += 4;
    if (code == 0 || size > body.size() - at) break;
    if (code == kResolution && size == 1) interface.resolution = byteAt(body, at);
    if (code == kOffset && size == 8) {
      const std::uint64_t high = u32(body, big_endian_ ? at : at + 4);
      const std::uint64_t low = u32(body, big_endian_ ? at + 4 : at);
      interface.offset_s = static_cast<std::int64_t>(high << 32 | low);
    }
    at += (size + 3) / 4 * 4;
  }
  interfaces_.push_back(interface);
}

std::optional<Packet> PacketFile::packetOf(std::uint32_t type, std::string_view body) const {
  const bool simple = type == kSimplePacketBlock;
  const bool old = type == kOldPacketBlock;
  if (!simple && !old && type != kPacketBlock) return std::nullopt;
  const std::size_t header = simple ? 4 : 20;
  if (body.size() < header) return std::nullopt;
  const std::size_t number = simple ? 0 : old ? u16(body, 0) : u32(body, 0);
  if (number >= interfaces_.size()) return std::nullopt;
  const Interface& interface = interfaces_[number];
  const std::size_t captured = simple ? u32(body, 0) : u32(body, 12);
  const std::string_view bytes = body.substr(header, captured);
  if (simple) return Packet{std::nullopt, interface.link_type, bytes};
  const std::uint64_t high = u32(body, 4);
  return Packet{timeOf(interface, high << 32 | u32(body, 8)), interface.link_type, bytes};
}

std::optional<vehicle::UtcTime> PacketFile::timeOf(const Interface& interface,
                                                   std::uint64_t count) const {
  const auto parts = split(count, interface.resolution);
  constexpr std::int64_t kLast = 9'000'000'000;  // seconds that nanoseconds can count
  if (!parts || parts->seconds > static_cast<std::uint64_t>(kLast)) return std::nullopt;
  const bool shifts = interface.offset_s > -kLast && interface.offset_s < kLast;
  if (!shifts) return std::nullopt;
  const std::int64_t seconds = static_cast<std::int64_t>(parts->seconds) + interface.offset_s;
  if (seconds < 0 || seconds > kLast) return std::nullopt;
  return std::chrono::seconds{seconds} +
         std::chrono::nanoseconds{static_cast<std::int64_t>(parts->nanoseconds)};
}

}  // namespace frontseat_driver::capture
