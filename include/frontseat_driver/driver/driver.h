#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/session/session.h"

namespace frontseat_driver::driver {

/// What a driver reports, all from its one thread. A call must return soon, since the vehicle waits
/// meanwhile, and must not throw: an exception ends the process (std::terminate, which prints it).
class Listener {
 public:
  virtual ~Listener() = default;
  /// Comes before everything that belongs to the connection; `endpoint` is numeric.
  virtual void onConnected(const vehicle::Now& now, const std::string& endpoint) = 0;
  /// Comes after everything that belongs to the connection.
  virtual void onDisconnected(const vehicle::Now& now, const std::string& reason) = 0;
  virtual void onConnectFailed(const vehicle::Now& now, const std::string& reason,
                               std::chrono::milliseconds retry_in) = 0;
  /// A line that starts with `$`, without its line end, not yet checked.
  virtual void onHeard(const vehicle::Now& now, std::string_view line) = 0;
  /// A sentence that the kernel took for the vehicle, without its line end.
  virtual void onSent(const vehicle::Now& now, std::string_view line) = 0;
  virtual void onEvent(const vehicle::Now& now, const vehicle::Event& event) = 0;
  virtual void onTick(const vehicle::Now& now) = 0;  ///< once a second, connected or not
};

/// Runs one link and one session on one thread of its own. Nothing else touches the session.
class Driver {
 public:
  /// Reads the three clocks; called once per read and per step, and again before the step if the
  /// work before it took longer than 0.1 s. `steady` must be the time of std::chrono::steady_clock,
  /// which the driver's timers run on.
  using Clock = std::function<vehicle::Now()>;

  /// Session and listener must outlive the driver.
  Driver(link::TcpClient::Options options, session::Session& session, Listener& listener,
         Clock clock);

  /// Stops, if that has not been done.
  ~Driver();

  /// Starts the thread; connecting begins there. Only the first call has an effect, and none after
  /// stop().
  void start();

  /// Lets the session say its last words, ends any wait, closes the connection in order, and joins
  /// the thread. Within 100 ms, unless a callback holds it up. May be called from any thread but
  /// the driver's own, at any time, and again. If there was a connection, the session and the
  /// listener are told that it ended; after that neither is called again.
  void stop();

  /// Runs `task` on the driver's thread, then a step of the session. From any thread; tasks run in
  /// order. Those posted before start() run at the start, those after stop() has begun never.
  void post(std::function<void(const vehicle::Now&)> task);

  /// Where the session's output goes: what a posted task hands to the session. Use it on the
  /// driver's thread only.
  session::Output& output();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::driver
