#pragma once

#include "frontseat_driver/nmea/values.h"
#include "frontseat_driver/sim/vehicle_state.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::sim {

/// The truth at the instant of a navigation solution.
struct Truth {
  vehicle::UtcTime stamp{};  ///< UTC by the vehicle's clock
  nmea::LatLon position;
  VehicleState state;
};

}  // namespace frontseat_driver::sim
