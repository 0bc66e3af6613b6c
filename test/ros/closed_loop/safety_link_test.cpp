#include <cstddef>

#include "safety.h"

// A link that is lost, half-open, full, congested or slow.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using session::AbortRequest;
using session::LogSwitch;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(Safety, LinkLostInMidCommandKingfisherHearsNothingFromBefore) {
  startKingfisher();
  loop_->publishFor(drive(0.6, 0.5), 100ms, 2s);
  loop_->disconnect();
  const Duration lost = loop_->elapsed();
  EXPECT_FALSE(loop_->commanding());
  EXPECT_EQ(loop_->publish(drive(0.6, 0.5)), "there is no connection to the vehicle");
  loop_->pass(300ms);
  loop_->connect();
  loop_->pass(10s);
  EXPECT_THAT(sentSince(lost), IsEmpty());
  EXPECT_TRUE(motorsStand()) << "by the vehicle's own watchdog";
  EXPECT_EQ(loop_->publish(drive(0.3, 0.3)), "");
  EXPECT_THAT(sentSince(lost), SizeIs(1));
}

TEST_F(Safety, LinkLostInMidCommandSandsharkIsCommandedAgainOnlyAfterANewGrant) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 2s);
  loop_->disconnect();
  const Duration lost = loop_->elapsed();
  loop_->pass(300ms);
  loop_->connect();
  for (int i = 0; i < 50; ++i) {
    EXPECT_NE(loop_->publish(heading(0.0)), "");
    loop_->pass(100ms);
  }
  EXPECT_EQ(loop_->reason(), "the vehicle has sent no BFCTL since the connection was made");
  EXPECT_THAT(behaviorsSince(lost), IsEmpty());

  takeControlAndGiveItBack();
  loop_->pass(2s);
  EXPECT_THAT(behaviorsSince(lost), IsEmpty()) << "the grant alone revives nothing";
  EXPECT_EQ(loop_->publish(heading(1.0)), "");
  loop_->pass(100ms);
  const auto behaviors = behaviorsSince(lost);
  ASSERT_THAT(behaviors, SizeIs(1));
  EXPECT_THAT(fields(behaviors[0].sentence)[2], StartsWith("34.1")) << "90 - 57.3 + 1.4";
}

TEST_F(Safety, HalfOpenLinkLeavesNothingBehind) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 1s);
  loop_->link.delivers = false;
  const std::size_t log = loop_->request(LogSwitch{"CTD", true});
  loop_->publishFor(heading(0.0), 100ms, 5s);  // silence_timeout
  EXPECT_LE(waitedFor(log), kAckTimeout);
  EXPECT_FALSE(answerTo(log).answer.success);
  const std::size_t abort = loop_->request(AbortRequest{"leak", true});
  loop_->pass(100ms);

  loop_->disconnect();  // as the driver does after silence_timeout
  const Duration lost = loop_->elapsed();
  EXPECT_EQ(answerTo(abort).answer.message, "the connection was lost before the vehicle answered");
  EXPECT_FALSE(loop_->commanding());
  EXPECT_EQ(loop_->session().unacknowledged(), 0u);
  EXPECT_FALSE(loop_->session().commanded());
  loop_->link.delivers = true;
  loop_->connect();
  loop_->pass(1min);
  for (const Sent& sent : sentSince(lost)) {
    EXPECT_THAT(sent.sentence, testing::AnyOf(StartsWith("$BPVER"), StartsWith("$BPLOG")));
  }
}

TEST_F(Safety, HalfOpenLinkKingfishersWatchdogStopsTheMotors) {
  startKingfisher();
  loop_->publishFor(drive(0.6, 0.5), 100ms, 2s);
  loop_->link.delivers = false;
  loop_->publishFor(drive(0.6, 0.5), 100ms, kVehiclesWatchdog + 2 * kVehicleTick);
  EXPECT_TRUE(motorsStand());
}

TEST_F(Safety, FullLinkNothingPilesUpAndTheNewestGoesWhenItTakesAgain) {
  startKingfisher();
  loop_->publishFor(drive(0.1, 0.1), 100ms, 1s);
  loop_->link.takes = false;
  for (int i = 20; i < 90; ++i) {
    loop_->publish(drive(i / 100.0, i / 100.0));
    loop_->pass(100ms);
  }
  loop_->link.takes = true;
  const Duration taken = loop_->elapsed();
  loop_->pass(kKingfisherSpacing);
  const auto sent = sentSince(taken);
  ASSERT_THAT(sent, SizeIs(testing::Ge(1u)));
  EXPECT_THAT(sent[0].sentence, StartsWith("$PYDIR,89,89*"));
  EXPECT_LE(sent[0].at - taken, kKingfisherSpacing);
  loop_->pass(2s);
  for (const Sent& one : sentSince(taken)) {
    EXPECT_THAT(one.sentence, testing::AnyOf(StartsWith("$PYDIR,89,89*"), kZero));
  }
  EXPECT_GE(leastSpacing(taken), kKingfisherSpacing);
}

TEST_F(Safety, FullLinkWhatIsStaleWhenItTakesAgainNeverGoes) {
  startKingfisher();
  loop_->publishFor(drive(0.5, 0.5), 100ms, 1s);
  loop_->link.takes = false;
  loop_->publish(drive(0.9, 0.9));
  loop_->pass(5s);
  loop_->link.takes = true;
  const Duration taken = loop_->elapsed();
  loop_->pass(10s);
  const auto sent = sentSince(taken);
  ASSERT_THAT(sent, SizeIs(1));
  EXPECT_EQ(sent[0].sentence, kZero);
  EXPECT_LE(sent[0].at - taken, kKingfisherSpacing);
}

TEST_F(Safety, CongestedLinkHoldsCommandsBackUntilTheyAreStale) {
  startKingfisher();
  loop_->publishFor(drive(0.5, 0.5), 100ms, 1s);
  loop_->link.congested = true;
  const Duration congested = loop_->elapsed();
  loop_->publishFor(drive(0.9, 0.9), 100ms, 3s);
  EXPECT_THAT(sentSince(congested), IsEmpty());
  loop_->pass(kCommandTimeout + kKingfisherSpacing);
  ASSERT_THAT(sentSince(congested), SizeIs(1)) << "zero thrust goes all the same";
  EXPECT_EQ(loop_->sent().back().sentence, kZero);
  loop_->link.congested = false;
  loop_->pass(10s);
  EXPECT_THAT(sentSince(congested), SizeIs(1));
}

TEST_F(Safety, CongestedLinkDoesNotHoldAnAbortBack) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 1s);
  loop_->link.congested = true;
  loop_->publishFor(heading(0.0), 100ms, 500ms);
  const Duration asked = loop_->elapsed();
  loop_->request(AbortRequest{"leak", true});
  loop_->pass(kSandsharkSpacing);
  EXPECT_THAT(loop_->sent("BPABT", asked), SizeIs(1));
}

TEST_F(Safety, FullLinkSandsharkHearsNothingStaleEither) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 1s);
  loop_->link.takes = false;
  const std::size_t modified = loop_->request(vehicle::BehaviorCommand{});
  loop_->publish(heading(1.0));
  loop_->pass(5s);
  loop_->link.takes = true;
  const Duration taken = loop_->elapsed();
  loop_->pass(10s);
  EXPECT_THAT(sentSince(taken), IsEmpty());
  EXPECT_LE(waitedFor(modified), kAckTimeout);
  EXPECT_THAT(answerTo(modified).answer.message, StartsWith("it could not be sent within"));
}

TEST_F(Safety, SlowLinkCommandsStillEnd) {
  startKingfisher();
  loop_->link.delay = 400ms;
  loop_->publishFor(drive(0.6, 0.5), 100ms, 5s);
  EXPECT_FALSE(motorsStand());
  loop_->pass(kCommandTimeout + kKingfisherSpacing + 400ms + kVehicleTick);
  EXPECT_TRUE(motorsStand());
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
