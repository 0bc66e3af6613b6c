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

  /// Where every byte that came in went. At any time, also while a sink runs,
  /// `bytes == sentence_bytes + line_end_bytes + dropped_bytes + pending()`.
  struct Counters {
    std::uint64_t bytes = 0;           ///< all that was taken from the chunks
    std::uint64_t sentences = 0;       ///< lines handed on
    std::uint64_t sentence_bytes = 0;  ///< in lines handed on, line ends not included
    std::uint64_t line_end_bytes = 0;  ///< CR and LF
    std::uint64_t dropped_bytes = 0;   ///< noise before `$`, cut-off and oversized lines
    std::uint64_t cut_off = 0;         ///< sentences interrupted by the next `$` or by reset()
    std::uint64_t noise_lines = 0;     ///< runs of bytes that no `$` began
    std::uint64_t oversized = 0;       ///< sentences longer than kMaxLine
  };

  /// Calls `sink(std::string_view line)` for each complete line that starts with `$`, in order.
  /// The view holds until the sink returns. The sink may call reset(), not feed().
  template <class Sink>
  void feed(std::string_view chunk, Sink&& sink) {
    for (Scan scan{chunk.data(), chunk.data() + chunk.size()}; scan.at != scan.end;) {
      if (const std::string_view line = step(scan); !line.empty()) sink(line);
    }
  }

  /// Forgets a line that has begun, as after a lost connection; its bytes count as dropped.
  void reset();

  const Counters& counters() const { return counters_; }

  /// Bytes of a sentence that has begun and not ended.
  std::size_t pending() const { return held_; }

 private:
  enum class State { Between, Noise, Sentence, Oversized };

  /// A chunk and how far it was read.
  struct Scan {
    bool atLineEnd() const { return at != end && (*at == '\r' || *at == '\n'); }
    std::size_t takeLineEnds();
    std::string_view takeRun();

    const char* at;
    const char* end;
  };

  std::string_view step(Scan& scan);
  std::string_view endLine(std::size_t line_end_bytes);
  std::string_view handOn(std::string_view line, std::size_t line_end_bytes);
  void countLineEnd(std::size_t bytes);
  void begin();
  void hold(std::string_view run);
  void drop(std::string_view run);

  State state_ = State::Between;
  std::size_t held_ = 0;  ///< bytes of `buffer_` in use
  std::array<char, kMaxLine> buffer_{};
  Counters counters_;
};

}  // namespace frontseat_driver::nmea
