#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// How often each sentence comes, by its address, as it arrives: before anything is decoded.
class SentenceRates {
 public:
  struct Rate {
    std::string address;      ///< "BFNVG"
    std::uint64_t count = 0;  ///< on this connection
    double age_s = 0.0;       ///< since the last one
    double hz = 0.0;          ///< over the window
    double shortest_s = 0.0;  ///< between two that came in the window; 0 without two
    double longest_s = 0.0;
    std::optional<double> usual_hz;  ///< over the connection, once it can be told
  };

  /// More addresses than this are counted together as "other": noise makes up many.
  static constexpr std::size_t kMost = 32;
  /// Calls of take() that the window spans.
  static constexpr std::size_t kWindow = 10;
  /// What is usual takes so many sentences and so long to learn.
  static constexpr std::uint64_t kLeastCount = 10;
  static constexpr std::chrono::seconds kLeastTime{10};

  /// A connection begins.
  void reset(vehicle::SteadyTime now);

  void count(std::string_view line, vehicle::SteadyTime arrival);

  /// The rates up to now; once a second.
  std::vector<Rate> take(vehicle::SteadyTime now);

 private:
  static constexpr std::size_t kAddress = 5;
  using Duration = vehicle::SteadyTime::duration;

  /// What came between two calls of take().
  struct Slice {
    std::uint64_t count = 0;
    Duration shortest = Duration::max();
    Duration longest{0};
  };
  struct Entry {
    std::array<char, kAddress> address{};
    std::uint64_t count = 0;
    vehicle::SteadyTime first{};
    vehicle::SteadyTime last{};
    std::array<Slice, kWindow> slices;
  };

  Entry& entryOf(std::string_view address);
  Rate rateOf(const Entry& entry, vehicle::SteadyTime now) const;
  void beginSlice(vehicle::SteadyTime now);

  std::array<Entry, kMost> entries_;
  std::size_t used_ = 0;
  std::array<vehicle::SteadyTime, kWindow> slice_begins_{};
  std::size_t slice_ = 0;
  std::size_t slices_used_ = 1;
};

}  // namespace frontseat_driver::ros_layer
