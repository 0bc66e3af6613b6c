#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace frontseat_driver::simulation {

/// A seed whose run broke a promise.
struct BrokenSeed {
  std::uint64_t seed = 0;
  std::string broken;
};

/// Runs seeds from `first` on, each thread taking the next one; ends early at the first failure,
/// which is the one of the lowest seed known. `run` tells what was broken, or nothing.
inline std::optional<BrokenSeed> firstBroken(
    std::uint64_t first, std::uint64_t count, unsigned threads,
    const std::function<std::string(std::uint64_t seed)>& run) {
  std::atomic<std::uint64_t> next{first};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::optional<BrokenSeed> lowest;
  const auto work = [&] {
    for (std::uint64_t seed = next++; seed < first + count && !failed; seed = next++) {
      const std::string broken = run(seed);
      if (broken.empty()) continue;
      failed = true;
      const std::lock_guard<std::mutex> lock(mutex);
      if (!lowest || seed < lowest->seed) lowest = BrokenSeed{seed, broken};
    }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return lowest;
}

/// The least of a plan's actions with which it still `breaks` something, by taking out halves,
/// quarters and so on.
template <class Plan>
Plan leastThat(Plan plan, const std::function<bool(const Plan&)>& breaks) {
  constexpr int kMostRuns = 400;
  int runs = 0;
  for (std::size_t size = plan.actions.size(); size > 0 && runs < kMostRuns; size /= 2) {
    for (std::size_t from = 0; from < plan.actions.size() && runs < kMostRuns;) {
      Plan fewer = plan;
      const auto begin = fewer.actions.begin() + static_cast<std::ptrdiff_t>(from);
      const auto end =
          begin + static_cast<std::ptrdiff_t>(std::min(size, fewer.actions.size() - from));
      fewer.actions.erase(begin, end);
      ++runs;
      if (breaks(fewer)) {
        plan = std::move(fewer);
      } else {
        from += size;
      }
    }
  }
  return plan;
}

}  // namespace frontseat_driver::simulation
