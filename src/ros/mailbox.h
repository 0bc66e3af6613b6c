#pragma once

#include <ros/time.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "convert.h"

namespace frontseat_driver::ros_layer {

/// When a message arrived, by the steady clock: it may have waited in this process, behind other
/// nodelets' callbacks.
inline vehicle::SteadyTime receivedAt(const ros::Time& receipt) {
  const auto waited = timeFrom(receipt, ros::Time::now());
  return std::chrono::steady_clock::now() - std::max(waited, std::chrono::nanoseconds{0});
}

/// The newest task that the session's thread has not taken yet. Must outlive what it posts.
template <class Task>
class Mailbox {
 public:
  /// Takes the place of a task that still waits; otherwise somebody is sent for it by `post`.
  template <class Post>
  void put(const Post& post, Task task) {
    if (replace(std::move(task))) return;  // somebody is on the way already
    post([this](const auto& now, auto& out) { replace(nullptr)(now, out); });
  }

 private:
  /// What was there before.
  Task replace(Task task) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(newest_, std::move(task));
  }

  std::mutex mutex_;
  Task newest_;
};

}  // namespace frontseat_driver::ros_layer
