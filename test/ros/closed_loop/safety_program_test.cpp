#include <cmath>
#include <cstddef>

#include "safety.h"

// What a program that commands can do wrong.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using session::AbortRequest;
using session::LogSwitch;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(Safety, ProgramStopsKingfisherHearsOneZeroWithinTheTimeOut) {
  startKingfisher();
  loop_->publishFor(drive(0.6, 0.5), 100ms, 5s);
  EXPECT_FALSE(motorsStand());
  const Duration last = loop_->elapsed() - 100ms;
  loop_->pass(1min);
  const auto zeros = loop_->sent("PYDIR,0,0*");
  ASSERT_THAT(zeros, SizeIs(1));
  EXPECT_LE(zeros[0].at - last, kCommandTimeout + kKingfisherSpacing);
  EXPECT_EQ(loop_->sent().back().sentence, kZero) << "and nothing after it";
  EXPECT_FALSE(loop_->commanding());
}

TEST_F(Safety, ProgramStopsKingfishersMotorsStop) {
  startKingfisher();
  loop_->publishFor(drive(0.6, 0.5), 100ms, 5s);
  loop_->pass(kCommandTimeout + kKingfisherSpacing + kVehicleTick);
  EXPECT_TRUE(motorsStand());
}

TEST_F(Safety, ProgramStopsSandsharkTakesOverItsMission) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 30s);
  ASSERT_LT(apart(loop_->yaw(), 0.0), 0.05) << "follows the program, away from its mission";
  const Duration last = loop_->elapsed() - 100ms;
  ASSERT_TRUE(loop_->sandshark().backseatSteers());
  loop_->pass(kCommandTimeout);
  const auto behaviors = loop_->sent("BPRMB");
  EXPECT_LT(behaviors.back().at - last, kCommandTimeout);
  const bool took_over = loop_->passUntil(
      [&] { return !loop_->sandshark().backseatSteers(); },
      behaviors.back().at + kVehicleTakesOver + 2 * kVehicleTick - loop_->elapsed());
  EXPECT_TRUE(took_over);
  loop_->pass(1min);
  EXPECT_EQ(loop_->sent().back().at, behaviors.back().at) << "nothing more was said";
  // Its leg lies to the west, going north.
  EXPECT_GT(loop_->yaw(), M_PI_2 - 0.1);
  EXPECT_EQ(loop_->sandshark().mission().state(), sim::Mission::State::Running);
}

TEST_F(Safety, FloodedKingfisherHearsNothingFasterThanTheSpacingAndZeroWithin100Ms) {
  startKingfisher();
  const Duration begin = loop_->elapsed();
  for (int i = 0; i < 5000; ++i) {
    const double value = (i % 100 + 1) / 100.0;
    const Wanted wanted[] = {drive(value, -value), helm(value, 0.5), course(0.0, value)};
    loop_->publish(wanted[i % 3]);
    loop_->pass(1ms);
  }
  const Duration asked = loop_->elapsed();
  loop_->publish(drive(0.0, 0.0));
  loop_->pass(100ms);
  EXPECT_GE(leastSpacing(begin), kKingfisherSpacing);
  EXPECT_GE(sentSince(begin).size(), 250u) << "it is commanded all the same";
  const auto zeros = loop_->sent("PYDIR,0,0*", asked);
  ASSERT_THAT(zeros, testing::Not(IsEmpty()));
  EXPECT_LE(zeros.front().at - asked, 100ms);
  EXPECT_EQ(zeros.size(), sentSince(zeros.front().at).size()) << "nothing else comes after it";
  EXPECT_TRUE(motorsStand());
}

TEST_F(Safety, FloodedSandsharkHearsNothingFasterThanTheSpacingAndTheRestHasItsTurn) {
  ros_layer::Parameters parameters = parametersFor(Dialect::Sandshark);
  parameters.session.status_rate_hz = 1.0;
  start(parameters, quietSandshark());
  const Duration begin = loop_->elapsed();
  std::size_t request = 0;
  for (int i = 0; i < 5000; ++i) {
    if (i == 1000) request = loop_->request(LogSwitch{"CTD", true});
    loop_->publish(heading(i / 1000.0));
    loop_->pass(1ms);
  }
  EXPECT_GE(leastSpacing(begin), kSandsharkSpacing);
  EXPECT_GE(loop_->sent("BPSTS", begin).size(), 4u);
  EXPECT_LE(waitedFor(request), 200ms);
  EXPECT_TRUE(answerTo(request).answer.success);

  const Duration stopped = loop_->elapsed();
  loop_->stop();
  loop_->pass(10s);
  EXPECT_THAT(behaviorsSince(stopped), IsEmpty());
}

TEST_F(Safety, FloodDoesNotDelayAnAbort) {
  startSandshark();
  for (int i = 0; i < 500; ++i) {
    loop_->publish(heading(i / 100.0));
    loop_->pass(1ms);
  }
  for (int i = 0; i < 60; ++i) loop_->request(LogSwitch{"CTD", true});
  const Duration asked = loop_->elapsed();
  const std::size_t abort = loop_->request(AbortRequest{"leak", true});
  loop_->pass(100ms);
  const auto sent = sentSince(asked);
  ASSERT_THAT(sent, testing::Not(IsEmpty()));
  EXPECT_THAT(sent[0].sentence, StartsWith("$BPABT,"));
  EXPECT_LE(sent[0].at - asked, kSandsharkSpacing);
  EXPECT_TRUE(answerTo(abort).answer.success);
  EXPECT_THAT(behaviorsSince(asked), IsEmpty()) << "an abort ends the command";
  EXPECT_TRUE(ascends());
}

TEST_F(Safety, NonsenseCostsThatCommandAndNothingElse) {
  startKingfisher();
  loop_->publish(drive(0.5, 0.5));
  const Duration good = loop_->elapsed();
  for (int i = 0; i < 20; ++i) {
    EXPECT_NE(loop_->publish(drive(NAN, 0.1)), "");
    EXPECT_NE(loop_->publish(helm(7.0, 0.1)), "");
    EXPECT_NE(loop_->publish(heading(0.0)), "") << "the other vehicle's";
    loop_->pass(100ms);
  }
  EXPECT_EQ(loop_->sent("PYDIR,50,50*").size(), loop_->sent("PY").size() - 1);
  const auto zeros = loop_->sent("PYDIR,0,0*");
  ASSERT_THAT(zeros, SizeIs(1));
  EXPECT_EQ(zeros[0].at - good, kCommandTimeout)
      << "nonsense does not lengthen the good one's life";
  EXPECT_EQ(loop_->session().counters().refused_commands, 60u);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
