#pragma once

#include <optional>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::capture {

enum class Direction { FromVehicle, ToVehicle };

/// One line of a record.
struct Entry {
  std::optional<vehicle::UtcTime> time;  ///< when it was recorded, where the record says so
  std::optional<Direction> direction;    ///< where the record tells it
  std::string_view line;                 ///< from the `$` on, without the line end
};

}  // namespace frontseat_driver::capture
