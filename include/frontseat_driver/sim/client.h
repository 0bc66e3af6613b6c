#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "frontseat_driver/nmea/framer.h"
#include "frontseat_driver/sim/faults.h"
#include "frontseat_driver/sim/random.h"

namespace frontseat_driver::sim {

using ClientId = std::uint64_t;

/// One connection to a simulated frontseat: what it asked for, and what is on its way to it.
class Client {
 public:
  /// `seed` decides this client's faults.
  Client(ClientId client, const Faults& faults, Random random)
      : id(client), faults_(&faults), random_(random) {}

  const ClientId id;
  nmea::Framer framer;
  std::string unread;        ///< bytes a slow reader has not read yet
  std::uint32_t logged = 0;  ///< a bit for every sentence asked for
  bool ignored = false;      ///< a second client of a vehicle that knows one only

  /// Queues one finished sentence, lost or spoilt as the faults want it.
  void queue(std::string_view sentence);

  /// Takes off what leaves now: everything, or with `split` a random part of it.
  std::string_view outgoing();
  void sent();  ///< outgoing() has left
  void lose();  ///< all that is queued is lost

 private:
  const Faults* faults_;
  Random random_;
  std::string queued_;
  std::size_t leaving_ = 0;
};

}  // namespace frontseat_driver::sim
