#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/session/session.h"

namespace frontseat_driver::driver {

/// What a driver reports, all from its one thread.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void onConnected(const vehicle::Now& now, const std::string& endpoint) = 0;
  virtual void onDisconnected(const vehicle::Now& now, const std::string& reason) = 0;
  virtual void onConnectFailed(const vehicle::Now& now, const std::string& reason,
                               std::chrono::milliseconds retry_in) = 0;
  virtual void onHeard(const vehicle::Now& now, std::string_view line) = 0;
  virtual void onSent(const vehicle::Now& now, std::string_view line) = 0;
  virtual void onEvent(const vehicle::Now& now, const vehicle::Event& event) = 0;
  virtual void onTick(const vehicle::Now& now) = 0;  ///< once a second, connected or not
};

/// Runs one link and one session on one thread of its own. Nothing else touches the session.
class Driver {
 public:
  /// Reads the three clocks; called once per read and per step.
  using Clock = std::function<vehicle::Now()>;

  /// Session and listener must outlive the driver.
  Driver(link::TcpClient::Options options, session::Session& session, Listener& listener,
         Clock clock);

  /// Stops, if that has not been done.
  ~Driver();

  /// Starts the thread; connecting begins there.
  void start();

  /// Ends any wait, closes the connection in order, and joins the thread. Within 100 ms.
  void stop();

  /// Runs `task` on the driver's thread, then a step of the session. Tasks run in order.
  void post(std::function<void(const vehicle::Now&)> task);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::driver
