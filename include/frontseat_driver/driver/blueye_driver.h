#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "frontseat_driver/link/zmq_client.h"
#include "frontseat_driver/session/blueye_session.h"

namespace frontseat_driver::driver {

/// What a BlueyeDriver reports, all from its one thread. A call must return soon and must not
/// throw. What the drone says goes from the session to its own listener.
class BlueyeLinkListener {
 public:
  virtual ~BlueyeLinkListener() = default;
  virtual void onConnected(const vehicle::Now& now, const std::string& endpoint) = 0;
  virtual void onDisconnected(const vehicle::Now& now, const std::string& reason) = 0;
  virtual void onConnectFailed(const vehicle::Now& now, const std::string& reason) = 0;
  /// A control message that the link took.
  virtual void onControlSent(const vehicle::Now& now, std::string_view type,
                             std::string_view payload) = 0;
  virtual void onRequestSent(const vehicle::Now& now, std::string_view type,
                             std::string_view payload) = 0;
  virtual void onTick(const vehicle::Now& now) = 0;  ///< once a second, connected or not
};

/// Runs the link to one Blueye drone and its session on one thread of its own. Nothing else touches
/// either.
class BlueyeDriver {
 public:
  /// Reads the three clocks. `steady` must be the time of std::chrono::steady_clock.
  using Clock = std::function<vehicle::Now()>;

  /// Session and listener must outlive the driver.
  BlueyeDriver(link::ZmqClient::Options options, session::BlueyeSession& session,
               BlueyeLinkListener& listener, Clock clock);

  /// Stops, if that has not been done.
  ~BlueyeDriver();

  /// Starts the thread; connecting begins there. Only the first call has an effect, and none after
  /// stop().
  void start();

  /// Lets the session say its last words, closes the connections and joins the thread: within
  /// 200 ms, unless a callback or a name server holds it up. May be called from any thread but the
  /// driver's own, and again.
  void stop();

  /// Runs `task` on the driver's thread, then a step of the session. From any thread; tasks run in
  /// order. Those posted after stop() has begun never run.
  void post(std::function<void(const vehicle::Now&)> task);

  /// Where the session's output goes. Use it on the driver's thread only.
  session::BlueyeOutput& output();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::driver
