#include "record_player.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "frontseat_driver/session/nmea_session.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using Told = std::vector<std::string>;

// 2026-05-10 22:00:00 UTC.
constexpr vehicle::UtcTime kStart = std::chrono::seconds{1778450400};

session::NmeaOptions listening() {
  session::NmeaOptions options;
  options.listen_only = true;
  return options;
}

/// Writes down what a record tells, in words.
class Record : public testing::Test, private driver::Listener {
 protected:
  void play(vehicle::UtcTime since_start, const std::string& connection, const std::string& line) {
    player_.play({kStart + since_start, connection, line});
  }

  Told told_;
  std::vector<vehicle::Now> heard_at_;
  int ticks_ = 0;
  session::NmeaSession session_{listening()};
  RecordPlayer player_{session_, *this, [this](Restart what) {
                         told_.push_back(what == Restart::Driver ? "new driver" : "restart");
                       }};

 private:
  void onConnected(const vehicle::Now&, const std::string& endpoint) override {
    told_.push_back("connected to " + endpoint);
  }
  void onDisconnected(const vehicle::Now&, const std::string& reason) override {
    told_.push_back(reason);
  }
  void onConnectFailed(const vehicle::Now&, const std::string&,
                       std::chrono::milliseconds) override {}
  void onHeard(const vehicle::Now& now, std::string_view line) override {
    heard_at_.push_back(now);
    told_.push_back(player_.connection() + " " + std::string{line});
  }
  void onSent(const vehicle::Now&, std::string_view line) override {
    ADD_FAILURE() << "sent: " << line;
  }
  void onEvent(const vehicle::Now&, const vehicle::Event&) override {}
  void onTick(const vehicle::Now&) override { ++ticks_; }
};

TEST_F(Record, IsHeardAsItStandsAtItsOwnTime) {
  play(0s, "connection_1", "$BFVER,220000.0,SS_0.0*00");
  play(70ms, "connection_1", "$half");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", "connection_1 $BFVER,220000.0,SS_0.0*00",
                         "connection_1 $half"}));
  EXPECT_EQ(heard_at_[1].stamp, kStart + 70ms);
  EXPECT_EQ(heard_at_[1].utc, kStart + 70ms);
  EXPECT_EQ(heard_at_[1].steady - heard_at_[0].steady, 70ms);
}

TEST_F(Record, ReconnectsWhereTheDriverDid) {
  play(0s, "connection_1", "$BFVER,220000.0,SS_0.0*44");
  EXPECT_EQ(session_.dialect(), std::nullopt);  // the checksum is wrong
  play(1s, "connection_1", "$BFCTL,220001.0,1*6E");
  play(2s, "connection_2", "$GPZDA*48");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", "connection_1 $BFVER,220000.0,SS_0.0*44",
                         "connection_1 $BFCTL,220001.0,1*6E", "the recorded connection ended",
                         "connected to nmea/replay", "connection_2 $GPZDA*48"}));
}

TEST_F(Record, WithoutConnectionsIsOne) {
  play(0s, "", "$a");
  play(100s, "", "$b");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", " $a", " $b"}));
}

TEST_F(Record, StartsAgainWhereItsTimeGoesBack) {
  play(0s, "connection_1", "$a");
  play(10s, "connection_1", "$b");
  play(0s, "connection_1", "$a");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", "connection_1 $a", "connection_1 $b",
                         "the record starts again", "restart", "connected to nmea/replay",
                         "connection_1 $a"}));
  EXPECT_EQ(heard_at_.back().stamp, kStart);
}

TEST_F(Record, StartsAgainWhereItsTimeGoesBackByMoreThanASecond) {
  play(10s, "connection_1", "$a");
  play(9s, "connection_1", "$b");
  EXPECT_EQ(std::count(told_.begin(), told_.end(), "restart"), 0);
  play(8990ms, "connection_1", "$c");
  EXPECT_EQ(std::count(told_.begin(), told_.end(), "restart"), 1);
}

TEST_F(Record, AConnectionEndsNoEarlierThanItsLastLine) {
  play(10s, "connection_1", "$a");
  play(9500ms, "connection_2", "$b");
  EXPECT_EQ(heard_at_.back().stamp, kStart + 10s);
}

TEST_F(Record, KnowsARestartedDriver) {
  play(0s, "connection_1@100.000", "$a");
  play(10s, "connection_2@100.000", "$b");
  play(20s, "connection_1@119.500", "$c");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", "connection_1@100.000 $a",
                         "the recorded connection ended", "connected to nmea/replay",
                         "connection_2@100.000 $b", "the recorded driver was restarted",
                         "new driver", "connected to nmea/replay", "connection_1@119.500 $c"}));
}

TEST_F(Record, OfARestartedDriverMayGoBackABit) {
  play(10s, "connection_1@100.000", "$a");
  play(9500ms, "connection_1@119.500", "$b");
  EXPECT_EQ(heard_at_.back().stamp, kStart + 9500ms);
}

TEST_F(Record, NamesOfOthersTellNoDriver) {
  const char* const kNames[] = {"connection_1", "connection_2", "", "@5", "boat@6",
                                "base_link",    "connection_3@"};
  for (const char* name : kNames) play(0s, name, "$a");
  EXPECT_EQ(std::count(told_.begin(), told_.end(), "new driver"), 0);
}

TEST_F(Record, OfAnOlderDriverAndANewerOneIsOfTwo) {
  play(0s, "connection_1", "$a");
  play(1s, "connection_1@119.500", "$b");
  EXPECT_EQ(std::count(told_.begin(), told_.end(), "new driver"), 1);
}

TEST_F(Record, ALittleDisorderIsNoRestart) {
  play(500ms, "", "$a");
  play(0s, "", "$b");
  EXPECT_EQ(told_, (Told{"connected to nmea/replay", " $a", " $b"}));
  EXPECT_EQ(heard_at_[1].stamp, kStart + 500ms);
}

TEST_F(Record, TicksByItsOwnTime) {
  for (auto at = 0ms; at <= 10s; at += 250ms) play(at, "", "$a");
  EXPECT_EQ(ticks_, 10);
}

TEST_F(Record, ATaskRunsAtTheRecordsTime) {
  std::vector<vehicle::UtcTime> ran_at;
  const auto task = [&](const vehicle::Now& now, session::Output&) { ran_at.push_back(now.stamp); };
  player_.post(task);
  play(3s, "", "$a");
  player_.post(task);
  EXPECT_EQ(ran_at, (std::vector<vehicle::UtcTime>{0s, kStart + 3s}));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
