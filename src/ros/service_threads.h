#pragma once

#include <ros/callback_queue_interface.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace frontseat_driver::ros_layer {

/// What becomes of a call that the session's thread comes to so late that the caller has been told
/// that nothing was done. What only ends something is done all the same.
enum class WhenLate { Drop, DoAnyway };

/// Runs service calls, each on a thread of its own while it lasts: a call that waits for the
/// vehicle keeps nobody else waiting. No thread exists while no call is under way. If none can be
/// started, the thread that brings the call runs it.
class ServiceThreads : public ros::CallbackQueueInterface {
 public:
  /// More calls than this at once wait for one of them to end.
  static constexpr std::size_t kMost = 64;

  ServiceThreads() = default;
  ~ServiceThreads() override { close(); }

  /// Drops the calls that wait and takes no more; returns when those under way have ended.
  void close();

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

  /// Drops the owner's waiting calls. Those under way end by themselves: they own what they use.
  void removeByID(std::uint64_t owner) override;

 private:
  struct Call {
    ros::CallbackInterfacePtr callback;
    std::uint64_t owner;
  };

  // All with the mutex locked; it is unlocked during a call.
  std::vector<std::thread> takeEnded();
  void startThread();
  void serve(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  bool closed_ = false;
  std::deque<Call> waiting_;
  std::size_t working_ = 0;
  std::vector<std::thread> threads_;
  std::vector<std::thread::id> done_;
};

}  // namespace frontseat_driver::ros_layer
