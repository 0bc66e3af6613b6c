#include "diagnosis/diagnosis.h"

namespace frontseat_driver::ros_layer {

namespace {

// A command is repeated five times in that, and a vehicle soon gives up on one it does not hear.
constexpr double kHeldBackLong_s = 1.0;

void judge(const Health& health, Diagnosis& diagnosis) {
  const bool free = health.control.reason.empty() && !health.replay;
  diagnosis.level = Diagnosis::Level::Warn;
  if (!health.vehicle_refusal.empty()) {
    diagnosis.message = "the vehicle refuses what is sent: " + health.vehicle_refusal +
                        "; is it within the limits of its mission, and within its safe depth?";
  } else if (health.held_back_s >= kHeldBackLong_s) {
    diagnosis.message = printed(
        "no command has gone out for %.1f s: the link still holds what it was given before. Only "
        "the newest command waits; is the radio link good, does other traffic fill it, and does "
        "the vehicle still read?",
        health.held_back_s);
  } else if (!health.effect_complaint.empty()) {
    diagnosis.message = "the vehicle does not do what it is told: " + health.effect_complaint +
                        "; look for weeds, a kill switch, manual or radio control, and a mission "
                        "that does not let it";
  } else if (free && health.commanded.empty() && !health.refused_command.empty()) {
    diagnosis.message = "commands come in, and the driver can send none: " + health.refused_command;
  } else {
    diagnosis.level = Diagnosis::Level::Ok;
    diagnosis.message =
        health.commanded.empty() ? "nothing is commanded" : "commanding " + health.commanded;
  }
}

}  // namespace

Diagnosis diagnoseCommands(const Health& health) {
  Diagnosis diagnosis;
  judge(health, diagnosis);
  diagnosis.values = {{"commanded", health.commanded},
                      {"refused by the driver", std::to_string(health.counters.refused_commands)},
                      {"held back by the link", printed("%.1f s", health.held_back_s)},
                      {"sent and not acknowledged", std::to_string(health.unacknowledged)}};
  return diagnosis;
}

}  // namespace frontseat_driver::ros_layer
