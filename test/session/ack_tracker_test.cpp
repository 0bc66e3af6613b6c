#include "frontseat_driver/session/ack_tracker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using vehicle::Acknowledgement;

constexpr vehicle::SteadyTime kStart{100s};
constexpr auto kForgotten = 10s;

Acknowledgement acknowledgement(std::optional<vehicle::TimeOfDay> time,
                                std::string_view command = "RMB") {
  Acknowledgement ack;
  ack.command = command;
  ack.command_time = time;
  ack.status = Acknowledgement::Status::Done;
  return ack;
}

struct TimeRow {
  const char* name;
  std::optional<vehicle::TimeOfDay> sent;
  std::optional<vehicle::TimeOfDay> acknowledged;
  bool same;
};

const TimeRow kTimes[] = {
    {"equal", 12h, 12h, true},
    {"truncated", 12h + 999us, 12h, true},
    {"more_decimals", 12h, 12h + 999us, true},
    {"a_millisecond_later", 12h, 12h + 1ms, false},
    {"a_millisecond_earlier", 12h + 1ms, 12h, false},
    {"none", std::nullopt, std::nullopt, true},
    {"only_sent", 12h, std::nullopt, false},
    {"only_acknowledged", std::nullopt, 12h, false},
};

class AckTimes : public testing::TestWithParam<TimeRow> {};

TEST_P(AckTimes, TellWhichSentence) {
  AckTracker acks{kForgotten};
  acks.sent({"RMB", GetParam().sent, 7, kStart});
  const auto found = acks.match(acknowledgement(GetParam().acknowledged), kStart);
  ASSERT_EQ(found.has_value(), GetParam().same);
  if (found) {
    EXPECT_EQ(found->request, 7U);
  }
  EXPECT_EQ(acks.outstanding(), GetParam().same ? 0U : 1U);
}

INSTANTIATE_TEST_SUITE_P(Table, AckTimes, testing::ValuesIn(kTimes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(AckTracker, OrderTellsForTwoSecondsIfNobodyWaits) {
  for (const auto& [age, found] : {std::pair{2000ms, true}, std::pair{2001ms, false}}) {
    AckTracker acks{kForgotten};
    acks.sent({"LOG", std::nullopt, AckTracker::kNoRequest, kStart});
    EXPECT_EQ(acks.match(acknowledgement(std::nullopt, "LOG"), kStart + age).has_value(), found);
  }
}

TEST(AckTracker, WhatIsWaitedForIsThereUntilForgotten) {
  for (const auto& [age, found] : {std::pair{10000ms, true}, std::pair{10001ms, false}}) {
    AckTracker acks{kForgotten};
    acks.sent({"LOG", std::nullopt, 7, kStart});
    EXPECT_EQ(acks.match(acknowledgement(std::nullopt, "LOG"), kStart + age).has_value(), found);
  }
}

TEST(AckTracker, WhenFullLosesTheOldestThatNobodyWaitsFor) {
  AckTracker acks{kForgotten};
  acks.sent({"RMB", 1s, 1, kStart});
  acks.sent({"RMB", 2s, AckTracker::kNoRequest, kStart});
  acks.sent({"RMB", 3s, AckTracker::kNoRequest, kStart});
  for (AckTracker::RequestId id = 4; id <= AckTracker::kMost; ++id) {
    acks.sent({"RMB", std::chrono::seconds(id), id, kStart});
  }
  ASSERT_EQ(acks.outstanding(), AckTracker::kMost);
  acks.sent({"RMB", 1h, AckTracker::kNoRequest, kStart});
  EXPECT_EQ(acks.outstanding(), AckTracker::kMost);
  EXPECT_FALSE(acks.match(acknowledgement(2s), kStart));
  EXPECT_TRUE(acks.match(acknowledgement(1s), kStart));
  EXPECT_TRUE(acks.match(acknowledgement(3s), kStart));
  EXPECT_TRUE(acks.match(acknowledgement(1h), kStart));
}

TEST(AckTracker, FullOfWhatIsWaitedForLosesTheOldest) {
  AckTracker acks{kForgotten};
  for (AckTracker::RequestId id = 1; id <= AckTracker::kMost + 1; ++id) {
    acks.sent({"RMB", std::chrono::seconds(id), id, kStart});
  }
  EXPECT_EQ(acks.outstanding(), AckTracker::kMost);
  EXPECT_FALSE(acks.match(acknowledgement(1s), kStart));
  EXPECT_TRUE(acks.match(acknowledgement(2s), kStart));
}

}  // namespace
}  // namespace frontseat_driver::session
