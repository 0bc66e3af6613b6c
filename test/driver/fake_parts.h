#pragma once

#include <algorithm>
#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "frontseat_driver/driver/driver.h"
#include "test/link/loopback.h"

/// A driver between parts that only keep what happens to them.
namespace frontseat_driver::driver::testing {

using vehicle::Now;
using vehicle::SteadyTime;

/// What happened, in order, from any thread.
class Log {
 public:
  void add(std::string entry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.push_back(std::move(entry));
  }

  std::vector<std::string> entries() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return entries_;
  }

  std::size_t count(const std::string& entry) const {
    const auto all = entries();
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), entry));
  }

  bool has(const std::string& entry) const { return count(entry) > 0; }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> entries_;
};

/// The hooks and `next_step` belong to the driver's thread once it runs.
struct FakeSession : session::Session {
  explicit FakeSession(Log& kept) : log(kept) {}

  void connected(const Now& now, session::Output& out) override {
    log.add("session connected");
    on_connected(now, out);
  }
  void disconnected(const Now&, session::Output&) override { log.add("session disconnected"); }
  void receive(const Now& now, std::string_view bytes, session::Output& out) override {
    bytes_received += bytes.size();
    on_receive(now, bytes, out);
  }
  void step(const Now& now, session::Output& out) override { on_step(now, out); }
  SteadyTime nextStep() const override { return next_step; }
  void stoodStill(const Now&, session::Output&) override { log.add("session stood still"); }
  void leave(const Now& now, session::Output& out) override { on_leave(now, out); }
  bool hasLeft() const override { return has_left; }

  Log& log;
  SteadyTime next_step = SteadyTime::max();
  bool has_left = true;
  std::atomic<std::size_t> bytes_received{0};
  std::function<void(const Now&, session::Output&)> on_connected = [](auto&, auto&) {};
  std::function<void(const Now&, std::string_view, session::Output&)> on_receive = [](auto&, auto,
                                                                                      auto&) {};
  std::function<void(const Now&, session::Output&)> on_step = [](auto&, auto&) {};
  std::function<void(const Now&, session::Output&)> on_leave = [](auto&, auto&) {};
};

struct FakeListener : Listener {
  explicit FakeListener(Log& kept) : log(kept) {}

  void onConnected(const Now&, const std::string& endpoint) override {
    log.add("connected to " + endpoint);
    connects++;
  }
  void onDisconnected(const Now&, const std::string& reason) override {
    log.add("disconnected: " + reason);
  }
  void onConnectFailed(const Now&, const std::string& reason,
                       std::chrono::milliseconds retry_in) override {
    last_retry_ms = retry_in.count();
    log.add("failed: " + reason);
    failures++;
  }
  void onHeard(const Now&, std::string_view line) override {
    log.add("heard " + std::string(line));
  }
  void onSent(const Now&, std::string_view line) override { log.add("sent " + std::string(line)); }
  void onEvent(const Now&, const vehicle::Event& event) override {
    log.add("event " + std::to_string(event.index()));
  }
  void onTick(const Now& now) override {
    const std::lock_guard<std::mutex> lock(mutex);
    ticks.push_back(now.steady);
  }

  Log& log;
  std::atomic<std::size_t> connects{0};
  std::atomic<std::size_t> failures{0};
  std::atomic<std::chrono::milliseconds::rep> last_retry_ms{0};
  std::mutex mutex;
  std::vector<SteadyTime> ticks;
};

inline Now systemNow() {
  const vehicle::UtcTime utc = std::chrono::system_clock::now().time_since_epoch();
  return {std::chrono::steady_clock::now(), utc, utc};
}

/// A driver for a host and port of this machine; not started.
struct Rig {
  Rig(const std::string& host, std::uint16_t port, Driver::Clock clock = systemNow)
      : driver(link::testing::quickOptions(host, port), session, listener, std::move(clock)) {}
  explicit Rig(const link::TcpClient::Options& options)
      : driver(options, session, listener, systemNow) {}

  Log log;
  FakeSession session{log};
  FakeListener listener{log};
  Driver driver;
};

/// A vehicle on a thread of its own.
class Vehicle {
 public:
  explicit Vehicle(std::uint16_t port = 0)
      : server_(io_, "127.0.0.1", port, log_), thread_([this] { io_.run(); }) {}
  ~Vehicle() {
    close();
    work_.reset();
    thread_.join();
  }

  std::uint16_t port() const { return server_.port(); }

  void send(std::string bytes) {
    call([this, bytes = std::move(bytes)] { server_.send(log_.connected.back(), bytes); });
  }
  void disconnect() {
    call([this] { server_.disconnect(log_.connected.back()); });
  }
  void close() {
    call([this] { server_.close(); });
  }
  std::string received() {
    std::string found;
    call([&] { found = log_.received; });
    return found;
  }
  std::size_t clients() {
    std::size_t found = 0;
    call([&] { found = log_.connected.size(); });
    return found;
  }

 private:
  /// Runs on the vehicle's thread, and waits for that.
  void call(const std::function<void()>& function) {
    std::packaged_task<void()> task(function);
    auto done = task.get_future();
    boost::asio::post(io_, [&task] { task(); });
    done.wait();
  }

  boost::asio::io_context io_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
      io_.get_executor()};
  link::testing::ServerLog log_;
  link::TcpServer server_;
  std::thread thread_;
};

}  // namespace frontseat_driver::driver::testing
