#include "service_threads.h"

#include <algorithm>
#include <utility>

namespace frontseat_driver::ros_layer {

void ServiceThreads::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  std::vector<std::thread> ended;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_) return;
    waiting_.push_back({callback, owner});
    for (const std::thread::id id : done_) {
      const auto thread = std::find_if(threads_.begin(), threads_.end(),
                                       [&](const auto& one) { return one.get_id() == id; });
      ended.push_back(std::move(*thread));
      threads_.erase(thread);
    }
    done_.clear();
    if (working_ < kMost) {
      ++working_;
      threads_.emplace_back([this] { work(); });
    }
  }
  for (std::thread& thread : ended) thread.join();
}

void ServiceThreads::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!waiting_.empty()) {
    ros::CallbackInterfacePtr callback = std::move(waiting_.front().callback);
    waiting_.pop_front();
    lock.unlock();
    callback->call();
    callback.reset();
    lock.lock();
  }
  --working_;
  done_.push_back(std::this_thread::get_id());
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
