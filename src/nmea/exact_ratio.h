#pragma once

#include <string_view>

namespace frontseat_driver::nmea {

/// The double nearest to `digits` x 10^`exponent`, ties to even; infinite if it is too large.
/// `digits` are decimal digits of any number, with at most one point, which is passed over.
///
/// This is the slow and exact way, for what toDouble() cannot do in one division: more than 53 bits
/// of digits, or an exponent. No vehicle is known to send such.
double nearestDouble(std::string_view digits, int exponent);

}  // namespace frontseat_driver::nmea
