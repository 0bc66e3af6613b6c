#include "parameter_kinds.h"

namespace frontseat_driver::sim {

void addFaultParameters(std::vector<Parameter>& all) {
  all.push_back(number(
      "drop", [](Config & c) -> auto& { return c.vehicle.faults.drop; }, 0, 1,
      "probability that a sentence is lost"));
  all.push_back(number(
      "corrupt", [](Config & c) -> auto& { return c.vehicle.faults.corrupt; }, 0, 1,
      "probability that a byte of a sentence changes"));
  all.push_back(flag(
      "split", [](Config & c) -> auto& { return c.vehicle.faults.split; },
      "sentences leave in random pieces"));
  all.push_back(number(
      "stall", [](Config & c) -> auto& { return c.vehicle.faults.stall_s; }, 0, kAny,
      "s of silence every `stall_every`"));
  all.push_back(number(
      "stall_every", [](Config & c) -> auto& { return c.vehicle.faults.stall_every_s; }, 0, kAny,
      "s from silence to silence; 0: never"));
  all.push_back(number(
      "disconnect_every", [](Config & c) -> auto& { return c.vehicle.faults.disconnect_every_s; },
      0, kAny, "s after which all connections end; 0: never"));
  all.push_back(flag(
      "withhold_acks", [](Config & c) -> auto& { return c.vehicle.faults.withhold_acks; },
      "sandshark: commands are obeyed, not acknowledged"));
  all.push_back(number(
      "delay_acks", [](Config & c) -> auto& { return c.vehicle.faults.delay_acks_s; }, 0, 3600,
      "sandshark: s that acknowledgements are late"));
  all.push_back(flag(
      "lie", [](Config & c) -> auto& { return c.vehicle.faults.lie; },
      "commands are acknowledged, not obeyed"));
}

}  // namespace frontseat_driver::sim
