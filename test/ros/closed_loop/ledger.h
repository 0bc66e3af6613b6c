#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "frontseat_driver/session/nmea_session.h"

namespace frontseat_driver::closed_loop {

/// What arrived, framed and counted a second time, a byte after the other: the lines that the
/// driver has to hear, in order, and where each byte must be found in its counters.
class Ledger {
 public:
  /// What is handed to the session next.
  void arrives(std::string_view bytes);
  /// What the session heard; false if that is not what came.
  bool heard(std::string_view line);
  /// A line that has begun is never going to end.
  void connectionEnded();

  /// What is wrong in the counters after a call of the session, or nothing.
  const char* complaint(const session::NmeaCounters& counters) const;

  std::uint64_t lines() const { return lines_; }
  std::uint64_t soundLines() const { return sound_; }

 private:
  enum class State { Between, Noise, Line, Oversized };

  void take(char byte);
  void endLine();
  void cutOff();

  State state_ = State::Between;
  std::string line_;
  std::deque<std::string> unheard_;
  std::uint64_t bytes_ = 0;
  std::uint64_t line_ends_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t sound_ = 0;  ///< lines with a frame and the right checksum
  std::uint64_t sound_bytes_ = 0;
  std::uint64_t no_lines_ = 0;  ///< noise, and sentences that the next one cut off
  std::uint64_t oversized_ = 0;
};

}  // namespace frontseat_driver::closed_loop
