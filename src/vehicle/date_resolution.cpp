#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::vehicle {

namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr nanoseconds kDay = 24h;

nanoseconds::rep floorDivide(nanoseconds dividend, nanoseconds divisor) {
  const nanoseconds::rep quotient = dividend / divisor;
  return dividend % divisor < nanoseconds::zero() ? quotient - 1 : quotient;
}

}  // namespace

UtcTime resolveDate(std::chrono::microseconds time_of_day, UtcTime near) {
  // The midnight before it is the one nearest to near - time_of_day.
  return floorDivide(near - time_of_day + kDay / 2, kDay) * kDay + time_of_day;
}

std::chrono::microseconds timeOfDay(UtcTime utc) {
  return std::chrono::duration_cast<std::chrono::microseconds>(utc - floorDivide(utc, kDay) * kDay);
}

UtcTime midnightOf(int year, int month, int day) {
  // Days since 1970-01-01 in the Gregorian calendar, counted in years that begin in March, so that
  // the leap day is the last of its year.
  const int march_year = month > 2 ? year : year - 1;
  const int march_month = month > 2 ? month - 3 : month + 9;
  const int leap_days = march_year / 4 - march_year / 100 + march_year / 400;
  const int day_of_year = (153 * march_month + 2) / 5 + day - 1;
  constexpr int kDaysBefore1970 = 719468;  // from 0000-03-01
  return (365 * march_year + leap_days + day_of_year - kDaysBefore1970) * kDay;
}

}  // namespace frontseat_driver::vehicle
