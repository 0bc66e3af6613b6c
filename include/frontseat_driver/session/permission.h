#pragma once

#include <optional>
#include <string_view>

#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// What tells that the backseat may command a Sandshark.
enum class ControlHook {
  Ctl,  ///< BFCTL 1
  Mis,  ///< BFMIS Running
  None  ///< nothing: always granted
};

/// Whether a command would be obeyed now. `reason` says in words why not, and is empty otherwise;
/// it has static storage.
struct ControlState {
  vehicle::Grant grant = vehicle::Grant::Unknown;
  bool commands_enabled = true;
  bool commanding = false;
  std::string_view reason;
};

inline bool operator==(const ControlState& a, const ControlState& b) {
  return a.grant == b.grant && a.commands_enabled == b.commands_enabled &&
         a.commanding == b.commanding && a.reason == b.reason;
}

/// Puts together what must hold for a command to be sent: a connection, a known dialect, the
/// vehicle's word, and the user's gate. After every connect the vehicle's word is unknown, and
/// unknown means no.
class Permission {
 public:
  Permission(ControlHook hook, bool commands_enabled);

  void connected();
  void disconnected();
  void setDialect(protocol::Dialect dialect);
  void setCommandsEnabled(bool enabled) { commands_enabled_ = enabled; }

  void take(const protocol::bluefin::BackseatControl& control);
  /// It sent a BFCTL whose word cannot be read: what it said before holds no more.
  void takeUnreadableControl();
  void take(vehicle::MissionStatus::State mission);

  bool granted() const { return state().reason.empty(); }
  ControlState state() const;

 private:
  vehicle::Grant grant() const;

  const ControlHook hook_;
  bool commands_enabled_;
  bool connected_ = false;
  std::optional<protocol::Dialect> dialect_;
  vehicle::Grant word_ = vehicle::Grant::Unknown;  ///< the vehicle's, on this connection
  bool unreadable_ = false;                        ///< that is why it is unknown
};

}  // namespace frontseat_driver::session
