#include "frontseat_driver/capture/packet_reader.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "chunks.h"

namespace frontseat_driver::capture {
namespace {

using namespace std::chrono_literals;
using Lines = std::vector<std::string>;

enum class Order { Little, Big };

std::string number(std::uint64_t value, int size, Order order) {
  std::string bytes;
  for (int i = 0; i < size; ++i) {
    const int shift = 8 * (order == Order::Big ? size - 1 - i : i);
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
  return bytes;
}
std::string big(std::uint64_t value, int size) { return number(value, size, Order::Big); }
std::string little(std::uint64_t value, int size) { return number(value, size, Order::Little); }
std::string zeros(std::size_t size) { return std::string(size, '\0'); }

constexpr unsigned kVehicle = 29500;
constexpr unsigned kPayload = 40000;

/// A TCP header without options, then the bytes.
std::string tcp(unsigned from, unsigned to, std::uint32_t sequence, const std::string& bytes,
                unsigned flags = 0x18) {
  return big(from, 2) + big(to, 2) + big(sequence, 4) + big(0, 4) + big(0x50, 1) + big(flags, 1) +
         big(8192, 2) + zeros(4) + bytes;
}

std::string ipv4(const std::string& payload, unsigned fragment = 0x4000) {
  return "\x45" + zeros(1) + big(20 + payload.size(), 2) + zeros(2) + big(fragment, 2) + "\x40" +
         "\x06" + zeros(2) + big(0x0A000001, 4) + big(0x0A000002, 4) + payload;
}

std::string ipv6(const std::string& payload, unsigned next = 6) {
  return "\x60" + zeros(3) + big(payload.size(), 2) + big(next, 1) + "\x40" + std::string(16, 'a') +
         std::string(16, 'b') + payload;
}

std::string ethernet(const std::string& packet, unsigned type = 0x0800) {
  return zeros(12) + big(type, 2) + packet;
}

std::string fromVehicle(std::uint32_t sequence, const std::string& bytes) {
  return ethernet(ipv4(tcp(kVehicle, kPayload, sequence, bytes)));
}
std::string toVehicle(std::uint32_t sequence, const std::string& bytes) {
  return ethernet(ipv4(tcp(kPayload, kVehicle, sequence, bytes)));
}

/// A pcap file, written byte by byte as the draft has it.
class Pcap {
 public:
  explicit Pcap(unsigned link_type = 1, Order order = Order::Little, bool nanoseconds = false)
      : order_(order), bytes_(number(nanoseconds ? 0xA1B23C4D : 0xA1B2C3D4, 4, order)) {
    bytes_ += number(2, 2, order) + number(4, 2, order) + zeros(8) + number(262144, 4, order) +
              number(link_type, 4, order);
  }

  /// `cut`: so many bytes of the packet were not captured.
  Pcap& add(const std::string& packet, unsigned seconds = 1, unsigned part = 0,
            std::size_t cut = 0) {
    const std::size_t size = packet.size() - cut;
    bytes_ += number(seconds, 4, order_) + number(part, 4, order_) + number(size, 4, order_) +
              number(packet.size(), 4, order_) + packet.substr(0, size);
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  Order order_;
  std::string bytes_;
};

PacketReader readerOf(const std::string& bytes, std::size_t pieces = 1 << 20) {
  return PacketReader{std::make_unique<Pieces>(bytes, pieces), static_cast<int>(kVehicle)};
}

Lines read(const std::string& bytes) {
  PacketReader reader = readerOf(bytes);
  return linesOf(reader);
}

const std::string kA = "$A,111*00\r\n";
const std::string kB = "$B,222*00\r\n";
const std::string kC = "$C,333*00\r\n";
const Lines kAbc{"$A,111*00", "$B,222*00", "$C,333*00"};

TEST(PacketReader, TellsTimeAndDirection) {
  Pcap pcap;
  pcap.add(fromVehicle(100, kA), 1416410000, 123456).add(toVehicle(7, kB), 1416410001, 0);
  PacketReader reader = readerOf(pcap.bytes());
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->line, "$A,111*00");
  EXPECT_EQ(first->direction, Direction::FromVehicle);
  EXPECT_EQ(first->time, 1'416'410'000s + 123456us);
  const auto second = reader.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->line, "$B,222*00");
  EXPECT_EQ(second->direction, Direction::ToVehicle);
  EXPECT_EQ(second->time, 1'416'410'001s);
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.counters().breaks_off);
}

TEST(PacketReader, GivesALineTheTimeOfThePacketThatEndsIt) {
  Pcap pcap;
  pcap.add(fromVehicle(0, "$A,1"), 1)
      .add(fromVehicle(4, "11*00\r\n$B"), 2)
      .add(fromVehicle(13, ",222*00\r\n"), 3);
  PacketReader reader = readerOf(pcap.bytes());
  EXPECT_EQ(reader.next()->time, vehicle::UtcTime{2s});
  EXPECT_EQ(reader.next()->time, vehicle::UtcTime{3s});
}

TEST(PacketReader, TakesOnlyThePort) {
  Pcap pcap;
  pcap.add(ethernet(ipv4(tcp(80, kPayload, 0, kA)))).add(fromVehicle(0, kB));
  EXPECT_EQ(read(pcap.bytes()), Lines{"$B,222*00"});
}

struct Wrapped {
  const char* name;
  std::string file;
};

std::string onLine(unsigned link_type, const std::string& packet) {
  return Pcap{link_type}.add(packet).bytes();
}

const std::string kV4 = ipv4(tcp(kVehicle, kPayload, 0, kA));
const std::string kV6 = ipv6(tcp(kVehicle, kPayload, 0, kA));

std::string block(std::uint32_t type, std::string body, Order order) {
  body.resize((body.size() + 3) / 4 * 4);
  const std::string size = number(body.size() + 12, 4, order);
  return number(type, 4, order) + size + body + size;
}

std::string section(Order order) {
  return block(
      0x0A0D0D0A,
      number(0x1A2B3C4D, 4, order) + number(1, 2, order) + zeros(2) + std::string(8, '\xFF'),
      order);
}

std::string interface(unsigned link_type, Order order, const std::string& options = {}) {
  return block(1, number(link_type, 2, order) + zeros(2) + number(0, 4, order) + options, order);
}

/// `resolution` as the option if_tsresol has it: 10^-n s, with the top bit set 2^-n s.
std::string withResolution(unsigned resolution, std::int64_t offset_s = 0) {
  return interface(1, Order::Little,
                   little(9, 2) + little(1, 2) + little(resolution, 4) + little(14, 2) +
                       little(8, 2) + little(static_cast<std::uint64_t>(offset_s), 8));
}

std::string enhanced(const std::string& packet, std::uint64_t time, Order order,
                     unsigned of_interface = 0) {
  return block(6,
               number(of_interface, 4, order) + number(time >> 32, 4, order) +
                   number(time & 0xFFFFFFFF, 4, order) + number(packet.size(), 4, order) +
                   number(packet.size(), 4, order) + packet,
               order);
}

std::string simple(const std::string& packet, Order order) {
  return block(3, number(packet.size(), 4, order) + packet, order);
}

std::string ng(Order order, const std::string& rest) { return section(order) + rest; }

const Wrapped kWrapped[] = {
    {"ethernet", onLine(1, ethernet(kV4))},
    {"ethernet_ipv6", onLine(1, ethernet(kV6, 0x86DD))},
    {"vlan", onLine(1, zeros(12) + big(0x8100, 2) + big(7, 2) + big(0x0800, 2) + kV4)},
    {"two_vlans", onLine(1, zeros(12) + big(0x88A8, 2) + big(7, 2) + big(0x8100, 2) + big(8, 2) +
                                big(0x86DD, 2) + kV6)},
    {"vlan_of_an_older_switch",
     onLine(1, zeros(12) + big(0x9100, 2) + big(7, 2) + big(0x0800, 2) + kV4)},
    {"padding_behind_the_packet", onLine(1, ethernet(kV4) + zeros(6))},
    {"cooked", onLine(113, zeros(14) + big(0x0800, 2) + kV4)},
    {"cooked_2", onLine(276, big(0x86DD, 2) + zeros(18) + kV6)},
    {"loopback", onLine(0, little(2, 4) + kV4)},
    {"loopback_ipv6", onLine(0, little(30, 4) + kV6)},
    {"loop", onLine(108, big(2, 4) + kV4)},
    {"raw", onLine(101, kV4)},
    {"raw_ipv6", onLine(101, kV6)},
    {"raw_bsd", onLine(12, kV4)},
    {"raw_openbsd", onLine(14, kV4)},
    {"ipv4", onLine(228, kV4)},
    {"ipv6", onLine(229, kV6)},
    {"ipv6_with_extensions",
     onLine(101, ipv6("\x3C" + zeros(7) + "\x06" + zeros(7) + tcp(kVehicle, kPayload, 0, kA), 0))},
    {"ipv6_with_authentication",
     onLine(101, ipv6("\x06\x04" + zeros(22) + tcp(kVehicle, kPayload, 0, kA), 51))},
    {"ipv6_with_routing",
     onLine(101, ipv6("\x06" + zeros(7) + tcp(kVehicle, kPayload, 0, kA), 43))},
    {"ipv6_without_length", onLine(101, std::string(kV6).replace(4, 2, zeros(2)))},
    {"no_length_from_the_card", onLine(101, std::string(kV4).replace(2, 2, zeros(2)))},
    {"big_endian", Pcap{1, Order::Big}.add(ethernet(kV4)).bytes()},
    {"nanoseconds", Pcap{1, Order::Little, true}.add(ethernet(kV4)).bytes()},
    {"pcapng", ng(Order::Little,
                  interface(1, Order::Little) + enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_big_endian",
     ng(Order::Big, interface(1, Order::Big) + enhanced(ethernet(kV4), 1'000'000, Order::Big))},
    {"pcapng_other_blocks",
     ng(Order::Little, block(10, "secrets", Order::Little) + interface(1, Order::Little) +
                           block(5, "statistics", Order::Little) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_nanoseconds",
     ng(Order::Little, interface(1, Order::Little, little(9, 2) + little(1, 2) + little(9, 4)) +
                           enhanced(ethernet(kV4), 1'000'000'000, Order::Little))},
    {"pcapng_picoseconds",
     ng(Order::Little,
        withResolution(12) + enhanced(ethernet(kV4), 1'000'000'000'000, Order::Little))},
    {"pcapng_whole_seconds",
     ng(Order::Little, withResolution(0) + enhanced(ethernet(kV4), 1, Order::Little))},
    {"pcapng_resolution_behind_the_last_option",
     ng(Order::Little,
        interface(1, Order::Little, little(0, 4) + little(9, 2) + little(1, 2) + little(9, 4)) +
            enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_resolution_and_offset_of_another_length",
     ng(Order::Little, interface(1, Order::Little,
                                 little(9, 2) + little(2, 2) + little(9, 4) + little(14, 2) +
                                     little(4, 2) + little(9, 4)) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_option_longer_than_its_block",
     ng(Order::Little, interface(1, Order::Little, little(9, 2) + little(400, 2)) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_old_packet_block",
     ng(Order::Little,
        interface(1, Order::Little) + block(2,
                                            little(0, 4) + little(0, 4) + little(1'000'000, 4) +
                                                little(ethernet(kV4).size(), 4) +
                                                little(ethernet(kV4).size(), 4) + ethernet(kV4),
                                            Order::Little))},
    {"pcapng_interface_that_nobody_told_of",
     ng(Order::Little, interface(1, Order::Little) +
                           enhanced(ethernet(kV4), 9'000'000, Order::Little, 1) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_interface_block_too_short",
     ng(Order::Little, block(1, "abc", Order::Little) + interface(1, Order::Little) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_packet_block_too_short",
     ng(Order::Little, interface(1, Order::Little) + block(6, zeros(16), Order::Little) +
                           enhanced(ethernet(kV4), 1'000'000, Order::Little))},
    {"pcapng_binary_fractions",
     ng(Order::Little, interface(1, Order::Little, little(9, 2) + little(1, 2) + little(0x8A, 4)) +
                           enhanced(ethernet(kV4), 1024, Order::Little))},
    {"pcapng_offset",
     ng(Order::Little, interface(1, Order::Little, little(14, 2) + little(8, 2) + little(1, 8)) +
                           enhanced(ethernet(kV4), 0, Order::Little))},
    {"pcapng_second_interface",
     ng(Order::Little, interface(147, Order::Little) + interface(101, Order::Little) +
                           enhanced(kV4, 1'000'000, Order::Little, 1))},
    {"pcapng_two_sections",
     ng(Order::Little, interface(147, Order::Little) +
                           ng(Order::Big, interface(1, Order::Big) +
                                              enhanced(ethernet(kV4), 1'000'000, Order::Big)))},
};

class Line : public testing::TestWithParam<Wrapped> {};

TEST_P(Line, IsUnpackedInPiecesOfAnySize) {
  for (const std::size_t pieces : {1U, 5U, 1U << 20U}) {
    PacketReader reader = readerOf(GetParam().file, pieces);
    const auto entry = reader.next();
    ASSERT_TRUE(entry) << pieces;
    EXPECT_EQ(entry->line, "$A,111*00");
    EXPECT_EQ(entry->time, vehicle::UtcTime{1s});
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.counters().breaks_off);
  }
}

TEST_P(Line, MayBreakOffAnywhere) {
  for (std::size_t size = 4; size < GetParam().file.size(); ++size) {
    PacketReader reader = readerOf(GetParam().file.substr(0, size));
    while (reader.next()) continue;
    EXPECT_LE(reader.counters().bytes, size);
  }
}

TEST_P(Line, MayHoldAnyByteAnywhere) {
  for (std::size_t at = 4; at < GetParam().file.size(); ++at) {
    for (const char value : {'\x00', '\x01', '\x7F', '\xFF'}) {
      std::string file = GetParam().file;
      file[at] = value;
      PacketReader reader = readerOf(file);
      while (reader.next()) continue;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Line, testing::ValuesIn(kWrapped),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(PacketReader, GivesNoTimeWhereABlockHasNone) {
  PacketReader reader = readerOf(
      ng(Order::Little, interface(1, Order::Little) + simple(ethernet(kV4), Order::Little)));
  const auto entry = reader.next();
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->time, std::nullopt);
}

struct Untimed {
  const char* name;
  unsigned resolution;
  std::int64_t offset_s;
  std::uint64_t count;
};

const Untimed kUntimed[] = {{"finer_than_64_bits", 20, 0, 1},
                            {"finer_than_64_binary_digits", 0x80 | 64, 0, 1},
                            {"later_than_nanoseconds_count", 0, 0, 9'000'000'001},
                            {"later_by_its_offset", 0, 8'000'000'000, 8'000'000'000},
                            {"before_1970", 0, -2, 1},
                            {"offset_far_ahead", 0, 9'000'000'000, 1},
                            {"offset_far_back", 0, -9'000'000'000, 1}};

class NoTime : public testing::TestWithParam<Untimed> {};

TEST_P(NoTime, IsTheirsAndTheirLinesAreRead) {
  PacketReader reader =
      readerOf(ng(Order::Little, withResolution(GetParam().resolution, GetParam().offset_s) +
                                     enhanced(ethernet(kV4), GetParam().count, Order::Little)));
  const auto entry = reader.next();
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->line, "$A,111*00");
  EXPECT_EQ(entry->time, std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(Table, NoTime, testing::ValuesIn(kUntimed),
                         [](const auto& row) { return std::string{row.param.name}; });

const Wrapped kNotOurs[] = {
    {"radio", onLine(147, ethernet(kV4))},
    {"arp", onLine(1, ethernet(kV4, 0x0806))},
    {"five_vlans", onLine(1, zeros(12) + big(0x8100, 2) + big(7, 2) + big(0x8100, 2) + big(7, 2) +
                                 big(0x8100, 2) + big(7, 2) + big(0x8100, 2) + big(7, 2) +
                                 big(0x8100, 2) + big(7, 2) + big(0x0800, 2) + kV4)},
    {"vlan_without_packet", onLine(1, zeros(12) + big(0x8100, 2) + zeros(1))},
    {"ip_version_5", onLine(101, std::string(kV4).replace(0, 1, "\x55"))},
    {"ip_header_of_four_words", onLine(101, std::string(kV4).replace(0, 1, "\x44"))},
    {"ip_header_longer_than_the_packet", onLine(101, "\x4F" + kV4.substr(1, 49))},
    {"ip_shorter_than_its_header", onLine(101, std::string(kV4).replace(2, 2, big(19, 2)))},
    {"ip_cut_off", onLine(101, kV4.substr(0, 19))},
    {"udp", onLine(101, std::string(kV4).replace(9, 1, "\x11"))},
    {"tcp_header_of_four_words", onLine(101, std::string(kV4).replace(32, 1, "\x40"))},
    {"tcp_header_longer_than_the_segment", onLine(101, std::string(kV4).replace(32, 1, "\xF0"))},
    {"tcp_cut_off", onLine(101, kV4.substr(0, 39))},
    {"ipv6_udp", onLine(101, ipv6(tcp(kVehicle, kPayload, 0, kA), 17))},
    {"ipv6_cut_off", onLine(101, kV6.substr(0, 39))},
    {"ipv6_extension_cut_off", onLine(101, ipv6("\x06", 0))},
    {"ipv6_extension_longer_than_the_packet", onLine(101, ipv6("\x06\xFF" + zeros(6), 0))},
    {"loopback_family_alone", onLine(0, little(2, 4))}};

class NotOurs : public testing::TestWithParam<Wrapped> {};

TEST_P(NotOurs, IsPassedOver) {
  PacketReader reader = readerOf(GetParam().file);
  EXPECT_EQ(linesOf(reader), Lines{});
  EXPECT_FALSE(reader.counters().breaks_off);
  EXPECT_EQ(reader.counters().bytes, GetParam().file.size());
}

INSTANTIATE_TEST_SUITE_P(Table, NotOurs, testing::ValuesIn(kNotOurs),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(PacketReader, KeepsNoMoreInterfacesThanAnyCaptureHas) {
  std::string interfaces;
  for (int i = 0; i < 257; ++i) interfaces += interface(1, Order::Little);
  EXPECT_EQ(
      read(ng(Order::Little, interfaces + enhanced(ethernet(kV4), 1'000'000, Order::Little, 256) +
                                 enhanced(ethernet(kV4), 1'000'000, Order::Little, 255))),
      Lines{"$A,111*00"});
}

struct Segments {
  const char* name;
  std::vector<std::string> packets;
  Lines lines;
  std::uint64_t sent_again = 0;
  std::uint64_t missing = 0;
};

std::string syn(std::uint32_t sequence) {
  return ethernet(ipv4(tcp(kVehicle, kPayload, sequence, "", 0x02)));
}

// Each of kA, kB, kC is 11 bytes long.
const Segments kSegments[] = {
    {"in_order", {fromVehicle(0, kA), fromVehicle(11, kB), fromVehicle(22, kC)}, kAbc},
    {"sent_twice", {fromVehicle(0, kA), fromVehicle(0, kA), fromVehicle(11, kB + kC)}, kAbc, 11},
    {"overlap",
     {fromVehicle(0, kA), fromVehicle(6, kA.substr(6) + kB), fromVehicle(22, kC)},
     kAbc,
     5},
    {"out_of_order", {fromVehicle(0, kA), fromVehicle(22, kC), fromVehicle(11, kB)}, kAbc},
    {"backwards",
     {fromVehicle(0, "$"), fromVehicle(22, kC), fromVehicle(11, kB), fromVehicle(1, kA.substr(1))},
     kAbc},
    {"out_of_order_and_twice",
     {fromVehicle(0, kA), fromVehicle(22, kC), fromVehicle(22, kC), fromVehicle(11, kB)},
     kAbc,
     11},
    {"gap_to_the_end", {fromVehicle(0, kA), fromVehicle(22, kC)}, {kAbc[0], kAbc[2]}, 0, 11},
    {"gap_inside_a_sentence",
     {fromVehicle(0, kA + "$B,2"), fromVehicle(18, "*00\r\n" + kC)},
     {kAbc[0], kAbc[2]},
     0,
     3},
    {"sequence_wraps",
     {fromVehicle(0xFFFFFFFB, kA), fromVehicle(6, kB), fromVehicle(17, kC)},
     kAbc},
    {"out_of_order_where_it_wraps",
     {fromVehicle(0xFFFFFFFB, kA), fromVehicle(17, kC), fromVehicle(6, kB)},
     kAbc},
    {"keep_alive", {fromVehicle(0, kA), fromVehicle(10, "\n"), fromVehicle(11, kB + kC)}, kAbc, 1},
    {"acknowledgements_alone",
     {fromVehicle(0, kA), fromVehicle(11, ""), fromVehicle(11, kB + kC)},
     kAbc},
    {"connects_again",
     {syn(4), fromVehicle(5, kA + "$cut"), syn(900), fromVehicle(901, kB), fromVehicle(912, kC)},
     kAbc},
    {"syn_sent_again", {syn(4), fromVehicle(5, kA), syn(4), fromVehicle(16, kB + kC)}, kAbc},
    {"first_packet_comes_second",
     {syn(4), fromVehicle(16, kB), fromVehicle(5, kA), fromVehicle(27, kC)},
     kAbc},
    {"connects_again_without_syn", {fromVehicle(5, kA), fromVehicle(900'000'000, kB + kC)}, kAbc},
    {"fragment",
     {ethernet(ipv4(tcp(kVehicle, kPayload, 0, kA), 0x2000)), fromVehicle(11, kB)},
     {kAbc[1]}},
};

class Stream : public testing::TestWithParam<Segments> {};

TEST_P(Stream, IsPutTogether) {
  Pcap pcap;
  for (const std::string& packet : GetParam().packets) pcap.add(packet);
  PacketReader reader = readerOf(pcap.bytes());
  EXPECT_EQ(linesOf(reader), GetParam().lines);
  EXPECT_EQ(reader.counters().sent_again, GetParam().sent_again);
  EXPECT_EQ(reader.counters().missing, GetParam().missing);
}

INSTANTIATE_TEST_SUITE_P(Table, Stream, testing::ValuesIn(kSegments),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(PacketReader, CountsWhatWasNotCaptured) {
  Pcap pcap;
  pcap.add(fromVehicle(0, kA + kB), 1, 0, 5).add(fromVehicle(22, kC));
  PacketReader reader = readerOf(pcap.bytes());
  EXPECT_EQ(linesOf(reader), (Lines{kAbc[0], kAbc[2]}));
  EXPECT_EQ(reader.counters().missing, 5U);
}

TEST(PacketReader, GivesAGapUpAfterTenSeconds) {
  Pcap pcap;
  pcap.add(fromVehicle(0, kA), 1)
      .add(fromVehicle(22, kC), 2)
      .add(fromVehicle(33, kC), 12)
      .add(fromVehicle(44, kC), 13);
  PacketReader reader = readerOf(pcap.bytes());
  EXPECT_EQ(reader.next()->line, kAbc[0]);
  const auto after = reader.next();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->time, vehicle::UtcTime{2s});
  EXPECT_EQ(linesOf(reader).size(), 2U);
  EXPECT_EQ(reader.counters().missing, 11U);
}

TEST(PacketReader, KeepsNoMoreThanItMustBehindAGap) {
  Pcap pcap;
  pcap.add(fromVehicle(0, kA));
  constexpr int kPackets = 3000;
  for (int i = 0; i < kPackets; ++i) {
    pcap.add(fromVehicle(22 + 11 * static_cast<std::uint32_t>(i), kC));
  }
  PacketReader reader = readerOf(pcap.bytes());
  EXPECT_EQ(linesOf(reader).size(), 1U + kPackets);
  EXPECT_EQ(reader.counters().missing, 11U);
}

TEST(PacketReader, SurvivesMoreConnectionsThanItKeeps) {
  Pcap pcap;
  for (unsigned port = 1; port <= 1000; ++port) {
    pcap.add(ethernet(ipv4(tcp(kVehicle, port, 0, kA + "$left"))));
  }
  EXPECT_EQ(read(pcap.bytes()).size(), 1000U);
}

TEST(PacketReader, SaysThatTheFileBreaksOff) {
  const std::string whole = Pcap{}.add(fromVehicle(0, kA)).add(fromVehicle(11, kB)).bytes();
  PacketReader reader = readerOf(whole.substr(0, whole.size() - 1));
  EXPECT_EQ(linesOf(reader), Lines{kAbc[0]});
  EXPECT_TRUE(reader.counters().breaks_off);
}

TEST(PacketReader, EndsAtAPacketThatCannotBe) {
  std::string file = Pcap{}.add(fromVehicle(0, kA)).bytes();
  file += zeros(8) + "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF" + std::string(100, 'x');
  PacketReader reader = readerOf(file);
  EXPECT_EQ(linesOf(reader), Lines{kAbc[0]});
  EXPECT_TRUE(reader.counters().breaks_off);
}

TEST(PacketReader, RefusesWhatIsNoCapture) {
  EXPECT_THROW(readerOf("$A*00\n$B*00\n"), std::runtime_error);
  EXPECT_THROW(readerOf(""), std::runtime_error);
  EXPECT_FALSE(PacketReader::recognizes("$BFN"));
  EXPECT_FALSE(PacketReader::recognizes(""));
}

}  // namespace
}  // namespace frontseat_driver::capture
