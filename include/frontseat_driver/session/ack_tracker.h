#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// Tells which sent sentence an acknowledgement is for (SPI 0.1, section 6.4).
///
/// Matches by name and by the time the sentence carried; BPLOG carries none, so there only the order
/// tells. Any sentence may come in between, acknowledgements may be lost, late, pending first, or
/// come twice: each sent sentence is found at most once with a final status, and one that is never
/// answered is forgotten after kForgotten. Bounded: the oldest goes when there are kMost.
class AckTracker {
 public:
  using SteadyTime = vehicle::SteadyTime;
  using RequestId = std::uint64_t;

  static constexpr RequestId kNoRequest = 0;  ///< a repeated command that nobody waits for
  static constexpr std::size_t kMost = 128;
  static constexpr std::chrono::seconds kForgotten{10};

  struct Sent {
    std::string_view formatter;  ///< "RMB"; static storage
    std::optional<vehicle::TimeOfDay> time;
    RequestId request = kNoRequest;
    SteadyTime at{};
  };

  void sent(const Sent& sentence);

  /// The sentence this acknowledges, if it is one of ours. A final status forgets it, a pending one
  /// does not.
  std::optional<Sent> match(const vehicle::Acknowledgement& ack, SteadyTime now);

  /// The connection is gone, and every answer with it.
  void clear() { outstanding_.clear(); }

  std::size_t outstanding() const { return outstanding_.size(); }

 private:
  std::deque<Sent> outstanding_;  ///< oldest first
};

}  // namespace frontseat_driver::session
