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
/// Matches by name and by the time the sentence carried; BPLOG carries none, so there only the
/// order tells. Any sentence may come in between, acknowledgements may be lost, late, pending
/// first, or come twice: each sent sentence is found at most once with a final status, and one that
/// is never answered is forgotten in time. Bounded: when there are kMost, the oldest that nobody
/// waits for goes.
class AckTracker {
 public:
  using SteadyTime = vehicle::SteadyTime;
  using RequestId = std::uint64_t;

  static constexpr RequestId kNoRequest = 0;  ///< a repeated command that nobody waits for
  static constexpr std::size_t kMost = 128;

  /// A sentence that has not been acknowledged after `forgotten` never will be.
  explicit AckTracker(std::chrono::nanoseconds forgotten) : forgotten_(forgotten) {}

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

  /// Nobody waits for this request any more, and nothing acknowledged it: what the vehicle
  /// acknowledges next is for another.
  void forget(RequestId request);

  /// The connection is gone, and every answer with it.
  void clear() { outstanding_.clear(); }

  std::size_t outstanding() const { return outstanding_.size(); }

 private:
  std::chrono::nanoseconds forgotten_;
  std::deque<Sent> outstanding_;  ///< oldest first
};

}  // namespace frontseat_driver::session
