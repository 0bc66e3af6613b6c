#pragma once

#include <chrono>
#include <cstdint>

#include "decoded_line.h"
#include "frontseat_driver/session/ack_tracker.h"

namespace frontseat_driver::decode {

/// Finds the commands that the acknowledgements of a record are for.
class AckRoundTrips {
 public:
  struct Counts {
    std::uint64_t commands = 0;     ///< sentences of a kind that is acknowledged
    std::uint64_t acks = 0;         ///< BFACK, whatever its status
    std::uint64_t done = 0;         ///< of the matched ones
    std::uint64_t refused = 0;      ///< invalid or failed, of the matched ones
    std::uint64_t pending = 0;      ///< not final, of the matched ones
    std::uint64_t not_matched = 0;  ///< for no command of the record
    std::chrono::nanoseconds shortest{}, longest{}, sum{};  ///< of what is done or refused
  };

  void add(const DecodedLine& line);

  const Counts& counts() const { return counts_; }

 private:
  void addCommand(const DecodedLine& line);
  void addAck(const protocol::bluefin::Acknowledgement& ack, vehicle::SteadyTime at);

  session::AckTracker tracker_{std::chrono::seconds{60}};
  Counts counts_;
};

}  // namespace frontseat_driver::decode
