// From bytes to values and back without one heap allocation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "decoding.h"
#include "frontseat_driver/nmea/framer.h"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc{};
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace frontseat_driver::protocol {
namespace {

struct Tally {
  std::size_t decoded = 0;
  std::size_t refused = 0;
  std::size_t written_bytes = 0;
};

void process(std::string_view line, Tally& tally) {
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  const auto reading = sentence ? decode(*sentence) : sentence.failure();
  if (!reading) {
    ++tally.refused;
    return;
  }
  ++tally.decoded;
  const auto talker = sentence->talker();
  const auto size = [&](const auto& message) { return write(talker, message).finish()->size(); };
  tally.written_bytes += std::visit(size, reading->message);
}

/// Feeds `bytes` in chunks of `chunk_size` and expects that nothing was allocated meanwhile.
Tally processWithoutAllocation(std::string_view bytes, std::size_t chunk_size) {
  Tally tally;
  nmea::Framer framer;
  const std::size_t before = allocations;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(chunk_size, bytes.size()))) {
    framer.feed(bytes.substr(0, chunk_size), [&](std::string_view line) { process(line, tally); });
  }
  EXPECT_EQ(allocations, before);
  return tally;
}

TEST(Allocation, IsCountedHere) {
  const std::size_t before = allocations;
  ::operator delete(::operator new(1));  // unlike a new-expression never optimised away
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, IsNeverNeeded) {
  const std::string capture = test::capture("heron_2014.nmea");
  for (const std::size_t chunk_size : {capture.size(), std::size_t{50}, std::size_t{1}}) {
    const Tally tally = processWithoutAllocation(capture, chunk_size);
    EXPECT_EQ(tally.decoded, 11U);
    EXPECT_EQ(tally.refused, 3U);
    EXPECT_GT(tally.written_bytes, 700U);
  }
}

TEST(Allocation, IsNeverNeededForBadInput) {
  const std::string bytes = "noise\n$BFNVG,x,y,z*00\n" + test::framed("BFNVG,x,y,z,,,,") + "\n" +
                            test::framed("BFNVR,1,1e-300,123456789012345678901234567890") + "\n$" +
                            std::string(5000, 'x') + "\n";
  const Tally tally = processWithoutAllocation(bytes, 100);
  EXPECT_EQ(tally.decoded, 2U);
  EXPECT_EQ(tally.refused, 1U);
}

}  // namespace
}  // namespace frontseat_driver::protocol
