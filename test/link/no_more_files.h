#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

namespace frontseat_driver::link::testing {

/// No file can be opened while it lives.
class NoMoreFiles {
 public:
  NoMoreFiles() {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit few = before_;
    few.rlim_cur = std::min<rlim_t>(few.rlim_cur, 256);
    setrlimit(RLIMIT_NOFILE, &few);
    takeAll();
  }
  /// Those as well that were closed since.
  void takeAll() {
    for (int file = dup(2); file >= 0; file = dup(2)) files_.push_back(file);
  }
  /// Leaves one that can be opened.
  void spareOne() {
    close(files_.back());
    files_.pop_back();
  }
  ~NoMoreFiles() {
    for (const int file : files_) close(file);
    setrlimit(RLIMIT_NOFILE, &before_);
  }
  NoMoreFiles(const NoMoreFiles&) = delete;
  NoMoreFiles& operator=(const NoMoreFiles&) = delete;

 private:
  rlimit before_{};
  std::vector<int> files_;
};

}  // namespace frontseat_driver::link::testing
