#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace frontseat_driver::decode {

/// A bar on standard error, for people who wait: only where that is a terminal, the size is known,
/// and it takes longer than a second.
class Progress {
 public:
  Progress(std::optional<std::uint64_t> size, bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();  ///< takes the bar away

  void show(std::uint64_t bytes);

 private:
  using Clock = std::chrono::steady_clock;

  std::uint64_t size_;  ///< 0: nothing is shown
  Clock::time_point next_;
  bool shown_ = false;
};

}  // namespace frontseat_driver::decode
