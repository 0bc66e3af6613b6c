#include "frontseat_driver/nmea/framer.h"

#include <algorithm>
#include <cstring>

namespace frontseat_driver::nmea {
namespace {

const char* find(char wanted, const char* from, const char* end) {
  const void* found = std::memchr(from, wanted, static_cast<std::size_t>(end - from));
  return found ? static_cast<const char*>(found) : end;
}

/// Moves `next` to the first `wanted` at or after `from`, unless it is there already.
void seek(const char*& next, char wanted, const char* from, const char* end) {
  if (next < from) next = find(wanted, from, end);
}

std::string_view view(const char* from, const char* to) {
  return {from, static_cast<std::size_t>(to - from)};
}

}  // namespace

Framer::Scan::Scan(std::string_view chunk)
    : at(chunk.data()),
      end(chunk.data() + chunk.size()),
      next_feed(at),
      next_return(at),
      next_dollar(at) {}

std::string_view Framer::Scan::takeLineEnds() {
  const char* const from = at;
  while (atLineEnd()) ++at;
  return view(from, at);
}

/// What lies before the next line end or `$`; a `$` that it begins with belongs to it.
std::string_view Framer::Scan::takeRun() {
  const char* const from = at++;
  seek(next_feed, '\n', at, end);
  seek(next_return, '\r', at, end);
  seek(next_dollar, '$', at, end);
  at = std::min({next_feed, next_return, next_dollar});
  return view(from, at);
}

std::string_view Framer::step(Scan& scan) {
  if (scan.atLineEnd()) return endLine(scan.takeLineEnds().size());
  const bool begins = *scan.at == '$';
  if (begins) begin();
  const std::string_view run = scan.takeRun();
  counters_.bytes += run.size();
  const bool whole = begins && scan.atLineEnd() && run.size() <= kMaxLine;
  if (whole) return handOn(run);
  if (state_ == State::Sentence) {
    hold(run);
  } else {
    drop(run);
  }
  return {};
}

std::string_view Framer::endLine(std::size_t line_end_bytes) {
  counters_.bytes += line_end_bytes;
  counters_.line_end_bytes += line_end_bytes;
  if (state_ == State::Sentence) return handOn({buffer_.data(), held_});
  state_ = State::Between;
  return {};
}

std::string_view Framer::handOn(std::string_view line) {
  state_ = State::Between;
  held_ = 0;
  ++counters_.sentences;
  counters_.sentence_bytes += line.size();
  return line;
}

void Framer::begin() {
  reset();
  state_ = State::Sentence;
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
