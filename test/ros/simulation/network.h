#pragma once

#include <functional>
#include <string>

#include "back_off.h"
#include "closed_loop.h"
#include "frontseat_driver/link/tcp_client.h"
#include "supervised.h"

namespace frontseat_driver::simulation {

using closed_loop::Duration;

/// The driver's side of the network in virtual time, as link::TcpClient behaves: an attempt that is
/// refused or runs into its time-out, the back-off between attempts, and a connection that is given
/// up after silence or when a sentence could be sent only in part.
class Network {
 public:
  /// What answers a vehicle's port.
  enum class Host { Listens, Refuses, IsNotThere };

  Network(closed_loop::ClosedLoop& loop, closed_loop::Supervised& supervised,
          const link::TcpClient::Options& options);

  void setHost(Host host) { host_ = host; }

  /// The connection ends now, as after a reset.
  void reset() { supervised_.disconnect(); }
  /// At the next chance, as when the kernel takes half a sentence.
  void breakSoon();
  /// The vehicle's host answers what it knows nothing of with a reset, at this time.
  void resetAt(Duration at);

  /// When act() has something to do.
  Duration next() const;
  void act();

  /// The program has gone and comes back.
  void setRunning(bool running);

  std::uint64_t connects() const { return connects_; }
  std::uint64_t failures() const { return failures_; }

 private:
  enum class State { BackingOff, Connecting, Connected, Off };

  void attempt();
  void lost();
  void retry();

  closed_loop::ClosedLoop& loop_;
  closed_loop::Supervised& supervised_;
  const link::TcpClient::Options options_;
  link::BackOff back_off_;
  Host host_ = Host::Listens;
  State state_ = State::BackingOff;
  Duration due_{0};
  Duration last_byte_{0};
  Duration breaks_at_;
  std::uint64_t connects_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace frontseat_driver::simulation
