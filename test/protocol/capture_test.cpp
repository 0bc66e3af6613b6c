// What a real vehicle sent, value by value.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "decoding.h"
#include "frontseat_driver/nmea/framer.h"
#include "values.h"

namespace frontseat_driver::protocol {
namespace {

using nmea::LatLon;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;

constexpr nmea::TimeOfDay at(int hour, int minute, int second, int millisecond) {
  return hours{hour} + minutes{minute} + milliseconds{second * 1000 + millisecond};
}

/// Every sentence of the Heron's capture, in order, by address.
class Heron : public testing::Test {
 protected:
  void SetUp() override {
    nmea::Framer framer;
    framer.feed(bytes_, [&](std::string_view line) {
      const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
      ASSERT_TRUE(sentence) << line;
      const auto reading = decode(*sentence);
      if (!reading) return unknown_.emplace_back(sentence->address), void();
      EXPECT_EQ(reading->faults.count, 0) << line;
      messages_[std::string{sentence->address}].push_back(reading->message);
    });
  }

  template <class T>
  T message(const char* address, std::size_t which = 0) const {
    return std::get<T>(messages_.at(address).at(which));
  }

  const std::string bytes_ = test::capture("heron_2014.nmea");
  std::map<std::string, std::vector<Message>> messages_;
  std::vector<std::string> unknown_;
};

TEST_F(Heron, SentTheseSentences) {
  const std::map<std::string, std::size_t> expected = {{"CPIMU", 1}, {"GPRMC", 2}, {"GPVTG", 1},
                                                       {"GPGGA", 2}, {"CPNVG", 2}, {"CPNVR", 1},
                                                       {"CPRCM", 1}, {"CPRBS", 1}};
  std::map<std::string, std::size_t> counts;
  for (const auto& [address, messages] : messages_) counts[address] = messages.size();
  EXPECT_EQ(counts, expected);
  EXPECT_EQ(unknown_, (std::vector<std::string>{"GPGSA", "GPGSV", "GPGSV"}));
}

TEST_F(Heron, KnewWhereItWas) {
  NavigationUpdate first;
  first.sent_at = at(16, 49, 59, 34);
  first.position = LatLon{42 + 21.711142 / 60, -(71 + 5.44878 / 60)};
  first.from_gps = true;
  first.altitude_m = 0.0;
  first.depth_m = 0.0;
  first.heading_deg = 234.32964;
  first.roll_deg = -6.796959;
  first.pitch_deg = -1.706798;
  first.computed_at = at(16, 49, 59, 6);
  EXPECT_TRUE(same(message<NavigationUpdate>("CPNVG", 0), first));
  const auto last = message<NavigationUpdate>("CPNVG", 1);
  EXPECT_EQ(last.sent_at, at(15, 2, 16, 246));
  EXPECT_EQ(last.position, (LatLon{42 + 21.516161 / 60, -(71 + 5.25215 / 60)}));
  EXPECT_EQ(last.heading_deg, 151.799032);
  EXPECT_EQ(last.pitch_deg, 2.519);
}

TEST_F(Heron, Moved) {
  const VelocityUpdate expected{at(16, 49, 59, 63), 0.02941, -0.068552, 0.0,
                                0.060938,           0.0,     -0.061132};
  EXPECT_TRUE(same(message<VelocityUpdate>("CPNVR"), expected));
}

TEST_F(Heron, HadSensors) {
  const kingfisher::RawImu imu{at(16, 49, 58, 858), -0.061035, -0.000097, -0.061035,
                               -0.026916,           0.104533,  -0.932172, {}};
  EXPECT_TRUE(same(message<kingfisher::RawImu>("CPIMU"), imu));
  const kingfisher::RawCompass compass{at(16, 49, 59, 65), 0,         234.326694,
                                       -1.655603,          -6.628557, at(16, 49, 59, 60)};
  EXPECT_TRUE(same(message<kingfisher::RawCompass>("CPRCM"), compass));
  const kingfisher::BatteryVoltage battery{at(15, 2, 18, 154), {},        15.091787,
                                           15.091787,          15.091787, 0.0};
  EXPECT_TRUE(same(message<kingfisher::BatteryVoltage>("CPRBS"), battery));
}

TEST_F(Heron, RelayedItsGpsReceiver) {
  const LatLon there{42 + 21.71114 / 60, -(71 + 5.44878 / 60)};
  const gps::MinimumData minimum{at(16, 49, 59, 0),       true, there, 0.145, 156.78,
                                 nmea::Date{2014, 12, 31}};
  EXPECT_TRUE(same(message<gps::MinimumData>("GPRMC", 0), minimum));
  EXPECT_EQ(message<gps::MinimumData>("GPRMC", 1).date, (nmea::Date{2014, 6, 26}));
  const gps::Fix fix{at(16, 49, 59, 0), there, 1, 6, 2.8, 46.6, -33.2};
  EXPECT_TRUE(same(message<gps::Fix>("GPGGA", 0), fix));
  EXPECT_EQ(message<gps::Fix>("GPGGA", 1).satellites, 10);
  const gps::CourseAndSpeed course{156.78, {}, 0.145, 0.269};
  EXPECT_TRUE(same(message<gps::CourseAndSpeed>("GPVTG"), course));
}

}  // namespace
}  // namespace frontseat_driver::protocol
