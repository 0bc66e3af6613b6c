#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "frontseat_driver/vehicle/clock.h"
#include "messages.h"

namespace frontseat_driver::sim {

/// Who is connected to a drone, and who is in control of it.
class BlueyeClients {
 public:
  /// Registers a client; the first that is no observer gets control. Returns its number, 1 or more.
  std::uint32_t connect(const bp::ClientInfo& info, vehicle::UtcTime now);

  /// Takes a client off; the next in order that is no observer is promoted. False: not connected.
  bool disconnect(std::uint32_t client, vehicle::UtcTime now);

  /// A watchdog came; 0 is a client that does not know its number yet.
  void pet(std::uint32_t client, vehicle::UtcTime now);

  /// Takes off the client in control if its watchdog is overdue. True if it was.
  bool drop(vehicle::UtcTime now, vehicle::UtcTime timeout);

  /// Whether somebody who may says that all is well, so that thrusters may turn.
  bool armed(vehicle::UtcTime now, vehicle::UtcTime timeout) const;

  std::uint32_t inControl() const { return in_control_; }  ///< 0: nobody
  std::vector<bp::ConnectedClient> list() const;

 private:
  void promote(vehicle::UtcTime now);

  struct Client {
    bp::ClientInfo info;
    vehicle::UtcTime heard;
  };
  std::map<std::uint32_t, Client> clients_;
  std::uint32_t last_ = 0;
  std::uint32_t in_control_ = 0;
  vehicle::UtcTime control_heard_{};
  bool petted_ = false;  ///< since it is in control
  vehicle::UtcTime anonymous_heard_{};
  bool anonymous_ = false;
};

}  // namespace frontseat_driver::sim
