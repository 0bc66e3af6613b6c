#include "frontseat_driver/nmea/framer.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "lines.h"

namespace frontseat_driver::nmea {
namespace {

using Lines = std::vector<std::string>;
using Counters = Framer::Counters;

struct Framed {
  Lines lines;
  Counters counters;
  std::size_t pending = 0;
};

void expectAccounted(const Framer& framer) {
  const Counters& c = framer.counters();
  EXPECT_EQ(c.bytes, c.sentence_bytes + c.line_end_bytes + c.dropped_bytes + framer.pending());
}

/// Feeds `bytes` in pieces whose sizes `next_size` gives.
template <class NextSize>
Framed frame(std::string_view bytes, NextSize next_size) {
  Framer framer;
  Framed framed;
  while (!bytes.empty()) {
    // A copy of its own, so that a sanitizer sees any look beyond the chunk.
    const std::string chunk{bytes.substr(0, next_size())};
    framer.feed(chunk, [&](std::string_view line) {
      expectAccounted(framer);
      framed.lines.emplace_back(line);
    });
    expectAccounted(framer);
    bytes.remove_prefix(chunk.size());
  }
  framed.counters = framer.counters();
  framed.pending = framer.pending();
  return framed;
}

Framed frameWhole(std::string_view bytes) {
  return frame(bytes, [&] { return bytes.size(); });
}

void expectSame(const Framed& a, const Framed& b) {
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.pending, b.pending);
  EXPECT_EQ(a.counters.bytes, b.counters.bytes);
  EXPECT_EQ(a.counters.sentences, b.counters.sentences);
  EXPECT_EQ(a.counters.sentence_bytes, b.counters.sentence_bytes);
  EXPECT_EQ(a.counters.line_end_bytes, b.counters.line_end_bytes);
  EXPECT_EQ(a.counters.cut_off, b.counters.cut_off);
  EXPECT_EQ(a.counters.noise_lines, b.counters.noise_lines);
  EXPECT_EQ(a.counters.oversized, b.counters.oversized);
  EXPECT_EQ(a.counters.dropped_bytes, b.counters.dropped_bytes);
}

void expectSameInAnyPieces(std::string_view bytes) {
  const Framed whole = frameWhole(bytes);
  expectSame(whole, frame(bytes, [] { return std::size_t{1}; }));
  std::mt19937 random{20140626};
  for (const std::size_t largest : {2U, 7U, 80U, 1500U}) {
    std::uniform_int_distribution<std::size_t> size{1, largest};
    for (int round = 0; round < 20; ++round) {
      expectSame(whole, frame(bytes, [&] { return size(random); }));
    }
  }
}

struct Stream {
  const char* name;
  std::string bytes;
  Lines lines;
  std::uint64_t line_ends, dropped, cut_off, noise, oversized;
  std::size_t pending;
};

std::string longLine(std::size_t size) { return "$" + std::string(size - 1, 'x'); }

const Stream kStreams[] = {
    {"nothing", "", {}, 0, 0, 0, 0, 0, 0},
    {"cr_lf", "$A\r\n$B\r\n", {"$A", "$B"}, 4, 0, 0, 0, 0, 0},
    {"lf", "$A\n$B\n", {"$A", "$B"}, 2, 0, 0, 0, 0, 0},
    {"cr", "$A\r$B\r", {"$A", "$B"}, 2, 0, 0, 0, 0, 0},
    {"cr_lf_lf", "$A\r\n\n$B\r\n\n", {"$A", "$B"}, 6, 0, 0, 0, 0, 0},
    {"blank_lines", "\r\n\n\r\r$A\n\n\n", {"$A"}, 8, 0, 0, 0, 0, 0},
    {"no_end_yet", "$A\r\n$BC", {"$A"}, 2, 0, 0, 0, 0, 3},
    {"dollar_alone", "$\n", {"$"}, 1, 0, 0, 0, 0, 0},
    {"noise_before_dollar", "xyz$A\n", {"$A"}, 1, 3, 0, 1, 0, 0},
    {"noise_line", "xyz\r\n$A\n", {"$A"}, 3, 3, 0, 1, 0, 0},
    {"two_noise_lines", "x\ny\n", {}, 2, 2, 0, 2, 0, 0},
    {"bytes_of_any_value",
     std::string("\0\xFF\x80$\0\xFF\n", 7),
     {std::string("$\0\xFF", 3)},
     1,
     3,
     0,
     1,
     0,
     0},
    {"dollar_inside", "$AB$C\n", {"$C"}, 1, 3, 1, 0, 0, 0},
    {"dollar_after_dollar", "$$$A\n", {"$A"}, 1, 2, 2, 0, 0, 0},
    {"noise_between_sentences", "$A\nx$B\n", {"$A", "$B"}, 2, 1, 0, 1, 0, 0},
    {"longest", longLine(1024) + "\r\n", {longLine(1024)}, 2, 0, 0, 0, 0, 0},
    {"longest_cut_off", longLine(1024) + "$A\n", {"$A"}, 1, 1024, 1, 0, 0, 0},
    {"too_long", longLine(1025) + "\r\n$A\r\n", {"$A"}, 4, 1025, 0, 0, 1, 0},
    {"too_long_up_to_dollar", longLine(5000) + "$A\r\n", {"$A"}, 2, 5000, 0, 0, 1, 0},
    {"too_long_twice", longLine(1025) + "\n" + longLine(3000) + "\n", {}, 2, 4025, 0, 0, 2, 0},
    {"too_long_without_end", longLine(1025), {}, 0, 1025, 0, 0, 1, 0},
    {"noise_is_never_oversized", std::string(5000, 'x') + "\n$A\n", {"$A"}, 2, 5000, 0, 1, 0, 0},
};

class Streams : public testing::TestWithParam<Stream> {};

TEST_P(Streams, GiveTheirLines) {
  const Stream& row = GetParam();
  const Framed framed = frameWhole(row.bytes);
  EXPECT_EQ(framed.lines, row.lines);
  EXPECT_EQ(framed.counters.bytes, row.bytes.size());
  EXPECT_EQ(framed.counters.sentences, row.lines.size());
  EXPECT_EQ(framed.counters.line_end_bytes, row.line_ends);
  EXPECT_EQ(framed.counters.dropped_bytes, row.dropped);
  EXPECT_EQ(framed.counters.cut_off, row.cut_off);
  EXPECT_EQ(framed.counters.noise_lines, row.noise);
  EXPECT_EQ(framed.counters.oversized, row.oversized);
  EXPECT_EQ(framed.pending, row.pending);
}

TEST_P(Streams, GiveTheSameInAnyPieces) { expectSameInAnyPieces(GetParam().bytes); }

INSTANTIATE_TEST_SUITE_P(Table, Streams, testing::ValuesIn(kStreams),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Framer, FindsAllLinesOfACapture) {
  const std::string bytes = test::capture("heron_2014.nmea");
  const Framed framed = frameWhole(bytes);
  ASSERT_EQ(framed.lines.size(), 14U);
  EXPECT_EQ(framed.lines.front(),
            "$CPIMU,164958.858,-0.061035,-0.000097,-0.061035,-0.026916,0.104533,-0.932172*57");
  EXPECT_EQ(framed.lines.back(),
            "$GPRMC,150216.20,A,4221.51616,N,07105.25215,W,0.021,0.00,260614,,,D*7C");
  EXPECT_EQ(framed.counters.sentence_bytes, 946U);  // 960 bytes less 14 line feeds
  EXPECT_EQ(framed.counters.dropped_bytes, 0U);
  expectSameInAnyPieces(bytes);
}

TEST(Framer, GivesTheSameFromNoiseInAnyPieces) {
  std::mt19937 random{1024};
  const char letters[] = {'$', '$', '\r', '\n', '\n', 'x', 'y', 'z', '\0', '*'};
  std::uniform_int_distribution<std::size_t> letter{0, sizeof letters - 1};
  for (int round = 0; round < 5; ++round) {
    std::string bytes;
    for (int i = 0; i < 3000; ++i) bytes += letters[letter(random)];
    bytes += longLine(2500) + bytes;
    expectSameInAnyPieces(bytes);
  }
}

TEST(Framer, HandsAWholeLineOnInPlace) {
  const std::string chunk = "$A,1\r\n$B,2\r\n$C";
  Framer framer;
  std::vector<std::ptrdiff_t> offsets;
  framer.feed(chunk, [&](std::string_view line) { offsets.push_back(line.data() - chunk.data()); });
  EXPECT_EQ(offsets, (std::vector<std::ptrdiff_t>{0, 6}));
}

TEST(Framer, SurvivesALineWithoutEnd) {
  const std::string mebibyte(1 << 20, 'x');
  Framer framer;
  Lines lines;
  const auto sink = [&](std::string_view line) { lines.emplace_back(line); };
  framer.feed("$", sink);
  for (int i = 0; i < 64; ++i) framer.feed(mebibyte, sink);
  EXPECT_EQ(framer.counters().oversized, 1U);
  EXPECT_EQ(framer.counters().dropped_bytes, (64U << 20) + 1);
  EXPECT_EQ(framer.pending(), 0U);
  framer.feed("\r\n$A\r\n", sink);
  EXPECT_EQ(lines, Lines{"$A"});
  expectAccounted(framer);
}

TEST(Framer, ForgetsABegunLineOnReset) {
  Framer framer;
  Lines lines;
  const auto sink = [&](std::string_view line) { lines.emplace_back(line); };
  framer.feed("$ABC", sink);
  EXPECT_EQ(framer.pending(), 4U);
  framer.reset();
  expectAccounted(framer);
  EXPECT_EQ(framer.pending(), 0U);
  EXPECT_EQ(framer.counters().cut_off, 1U);
  framer.feed("DE\n$F\n", sink);
  EXPECT_EQ(lines, Lines{"$F"});
  EXPECT_EQ(framer.counters().noise_lines, 1U);
}

TEST(Framer, MayBeResetByItsSink) {
  Framer framer;
  Lines lines;
  framer.feed("$A\n$B\n$C", [&](std::string_view line) {
    lines.emplace_back(line);
    framer.reset();
  });
  EXPECT_EQ(lines, (Lines{"$A", "$B"}));
  EXPECT_EQ(framer.pending(), 2U);
  expectAccounted(framer);
}

}  // namespace
}  // namespace frontseat_driver::nmea
