#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "frontseat_driver/capture/byte_source.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::capture {

/// One packet as it was captured. The bytes hold until the next one is read.
struct Packet {
  std::optional<vehicle::UtcTime> time;
  std::uint32_t link_type = 0;  ///< LINKTYPE_ number of tcpdump.org
  std::string_view bytes;       ///< may be shorter than what was on the line
};

/// The packets of a pcap or pcapng file (IETF draft-ietf-opsawg-pcap and -pcapng), one by one.
class PacketFile {
 public:
  /// Throws std::runtime_error when the source is neither.
  explicit PacketFile(std::unique_ptr<ByteSource> source);

  static bool recognizes(std::string_view first_bytes);

  std::optional<Packet> next();

  std::uint64_t bytesRead() const { return bytes_read_; }

  /// Bytes of the next packet are at hand.
  bool hasBuffered() const { return filled_ - at_ >= kBlockHeader || ended_; }

  /// The file ended inside a packet, or what follows cannot be a packet.
  bool breaksOff() const { return breaks_off_; }

 private:
  static constexpr std::size_t kBlockHeader = 16;

  struct Interface {
    std::uint32_t link_type = 0;
    std::uint8_t resolution = 6;  ///< as if_tsresol has it
    std::int64_t offset_s = 0;
  };

  bool require(std::size_t size);
  std::string_view take(std::size_t size);
  std::optional<Packet> end(bool damaged);
  std::uint16_t u16(std::string_view bytes, std::size_t at) const;
  std::uint32_t u32(std::string_view bytes, std::size_t at) const;
  void readHeader();
  std::optional<Packet> nextRecord();
  std::optional<Packet> nextBlock();
  bool beginSection();
  void addInterface(std::string_view body);
  std::optional<Packet> packetOf(std::uint32_t type, std::string_view body) const;
  std::optional<vehicle::UtcTime> timeOf(const Interface& interface, std::uint64_t count) const;

  std::unique_ptr<ByteSource> source_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;      ///< read so far
  std::size_t filled_ = 0;  ///< bytes in the buffer
  std::uint64_t bytes_read_ = 0;
  bool ended_ = false;
  bool breaks_off_ = false;
  bool big_endian_ = false;
  bool blocks_ = false;  ///< pcapng
  bool nanoseconds_ = false;
  std::uint32_t link_type_ = 0;
  std::vector<Interface> interfaces_;
};

}  // namespace frontseat_driver::capture
