#pragma once

#include <cstdint>
#include <optional>

#include "frontseat_driver/capture/entry.h"

namespace frontseat_driver::capture {

/// What a reader met that became no entry.
struct ReadCounters {
  std::uint64_t bytes = 0;        ///< read so far, for a progress display
  std::uint64_t oversized = 0;    ///< sentences longer than nmea::Framer::kMaxLine
  std::uint64_t cut_off = 0;      ///< sentences that the next `$` interrupted
  std::uint64_t other_lines = 0;  ///< without a sentence: comments, other text, noise

  std::uint64_t sent_again = 0;  ///< bytes of TCP that came more than once
  std::uint64_t missing = 0;     ///< bytes of TCP that the capture lacks
  bool breaks_off = false;       ///< the file ends inside a packet, or is damaged from there on
};

/// A record, entry by entry, in constant memory whatever is in it.
class Reader {
 public:
  virtual ~Reader() = default;

  /// The next entry, or nothing at the end. Its line holds until the next call. Waits for live
  /// input. Throws std::runtime_error with one line that says what cannot be read, and why.
  virtual std::optional<Entry> next() = 0;

  /// True when next() has its answer at hand and will not wait for input.
  virtual bool ready() const { return true; }

  virtual ReadCounters counters() const = 0;
};

}  // namespace frontseat_driver::capture
