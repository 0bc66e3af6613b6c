#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <ostream>
#include <string>

#include "convert.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/session/nmea_session.h"
#include "vehicle_messages.h"

// From the time of day in a sentence to the stamp of what is published: which day, which second.

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

// Seconds since 1970, from `date -u -d ... +%s`.
constexpr std::chrono::seconds k20141231{1419984000};
constexpr std::chrono::seconds k20160229{1456704000};
constexpr std::chrono::seconds k20160301{1456790400};
constexpr std::chrono::seconds k20161231{1483142400};

struct Row {
  const char* name;
  Dialect dialect;
  const char* solution_time;  ///< of NVG; blank: the sentence's own
  const char* sentence_time;
  vehicle::UtcTime arrival;
  vehicle::UtcTime stamp;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

constexpr auto kShark = Dialect::Sandshark;
constexpr auto kBoat = Dialect::Kingfisher;

const Row kRows[] = {
    {"same_day", kShark, "115959.900", "120000.000", k20141231 + 12h + 50ms,
     k20141231 + 12h - 100ms},
    {"blank_solution_time", kShark, "", "120000.000", k20141231 + 12h + 50ms, k20141231 + 12h},
    {"solution_before_midnight_sentence_after", kShark, "235959.990", "000000.010",
     k20141231 + 24h + 20ms, k20141231 + 24h - 10ms},
    {"vehicle_before_midnight_host_after", kShark, "", "235959.500", k20141231 + 24h + 1s,
     k20141231 + 24h - 500ms},
    {"vehicle_after_midnight_host_before", kShark, "", "000000.500", k20141231 + 24h - 1s,
     k20141231 + 24h + 500ms},
    {"year_end_host_behind", kShark, "", "000001.000", k20161231 + 24h - 2s, k20161231 + 24h + 1s},
    {"leap_day_begins", kShark, "", "235959.000", k20160229 + 1s, k20160229 - 1s},
    {"leap_day_ends", kShark, "", "000000.000", k20160301 - 1s, k20160301},
    {"second_60_of_a_leap_second", kShark, "", "235960.000", k20161231 + 24h, k20161231 + 24h},
    {"second_60_with_decimals", kShark, "", "235960.250", k20161231 + 24h + 300ms,
     k20161231 + 24h + 250ms},
    {"second_60_by_rounding", kShark, "", "120060.000", k20141231 + 12h + 1min + 10ms,
     k20141231 + 12h + 1min},
    {"no_decimals", kShark, "", "120000", k20141231 + 12h, k20141231 + 12h},
    {"two_decimals", kShark, "", "120000.25", k20141231 + 12h + 1s, k20141231 + 12h + 250ms},
    {"three_decimals", kShark, "", "120000.125", k20141231 + 12h + 1s, k20141231 + 12h + 125ms},
    {"four_decimals", kShark, "", "120000.1234", k20141231 + 12h + 1s, k20141231 + 12h + 123400us},
    {"five_decimals", kShark, "", "120000.12345", k20141231 + 12h + 1s, k20141231 + 12h + 123450us},
    {"six_decimals", kShark, "", "120000.123456", k20141231 + 12h + 1s, k20141231 + 12h + 123456us},
    {"gps_time", kBoat, "", "120018.000", k20141231 + 12h + 50ms, k20141231 + 12h},
    {"gps_time_over_midnight_utc_not", kBoat, "", "000005.000", k20141231 + 24h - 12s,
     k20141231 + 24h - 13s},
    {"gps_time_at_a_year_end_host_behind", kBoat, "", "000018.500", k20161231 + 24h - 1s,
     k20161231 + 24h + 500ms},
};

class Dates : public testing::TestWithParam<Row>, private session::Output, private MessageOutlet {
 protected:
  /// The stamps of what came of one NVG, all the same.
  ros::Time hear(const std::string& body) {
    Parameters parameters;
    parameters.session.dialect = GetParam().dialect;
    parameters.session.listen_only = true;
    parameters.stamp = StampMode::Vehicle;
    messages_.emplace(parameters);
    session::NmeaSession session{parameters.session};
    const vehicle::UtcTime at = GetParam().arrival;
    const vehicle::Now now{vehicle::SteadyTime{at}, at, at};
    session.connected(now, *this);
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", nmea::checksum(body));
    session.receive(now, "$" + body + end, *this);
    return stamp_;
  }

  int published_ = 0;

 private:
  bool send(const vehicle::Now&, std::string_view) override { return false; }
  void heard(const vehicle::Now&, std::string_view) override {}
  void confirmed() override {}
  void event(const vehicle::Now& now, const vehicle::Event& event) override {
    messages_->take(now, event, *this);
  }
  bool wanted(VehicleTopic) const override { return true; }
  void publish(VehicleTopic topic, VehicleMessage message) override {
    if (topic == VehicleTopic::VehicleTime || topic == VehicleTopic::Control) return;
    const ros::Time stamp = std::visit([](const auto& any) { return any.header.stamp; }, message);
    if (published_++ > 0) {
      EXPECT_EQ(stamp, stamp_);
    }
    stamp_ = stamp;
  }

  std::optional<VehicleMessages> messages_;
  ros::Time stamp_;
};

TEST_P(Dates, OfPublishedStamps) {
  const Row& row = GetParam();
  const std::string talker = row.dialect == kShark ? "BF" : "CP";
  const ros::Time stamp =
      hear(talker + "NVG," + row.sentence_time +
           ",4221.0000,N,07106.0000,W,1,5.0,3.0,90.0,0.0,0.0," + row.solution_time);
  EXPECT_EQ(published_, 5);  // odom, tf, nav/fix, depth, altitude
  EXPECT_EQ(stamp, toRosTime(row.stamp));
}

INSTANTIATE_TEST_SUITE_P(Table, Dates, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::ros_layer
