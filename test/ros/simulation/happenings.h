#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "frontseat_driver/sim/random.h"

/// What happens in a mission and when, drawn from its seed. Each simulation has its own kinds.
namespace frontseat_driver::simulation {

template <class T, std::size_t kCount>
const T& oneOf(sim::Random& random, const T (&choices)[kCount]) {
  return choices[random.below(kCount)];
}

inline double between(sim::Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

inline std::chrono::nanoseconds fromSeconds(double s) {
  return std::chrono::nanoseconds{static_cast<std::int64_t>(s * 1e9)};
}

inline double inSeconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

/// One thing that happens, for how long where it lasts, and where its details come from.
template <class Kind>
struct Happening {
  std::chrono::nanoseconds at{};
  Kind kind{};
  std::chrono::nanoseconds lasts{};
  std::uint64_t seed = 0;
};

struct KindRow {
  std::string_view name;  ///< "half-open", for people
  double per_hour;        ///< how often, on average
  double least_s;         ///< how long
  double most_s;
};

/// What happens within `length`, in the order of time, `pace` times as often as the rows say, which
/// are in the order of Kind.
template <class Kind, std::size_t kKinds>
std::vector<Happening<Kind>> anyHappenings(const KindRow (&rows)[kKinds], sim::Random& random,
                                           std::chrono::nanoseconds length, double pace) {
  std::vector<Happening<Kind>> happenings;
  const double hours = inSeconds(length) / 3600.0;
  // Rough times and quiet ones.
  const double rate = pace * oneOf(random, {0.3, 1.0, 1.0, 3.0});
  for (std::size_t i = 0; i < kKinds; ++i) {
    const double mean = rows[i].per_hour * hours * rate;
    auto count = static_cast<std::size_t>(mean);
    if (random.chance(mean - std::floor(mean))) ++count;
    for (std::size_t n = 0; n < count; ++n) {
      Happening<Kind> one;
      one.at = fromSeconds(random.uniform() * hours * 3600.0);
      one.kind = static_cast<Kind>(i);
      one.lasts = fromSeconds(between(random, rows[i].least_s, rows[i].most_s));
      one.seed = 1 + random.below(1000000000);
      happenings.push_back(one);
    }
  }
  std::stable_sort(happenings.begin(), happenings.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  return happenings;
}

}  // namespace frontseat_driver::simulation
