#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Counts sentences by address, so that diagnostics can say how often each one comes.
class SentenceRates {
 public:
  struct Rate {
    std::string address;         ///< "BFNVG"
    double hz = 0.0;             ///< over the time between the last two calls of take()
    std::uint64_t count = 0;     ///< since the beginning
    vehicle::SteadyTime last{};  ///< when the last one arrived
  };

  /// More addresses than this are counted together as "others": noise makes up many.
  static constexpr std::size_t kMost = 32;

  void count(std::string_view line, vehicle::SteadyTime arrival);

  /// The rates since the last call.
  std::vector<Rate> take(vehicle::SteadyTime now);

 private:
  static constexpr std::size_t kAddress = 5;

  struct Entry {
    std::array<char, kAddress> address{};
    std::uint64_t count = 0;
    std::uint64_t counted_before = 0;
    vehicle::SteadyTime last{};
  };

  Entry& entryOf(std::string_view address);

  std::array<Entry, kMost> entries_;
  std::size_t used_ = 0;
  vehicle::SteadyTime taken_{};
};

}  // namespace frontseat_driver::ros_layer
