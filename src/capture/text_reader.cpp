#include "frontseat_driver/capture/text_reader.h"

#include <cstring>
#include <functional>

namespace frontseat_driver::capture {
namespace {

/// One after the last line end in [from, to), or `from` if there is none.
const char* afterLastLineEnd(const char* from, const char* to) {
  while (to != from && to[-1] != '\n' && to[-1] != '\r') --to;
  return to;
}

}  // namespace

// One byte more than a chunk, for the line end that the last line may lack.
TextReader::TextReader(std::unique_ptr<ByteSource> source)
    : source_(std::move(source)), buffer_(kChunk + 1) {}

std::optional<Entry> TextReader::next() {
  while (at_ != lines_.size() || refill()) {
    const std::string_view line = lines_[at_++];
    const std::string_view before = textBefore(line);
    if (before.empty()) return Entry{std::nullopt, std::nullopt, line};
    ++prefixed_;
    const LinePrefix prefix = readPrefix(before);
    if (!prefix.comment) return Entry{prefix.time, prefix.direction, line};
  }
  return std::nullopt;
}

ReadCounters TextReader::counters() const {
  const nmea::Framer::Counters& framed = framer_.counters();
  const std::uint64_t others = framed.noise_lines - std::min(framed.noise_lines, prefixed_);
  return {bytes_, framed.oversized, framed.cut_off, others};
}

/// Reads until there is a line. The framer is fed up to a line end, so that lines lie whole in the
/// buffer with the text in front of them; only a line that fills the buffer is fed in pieces.
bool TextReader::refill() {
  lines_.clear();
  at_ = 0;
  while (lines_.empty() && !ended_) {
    std::memmove(buffer_.data(), buffer_.data() + fed_, filled_ - fed_);
    filled_ -= fed_;
    fed_ = 0;
    const std::size_t count = source_->read(buffer_.data() + filled_, kChunk - filled_);
    const char* const fresh = buffer_.data() + filled_;
    bytes_ += count;
    filled_ += count;
    ended_ = count == 0;
    if (ended_) buffer_[filled_++] = '\n';
    const char* const end = afterLastLineEnd(fresh, buffer_.data() + filled_);
    if (end != fresh) {
      feed(static_cast<std::size_t>(end - buffer_.data()));
    } else if (filled_ == kChunk) {
      feed(filled_);
    }
  }
  return !lines_.empty();
}

void TextReader::feed(std::size_t size) {
  fed_ = size;
  framer_.feed({buffer_.data(), size}, [this](std::string_view line) { keep(line); });
}

/// A line that was fed in pieces lies in the framer, which may need the room: it is copied. There
/// is at most one, the first of a buffer.
void TextReader::keep(std::string_view line) {
  const std::less<const char*> before;
  const bool in_place =
      !before(line.data(), buffer_.data()) && before(line.data(), buffer_.data() + buffer_.size());
  if (in_place) return lines_.push_back(line);
  std::memcpy(carried_.data(), line.data(), line.size());
  lines_.emplace_back(carried_.data(), line.size());
}

/// What stands between the line end before a line and its `$`.
std::string_view TextReader::textBefore(std::string_view line) const {
  if (line.data() == carried_.data()) return {};
  const char* const from = afterLastLineEnd(buffer_.data(), line.data());
  return {from, static_cast<std::size_t>(line.data() - from)};
}

}  // namespace frontseat_driver::capture
