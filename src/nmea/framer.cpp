#include "frontseat_driver/nmea/framer.h"

#include <cstring>

#include "bytes.h"

namespace frontseat_driver::nmea {
namespace {

/// The first line end or `$` from `at` on.
const char* nextStop(const char* at, const char* end) {
  const auto stops = [](Bytes text) {
    return bitsOf((text == '\r') | (text == '\n') | (text == '$'));
  };
  for (; end - at >= kWidth; at += kWidth) {
    if (const std::uint64_t found = stops(load(at)); found != 0) return at + __builtin_ctzll(found);
  }
  const std::uint64_t found = stops(loadFirst(at, end, ' '));
  return found != 0 ? at + __builtin_ctzll(found) : end;
}

}  // namespace

inline std::size_t Framer::Scan::takeLineEnds() {
  const char* const from = at;
  while (atLineEnd()) ++at;
  return static_cast<std::size_t>(at - from);
}

/// What lies before the next line end or `$`; a `$` that it begins with belongs to it.
inline std::string_view Framer::Scan::takeRun() {
  const char* const from = at;
  at = nextStop(at + 1, end);
  return {from, static_cast<std::size_t>(at - from)};
}

inline void Framer::countLineEnd(std::size_t bytes) {
  counters_.bytes += bytes;
  counters_.line_end_bytes += bytes;
}

inline std::string_view Framer::handOn(std::string_view line, std::size_t line_end_bytes) {
  countLineEnd(line_end_bytes);
  state_ = State::Between;
  held_ = 0;
  ++counters_.sentences;
  counters_.sentence_bytes += line.size();
  return line;
}

inline void Framer::begin() {
  reset();
  state_ = State::Sentence;
}

std::string_view Framer::step(Scan& scan) {
  if (scan.atLineEnd()) return endLine(scan.takeLineEnds());
  const bool begins = *scan.at == '$';
  if (begins) begin();
  const std::string_view run = scan.takeRun();
  counters_.bytes += run.size();
  const bool whole = begins && scan.atLineEnd() && run.size() <= kMaxLine;
  if (whole) return handOn(run, scan.takeLineEnds());
  if (state_ == State::Sentence) {
    hold(run);
  } else {
    drop(run);
  }
  return {};
}

std::string_view Framer::endLine(std::size_t line_end_bytes) {
  if (state_ == State::Sentence) return handOn({buffer_.data(), held_}, line_end_bytes);
  countLineEnd(line_end_bytes);
  state_ = State::Between;
  return {};
}

void Framer::reset() {
  if (state_ == State::Sentence) ++counters_.cut_off;
  counters_.dropped_bytes += held_;
  held_ = 0;
  state_ = State::Between;
}

void Framer::hold(std::string_view run) {
  if (run.size() > kMaxLine - held_) {
    ++counters_.oversized;
    counters_.dropped_bytes += held_ + run.size();
    held_ = 0;
    state_ = State::Oversized;
    return;
  }
  std::memcpy(buffer_.data() + held_, run.data(), run.size());
  held_ += run.size();
}

void Framer::drop(std::string_view run) {
  counters_.dropped_bytes += run.size();
  if (state_ != State::Between) return;
  ++counters_.noise_lines;
  state_ = State::Noise;
}

}  // namespace frontseat_driver::nmea
