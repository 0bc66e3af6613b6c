#include "frontseat_driver/vehicle/date_resolution.h"

#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::vehicle {
namespace {

using namespace std::chrono_literals;
using std::chrono::seconds;

// Seconds since 1970, from `date -u -d ... +%s`.
constexpr seconds kMidnight20141231{1419984000};
constexpr seconds kMidnight20150101{1420070400};
constexpr seconds kMidnight20160229{1456704000};

struct Resolved {
  const char* name;
  std::chrono::microseconds time_of_day;
  UtcTime near;
  UtcTime expected;
};

const Resolved kResolved[] = {
    {"same_day", 12h, kMidnight20141231 + 12h + 1s, kMidnight20141231 + 12h},
    {"vehicle_before_midnight_host_after", 23h + 59min + 59s, kMidnight20150101 + 1s,
     kMidnight20150101 - 1s},
    {"vehicle_after_midnight_host_before", 1s, kMidnight20150101 - 1s, kMidnight20150101 + 1s},
    {"eleven_hours_ahead", 11h, kMidnight20150101, kMidnight20150101 + 11h},
    {"eleven_hours_behind", 13h, kMidnight20150101, kMidnight20141231 + 13h},
    {"leap_second", 24h, kMidnight20150101, kMidnight20150101},
    {"leap_second_with_decimals", 24h + 500ms, kMidnight20150101 - 200ms,
     kMidnight20150101 + 500ms},
    {"gps_time_taken_off_before_midnight", 5s - 18s, kMidnight20150101 - 12s,
     kMidnight20150101 - 13s},
    {"clock_not_started", 1s, 0s, 1s},
    {"before_1970", 23h, 0s, -1h},
};

class Resolution : public testing::TestWithParam<Resolved> {};

TEST_P(Resolution, TakesTheNearestDay) {
  EXPECT_EQ(resolveDate(GetParam().time_of_day, GetParam().near), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Table, Resolution, testing::ValuesIn(kResolved),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(TimeOfDay, CountsFromMidnight) {
  EXPECT_EQ(timeOfDay(kMidnight20150101), 0s);
  EXPECT_EQ(timeOfDay(kMidnight20150101 + 16h + 250ms), 16h + 250ms);
  EXPECT_EQ(timeOfDay(kMidnight20150101 - 1ms), 24h - 1ms);
  EXPECT_EQ(timeOfDay(-1s), 24h - 1s);
}

TEST(Midnight, OfACalendarDay) {
  EXPECT_EQ(midnightOf(1970, 1, 1), 0s);
  EXPECT_EQ(midnightOf(2014, 12, 31), kMidnight20141231);
  EXPECT_EQ(midnightOf(2015, 1, 1), kMidnight20150101);
  EXPECT_EQ(midnightOf(2016, 2, 29), kMidnight20160229);
  EXPECT_EQ(midnightOf(2016, 3, 1), kMidnight20160229 + 24h);
}

}  // namespace
}  // namespace frontseat_driver::vehicle
