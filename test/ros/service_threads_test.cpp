#include "service_threads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <utility>
#include <vector>

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

constexpr std::uint64_t kOwner = 7;

class Call : public ros::CallbackInterface {
 public:
  explicit Call(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  const std::function<void()> work_;
};

void bring(ServiceThreads& threads, std::function<void()> work, std::uint64_t owner = kOwner) {
  threads.addCallback(boost::make_shared<Call>(std::move(work)), owner);
}

/// While it lives, no thread can be started: each wants a stack as large as the address space.
class NoThreadsLeft {
 public:
  NoThreadsLeft() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 60U);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  NoThreadsLeft(const NoThreadsLeft&) = delete;
  NoThreadsLeft& operator=(const NoThreadsLeft&) = delete;
  ~NoThreadsLeft() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }

 private:
  pthread_attr_t before_{};
};

TEST(ServiceThreads, ACallThatWaitsKeepsNobodyElseWaiting) {
  ServiceThreads threads;
  std::promise<void> go_on;
  std::promise<void> done;
  bring(threads, [&] { go_on.get_future().wait(); });
  bring(threads, [&] { done.set_value(); });
  EXPECT_EQ(done.get_future().wait_for(5s), std::future_status::ready);
  go_on.set_value();
}

TEST(ServiceThreads, MoreCallsThanThreadsWaitForTheirTurn) {
  ServiceThreads threads;
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  std::atomic<std::size_t> served{0};
  const std::size_t calls = ServiceThreads::kMost + 10;
  std::promise<void> all;
  for (std::size_t i = 0; i < calls; ++i) {
    bring(threads, [&, gate] {
      gate.wait();
      if (++served == calls) all.set_value();
    });
  }
  EXPECT_EQ(served, 0U);
  go_on.set_value();
  EXPECT_EQ(all.get_future().wait_for(5s), std::future_status::ready);
}

TEST(ServiceThreads, AClosedOneDropsWhatWaitsAndTakesNoMore) {
  ServiceThreads threads;
  threads.close();
  bool served = false;
  bring(threads, [&] { served = true; });
  EXPECT_FALSE(served);
}

TEST(ServiceThreads, WithoutAThreadToStartTheBringerServes) {
  ServiceThreads threads;
  std::vector<std::thread::id> by;
  {
    const NoThreadsLeft none;
    bring(threads, [&] { by.push_back(std::this_thread::get_id()); });
    bring(threads, [&] { by.push_back(std::this_thread::get_id()); });
  }
  EXPECT_THAT(by, ElementsAre(std::this_thread::get_id(), std::this_thread::get_id()));
}

TEST(ServiceThreads, WithoutAThreadToStartThoseAtWorkServe) {
  ServiceThreads threads;
  std::promise<void> go_on;
  std::promise<std::thread::id> first;
  std::promise<std::thread::id> second;
  bring(threads, [&] {
    first.set_value(std::this_thread::get_id());
    go_on.get_future().wait();
  });
  {
    const NoThreadsLeft none;
    bring(threads, [&] { second.set_value(std::this_thread::get_id()); });
  }
  go_on.set_value();
  EXPECT_EQ(second.get_future().get(), first.get_future().get());
}

TEST(ServiceThreads, WaitingCallsOfAnOwnerAreDropped) {
  ServiceThreads threads;
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  for (std::size_t i = 0; i < ServiceThreads::kMost; ++i) bring(threads, [gate] { gate.wait(); });
  std::atomic<bool> dropped{true};
  std::promise<void> kept;
  bring(
      threads, [&] { dropped = false; }, kOwner + 1);
  bring(threads, [&] { kept.set_value(); });
  threads.removeByID(kOwner + 1);
  go_on.set_value();
  EXPECT_EQ(kept.get_future().wait_for(5s), std::future_status::ready);
  threads.close();
  EXPECT_TRUE(dropped);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
