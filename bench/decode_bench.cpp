// From bytes to structs: this project's decoder beside what it is measured against.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "allocations.h"
#include "baselines.h"
#include "frontseat_driver/nmea/framer.h"
#include "frontseat_driver/protocol/message.h"
#include "mix.h"

namespace frontseat_driver::bench {
namespace {

/// What one read of a socket brings when sentences come fast.
constexpr std::size_t kRead = 4096;
constexpr std::size_t kSentences = 100'000;

std::size_t decoder(std::string_view bytes) {
  std::size_t decoded = 0;
  nmea::Framer framer;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kRead, bytes.size()))) {
    framer.feed(bytes.substr(0, kRead), [&](std::string_view line) {
      const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
      if (!sentence) return;
      const auto reading = protocol::decode(*sentence);
      decoded += reading ? 1 : 0;
      benchmark::DoNotOptimize(&reading);
      benchmark::ClobberMemory();
    });
  }
  return decoded;
}

std::size_t framing(std::string_view bytes) {
  std::size_t lines = 0;
  nmea::Framer framer;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kRead, bytes.size()))) {
    framer.feed(bytes.substr(0, kRead), [&](std::string_view line) {
      benchmark::DoNotOptimize(line);
      ++lines;
    });
  }
  return lines;
}

std::size_t framingAndChecking(std::string_view bytes) {
  std::size_t good = 0;
  nmea::Framer framer;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kRead, bytes.size()))) {
    framer.feed(bytes.substr(0, kRead), [&](std::string_view line) {
      good += nmea::parseSentence(line, nmea::ChecksumRule::Required) ? 1 : 0;
    });
  }
  return good;
}

/// Nanoseconds, heap allocations and bytes of one sentence.
void measure(benchmark::State& state, std::size_t (*run)(std::string_view), const Sample& sample) {
  const std::size_t before = allocations();
  for (auto _ : state) {
    if (run(sample.bytes) != sample.sentences) state.SkipWithError("a sentence was not taken");
  }
  const auto sentences = static_cast<double>(state.iterations()) * double(sample.sentences);
  state.counters["ns"] = benchmark::Counter(
      sentences * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["allocations"] = static_cast<double>(allocations() - before) / sentences;
  state.counters["bytes"] = sample.bytesEach();
}

void add(const std::string& name, std::size_t (*run)(std::string_view), const Sample& sample) {
  benchmark::RegisterBenchmark(name.c_str(), measure, run, sample)->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool kAdded = [] {
  const Sample mix = vehicleMix(kSentences);
  add("decode/line_ends", lineEnds, mix);
  add("decode/byte_wise_checksum", byteWiseChecksum, mix);
  add("decode/framer", framing, mix);
  add("decode/framer_and_checksum", framingAndChecking, mix);
  add("decode/this_decoder", decoder, mix);
  add("decode/strtod", strtodDecoder, mix);
  add("decode/istringstream", streamDecoder, vehicleMix(kSentences / 5));
  for (const std::string_view type : types()) {
    add("decode/this_decoder/" + std::string{type}, decoder, onlyOf(type, kSentences / 5));
  }
  return true;
}();

}  // namespace
}  // namespace frontseat_driver::bench
