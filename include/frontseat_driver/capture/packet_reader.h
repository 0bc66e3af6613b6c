#pragma once

#include <memory>
#include <string_view>

#include "frontseat_driver/capture/byte_source.h"
#include "frontseat_driver/capture/reader.h"

namespace frontseat_driver::capture {

/// A packet capture of the vehicle's TCP connections, pcap or pcapng, as tcpdump and Wireshark
/// write them: over Ethernet with or without VLAN tags, Linux "cooked", loopback, or raw IP; IPv4
/// or IPv6.
///
/// Both directions of every connection to the port are put together from their segments: what was
/// sent twice counts once, what came out of order is put in order, and what the capture lacks cuts
/// off a sentence and is counted. An entry has the time of the packet that completed it. A capture
/// that breaks off ends there.
class PacketReader : public Reader {
 public:
  /// `port` is the vehicle's. Throws std::runtime_error when the source is no packet capture.
  PacketReader(std::unique_ptr<ByteSource> source, int port);
  ~PacketReader() override;

  /// True for the first four bytes of a packet capture.
  static bool recognizes(std::string_view first_bytes);

  std::optional<Entry> next() override;
  bool ready() const override;
  ReadCounters counters() const override;

 private:
  class Conversations;
  std::unique_ptr<Conversations> conversations_;
};

}  // namespace frontseat_driver::capture
