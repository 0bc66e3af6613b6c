#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "frontseat_driver/sim/blueye/drone.h"

namespace frontseat_driver::sim {

/// Where a simulated Blueye drone is reached, and how fast its time goes. Port 0: the system
/// chooses.
struct BlueyeServerConfig {
  std::string bind = "127.0.0.1";       ///< an IPv4 or IPv6 address in numbers
  std::uint16_t telemetry_port = 5555;  ///< ZeroMQ PUB
  std::uint16_t request_port = 5556;    ///< ZeroMQ, answers REQ
  std::uint16_t control_port = 5557;    ///< ZeroMQ SUB
  std::uint16_t http_port = 80;         ///< where clients ask; may take privileges
  bool http = true;
  bool http_optional = false;  ///< go on without HTTP if its port cannot be had
  double speed = 1.0;          ///< seconds of the drone per second, > 0
};

/// Runs a drone behind its sockets on a thread of its own, in real time times a factor. A machine
/// that cannot keep up, or sleeps, makes the drone's time slow, never its steps long.
class BlueyeServer {
 public:
  /// Called on the server's thread, 20 times a second of the drone.
  using OnTruth = std::function<void(const Truth&)>;

  /// Binds at once; throws std::runtime_error, which names the address, when that fails.
  BlueyeServer(const BlueyeConfig& drone, const BlueyeServerConfig& config, OnTruth on_truth = {});
  ~BlueyeServer();
  BlueyeServer(const BlueyeServer&) = delete;
  BlueyeServer& operator=(const BlueyeServer&) = delete;

  void start();
  /// Closes all sockets and joins the thread. Nothing is called after it.
  void stop();

  std::uint16_t telemetryPort() const;
  std::uint16_t requestPort() const;
  std::uint16_t controlPort() const;
  std::uint16_t httpPort() const;  ///< 0: there is none
  /// Why there is no HTTP though there should be; empty otherwise.
  std::string httpProblem() const;

  /// Messages that did not have two frames.
  std::uint64_t malformed() const;

  /// Has `action` called with the drone on the server's thread, soon; from any thread.
  void post(std::function<void(BlueyeDrone&)> action);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::sim
