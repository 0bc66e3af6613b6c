#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <random>

namespace frontseat_driver::link {

/// How long to wait before the next attempt: steps of min, 2 min, 4 min ... up to max, each
/// shortened by chance to between half of it and all of it, but never below min, nor above max. The
/// chance spreads the backseats of a fleet that lost the same network.
class BackOff {
 public:
  using Milliseconds = std::chrono::milliseconds;

  BackOff(Milliseconds min, Milliseconds max, std::uint64_t seed)
      : max_(std::max(max, Milliseconds(1))),
        min_(std::clamp(min, Milliseconds(1), max_)),
        step_(min_),
        random_(seed != 0 ? seed : std::random_device{}()) {}

  Milliseconds next() {
    std::uniform_int_distribution<Milliseconds::rep> delay_ms(std::max(min_, step_ / 2).count(),
                                                              step_.count());
    const Milliseconds delay(delay_ms(random_));
    step_ = step_ > max_ / 2 ? max_ : step_ * 2;
    return delay;
  }

  void restart() { step_ = min_; }

 private:
  Milliseconds max_;
  Milliseconds min_;
  Milliseconds step_;
  std::mt19937_64 random_;
};

}  // namespace frontseat_driver::link
