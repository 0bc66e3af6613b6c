#include "capture_times.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "frontseat_driver/capture/text_reader.h"
#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using Times = std::vector<std::chrono::milliseconds>;

// 2014-12-31 00:00 UTC, `date -u -d 2014-12-31 +%s`.
constexpr std::chrono::seconds kDay{1419984000};

/// `time` as hhmmss.sss
std::string version(const std::string& time) {
  const std::string body = "BFVER," + time + ",SS_0.0";
  char end[8];
  std::snprintf(end, sizeof end, "*%02X\n", nmea::checksum(body));
  return "$" + body + end;
}

struct Row {
  const char* name;
  std::string start;
  std::string capture;
  Times since_day;  ///< 2014-12-31
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

const std::string kGps = "$GPVTG,,T,,M,,N,,K*4E\n";

const Row kRows[] = {
    {"date", "2014-12-31", version("120000.000") + version("120000.250"), {12h, 12h + 250ms}},
    {"moment",
     "2014-12-31T08:00:00Z",
     version("120000.000") + version("120000.250"),
     {8h, 8h + 250ms}},
    {"moment_far_from_the_vehicles_time",
     "2014-12-31T01:00:00Z",
     version("120000.000") + version("120000.250"),
     {1h, 1h + 250ms}},
    {"over_midnight_and_year",
     "2014-12-31",
     version("235959.900") + version("000000.100") + version("000001.00"),
     {24h - 100ms, 24h + 100ms, 24h + 1s}},
    {"leap_second",
     "2014-12-31",
     version("235959.900") + version("235960.500") + version("000001"),
     {24h - 100ms, 24h + 500ms, 24h + 1s}},
    {"a_gap_is_a_gap", "2014-12-31", version("120000.000") + version("130000.000"), {12h, 13h}},
    {"a_little_disorder_is_held",
     "2014-12-31",
     version("120000.500") + version("120000.400"),
     {12h + 500ms, 12h + 500ms}},
    {"a_clock_set_back_goes_on",
     "2014-12-31",
     version("120000.000") + version("080000.000") + version("080000.250"),
     {12h, 12h, 12h + 250ms}},
    {"a_clock_set_back_in_the_morning_goes_on",
     "2014-12-31",
     version("100000.000") + version("060000.000") + version("060000.250"),
     {10h, 10h, 10h + 250ms}},
    {"disorder_of_less_than_five_seconds_is_held",
     "2014-12-31",
     version("120006.000") + version("120001.500") + version("120006.250"),
     {12h + 6s, 12h + 6s, 12h + 6250ms}},
    {"more_is_a_clock_set_back",
     "2014-12-31",
     version("120007.000") + version("120001.000") + version("120001.250"),
     {12h + 7s, 12h + 7s, 12h + 7250ms}},
    {"without_a_time_as_the_one_before",
     "2014-12-31",
     kGps + version("120000.000") + kGps + version("120001.000"),
     {12h, 12h, 12h, 12h + 1s}},
    {"a_wrong_checksum_tells_no_time",
     "2014-12-31",
     version("120000.000") + "$BFVER,130000.000,SS_0.0*00\n" + version("120000.250"),
     {12h, 12h, 12h + 250ms}},
    {"no_times_at_all", "2014-12-31", kGps + kGps + kGps, {20ms, 40ms, 60ms}},
    {"times_in_front",
     "2000-01-01",
     "1419984001.5 " + version("120000.000") + "2014-12-31T00:00:02Z " + version("120001.000"),
     {1500ms, 2s}},
    {"times_in_front_never_go_back",
     "2000-01-01",
     "1419984002 " + version("120000.000") + "1419984001 " + kGps + kGps + "1419984003 " + kGps,
     {2s, 2s, 2s, 3s}},
};

class Capture : public testing::TestWithParam<Row> {};

std::unique_ptr<capture::TextReader> reader(const std::string& text) {
  return std::make_unique<capture::TextReader>(std::make_unique<capture::MemorySource>(text));
}

TEST_P(Capture, LinesGetTheirTimes) {
  const auto start = CaptureTimes::readStart(GetParam().start);
  ASSERT_TRUE(start);
  CaptureTimes times{firstTime(*reader(GetParam().capture)), *start};
  const auto lines = reader(GetParam().capture);
  Times since_day;
  while (const auto entry = lines->next()) {
    since_day.push_back(
        std::chrono::duration_cast<std::chrono::milliseconds>(times.timeOf(*entry) - kDay));
  }
  EXPECT_EQ(since_day, GetParam().since_day);
}

INSTANTIATE_TEST_SUITE_P(Table, Capture, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(CaptureStart, IsADateOrATime) {
  EXPECT_TRUE(CaptureTimes::readStart("2014-12-31")->day_only);
  EXPECT_EQ(CaptureTimes::readStart("2014-12-31")->at, kDay);
  EXPECT_FALSE(CaptureTimes::readStart("2014-12-31T08:00:00Z")->day_only);
  EXPECT_EQ(CaptureTimes::readStart("1419984000.5")->at, kDay + 500ms);
  for (const char* wrong : {"", "yesterday", "31.12.2014", "2014-13-31", "12:00"}) {
    EXPECT_FALSE(CaptureTimes::readStart(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
