#include "ledger.h"

#include "written.h"

namespace frontseat_driver::closed_loop {

namespace {

constexpr std::size_t kLongest = 1024;

}  // namespace

void Ledger::arrives(std::string_view bytes) {
  bytes_ += bytes.size();
  for (const char byte : bytes) take(byte);
}

void Ledger::take(char byte) {
  if (byte == '\r' || byte == '\n') {
    ++line_ends_;
    return endLine();
  }
  if (byte == '$') {
    cutOff();
    line_ = '$';
    state_ = State::Line;
  } else if (state_ == State::Line) {
    line_ += byte;
    if (line_.size() <= kLongest) return;
    ++oversized_;
    line_.clear();
    state_ = State::Oversized;
  } else if (state_ == State::Between) {
    ++no_lines_;
    state_ = State::Noise;
  }
}

void Ledger::endLine() {
  if (state_ == State::Line) {
    ++lines_;
    if (isSound(line_)) {
      ++sound_;
      sound_bytes_ += line_.size();
    }
    unheard_.push_back(line_);
    line_.clear();
  }
  state_ = State::Between;
}

void Ledger::cutOff() {
  if (state_ == State::Line) ++no_lines_;
  line_.clear();
  state_ = State::Between;
}

void Ledger::connectionEnded() { cutOff(); }

bool Ledger::heard(std::string_view line) {
  if (unheard_.empty() || unheard_.front() != line) return false;
  unheard_.pop_front();
  return true;
}

const char* Ledger::complaint(const session::NmeaCounters& counters) const {
  if (!unheard_.empty()) return "a sentence was lost";
  if (counters.bytes_received != bytes_) return "bytes_received is wrong";
  if (counters.sentences_received != lines_) return "sentences_received is wrong";
  if (counters.oversized != oversized_) return "oversized is wrong";
  if (counters.no_sentences != no_lines_) return "no_sentences is wrong";
  if (counters.pending_bytes != line_.size()) return "pending_bytes is wrong";
  if (counters.line_end_bytes != line_ends_) return "line_end_bytes is wrong";
  const std::uint64_t known = counters.decoded_bytes + counters.refused_bytes;
  if (known + line_ends_ + line_.size() != bytes_) return "a byte was counted nowhere";
  if (counters.decoded_bytes > sound_bytes_) return "decoded_bytes is wrong";
  // What is spoilt may have the right checksum by chance and still be no sentence.
  const std::uint64_t read = counters.decoded + counters.unknown;
  if (read > sound_) return "decoded or unknown is wrong";
  const std::uint64_t refused = counters.bad_checksums + counters.bad_frames;
  if (refused + read != lines_ + no_lines_) return "a sentence was counted nowhere, or twice";
  return nullptr;
}

}  // namespace frontseat_driver::closed_loop
