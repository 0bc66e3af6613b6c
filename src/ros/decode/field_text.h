#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/nmea/values.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::decode {

// Each puts its text at the end of `out`. No locale has a say.

void appendInteger(std::string& out, std::int64_t value);

/// The shortest decimal text that reads back as the same double.
void appendNumber(std::string& out, double value);

/// So many decimals, at most 9; for magnitudes up to a million.
void appendFixed(std::string& out, double value, int decimals);

/// 12:00:00.123, or six decimals where they are not zeros; a leap second is 23:59:60.
void appendClock(std::string& out, nmea::TimeOfDay time);

/// Seconds with the decimals that are not zeros.
void appendSeconds(std::string& out, std::chrono::nanoseconds time);

/// 2014-11-19T15:13:20.123456Z
void appendUtc(std::string& out, vehicle::UtcTime time);

/// 2014-11-19
void appendDate(std::string& out, const nmea::Date& date);

/// Bytes that are no printable ASCII as \xhh and the backslash twice, so that no record can play
/// tricks on a terminal.
void appendVisible(std::string& out, std::string_view text);
std::string visible(std::string_view text);

}  // namespace frontseat_driver::decode
