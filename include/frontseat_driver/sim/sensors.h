#pragma once

#include "frontseat_driver/nmea/values.h"
#include "frontseat_driver/sim/random.h"
#include "frontseat_driver/sim/vehicle_model.h"

namespace frontseat_driver::sim {

/// What the instruments of a vehicle read: the truth, or the truth with errors from a seed.
class Sensors {
 public:
  /// `noise` false: readings are the truth.
  Sensors(Random random, bool noise) : random_(random), noise_(noise) {}

  struct Reading {
    nmea::LatLon position;
    VehicleState state;  ///< with errors, consistent within one reading only
  };

  /// One reading of everything, `dt_s` after the one before.
  Reading read(const VehicleModel& model, double dt_s);

 private:
  double white(double sigma) { return sigma * random_.normal(); }
  void spoil(VehicleState& state, double dt_s);

  Random random_;
  bool noise_;
  Wander east_{0.4, 60.0};
  Wander north_{0.4, 60.0};
  Wander heading_{0.007, 40.0};
};

}  // namespace frontseat_driver::sim
