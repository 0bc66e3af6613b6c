#include "service_threads.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace frontseat_driver::ros_layer {

void ServiceThreads::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (closed_) return;
  waiting_.push_back({callback, owner});
  std::vector<std::thread> ended = takeEnded();
  if (working_ < kMost) startThread();
  if (working_ == 0) serve(lock);  // late for others, but a stop is done
  lock.unlock();
  for (std::thread& thread : ended) thread.join();
}

std::vector<std::thread> ServiceThreads::takeEnded() {
  std::vector<std::thread> ended;
  for (const std::thread::id id : done_) {
    const auto thread = std::find_if(threads_.begin(), threads_.end(),
                                     [&](const auto& one) { return one.get_id() == id; });
    ended.push_back(std::move(*thread));
    threads_.erase(thread);
  }
  done_.clear();
  return ended;
}

void ServiceThreads::startThread() {
  const auto run = [this] {
    std::unique_lock<std::mutex> lock(mutex_);
    serve(lock);
    --working_;
    done_.push_back(std::this_thread::get_id());
  };
  try {
    threads_.emplace_back(run);
    ++working_;
  } catch (const std::system_error&) {
    // The computer has no thread to give. Those at work come to the call, too.
  }
}

void ServiceThreads::serve(std::unique_lock<std::mutex>& lock) {
  while (!waiting_.empty()) {
    ros::CallbackInterfacePtr callback = std::move(waiting_.front().callback);
    waiting_.pop_front();
    lock.unlock();
    callback->call();
    callback.reset();
    lock.lock();
  }
}

void ServiceThreads::removeByID(std::uint64_t owner) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                [&](const Call& call) { return call.owner == owner; }),
                 waiting_.end());
}

void ServiceThreads::close() {
  std::vector<std::thread> threads;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
    waiting_.clear();
    threads.swap(threads_);
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace frontseat_driver::ros_layer
