#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"
#include "tcp_segment.h"

namespace frontseat_driver::capture {

/// One direction of a TCP connection, put in order from its segments as far as the capture has
/// them.
///
/// What comes too early waits for what is missing: as long as that may still be sent again, and no
/// more than kMostWaiting bytes. Then the gap is given up.
class TcpStream {
 public:
  using Time = std::optional<vehicle::UtcTime>;

  static constexpr std::size_t kMostWaiting = 64UL * 1024;
  static constexpr std::size_t kMostSegments = 256;
  static constexpr std::chrono::seconds kLongestWait{10};

  /// Hears the bytes in their order. `after_gap`: some are missing before them.
  using Sink = std::function<void(std::string_view bytes, Time time, bool after_gap)>;

  void add(const TcpSegment& segment, Time time, const Sink& sink);

  /// Nothing more comes: what waits is given out.
  void finish(const Sink& sink);

  std::uint64_t sentAgain() const { return sent_again_; }
  std::uint64_t missing() const { return missing_; }

 private:
  struct Waiting {
    std::uint32_t sequence;
    std::string bytes;
    std::size_t not_captured;
    Time time;
  };

  bool isGivenUp(const Time& now) const;
  void begin(std::uint32_t sequence);
  void take(std::uint32_t sequence, std::string_view bytes, std::size_t not_captured, Time time,
            const Sink& sink);
  void keep(const TcpSegment& segment, Time time);
  void takeWaiting(const Sink& sink);
  void skipGap(const Sink& sink);

  std::optional<std::uint32_t> first_;  ///< sequence number of the first byte
  std::optional<std::uint32_t> next_;   ///< the sequence number that continues it
  std::deque<Waiting> waiting_;         ///< by sequence number
  std::size_t waiting_bytes_ = 0;
  Time waiting_since_;
  bool after_gap_ = false;
  std::uint64_t sent_again_ = 0;
  std::uint64_t missing_ = 0;
};

}  // namespace frontseat_driver::capture
