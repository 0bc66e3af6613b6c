#include "tcp_stream.h"

#include <algorithm>

namespace frontseat_driver::capture {
namespace {

/// How far `a` is ahead of `b`; the numbers go on at 0 after 2^32.
std::int32_t ahead(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b); }

// A larger step forward or back than any window of an ordinary connection is another connection.
constexpr std::int32_t kOtherConnection = 16 << 20;

}  // namespace

void TcpStream::add(const TcpSegment& segment, Time time, const Sink& sink) {
  if (segment.begins) {
    if (first_ == segment.sequence + 1) return;
    finish(sink);
    begin(segment.sequence + 1);
    return;
  }
  if (segment.payload.empty() && segment.not_captured == 0) return;
  const bool other =
      next_ && std::abs(std::int64_t{ahead(segment.sequence, *next_)}) > kOtherConnection;
  if (other) finish(sink);
  if (other || !next_) begin(segment.sequence);
  if (ahead(segment.sequence, *next_) > 0) {
    keep(segment, time);
  } else {
    take(segment.sequence, segment.payload, segment.not_captured, time, sink);
    takeWaiting(sink);
  }
  while (!waiting_.empty() && isGivenUp(time)) skipGap(sink);
}

void TcpStream::finish(const Sink& sink) {
  while (!waiting_.empty()) skipGap(sink);
}

bool TcpStream::isGivenUp(const Time& now) const {
  if (waiting_bytes_ > kMostWaiting || waiting_.size() > kMostSegments) return true;
  return now && waiting_since_ && *now - *waiting_since_ > kLongestWait;
}

void TcpStream::begin(std::uint32_t sequence) {
  after_gap_ = next_.has_value();  // a sentence of the connection before ends with it
  first_ = sequence;
  next_ = sequence;
}

/// Bytes that do not begin later than they should.
void TcpStream::take(std::uint32_t sequence, std::string_view bytes, std::size_t not_captured,
                     Time time, const Sink& sink) {
  const auto known = static_cast<std::size_t>(ahead(*next_, sequence));
  const std::size_t again = std::min(known, bytes.size());
  sent_again_ += again;
  bytes.remove_prefix(again);
  if (!bytes.empty()) {
    sink(bytes, time, after_gap_);
    after_gap_ = false;
    *next_ += static_cast<std::uint32_t>(bytes.size());
  }
  const std::size_t lacking = not_captured - std::min(not_captured, known - again);
  if (lacking == 0) return;
  missing_ += lacking;
  after_gap_ = true;
  *next_ += static_cast<std::uint32_t>(lacking);
}

void TcpStream::keep(const TcpSegment& segment, Time time) {
  const auto later = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& other) {
    return ahead(other.sequence, segment.sequence) > 0;
  });
  if (waiting_.empty()) waiting_since_ = time;
  waiting_bytes_ += segment.payload.size();
  waiting_.insert(later,
                  {segment.sequence, std::string{segment.payload}, segment.not_captured, time});
}

/// Gives out what is no longer too early.
void TcpStream::takeWaiting(const Sink& sink) {
  while (!waiting_.empty() && ahead(waiting_.front().sequence, *next_) <= 0) {
    const Waiting first = std::move(waiting_.front());
    waiting_.pop_front();
    waiting_bytes_ -= first.bytes.size();
    if (!waiting_.empty()) waiting_since_ = waiting_.front().time;
    take(first.sequence, first.bytes, first.not_captured, first.time, sink);
  }
}

void TcpStream::skipGap(const Sink& sink) {
  missing_ += static_cast<std::uint64_t>(ahead(waiting_.front().sequence, *next_));
  after_gap_ = true;
  next_ = waiting_.front().sequence;
  takeWaiting(sink);
}

}  // namespace frontseat_driver::capture
