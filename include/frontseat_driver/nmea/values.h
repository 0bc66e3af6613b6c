#pragma once

#include <chrono>

namespace frontseat_driver::nmea {

/// Time since midnight, of UTC or of whatever clock the sentence carries. A leap second at the end
/// of the day reads 24 h exactly or later.
using TimeOfDay = std::chrono::microseconds;

/// WGS-84 degrees, north and east positive.
struct LatLon {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

inline bool operator==(const LatLon& a, const LatLon& b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg;
}

/// Where ddmm.mmm is split into degrees and minutes. Well-formed fields read the same either way.
enum class DegreeSplit {
  FromLeft,  ///< two digits of latitude, three of longitude: Sandsharks do not pad the minutes
  FromPoint  ///< two digits of minutes before the point: Herons drop leading zeros of the degrees
};

/// A calendar date as RMC carries it.
struct Date {
  int year = 0;   ///< four digits
  int month = 0;  ///< 1..12
  int day = 0;    ///< 1..31
};

inline bool operator==(const Date& a, const Date& b) {
  return a.year == b.year && a.month == b.month && a.day == b.day;
}

}  // namespace frontseat_driver::nmea
