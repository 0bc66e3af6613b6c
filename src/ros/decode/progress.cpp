#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace frontseat_driver::decode {

using namespace std::chrono_literals;

Progress::Progress(std::optional<std::uint64_t> size, bool wanted)
    : size_(wanted && isatty(STDERR_FILENO) == 1 ? size.value_or(0) : 0),
      next_(Clock::now() + 1s) {}

void Progress::show(std::uint64_t bytes) {
  if (size_ == 0 || Clock::now() < next_) return;
  next_ = Clock::now() + 100ms;
  shown_ = true;
  constexpr double kWidth = 40.0;
  const double part = std::min(1.0, static_cast<double>(bytes) / static_cast<double>(size_));
  const std::string bar(static_cast<std::size_t>(part * kWidth), '#');
  std::fprintf(stderr, "\r[%-40s] %3.0f %% of %.0f MB", bar.c_str(), part * 100.0,
               static_cast<double>(size_) / 1e6);
  std::fflush(stderr);
}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

}  // namespace frontseat_driver::decode
