#include "tcp_segment.h"

#include <algorithm>

namespace frontseat_driver::capture {
namespace {

// Numbers of tcpdump.org/linktypes.html and of IANA.
constexpr std::uint32_t kNull = 0, kEthernet = 1, kRawBsd = 12, kRawOpenBsd = 14, kRaw = 101,
                        kLoop = 108, kCooked = 113, kIpv4Link = 228, kIpv6Link = 229,
                        kCooked2 = 276;
constexpr unsigned kIpv4Type = 0x0800, kIpv6Type = 0x86DD;
constexpr unsigned kTcp = 6;

unsigned u8(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}
unsigned u16(std::string_view bytes, std::size_t at) {
  return u8(bytes, at) << 8 | u8(bytes, at + 1);
}
std::uint32_t u32(std::string_view bytes, std::size_t at) {
  return std::uint32_t{u16(bytes, at)} << 16 | u16(bytes, at + 2);
}

bool isVlan(unsigned type) { return type == 0x8100 || type == 0x88A8 || type == 0x9100; }

/// What comes behind the type at `at`, where that says IP, with any VLAN tags in between.
std::string_view behindType(std::string_view frame, std::size_t at, std::size_t payload) {
  constexpr std::size_t kTag = 4;
  for (int tags = 0; tags < 4 && frame.size() >= payload; ++tags) {
    const unsigned type = u16(frame, at);
    if (type == kIpv4Type || type == kIpv6Type) return frame.substr(payload);
    if (!isVlan(type) || frame.size() < payload + kTag) return {};
    at = payload + 2;
    payload += kTag;
  }
  return {};
}

std::string_view ipPacketOf(std::uint32_t link_type, std::string_view frame) {
  switch (link_type) {
    case kEthernet:
      return behindType(frame, 12, 14);
    case kCooked:
      return behindType(frame, 14, 16);
    case kCooked2:
      return behindType(frame, 0, 20);
    case kNull:
    case kLoop:  // a number for the family, which the packet tells too
      return frame.size() > 4 ? frame.substr(4) : std::string_view{};
    case kRaw:
    case kRawBsd:
    case kRawOpenBsd:
    case kIpv4Link:
    case kIpv6Link:
      return frame;
    default:
      return {};
  }
}

/// The payload of an IP packet, and how much of it was on the line.
struct Datagram {
  std::string_view source, destination;
  unsigned protocol = 0;
  std::string_view payload;
  std::size_t size = 0;
};

std::optional<Datagram> ipv4(std::string_view packet) {
  if (packet.size() < 20) return std::nullopt;
  const std::size_t header = (u8(packet, 0) & 0xF) * std::size_t{4};
  const std::size_t told = u16(packet, 2);
  // A card that cuts the packets itself is handed a length of 0.
  const std::size_t total = told == 0 ? packet.size() : told;
  const bool fragment = (u16(packet, 6) & 0x3FFF) != 0;
  if (header < 20 || header > packet.size() || total < header || fragment) return std::nullopt;
  const std::string_view payload = packet.substr(header, total - header);
  return Datagram{packet.substr(12, 4), packet.substr(16, 4), u8(packet, 9), payload,
                  total - header};
}

/// How long an extension header is; 0 for what is none that can be skipped.
std::size_t extensionSize(unsigned type, std::string_view header) {
  constexpr unsigned kHopByHop = 0, kRouting = 43, kAuthentication = 51, kDestination = 60;
  if (header.size() < 8) return 0;
  if (type == kAuthentication) return (u8(header, 1) + 2) * std::size_t{4};
  const bool plain = type == kHopByHop || type == kRouting || type == kDestination;
  return plain ? (u8(header, 1) + 1) * std::size_t{8} : 0;
}

std::optional<Datagram> ipv6(std::string_view packet) {
  constexpr std::size_t kHeader = 40;
  if (packet.size() < kHeader) return std::nullopt;
  const std::size_t told = u16(packet, 4);
  std::size_t size = told == 0 ? packet.size() - kHeader : told;
  std::string_view payload = packet.substr(kHeader, size);
  unsigned type = u8(packet, 6);
  while (type != kTcp) {
    const std::size_t extension = extensionSize(type, payload);
    if (extension == 0 || extension > payload.size()) return std::nullopt;
    type = u8(payload, 0);
    payload.remove_prefix(extension);
    size -= extension;
  }
  return Datagram{packet.substr(8, 16), packet.substr(24, 16), type, payload, size};
}

std::optional<TcpSegment> tcp(const Datagram& datagram) {
  const std::string_view bytes = datagram.payload;
  if (datagram.protocol != kTcp || bytes.size() < 20) return std::nullopt;
  const std::size_t header = (u8(bytes, 12) >> 4) * std::size_t{4};
  if (header < 20 || header > bytes.size()) return std::nullopt;
  TcpSegment segment;
  segment.source = datagram.source;
  segment.destination = datagram.destination;
  segment.source_port = static_cast<std::uint16_t>(u16(bytes, 0));
  segment.destination_port = static_cast<std::uint16_t>(u16(bytes, 2));
  segment.sequence = u32(bytes, 4);
  segment.begins = (u8(bytes, 13) & 0x02) != 0;
  segment.payload = bytes.substr(header);
  segment.not_captured = datagram.size - bytes.size();
  return segment;
}

}  // namespace

std::optional<TcpSegment> tcpSegmentOf(std::uint32_t link_type, std::string_view packet) {
  const std::string_view ip = ipPacketOf(link_type, packet);
  if (ip.empty()) return std::nullopt;
  const unsigned version = u8(ip, 0) >> 4;
  std::optional<Datagram> datagram;
  if (version == 4) datagram = ipv4(ip);
  if (version == 6) datagram = ipv6(ip);
  return datagram ? tcp(*datagram) : std::nullopt;
}

}  // namespace frontseat_driver::capture
