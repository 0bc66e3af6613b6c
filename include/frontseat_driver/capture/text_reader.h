#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "frontseat_driver/capture/byte_source.h"
#include "frontseat_driver/capture/reader.h"
#include "frontseat_driver/nmea/framer.h"

namespace frontseat_driver::capture {

/// What stands in front of a sentence on its line.
struct LinePrefix {
  std::optional<vehicle::UtcTime> time;
  std::optional<Direction> direction;
  bool comment = false;  ///< `#` or `%`: the line is for people
};

/// Reads the front of a line, in any of the forms that recorders write:
///
///     1416410000.123            UNIX time: seconds; 13, 16 and 19 digits: ms, us and ns
///     2014-11-19T14:30:00.123Z  ISO 8601, or with a blank for the T; without zone: UTC
///     [ INFO] [1416410000.123]: as ROS logs
///     > or <, tx or rx          to the vehicle, from the vehicle; alone or after a time
///
/// What is none of them tells nothing, and neither does what follows it.
LinePrefix readPrefix(std::string_view text);

/// A capture as text: one sentence on a line, with or without a time and a direction in front. Line
/// ends, noise, cut-off and oversized sentences are as nmea::Framer has them.
class TextReader : public Reader {
 public:
  explicit TextReader(std::unique_ptr<ByteSource> source);

  std::optional<Entry> next() override;
  bool ready() const override { return at_ != lines_.size() || ended_; }
  ReadCounters counters() const override;

 private:
  static constexpr std::size_t kChunk = 256UL * 1024;

  bool refill();
  void feed(std::size_t size);
  void keep(std::string_view line);
  std::string_view textBefore(std::string_view line) const;

  std::unique_ptr<ByteSource> source_;
  nmea::Framer framer_;
  std::vector<char> buffer_;
  std::size_t filled_ = 0;                              ///< bytes in the buffer
  std::size_t fed_ = 0;                                 ///< of them, those the framer has seen
  std::vector<std::string_view> lines_;                 ///< what it made of them
  std::size_t at_ = 0;                                  ///< the line that comes next
  std::array<char, nmea::Framer::kMaxLine> carried_{};  ///< a line longer than a chunk began
  std::uint64_t bytes_ = 0;
  std::uint64_t prefixed_ = 0;  ///< sentences with text in front
  bool ended_ = false;
};

}  // namespace frontseat_driver::capture
