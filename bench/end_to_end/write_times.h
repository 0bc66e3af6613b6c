#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace frontseat_driver::bench {

/// When each sentence was written, in a file that the vehicle and the subscriber both map: they
/// find it by the number that the sentence carries as its depth.
class WriteTimes {
 public:
  /// Makes the file as large as `count` needs, if it is not.
  WriteTimes(const std::string& path, std::size_t count) : count_(count) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT, 0600);
    const std::size_t bytes = count * sizeof(Time);
    if (file < 0 || ftruncate(file, static_cast<off_t>(bytes)) != 0) {
      throw std::runtime_error{"cannot open " + path};
    }
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (memory == MAP_FAILED) throw std::runtime_error{"cannot map " + path};
    times_ = static_cast<Time*>(memory);
  }
  WriteTimes(const WriteTimes&) = delete;
  WriteTimes& operator=(const WriteTimes&) = delete;
  ~WriteTimes() { munmap(times_, count_ * sizeof(Time)); }

  void note(std::size_t number) {
    if (number < count_) times_[number].store(now_ns(), std::memory_order_release);
  }

  /// Seconds since the sentence was written; negative if it never was.
  double since(std::size_t number) const {
    if (number >= count_) return -1.0;
    const std::int64_t written = times_[number].load(std::memory_order_acquire);
    return written == 0 ? -1.0 : static_cast<double>(now_ns() - written) * 1e-9;
  }

 private:
  using Time = std::atomic<std::int64_t>;

  static std::int64_t now_ns() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds{1};
  }

  std::size_t count_;
  Time* times_;
};

}  // namespace frontseat_driver::bench
