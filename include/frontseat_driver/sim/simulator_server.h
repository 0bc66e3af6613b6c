#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "frontseat_driver/sim/frontseat.h"

namespace frontseat_driver::sim {

/// Where a simulated vehicle is reached, and how fast its time goes.
struct ServerConfig {
  std::string bind = "127.0.0.1";
  std::uint16_t port = 29500;  ///< 0: the system chooses
  double speed = 1.0;          ///< seconds of the vehicle per second, > 0
};

/// Runs a frontseat behind a TCP server on a thread of its own, in real time times a factor. A
/// machine that cannot keep up, or sleeps, makes the vehicle's time slow, never its steps long.
class SimulatorServer {
 public:
  /// Called on the server's thread at each navigation instant, before the sentence leaves.
  using OnTruth = std::function<void(const Truth&)>;

  /// Listens at once; throws std::system_error (or boost::system::system_error) when that fails.
  SimulatorServer(std::unique_ptr<Frontseat> frontseat, const ServerConfig& config,
                  OnTruth on_truth = {});
  ~SimulatorServer();
  SimulatorServer(const SimulatorServer&) = delete;
  SimulatorServer& operator=(const SimulatorServer&) = delete;

  void start();
  /// Ends all connections in order and joins the thread. Nothing is called after it.
  void stop();

  std::uint16_t port() const;

  /// Has `action` called with the frontseat on the server's thread, soon; from any thread.
  void post(std::function<void(Frontseat&)> action);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::sim
