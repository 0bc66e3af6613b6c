#include "stamper.h"

#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using vehicle::Now;
using vehicle::TimeOfDay;

// 2014-12-31 00:00 UTC, `date -u -d 2014-12-31 +%s`.
constexpr std::chrono::seconds kMidnight{1419984000};

/// ROS time runs 1000 s behind the system clock here, as it may in a replay.
Now arrivalAt(std::chrono::nanoseconds time_of_day) {
  Now now;
  now.utc = kMidnight + time_of_day;
  now.stamp = now.utc - 1000s;
  return now;
}

ros::Time timeAt(std::chrono::nanoseconds time_of_day) {
  ros::Time out;
  out.fromNSec(
      static_cast<std::uint64_t>(std::chrono::nanoseconds(kMidnight + time_of_day).count()));
  return out;
}

struct Stamped {
  const char* name;
  StampMode mode;
  std::chrono::seconds leap_seconds;
  TimeScale scale;
  std::optional<TimeOfDay> measured_at;
  std::chrono::nanoseconds arrival;
  std::chrono::nanoseconds stamp;  ///< since kMidnight
};

const Stamped kStamped[] = {
    {"receive_is_arrival", StampMode::Receive, 0s, TimeScale::Vehicle, 11h, 12h, 12h - 1000s},
    {"synced_falls_back_to_arrival", StampMode::Synced, 18s, TimeScale::Vehicle, 11h, 12h,
     12h - 1000s},
    {"vehicle", StampMode::Vehicle, 0s, TimeScale::Vehicle, 11h + 250ms, 12h, 11h + 250ms},
    {"vehicle_in_gps_time", StampMode::Vehicle, 18s, TimeScale::Vehicle, 12h, 12h, 12h - 18s},
    {"receiver_in_utc", StampMode::Vehicle, 18s, TimeScale::Utc, 12h, 12h, 12h},
    {"vehicle_blank", StampMode::Vehicle, 18s, TimeScale::Vehicle, {}, 12h, 12h - 1000s},
    {"sent_before_midnight", StampMode::Vehicle, 0s, TimeScale::Vehicle, 23h + 59min + 59s, 1s,
     -1s},
    {"vehicle_ahead_over_midnight", StampMode::Vehicle, 0s, TimeScale::Vehicle, 1s, 24h - 1s,
     24h + 1s},
    {"gps_time_over_midnight", StampMode::Vehicle, 18s, TimeScale::Vehicle, 5s, 24h - 12s,
     24h - 13s},
    {"gps_time_after_midnight", StampMode::Vehicle, 18s, TimeScale::Vehicle, 5s, 1s, -13s},
    {"leap_second", StampMode::Vehicle, 0s, TimeScale::Vehicle, 24h, 24h, 24h},
};

class StampedData : public testing::TestWithParam<Stamped> {};

TEST_P(StampedData, IsStamped) {
  Stamper stamper(GetParam().mode);
  stamper.setLeapSeconds(GetParam().leap_seconds);
  EXPECT_EQ(stamper.stamp(GetParam().measured_at, GetParam().scale, arrivalAt(GetParam().arrival)),
            timeAt(GetParam().stamp));
}

INSTANTIATE_TEST_SUITE_P(Table, StampedData, testing::ValuesIn(kStamped),
                         [](const auto& row) { return std::string{row.param.name}; });

/// The vehicle's clock is three hours behind this computer's, a GPS receiver's 18 s ahead of it.
class Synced : public testing::Test {
 protected:
  Synced() {
    stamper_.take(9h, TimeScale::Vehicle, arrivalAt(12h));
    stamper_.take(12h + 18s, TimeScale::Utc, arrivalAt(12h));
  }

  Stamper stamper_{StampMode::Synced};
};

TEST_F(Synced, EachClockHasItsOwnOffset) {
  const Now arrival = arrivalAt(12h + 1s);
  EXPECT_EQ(stamper_.stamp(9h + 900ms, TimeScale::Vehicle, arrival), timeAt(12h + 900ms - 1000s));
  EXPECT_EQ(stamper_.stamp(12h + 18s + 500ms, TimeScale::Utc, arrival),
            timeAt(12h + 500ms - 1000s));
  EXPECT_EQ(stamper_.clock().offset, 3h - 1000s);
}

TEST_F(Synced, StampsAreNotLaterThanTheArrival) {
  EXPECT_EQ(stamper_.stamp(9h + 1100ms, TimeScale::Vehicle, arrivalAt(12h + 1s)),
            timeAt(12h + 1s - 1000s));
}

TEST_F(Synced, ATimeThatIsMuchTooOldIsNotBelieved) {
  const Now arrival = arrivalAt(12h + 50s);
  EXPECT_EQ(stamper_.stamp(9h + 20s + 1us, TimeScale::Vehicle, arrival),
            timeAt(12h + 20s + 1us - 1000s));
  EXPECT_EQ(stamper_.stamp(9h + 20s, TimeScale::Vehicle, arrival), timeAt(12h + 50s - 1000s));
}

TEST(OwnTime, IsOnTheRosClock) {
  EXPECT_EQ(Stamper(StampMode::Receive).ownTime(12h, arrivalAt(12h + 1s)), timeAt(12h - 1000s));
}

TEST(OwnTime, OnTheVehiclesClockHasNoLeapSeconds) {
  Stamper stamper(StampMode::Vehicle);
  stamper.setLeapSeconds(18s);
  EXPECT_EQ(stamper.ownTime(12h, arrivalAt(12h + 1s)), timeAt(12h));
}

TEST(OwnTime, FromBeforeMidnightIsOfTheDayBefore) {
  EXPECT_EQ(Stamper(StampMode::Vehicle).ownTime(24h - 1s, arrivalAt(1s)), timeAt(-1s));
}

TEST(StampGuard, HoldsTheLastStampWhileTimeGoesBack) {
  StampGuard guard;
  EXPECT_EQ(guard.clamp(ros::Time(10)), ros::Time(10));
  EXPECT_EQ(guard.clamp(ros::Time(9)), ros::Time(10));
  EXPECT_EQ(guard.clamp(ros::Time(10)), ros::Time(10));
  EXPECT_EQ(guard.clamp(ros::Time(11)), ros::Time(11));
}

TEST(StampGuard, AdvancesOnLaterStampsOnly) {
  StampGuard guard;
  EXPECT_TRUE(guard.advances(ros::Time(10)));
  EXPECT_FALSE(guard.advances(ros::Time(10)));
  EXPECT_FALSE(guard.advances(ros::Time(9)));
  EXPECT_TRUE(guard.advances(ros::Time(10, 1)));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
