#include "frontseat_driver/driver/blueye_driver.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace frontseat_driver::driver {

using vehicle::Now;
using vehicle::SteadyTime;

namespace {

constexpr std::chrono::seconds kTick{1};
// For zero motion and goodbye; the drone answers within 50 ms.
constexpr std::chrono::milliseconds kLastWords{100};
// A tick that is later tells of a process that was halted: longer than a busy computer takes.
constexpr std::chrono::milliseconds kStoodStill{500};

}  // namespace

class BlueyeDriver::Impl : public link::ZmqClient::Handler, public session::BlueyeOutput {
 public:
  Impl(link::ZmqClient::Options options, session::BlueyeSession& session,
       BlueyeLinkListener& listener, Clock clock)
      : session_(session),
        listener_(listener),
        clock_(std::move(clock)),
        client_(std::move(options), *this) {}

  void start() {
    const std::lock_guard<std::mutex> lock(lifetime_);
    if (stopping_ || thread_.joinable()) return;
    thread_ = std::thread([this] { run(); });
  }

  void stop() {
    const std::lock_guard<std::mutex> lock(lifetime_);
    stopping_ = true;
    if (!thread_.joinable()) return;
    client_.wake();
    thread_.join();
  }

  void post(std::function<void(const Now&)> task) {
    if (stopping_) return;
    {
      const std::lock_guard<std::mutex> lock(tasks_mutex_);
      tasks_.push_back(std::move(task));
    }
    client_.wake();
  }

  session::BlueyeOutput& output() { return *this; }

 private:
  void run() {
    pthread_setname_np(pthread_self(), "blueye");
    next_tick_ = clock_().steady;
    client_.start();
    while (!stopping_) turn(std::min(session_.nextStep(), next_tick_));
    leave();
  }

  void turn(SteadyTime deadline) {
    client_.run(deadline);
    if (!stopping_) runTasks();
    const Now now = wakeUp();
    session_.step(now, *this);
    if (now.steady >= next_tick_) tick(now);
  }

  /// The time, for what comes first after a wait.
  Now wakeUp() {
    const Now now = clock_();
    if (now.steady > next_tick_ + kStoodStill) session_.stoodStill(now);
    return now;
  }

  void runTasks() {
    std::deque<std::function<void(const Now&)>> tasks;
    {
      const std::lock_guard<std::mutex> lock(tasks_mutex_);
      tasks.swap(tasks_);
    }
    for (const auto& task : tasks) task(wakeUp());
  }

  void tick(const Now& now) {
    listener_.onTick(now);
    while (next_tick_ <= now.steady) next_tick_ += kTick;  // what was missed is not made up for
  }

  void leave() {
    const Now now = clock_();
    const SteadyTime end = now.steady + kLastWords;
    session_.leave(now, *this);
    session_.step(now, *this);
    while (client_.connected() && !session_.hasLeft() && clock_().steady < end) {
      turn(std::min(session_.nextStep(), end));
    }
    client_.close();
    const std::lock_guard<std::mutex> lock(tasks_mutex_);
    tasks_.clear();
  }

  // What the link reports.

  void onConnected(const std::string& endpoint) override {
    const Now now = clock_();
    listener_.onConnected(now, endpoint);
    session_.connected(now, *this);
  }

  void onTelemetry(std::string_view type, std::string_view payload) override {
    session_.telemetry(wakeUp(), type, payload, *this);
  }

  void onReply(std::string_view type, std::string_view payload) override {
    session_.reply(wakeUp(), type, payload, *this);
  }

  void onNoReply(const std::string& reason) override { session_.noReply(wakeUp(), reason, *this); }

  void onMalformed() override { session_.malformed(); }

  void onDisconnected(const std::string& reason) override {
    const Now now = clock_();
    session_.disconnected(now, *this);
    listener_.onDisconnected(now, reason);
  }

  void onConnectFailed(const std::string& reason) override {
    listener_.onConnectFailed(clock_(), reason);
  }

  // What the session says.

  bool publish(const Now& now, std::string_view type, std::string_view payload) override {
    if (!client_.publish(type, payload)) return false;
    listener_.onControlSent(now, type, payload);
    return true;
  }

  bool request(const Now& now, std::string_view type, std::string_view payload,
               std::chrono::milliseconds timeout) override {
    if (!client_.request(type, payload, timeout)) return false;
    listener_.onRequestSent(now, type, payload);
    return true;
  }

  void reconnect(const Now&, const std::string& reason) override { client_.reconnect(reason); }

  session::BlueyeSession& session_;
  BlueyeLinkListener& listener_;
  const Clock clock_;
  link::ZmqClient client_;
  SteadyTime next_tick_{};
  std::atomic<bool> stopping_{false};
  std::mutex tasks_mutex_;
  std::deque<std::function<void(const Now&)>> tasks_;
  std::mutex lifetime_;  ///< of the thread
  std::thread thread_;
};

BlueyeDriver::BlueyeDriver(link::ZmqClient::Options options, session::BlueyeSession& session,
                           BlueyeLinkListener& listener, Clock clock)
    : impl_(std::make_unique<Impl>(std::move(options), session, listener, std::move(clock))) {}

BlueyeDriver::~BlueyeDriver() { stop(); }

void BlueyeDriver::start() { impl_->start(); }

void BlueyeDriver::stop() { impl_->stop(); }

void BlueyeDriver::post(std::function<void(const vehicle::Now&)> task) {
  impl_->post(std::move(task));
}

session::BlueyeOutput& BlueyeDriver::output() { return impl_->output(); }

}  // namespace frontseat_driver::driver
