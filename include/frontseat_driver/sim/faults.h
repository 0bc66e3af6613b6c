#pragma once

namespace frontseat_driver::sim {

/// What goes wrong between vehicle and payload, on purpose. Times are those of the vehicle.
struct Faults {
  double drop = 0.0;                ///< probability that a sentence is lost
  double corrupt = 0.0;             ///< probability that a byte of a sentence changes on the way
  bool split = false;               ///< sentences leave in random pieces
  double stall_s = 0.0;             ///< so long a silence, in which all that is sent is lost,
  double stall_every_s = 0.0;       ///< begins so often; 0: never
  double disconnect_every_s = 0.0;  ///< all connections end so often; 0: never
  bool withhold_acks = false;       ///< commands are obeyed, not acknowledged
  double delay_acks_s = 0.0;        ///< acknowledgements come so late
  bool lie = false;                 ///< commands are acknowledged as done, not obeyed
};

}  // namespace frontseat_driver::sim
