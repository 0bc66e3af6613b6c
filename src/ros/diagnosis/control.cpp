#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

const char* name(vehicle::Grant grant) {
  switch (grant) {
    case vehicle::Grant::Denied:
      return "denied";
    case vehicle::Grant::Granted:
      return "granted";
    case vehicle::Grant::Unknown:
      break;
  }
  return "unknown";
}

const char* whatToDo(const Health& health) {
  if (health.control_hook == session::ControlHook::Mis) return "start the vehicle's mission";
  if (health.control.grant == vehicle::Grant::Denied) {
    return "start its mission, with allowDynamicRequests on in the mission file";
  }
  return "it is sent on change only: start the mission, with CTL in log_sentences, or set "
         "control_hook for a vehicle that tells it otherwise";
}

}  // namespace

// That the user closed the gate, or that the vehicle keeps control while nobody wants it, is
// normal; whoever commands against it is told in the log.
Diagnosis diagnoseControl(const Health& health) {
  Diagnosis diagnosis;
  const std::string reason{health.control.reason};
  const bool told = !health.dialect.empty() && !health.other_dialect_only &&
                    health.control.commands_enabled && !health.replay;
  if (reason.empty()) {
    diagnosis.message = "the vehicle takes commands";
  } else if (told && !health.refused_command.empty()) {
    diagnosis.level = Diagnosis::Level::Warn;
    diagnosis.message = "commands come in and are refused: " + reason + "; " + whatToDo(health);
  } else {
    diagnosis.message = reason;
  }
  diagnosis.values = {{"grant", name(health.control.grant)},
                      {"commands enabled", health.control.commands_enabled ? "True" : "False"}};
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
