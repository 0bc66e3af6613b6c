#include <cmath>

#include "safety.h"

// A vehicle that takes control back, reboots, dies or lies.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST_F(Safety, VehicleTakesControlBackAndGivesItAgain) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 3s);
  loop_->sandshark().setBackseatControl(false);
  loop_->pass(2 * kVehicleTick);
  const Duration taken = loop_->elapsed();
  EXPECT_FALSE(loop_->commanding());
  EXPECT_EQ(loop_->publish(heading(0.0)), "the vehicle keeps control (BFCTL 0)");
  loop_->publishFor(heading(0.0), 100ms, 5s);
  EXPECT_THAT(sentSince(taken), IsEmpty());

  loop_->sandshark().setBackseatControl(true);
  awaitPermission();
  loop_->pass(10s);
  EXPECT_THAT(sentSince(taken), IsEmpty()) << "nothing from before is revived";
  EXPECT_EQ(loop_->publish(heading(1.0)), "");
  loop_->pass(50ms);
  EXPECT_THAT(behaviorsSince(taken), SizeIs(1));
  EXPECT_TRUE(loop_->sandshark().backseatSteers());
}

TEST_F(Safety, SandsharkRebootsInMidMission) {
  startSandshark();
  loop_->publishFor(heading(0.0), 100ms, 3s);
  sim::SandsharkConfig rebooted = quietSandshark();
  rebooted.mission.ready_s = 5.0;  // BFCTL is sent on change only: not before the driver is back
  loop_->powerCycle(rebooted);
  const Duration off = loop_->elapsed();
  loop_->publishFor(heading(0.0), 100ms, 2s);
  EXPECT_THAT(sentSince(off), IsEmpty());
  loop_->connect();
  const Duration back = loop_->elapsed();
  ASSERT_TRUE(loop_->passUntil([&] { return loop_->publish(heading(0.0)).empty(); }, 10s));
  const Duration granted = loop_->elapsed();
  loop_->pass(100ms);
  const auto sent = sentSince(back);
  ASSERT_THAT(sent, SizeIs(testing::Ge(3u)));
  EXPECT_THAT(sent[0].sentence, StartsWith("$BPVER"));
  EXPECT_THAT(sent[1].sentence, StartsWith("$BPLOG,ACK,ON"));
  ASSERT_THAT(behaviorsSince(back), SizeIs(1));
  EXPECT_GE(behaviorsSince(back)[0].at, granted);
}

TEST_F(Safety, KingfisherRebootsInMidMission) {
  startKingfisher();
  loop_->publishFor(drive(0.6, 0.5), 100ms, 3s);
  loop_->powerCycle(quietKingfisher());
  loop_->connect();
  const Duration back = loop_->elapsed();
  loop_->pass(10s);
  EXPECT_THAT(sentSince(back), IsEmpty());
  EXPECT_TRUE(motorsStand());
  EXPECT_EQ(loop_->publish(drive(0.3, 0.3)), "");
  loop_->pass(20ms);
  EXPECT_FALSE(motorsStand());
}

TEST_F(Safety, VehicleThatDiesOfACommandIsNotSentItAgain) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.quirks.dies_on_empty_field = true;
  startSandshark(vehicle);
  loop_->publish(heading(0.0));
  ASSERT_TRUE(loop_->passUntil([&] { return !loop_->connected(); }, 1s));
  const Duration died = loop_->elapsed();
  loop_->pass(1s);
  loop_->connect();
  loop_->pass(10s);
  EXPECT_THAT(behaviorsSince(died), IsEmpty());
}

TEST_F(Safety, SandsharkThatLiesIsComplainedAboutWithFigures) {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.faults.lie = true;
  startSandshark(vehicle);
  loop_->publishFor(heading(-M_PI_2), 100ms, 9s);
  EXPECT_EQ(loop_->session().effectComplaint(), "");
  loop_->publishFor(heading(-M_PI_2), 100ms, 2s);  // effect_timeout is 10 s
  EXPECT_THAT(loop_->session().effectComplaint(),
              testing::AllOf(HasSubstr("heading 181.4 deg commanded, 1.4 deg measured"),
                             HasSubstr("no answer for 1")));
  EXPECT_TRUE(loop_->commanding()) << "to stop is the user's to decide";
  loop_->stop();
  EXPECT_EQ(loop_->session().effectComplaint(), "");
}

TEST_F(Safety, KingfisherThatLiesIsComplainedAboutWithFigures) {
  sim::KingfisherConfig vehicle = quietKingfisher();
  vehicle.faults.lie = true;
  startKingfisher(vehicle);
  loop_->publishFor(course(0.0, 1.0), 100ms, 11s);
  EXPECT_THAT(loop_->session().effectComplaint(),
              HasSubstr("heading 90.0 deg commanded, 0.0 deg measured; "
                        "speed 1.0 m/s commanded, 0.0 m/s measured"));
}

TEST_F(Safety, VehiclesThatObeyAreNotComplainedAbout) {
  startSandshark();
  for (const double yaw : {3.0, -1.5, 0.5}) {
    for (int i = 0; i < 300; ++i) {
      loop_->publish(heading(yaw));
      loop_->pass(100ms);
      ASSERT_EQ(loop_->session().effectComplaint(), "");
    }
  }
  startKingfisher();
  for (const double yaw : {3.0, -1.5, 0.5}) {
    for (int i = 0; i < 300; ++i) {
      loop_->publish(course(yaw, 1.2));
      loop_->pass(100ms);
      ASSERT_EQ(loop_->session().effectComplaint(), "");
    }
  }
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
