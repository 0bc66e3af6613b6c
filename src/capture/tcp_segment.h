#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace frontseat_driver::capture {

/// What one packet carries of a TCP connection. Views into the packet.
struct TcpSegment {
  std::string_view source, destination;  ///< addresses, 4 or 16 bytes
  std::uint16_t source_port = 0, destination_port = 0;
  std::uint32_t sequence = 0;
  bool begins = false;  ///< SYN
  std::string_view payload;
  std::size_t not_captured = 0;  ///< bytes of the payload that follow, on the line only
};

/// Nothing for a packet that is no TCP, a fragment, cut off in its headers, or of a kind of line
/// that is not known.
std::optional<TcpSegment> tcpSegmentOf(std::uint32_t link_type, std::string_view packet);

}  // namespace frontseat_driver::capture
