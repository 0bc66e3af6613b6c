#pragma once

#include <chrono>

#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::vehicle {

/// The moment nearest to `near` at which a UTC clock shows `time_of_day` (since midnight, up to and
/// including a leap second). Right as long as both clocks agree within 12 hours, on either side of
/// midnight and in either order.
UtcTime resolveDate(std::chrono::microseconds time_of_day, UtcTime near);

/// Time since the last UTC midnight.
std::chrono::microseconds timeOfDay(UtcTime utc);

/// Midnight at the beginning of a calendar day, year 1970 or later.
UtcTime midnightOf(int year, int month, int day);

}  // namespace frontseat_driver::vehicle
