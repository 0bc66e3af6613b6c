#include "frontseat_driver/session/permission.h"

namespace frontseat_driver::session {

using vehicle::Grant;

Permission::Permission(ControlHook hook, bool commands_enabled)
    : hook_(hook), commands_enabled_(commands_enabled) {}

void Permission::connected() {
  connected_ = true;
  word_ = Grant::Unknown;
  unreadable_ = false;
}

void Permission::disconnected() {
  connected_ = false;
  dialect_.reset();
  word_ = Grant::Unknown;
}

void Permission::setDialect(protocol::Dialect dialect) { dialect_ = dialect; }

void Permission::take(const protocol::bluefin::BackseatControl& control) {
  if (hook_ != ControlHook::Ctl || !control.backseat_in_control) return;
  word_ = *control.backseat_in_control ? Grant::Granted : Grant::Denied;
  unreadable_ = false;
}

void Permission::takeUnreadableControl() {
  if (hook_ != ControlHook::Ctl) return;
  word_ = Grant::Unknown;
  unreadable_ = true;
}

void Permission::take(vehicle::MissionStatus::State mission) {
  if (hook_ != ControlHook::Mis) return;
  const bool running = mission == vehicle::MissionStatus::State::Running;
  word_ = running ? Grant::Granted : Grant::Denied;
}

Grant Permission::grant() const {
  if (!connected_ || !dialect_) return Grant::Unknown;
  // A boat obeys any client (Kingfisher 0.1, section 2.3).
  const bool asks_nobody = *dialect_ == protocol::Dialect::Kingfisher || hook_ == ControlHook::None;
  return asks_nobody ? Grant::Granted : word_;
}

ControlState Permission::state() const {
  ControlState state;
  state.grant = grant();
  state.commands_enabled = commands_enabled_;
  const bool by_mission = hook_ == ControlHook::Mis;
  if (!connected_) {
    state.reason = "there is no connection to the vehicle";
  } else if (!dialect_) {
    state.reason = "the vehicle has not shown its dialect yet; parameter dialect sets it";
  } else if (!commands_enabled_) {
    state.reason = "the command gate is closed; service enable_commands opens it";
  } else if (state.grant == Grant::Unknown && unreadable_) {
    state.reason = "the vehicle's last BFCTL cannot be read";
  } else if (state.grant == Grant::Unknown) {
    state.reason = by_mission ? "the vehicle has sent no BFMIS since the connection was made"
                              : "the vehicle has sent no BFCTL since the connection was made";
  } else if (state.grant == Grant::Denied) {
    state.reason = by_mission ? "the vehicle's mission is not running (BFMIS)"
                              : "the vehicle keeps control (BFCTL 0)";
  }
  return state;
}

}  // namespace frontseat_driver::session
