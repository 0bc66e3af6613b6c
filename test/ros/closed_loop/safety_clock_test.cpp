#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "safety.h"

// Clocks of the driver's computer that step or stand.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using session::LogSwitch;
using testing::SizeIs;

class SafetyClock : public Safety, public testing::WithParamInterface<int> {};

TEST_P(SafetyClock, SystemClockStepKingfishersTimeOutsSpacingAndRepetitionGoOn) {
  startKingfisher();
  loop_->publishFor(drive(0.5, 0.5), 200ms, 3s);
  loop_->pass(100ms);
  const Duration begin = loop_->elapsed();
  loop_->publish(drive(0.6, 0.6));
  loop_->pass(500ms);
  loop_->stepSystemClock(std::chrono::hours{GetParam()});
  loop_->pass(1min);
  const auto sent = sentSince(begin);
  ASSERT_THAT(sent, SizeIs(6));
  for (std::size_t i = 1; i < sent.size(); ++i) {
    EXPECT_EQ(sent[i].at - sent[i - 1].at, 200ms) << i;
  }
  EXPECT_EQ(sent.back().sentence, kZero);
  EXPECT_EQ(sent.back().at - begin, kCommandTimeout);
  EXPECT_EQ(loop_->publish(drive(0.5, 0.5)), "");
}

TEST_P(SafetyClock, SystemClockStepSandsharkIsCommandedOnAndAcksStillMatch) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.delay_acks_s = 1.0;
  startSandshark(vehicle);
  loop_->pass(2s);
  loop_->publishFor(heading(0.0), 100ms, 20s);
  const std::size_t before = loop_->request(vehicle::BehaviorCommand{});
  loop_->pass(500ms);
  loop_->stepSystemClock(std::chrono::hours{GetParam()});
  const Duration stepped = loop_->elapsed();
  const std::size_t after = loop_->request(vehicle::BehaviorCommand{});
  loop_->publishFor(heading(0.0), 100ms, 20s);
  EXPECT_TRUE(answerTo(before).answer.success) << answerTo(before).answer.message;
  EXPECT_TRUE(answerTo(after).answer.success) << answerTo(after).answer.message;
  EXPECT_GE(leastSpacing(stepped), kSandsharkSpacing);
  EXPECT_GE(behaviorsSince(stepped).size(), 100u);
  EXPECT_TRUE(loop_->sandshark().backseatSteers());
  EXPECT_LT(apart(loop_->state().heading_rad, M_PI_2), 0.05);

  const Duration last = loop_->elapsed() - 100ms;
  loop_->pass(1min);
  EXPECT_LT(loop_->sent().back().at - last, kCommandTimeout);
}

TEST_P(SafetyClock, SystemClockStepWhileTheVehicleLiesIsNoticedInTime) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.lie = true;
  startSandshark(vehicle);
  loop_->publishFor(heading(-M_PI_2), 100ms, 5s);
  loop_->stepSystemClock(std::chrono::hours{GetParam()});
  loop_->publishFor(heading(-M_PI_2), 100ms, 4s);
  EXPECT_EQ(loop_->session().effectComplaint(), "");
  loop_->publishFor(heading(-M_PI_2), 100ms, 2s);
  EXPECT_NE(loop_->session().effectComplaint(), "");
}

INSTANTIATE_TEST_SUITE_P(Hours, SafetyClock, testing::Values(-5, 5, -13, 24 * 365),
                         [](const auto& row) {
                           return (row.param < 0 ? "Back" : "Ahead") +
                                  std::to_string(std::abs(row.param)) + "Hours";
                         });

TEST_F(Safety, SimulatedTimeWithoutAClockTimeOutsGoOn) {
  loop_ = std::make_unique<ClosedLoop>(quiet(Dialect::Kingfisher), quietKingfisher());
  loop_->holdStampsAtZero();
  loop_->connect();
  loop_->pass(1s);
  const Duration begin = loop_->elapsed();
  loop_->publish(drive(0.6, 0.5));
  loop_->pass(1min);
  ASSERT_THAT(sentSince(begin), SizeIs(6));
  EXPECT_EQ(loop_->sent().back().sentence, kZero);
  EXPECT_EQ(loop_->sent().back().at - begin, kCommandTimeout);
}

TEST_F(Safety, SimulatedTimeWithoutAClockServicesAnswerAndSandsharkTakesOver) {
  loop_ = std::make_unique<ClosedLoop>(quiet(Dialect::Sandshark), quietSandshark());
  loop_->holdStampsAtZero();
  loop_->connect();
  awaitPermission();
  loop_->pass(1s);
  const std::size_t log = loop_->request(LogSwitch{"CTD", true});
  loop_->publishFor(heading(0.0), 100ms, 5s);
  EXPECT_TRUE(answerTo(log).answer.success);
  EXPECT_TRUE(loop_->sandshark().backseatSteers());
  loop_->pass(kCommandTimeout + kVehicleTakesOver);
  EXPECT_FALSE(loop_->sandshark().backseatSteers());
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
