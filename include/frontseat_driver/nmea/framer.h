#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frontseat_driver::nmea {

/// Finds lines in a byte stream that arrives in any pieces.
///
/// A sentence starts at `$` and ends before CR or LF, alone or together; blank lines are no error.
/// A `$` inside a line starts a new sentence and what came before it is cut off. A line longer than
/// kMaxLine is dropped, counted once, up to its end or the next `$`. Nothing here allocates: a line
/// that lies whole in one chunk is handed on in place, only a line split over reads is copied.
class Framer {
 public:
  /// Longest sentence, `$` to the last character before the line end, in bytes.
  static constexpr std::size_t kMaxLine = 1024;

  /// Where every byte that came in went. At any time
  /// `bytes == sentence_bytes + line_end_bytes + dropped_bytes + pending()`.
  struct Counters {
    std::uint64_t bytes = 0;           ///< all that was fed
    std::uint64_t sentences = 0;       ///< lines handed on
    std::uint64_t sentence_bytes = 0;  ///< in lines handed on, line ends not included
    std::uint64_t line_end_bytes = 0;  ///< CR and LF
    std::uint64_t dropped_bytes = 0;   ///< noise before `$`, cut-off and oversized lines
    std::uint64_t cut_off = 0;         ///< sentences interrupted by the next `$`
    std::uint64_t noise_lines = 0;     ///< runs of bytes that no `$` began
    std::uint64_t oversized = 0;       ///< sentences longer than kMaxLine
  };

  /// Calls `sink(std::string_view line)` for each complete line that starts with `$`, in order.
  /// The view holds until the sink returns.
  template <class Sink>
  void feed(std::string_view chunk, Sink&& sink);

  /// Forgets a line that has begun, as after a lost connection; its bytes count as dropped.
  void reset();

  const Counters& counters() const { return counters_; }

  /// Bytes of a sentence that has begun and not ended.
  std::size_t pending() const;
};

}  // namespace frontseat_driver::nmea
