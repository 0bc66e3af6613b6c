// The conversation in virtual time, message by message.

#include "frontseat_driver/session/blueye_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "scripted_drone.h"

namespace frontseat_driver::session {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::SizeIs;
using State = vehicle::MissionStatus::State;

vehicle::MotionCommand forward(double surge = 0.5) {
  vehicle::MotionCommand motion;
  motion.surge = surge;
  return motion;
}

pb::DroneTimeTel clockAt(std::int64_t uptime_s, std::int32_t and_ns = 0) {
  pb::DroneTimeTel message;
  auto& time = *message.mutable_monotonic_clock()->mutable_unix_timestamp();
  time.set_seconds(uptime_s);
  time.set_nanos(and_ns);
  return message;
}

pb::MissionStatusTel missionIn(pb::MissionState state) {
  pb::MissionStatusTel message;
  message.mutable_mission_status()->set_state(state);
  return message;
}

std::vector<std::chrono::nanoseconds> spacings(const std::vector<vehicle::SteadyTime>& times) {
  std::vector<std::chrono::nanoseconds> between;
  for (std::size_t i = 1; i < times.size(); ++i) between.push_back(times[i] - times[i - 1]);
  return between;
}

/// When each request of a type was sent.
std::vector<vehicle::SteadyTime> timesOf(const ScriptedDrone& drone, const std::string& type) {
  std::vector<vehicle::SteadyTime> times;
  for (const auto& sent : drone.requests) {
    if (sent.type == type) times.push_back(sent.at);
  }
  return times;
}

TEST(BlueyeSession, RegistersAsAnObserverAndThenAsksForWhatItNeeds) {
  BlueyeOptions options;
  options.client_name = "lab";
  options.rates_hz = {{"CalibratedImuTel", 100.0}};
  ScriptedDrone drone(options);
  drone.connect();
  ASSERT_EQ(drone.registry.size(), 1u);
  EXPECT_EQ(drone.registry[0].name, "lab");
  EXPECT_TRUE(drone.registry[0].observer);
  EXPECT_EQ(drone.session.id(), drone.registry[0].id);
  const auto names = drone.requestNames();
  ASSERT_GE(names.size(), 4u);
  EXPECT_EQ(names[0], "PingReq");
  EXPECT_EQ(names[1], "ConnectClientReq");
  EXPECT_EQ(names[2], "SetPubFrequencyReq");
  EXPECT_EQ(names[3], "GetTelemetryReq");
  EXPECT_EQ(drone.control.grant, vehicle::Grant::Denied);
  EXPECT_THAT(drone.reason, HasSubstr("take_control"));
}

TEST(BlueyeSession, KeepsAskingUntilTheDroneAnswers) {
  ScriptedDrone drone;
  drone.answers = false;
  drone.session.connected(drone.now, drone);
  drone.run(5s);
  const auto pings = drone.requestNames();
  EXPECT_THAT(pings, Each(std::string{"PingReq"}));
  EXPECT_EQ(pings.size(), 3u);  // each waits 1 s for its reply and 1 s after it
  EXPECT_EQ(drone.control.grant, vehicle::Grant::Unknown);
  drone.answers = true;
  drone.run(2s);
  EXPECT_TRUE(drone.session.registered());
}

TEST(BlueyeSession, SaysThatThereIsNoConnectionBeforeTheFirst) {
  ScriptedDrone drone;
  drone.turn();
  EXPECT_EQ(drone.reason, "there is no connection to the vehicle");
  EXPECT_EQ(drone.session.nextStep(), vehicle::SteadyTime::max());
  EXPECT_THAT(drone.requests, IsEmpty());
}

TEST(BlueyeSession, ReportsControlWhenItChangesAlone) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.control_reports = 0;
  for (int i = 0; i < 10; ++i) drone.tellClients();
  EXPECT_EQ(drone.control_reports, 0);
  drone.command(forward());
  drone.command(forward(0.6));
  EXPECT_EQ(drone.control_reports, 1);
  drone.session.setCommandsEnabled(drone.now, false);
  EXPECT_EQ(drone.control_reports, 2);
}

TEST(BlueyeSession, TriesOnceASecondToRegisterWithADroneThatRegistersNobody) {
  ScriptedDrone drone;
  drone.echoes = true;
  drone.echo = {pb::ConnectClientRep{}.GetTypeName(), {}};
  drone.session.connected(drone.now, drone);
  drone.run(5s);
  EXPECT_THAT(spacings(timesOf(drone, "ConnectClientReq")), AllOf(SizeIs(4), Each(1001ms)));
}

TEST(BlueyeSession, AnObserverPublishesNothingAtAll) {
  ScriptedDrone drone;
  drone.connect();
  for (int i = 0; i < 50; ++i) {
    EXPECT_THAT(drone.command(forward()), HasSubstr("not in control"));
    drone.run(100ms);
  }
  drone.session.stop(drone.now, drone);
  drone.session.setCommandsEnabled(drone.now, false);
  drone.session.setCommandsEnabled(drone.now, true);
  drone.run(2s);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_EQ(drone.session.counters().refused_commands, 50u);
}

TEST(BlueyeSession, TakesControlFromWhoeverHasIt) {
  ScriptedDrone drone;
  const auto app = drone.addClient("Blueye App");
  drone.giveControl();
  EXPECT_TRUE(drone.took_control);
  EXPECT_TRUE(drone.session.inControl());
  EXPECT_EQ(drone.in_control, drone.session.id());
  EXPECT_THAT(drone.registry, Not(Contains(testing::Field(&BlueyeClient::id, app))));
  EXPECT_EQ(drone.control.grant, vehicle::Grant::Granted);
  EXPECT_EQ(drone.reason, "");
}

TEST(BlueyeSession, GivesUpOnAClientThatKeepsControlAndGoesBackToObserving) {
  ScriptedDrone drone;
  const auto app = drone.addClient("Blueye App");
  drone.keeps_control = true;
  drone.connect();
  std::optional<BlueyeSession::Answer> answer;
  const auto asked = drone.now.steady;
  drone.session.takeControl(
      drone.now, [&](const auto& given) { answer = given; }, drone);
  while (!answer && drone.now.steady < asked + 3s) drone.run(1ms);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->success);
  EXPECT_THAT(answer->message, HasSubstr("client " + std::to_string(app) + " keeps control"));
  EXPECT_LE(drone.now.steady - asked, 1200ms);
  drone.run(100ms);
  auto goodbyes = timesOf(drone, "DisconnectClientReq");
  ASSERT_GE(goodbyes.size(), 10u);
  goodbyes.erase(goodbyes.begin());  // of the observer, and of who would have been in control
  goodbyes.pop_back();
  EXPECT_THAT(spacings(goodbyes), Each(100ms));
  // When the other one goes, this client must not find itself in control.
  drone.keeps_control = false;
  drone.removeClient(app);
  drone.tellClients();
  drone.run(2s);
  EXPECT_EQ(drone.in_control, 0u);
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, SendsZeroMotionAndTheClockWhenItGainsControl) {
  BlueyeOptions options;
  options.water_density_kg_m3 = 1025.0;
  ScriptedDrone drone(options);
  drone.now.utc += 1s;  // an odd one, of which the fraction is not to be read as more than a second
  const auto steady_to_utc = drone.now.utc - drone.now.steady.time_since_epoch();
  drone.giveControl();
  ASSERT_THAT(drone.controlsOf("MotionInputCtrl"), Not(IsEmpty()));
  EXPECT_TRUE(drone.isAtRest());
  const auto sync =
      std::find_if(drone.requests.begin(), drone.requests.end(),
                   [](const ScriptedDrone::Sent& one) { return one.type == "SyncTimeReq"; });
  ASSERT_NE(sync, drone.requests.end());
  pb::SyncTimeReq message;
  ASSERT_TRUE(message.ParseFromString(sync->payload));
  const auto& time = message.time().unix_timestamp();
  const auto sent_at = sync->at.time_since_epoch() + steady_to_utc;
  EXPECT_EQ(1s * time.seconds() + 1ns * time.nanos(), sent_at);
  EXPECT_LT(time.nanos(), 1'000'000'000);
  ASSERT_EQ(drone.controlsOf("WaterDensityCtrl").size(), 1u);
  pb::WaterDensityCtrl density;
  ASSERT_TRUE(density.ParseFromString(drone.controlsOf("WaterDensityCtrl")[0].payload));
  EXPECT_FLOAT_EQ(density.density().value(), 1025.0F);
  EXPECT_THAT(drone.controlsOf("PingerConfigurationCtrl"), IsEmpty());
}

TEST(BlueyeSession, TellsHowTheEchoSounderIsMountedWhenItGainsControl) {
  using Told = pb::PingerConfiguration;
  const std::pair<PingerMounting, Told::MountingDirection> kRows[] = {
      {PingerMounting::Forwards, Told::MOUNTING_DIRECTION_FORWARDS},
      {PingerMounting::Downwards, Told::MOUNTING_DIRECTION_DOWNWARDS}};
  for (const auto& [mounting, told] : kRows) {
    BlueyeOptions options;
    options.pinger_mounting = mounting;
    ScriptedDrone drone(options);
    drone.giveControl();
    const auto sent = drone.controlsOf("PingerConfigurationCtrl");
    ASSERT_EQ(sent.size(), 1u);
    pb::PingerConfigurationCtrl message;
    ASSERT_TRUE(message.ParseFromString(sent[0].payload));
    EXPECT_EQ(message.configuration().mounting_direction(), told);
  }
}

TEST(BlueyeSession, SendsTheWatchdogTwiceASecondWhileInControlOnly) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(3s);
  EXPECT_THAT(drone.controlsOf("WatchdogCtrl"), IsEmpty());
  drone.giveControl();
  drone.controls.clear();
  drone.run(10s);
  const auto watchdogs = drone.controlsOf("WatchdogCtrl");
  EXPECT_EQ(watchdogs.size(), 20u);
  for (std::size_t i = 1; i < watchdogs.size(); ++i) {
    EXPECT_EQ(watchdogs[i].at - watchdogs[i - 1].at, 500ms);
  }
  pb::WatchdogCtrl last;
  ASSERT_TRUE(last.ParseFromString(watchdogs.back().payload));
  EXPECT_EQ(last.client_id(), drone.session.id());
  EXPECT_GE(last.connection_duration().value(), 9);
  drone.session.releaseControl(
      drone.now, [](const auto&) {}, drone);
  drone.run(100ms);
  drone.controls.clear();
  drone.run(5s);
  EXPECT_THAT(drone.controlsOf("WatchdogCtrl"), IsEmpty());
}

TEST(BlueyeSession, SendsTheWatchdogAgainThatTheLinkDidNotTake) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.controls.clear();
  drone.link_takes = false;
  drone.offers.clear();
  drone.run(800ms);
  EXPECT_THAT(drone.controlsOf("WatchdogCtrl"), IsEmpty());
  EXPECT_THAT(spacings(drone.offers["WatchdogCtrl"]), AllOf(SizeIs(Ge(10u)), Each(20ms)));
  drone.link_takes = true;
  drone.run(20ms);
  EXPECT_EQ(drone.controlsOf("WatchdogCtrl").size(), 1u);
  drone.run(500ms);
  EXPECT_EQ(drone.controlsOf("WatchdogCtrl").size(), 2u);
}

TEST(BlueyeSession, RepeatsTheNewestMotionWithAllAxesAndNothingElse) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);  // past the zeros of gaining control
  drone.controls.clear();
  for (int i = 0; i < 100; ++i) {  // a program at 100 Hz
    EXPECT_EQ(drone.command(forward(0.005 * i)), "");
    drone.run(10ms);
  }
  drone.run(30ms);
  const auto motions = drone.controlsOf("MotionInputCtrl");
  EXPECT_FLOAT_EQ(ScriptedDrone::motionOf(motions.back()).surge(), 0.495F);
  drone.controls.clear();
  drone.run(900ms);
  const auto repeated = drone.controlsOf("MotionInputCtrl");
  EXPECT_EQ(repeated.size(), 9u);
  for (const auto& one : repeated) {
    EXPECT_FLOAT_EQ(ScriptedDrone::motionOf(one).surge(), 0.495F);
  }
}

// A drone keeps what comes faster than it is used and acts on it late.
TEST(BlueyeSession, SendsNoMoreThanThirtyOfAKindASecondHoweverFastAProgramIs) {
  for (const auto period : {1ms, 10ms}) {
    ScriptedDrone drone;
    drone.giveControl();
    drone.run(5s);
    drone.controls.clear();
    const auto begun = drone.now.steady;
    EXPECT_EQ(drone.command(forward(0.1)), "");
    ASSERT_EQ(drone.controlsOf("MotionInputCtrl").size(), 1u);  // the first one at once
    while (drone.now.steady < begun + 3s) {
      const double surge = 0.1 + 0.2 * std::chrono::duration<double>(drone.now.steady - begun) / 1s;
      drone.command(forward(surge));
      drone.command(vehicle::TiltCommand{surge});
      drone.run(period);
    }
    const auto motions = drone.controlsOf("MotionInputCtrl");
    EXPECT_GE(motions.size(), 87u);  // each 34 ms: time goes by the millisecond here
    EXPECT_LE(motions.size(), 91u);
    EXPECT_LE(drone.controlsOf("TiltVelocityCtrl").size(), 91u);
    for (std::size_t i = 1; i < motions.size(); ++i) {
      EXPECT_GE(motions[i].at - motions[i - 1].at, 33ms);
      // The newest of those that came: what was wanted a period ago at most.
      const double wanted = 0.1 + 0.2 * std::chrono::duration<double>(motions[i].at - begun) / 1s;
      EXPECT_NEAR(ScriptedDrone::motionOf(motions[i]).surge(), wanted, 0.003);
    }
  }
}

TEST(BlueyeSession, SendsZeroAtOnceHoweverSoonItComes) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.command(forward());
  drone.run(2ms);
  EXPECT_FALSE(drone.isAtRest());
  drone.command(vehicle::MotionCommand{});  // a stick that is let go
  EXPECT_TRUE(drone.isAtRest());
  drone.controls.clear();
  for (int i = 0; i < 1000; ++i) {
    drone.command(vehicle::MotionCommand{});
    drone.run(1ms);
  }
  EXPECT_LE(drone.controlsOf("MotionInputCtrl").size(), 31u);
  drone.command(forward());
  drone.run(40ms);
  EXPECT_FALSE(drone.isAtRest());
  drone.session.stop(drone.now, drone);
  EXPECT_TRUE(drone.isAtRest());
}

// Zero does not wait, so what follows it has to.
TEST(BlueyeSession, SendsNoMoreThanThirtyASecondToAndFroEither) {
  for (const auto period : {1ms, 10ms, 20ms, 40ms}) {
    ScriptedDrone drone;
    drone.giveControl();
    drone.run(5s);
    drone.controls.clear();
    for (auto passed = 0ms; passed < 3s; passed += 2 * period) {
      drone.command(forward());
      drone.run(period);
      const bool moved = !drone.isAtRest();
      drone.command(vehicle::MotionCommand{});
      EXPECT_TRUE(drone.isAtRest()) << moved;
      drone.run(period);
    }
    EXPECT_LE(drone.controlsOf("MotionInputCtrl").size(), 92u) << period.count();
    EXPECT_GE(drone.controlsOf("MotionInputCtrl").size(), 70u) << period.count();
  }
}

TEST(BlueyeSession, StopsThatComeByTheHundredDoNotFloodTheDrone) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.controls.clear();
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(drone.session.stop(drone.now, drone).success);
    EXPECT_TRUE(drone.isAtRest());
    drone.run(1ms);
  }
  EXPECT_LE(drone.controlsOf("MotionInputCtrl").size(), 31u);
  EXPECT_LE(drone.controlsOf("GripperCtrl").size(), 31u);
}

TEST(BlueyeSession, SendsACommandOfZeroAgainThatTheLinkDidNotTake) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.command(forward());
  drone.run(50ms);
  drone.link_takes = false;
  drone.command(vehicle::MotionCommand{});
  EXPECT_FALSE(drone.isAtRest());
  drone.link_takes = true;
  drone.run(20ms);
  EXPECT_TRUE(drone.isAtRest());
}

struct Axis {
  const char* name;
  double vehicle::MotionCommand::*command;
  float (pb::MotionInput::*wire)() const;
};

const Axis kAxes[] = {{"surge", &vehicle::MotionCommand::surge, &pb::MotionInput::surge},
                      {"sway", &vehicle::MotionCommand::sway, &pb::MotionInput::sway},
                      {"heave", &vehicle::MotionCommand::heave, &pb::MotionInput::heave},
                      {"roll", &vehicle::MotionCommand::roll, &pb::MotionInput::roll},
                      {"pitch", &vehicle::MotionCommand::pitch, &pb::MotionInput::pitch},
                      {"yaw", &vehicle::MotionCommand::yaw, &pb::MotionInput::yaw},
                      {"slow", &vehicle::MotionCommand::slow, &pb::MotionInput::slow},
                      {"boost", &vehicle::MotionCommand::boost, &pb::MotionInput::boost}};

class OneAxis : public testing::TestWithParam<Axis> {};

TEST_P(OneAxis, GoesToItsFieldAloneAndKeepsItsSign) {
  for (const bool clockwise_yaw : {true, false}) {
    BlueyeOptions options;
    options.clockwise_yaw = clockwise_yaw;
    ScriptedDrone drone(options);
    drone.giveControl();
    vehicle::MotionCommand motion;
    motion.*GetParam().command = 0.25;
    drone.command(motion);
    const auto sent = ScriptedDrone::motionOf(drone.controlsOf("MotionInputCtrl").back());
    for (const Axis& axis : kAxes) {
      const bool this_one = std::string{axis.name} == GetParam().name;
      const bool turned = std::string{axis.name} == "yaw" && !clockwise_yaw;
      EXPECT_FLOAT_EQ((sent.*axis.wire)(), !this_one ? 0.0F : turned ? -0.25F : 0.25F);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, OneAxis, testing::ValuesIn(kAxes),
                         [](const auto& row) { return std::string{row.param.name}; });

std::vector<bool> observersAsked(const ScriptedDrone& drone) {
  std::vector<bool> observers;
  for (const auto& sent : drone.requests) {
    if (sent.type != "ConnectClientReq") continue;
    pb::ConnectClientReq asked;
    asked.ParseFromString(sent.payload);
    observers.push_back(asked.client_info().is_observer());
  }
  return observers;
}

/// What takeControl() and releaseControl() are answered.
struct Answers {
  auto keep() {
    return [this](const BlueyeSession::Answer& answer) { all.push_back(answer); };
  }
  std::vector<BlueyeSession::Answer> all;
};

TEST(BlueyeSession, ALinkLostWhileControlIsTakenLeavesNoRegistrationForTheNextOne) {
  for (const std::size_t step : {0U, 1U}) {  // goodbye of the observer, registration anew
    ScriptedDrone drone;
    Answers answers;
    drone.connect();
    drone.run(1s);
    drone.hold(step);
    drone.session.takeControl(drone.now, answers.keep(), drone);
    drone.run(20ms);
    drone.loseLink();
    ASSERT_EQ(answers.all.size(), 1u) << step;
    EXPECT_FALSE(answers.all[0].success) << step;
    drone.letGo();
    drone.requests.clear();
    drone.connect();
    drone.run(3s);
    EXPECT_THAT(observersAsked(drone), ElementsAre(true)) << step;
    EXPECT_EQ(drone.in_control, 0u) << step;
    EXPECT_THAT(drone.controls, IsEmpty()) << step;
  }
}

TEST(BlueyeSession, LeavingWhileControlIsTakenRegistersNothing) {
  ScriptedDrone drone;
  Answers answers;
  drone.connect();
  drone.run(1s);
  drone.hold();
  drone.session.takeControl(drone.now, answers.keep(), drone);
  drone.run(20ms);
  drone.requests.clear();
  drone.session.leave(drone.now, drone);
  drone.letGo();
  drone.run(200ms);
  EXPECT_THAT(observersAsked(drone), IsEmpty());
  ASSERT_EQ(answers.all.size(), 1u);
  EXPECT_EQ(answers.all[0].message, "the driver is stopping");
  EXPECT_TRUE(drone.session.hasLeft());
}

TEST(BlueyeSession, ReleasingUnderAStreamOfCommandsLeavesTheDroneAtRest) {
  ScriptedDrone drone;
  Answers answers;
  drone.giveControl();
  drone.run(2s);
  EXPECT_EQ(drone.command(forward()), "");
  drone.hold();
  drone.session.releaseControl(drone.now, answers.keep(), drone);
  for (int i = 0; i < 50; ++i) {  // a program that goes on while the drone takes its time
    EXPECT_THAT(drone.command(forward()), HasSubstr("given back"));
    drone.run(10ms);
    EXPECT_TRUE(drone.isAtRest());
  }
  drone.letGo();
  drone.run(10ms);
  ASSERT_EQ(answers.all.size(), 1u);
  EXPECT_TRUE(answers.all[0].success);
  drone.controls.clear();
  EXPECT_THAT(drone.command(forward()), HasSubstr("not in control"));
  drone.run(5s);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_TRUE(drone.registry.back().observer);
}

TEST(BlueyeSession, FallsSilentWhenTheGoodbyeOfAReleaseIsNotAnswered) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  drone.hold();
  drone.session.releaseControl(
      drone.now, [](const auto&) {}, drone);
  drone.run(2100ms);
  ASSERT_TRUE(drone.registry.back().observer);
  drone.controls.clear();
  drone.run(5s);
  EXPECT_THAT(drone.controls, IsEmpty());  // the drone has the one before in control still
}

TEST(BlueyeSession, ALinkLostWhileControlIsReleasedIsAnsweredAndLeavesAnObserver) {
  ScriptedDrone drone;
  Answers answers;
  drone.giveControl();
  drone.run(2s);
  drone.hold();
  drone.session.releaseControl(drone.now, answers.keep(), drone);
  drone.run(20ms);
  drone.loseLink();
  ASSERT_EQ(answers.all.size(), 1u);
  EXPECT_THAT(answers.all[0].message, HasSubstr("connection was lost"));
  drone.letGo();
  drone.requests.clear();
  drone.controls.clear();
  drone.connect();
  drone.run(3s);
  EXPECT_THAT(observersAsked(drone), ElementsAre(true));
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, FallsSilentWhenAnotherClientTakesControlWhileItIsReleased) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  drone.hold();
  drone.session.releaseControl(
      drone.now, [](const auto&) {}, drone);
  drone.run(20ms);
  drone.in_control = drone.addClient("Blueye App");
  drone.tellClients();
  drone.controls.clear();
  drone.run(5s);
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, ControlThatComesAfterTheCallerWasToldItDidNotIsGivenBack) {
  for (const std::size_t step : {0U, 1U, 2U}) {  // own goodbye, registration, the other's goodbye
    ScriptedDrone drone;
    Answers answers;
    const auto app = drone.addClient("Blueye App");
    drone.connect();
    drone.run(1s);
    if (step == 1) drone.removeClient(app);  // then control comes with the registration
    drone.hold(step);
    drone.session.takeControl(drone.now, answers.keep(), drone);
    drone.run(1500ms);  // control_timeout is 1 s, request_timeout 2 s
    drone.letGo();
    drone.run(200ms);
    ASSERT_EQ(answers.all.size(), 1u) << step;
    EXPECT_FALSE(answers.all[0].success) << step;
    EXPECT_FALSE(drone.session.inControl()) << step;
    ASSERT_TRUE(drone.session.registered()) << step;
    EXPECT_TRUE(drone.registry.back().observer) << step;
    if (step == 0) {
      EXPECT_THAT(observersAsked(drone), ElementsAre(true, true));
    }
    EXPECT_NE(drone.in_control, drone.session.id()) << step;
    EXPECT_THAT(drone.command(forward()), Not(IsEmpty())) << step;
    drone.controls.clear();
    drone.run(3s);
    EXPECT_THAT(drone.controls, IsEmpty()) << step;
  }
}

TEST(BlueyeSession, TellsWhoeverAsksForControlInTimeAlsoWithoutAReply) {
  for (const std::size_t step : {0U, 1U, 2U}) {  // own goodbye, registration, the other's goodbye
    ScriptedDrone drone;
    Answers answers;
    drone.addClient("Blueye App");
    drone.connect();
    drone.run(1s);
    drone.hold(step);
    const auto asked = drone.now.steady;
    drone.session.takeControl(drone.now, answers.keep(), drone);
    while (answers.all.empty() && drone.now.steady < asked + 5s) drone.run(1ms);
    ASSERT_EQ(answers.all.size(), 1u) << step;
    EXPECT_FALSE(answers.all[0].success) << step;
    EXPECT_LE(drone.now.steady - asked, 1001ms) << step;  // control_timeout
    drone.run(5s);
    EXPECT_EQ(answers.all.size(), 1u) << step;
    EXPECT_TRUE(drone.registry.back().observer) << step;
  }
}

TEST(BlueyeSession, EndsAStaleCommandWithZerosWithinItsLimit) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.command(forward());
  drone.command(vehicle::TiltCommand{0.5});
  drone.command(vehicle::GripperCommand{1.0, -1.0});
  const auto commanded = drone.now.steady;
  while (!drone.isAtRest() && drone.now.steady < commanded + 5s) drone.run(1ms);
  EXPECT_LE(drone.now.steady - commanded, 1s + 1ms);  // command_timeout
  EXPECT_FALSE(drone.control.commanding);
  drone.controls.clear();
  drone.run(10s);
  EXPECT_EQ(drone.controlsOf("MotionInputCtrl").size(), 3u);  // a second apart, for three seconds
  EXPECT_EQ(drone.controlsOf("TiltVelocityCtrl").size(), 3u);
  EXPECT_EQ(drone.controlsOf("GripperCtrl").size(), 3u);
  EXPECT_TRUE(drone.isAtRest());
}

TEST(BlueyeSession, FallsSilentWhenAnotherClientTakesControl) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  drone.command(forward());
  const auto other = drone.addClient("Blueye App");
  drone.in_control = other;
  drone.tellClients();
  drone.controls.clear();
  EXPECT_THAT(drone.command(forward()), HasSubstr("(Blueye App) is in control"));
  drone.run(10s);
  // Not even zero or the watchdog: they would stop or arm what the other one does.
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_EQ(drone.control.grant, vehicle::Grant::Denied);
}

TEST(BlueyeSession, RegistersAgainAsAnObserverWhenSomebodyDisconnectsIt) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  drone.command(forward());
  const auto before = drone.session.id();
  drone.removeClient(before);
  drone.addClient("Blueye App");
  drone.tellClients();
  drone.controls.clear();
  drone.run(5s);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_TRUE(drone.session.registered());
  EXPECT_NE(drone.session.id(), before);
  EXPECT_TRUE(drone.registry.back().observer);
}

TEST(BlueyeSession, RegistersAgainWhenTheDroneHasNoClientsLeft) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  drone.removeClient(drone.session.id());
  drone.requests.clear();
  const auto told = drone.now.steady;
  drone.tellClients();
  EXPECT_FALSE(drone.session.inControl());
  drone.run(2s);
  EXPECT_THAT(timesOf(drone, "PingReq"), ElementsAre(told + 1s));
  ASSERT_EQ(drone.registry.size(), 1u);
  EXPECT_EQ(drone.registry[0].id, drone.session.id());
}

TEST(BlueyeSession, ADroneThatListsNobodyKeepsItsClient) {
  ScriptedDrone drone;
  drone.lists_clients = false;
  drone.giveControl();
  drone.run(2s);
  drone.tellClients();
  EXPECT_TRUE(drone.session.inControl());
  EXPECT_EQ(drone.registry.size(), 1u);
}

TEST(BlueyeSession, AsksWhenTelemetryMayBeOlderThanTheLastReply) {
  ScriptedDrone drone;
  const auto app = drone.addClient("Blueye App");
  drone.giveControl();
  ASSERT_TRUE(drone.session.inControl());
  // What the drone published before it gave control, overtaken by the reply.
  pb::ConnectedClientsTel old;
  old.set_client_id_in_control(app);
  old.add_connected_clients()->set_client_id(app);
  drone.tell(old);
  drone.run(100ms);
  EXPECT_TRUE(drone.session.inControl());
  EXPECT_EQ(drone.registry.size(), 1u);
}

TEST(BlueyeSession, CountsLossOfControlRightAfterItWasGiven) {
  for (const bool answered : {true, false}) {
    ScriptedDrone drone;
    drone.giveControl();
    ASSERT_TRUE(drone.session.inControl());
    EXPECT_EQ(drone.command(forward()), "");
    drone.in_control = drone.addClient("Blueye App");
    if (!answered) drone.hold();
    drone.tellClients();  // within the second in which telemetry may be old
    drone.controls.clear();
    EXPECT_THAT(drone.command(forward()), HasSubstr("in control")) << answered;
    EXPECT_EQ(drone.session.idInControl(), drone.in_control) << answered;
    drone.run(2500ms);
    EXPECT_THAT(drone.controls, IsEmpty()) << answered;
    EXPECT_FALSE(drone.session.inControl()) << answered;
  }
}

// It may list others alone and still name this client, as between two of its own steps.
TEST(BlueyeSession, IsNotInControlOfADroneThatDoesNotListIt) {
  ScriptedDrone drone;
  drone.giveControl();
  EXPECT_EQ(drone.command(forward()), "");
  drone.registry = {{99, "Blueye App", "App", false}};
  drone.hold();
  drone.tellClients();
  EXPECT_FALSE(drone.session.inControl());
  drone.controls.clear();
  drone.run(1s);
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, AsksForASecondAfterItsRegistrationWhetherTelemetryIsOlder) {
  for (const auto& [after, asks] : {std::pair{999ms, 1u}, std::pair{1000ms, 0u}}) {
    ScriptedDrone drone;
    drone.connect();
    const auto registered = timesOf(drone, "ConnectClientReq").at(0);  // and answered
    while (drone.now.steady < registered + after) drone.run(1ms);
    drone.addClient("Blueye App");
    drone.requests.clear();
    drone.tellClients();
    drone.run(10ms);
    EXPECT_THAT(timesOf(drone, "GetTelemetryReq"), SizeIs(asks)) << after.count();
    EXPECT_EQ(drone.session.idInControl(), drone.in_control) << after.count();
  }
}

TEST(BlueyeSession, AsksWhoIsInControlUntilItIsTold) {
  ScriptedDrone drone;
  const auto app = drone.addClient("Blueye App");
  drone.giveControl();
  pb::ConnectedClientsTel old;  // overtaken by the reply
  old.set_client_id_in_control(app);
  old.add_connected_clients()->set_client_id(app);
  drone.hold();
  drone.tell(old);
  drone.run(2100ms);
  EXPECT_FALSE(drone.session.inControl());
  drone.letGo();
  drone.run(1100ms);
  EXPECT_TRUE(drone.session.inControl());
}

// Another client takes control while the reply that tells of ours is on its way.
TEST(BlueyeSession, AReplyThatIsOlderThanTheLossOfControlDoesNotBringItBack) {
  ScriptedDrone drone;
  drone.giveControl();
  const auto rightful = drone.replyAboutClients();
  drone.in_control = drone.addClient("Blueye App");
  drone.hold();
  drone.tellClients();
  drone.run(10ms);
  drone.tellClients();
  drone.controls.clear();
  drone.echoes = true;
  drone.echo = rightful;
  drone.letGo();
  drone.run(1ms);
  drone.echoes = false;
  EXPECT_FALSE(drone.session.inControl());
  drone.run(3s);
  EXPECT_FALSE(drone.session.inControl());
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, ARegistrationThatIsOlderThanTheLossOfControlDoesNotBringIt) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(2s);
  drone.hold(1);  // goodbye is answered, the registration late
  drone.session.takeControl(
      drone.now, [](const auto&) {}, drone);
  drone.run(10ms);
  const auto app = drone.addClient("Blueye App");
  drone.tellClients();
  ASSERT_EQ(drone.in_control, app);
  pb::ConnectClientRep registered;
  registered.set_client_id(app + 1);
  registered.set_client_id_in_control(app + 1);
  registered.add_connected_clients()->set_client_id(app + 1);
  drone.echoes = true;
  drone.echo = {registered.GetTypeName(), registered.SerializeAsString()};
  drone.letGo();
  drone.run(1ms);
  drone.echoes = false;
  EXPECT_EQ(drone.session.id(), app + 1);
  EXPECT_FALSE(drone.session.inControl());
  EXPECT_THAT(drone.controls, IsEmpty());
}

// A caller's request would wait behind them.
TEST(BlueyeSession, AsksOneQuestionAtATimeHoweverFastTelemetryIs) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.in_control = drone.addClient("Blueye App");
  drone.hold();
  for (int i = 0; i < 50; ++i) {
    drone.tellClients();
    drone.run(10ms);
  }
  drone.letGo();
  drone.requests.clear();
  drone.run(5ms);
  EXPECT_LE(drone.requests.size(), 1u);
  EXPECT_FALSE(drone.session.inControl());
}

TEST(BlueyeSession, TelemetryAloneGivesNoControl) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(2s);
  const auto app = drone.addClient("Blueye App");
  drone.in_control = app;
  drone.tellClients();
  EXPECT_FALSE(drone.session.inControl());
  drone.removeClient(app);  // this client is next in line
  drone.controls.clear();
  drone.hold();
  drone.tellClients();
  drone.run(100ms);
  EXPECT_FALSE(drone.session.inControl());
  EXPECT_THAT(drone.controls, IsEmpty());
  drone.letGo();
  drone.run(10ms);
  EXPECT_TRUE(drone.session.inControl());
  EXPECT_TRUE(drone.isAtRest());
}

TEST(BlueyeSession, SendsZeroAgainHoweverSoonControlComesBack) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.session.stop(drone.now, drone);
  const auto us = std::exchange(drone.in_control, drone.addClient("Blueye App"));
  drone.tellClients();
  drone.controls.clear();
  drone.in_control = us;  // who may have moved it meanwhile
  drone.tellClients();
  drone.run(5ms);
  ASSERT_TRUE(drone.session.inControl());
  EXPECT_EQ(drone.controlsOf("MotionInputCtrl").size(), 1u);
}

TEST(BlueyeSession, ForgetsEverythingWithTheConnection) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.command(forward());
  drone.loseLink();
  EXPECT_EQ(drone.control.grant, vehicle::Grant::Unknown);
  EXPECT_FALSE(drone.control.commanding);
  EXPECT_EQ(drone.session.nextStep(), vehicle::SteadyTime::max());
  drone.controls.clear();
  drone.requests.clear();
  drone.run(2s);
  EXPECT_THAT(drone.requests, IsEmpty());
  EXPECT_EQ(drone.command(forward()), "there is no connection to the vehicle");
  drone.connect();
  EXPECT_THAT(drone.command(forward()), HasSubstr("not in control"));
  drone.run(5s);
  EXPECT_TRUE(drone.session.registered());
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, LeavesTheConnectionsOfADroneThatWasRebooted) {
  ScriptedDrone drone;
  drone.connect();
  drone.tell(clockAt(1000));
  drone.tell(clockAt(1001));
  EXPECT_THAT(drone.reconnects, IsEmpty());
  drone.tell(clockAt(3));
  EXPECT_THAT(drone.reconnects, ElementsAre("the drone was rebooted"));
}

struct Clocks {
  pb::DroneTimeTel before, after;
  bool rebooted;
};

// Telemetry may overtake itself by a little, and a clock does not step back by a second.
TEST(BlueyeSession, TakesAClockThatGoesBackByMoreThanASecondForAReboot) {
  const Clocks kRows[] = {{clockAt(1000), clockAt(1000), false},
                          {clockAt(1000), clockAt(999, 500'000'000), false},
                          {clockAt(1000), clockAt(999), false},
                          {clockAt(1000), clockAt(998, 999'999'999), true},
                          {clockAt(1000, 900'000'000), clockAt(999, 800'000'000), true},
                          {clockAt(1000, 100'000'000), clockAt(999, 200'000'000), false}};
  for (const Clocks& row : kRows) {
    ScriptedDrone drone;
    drone.connect();
    drone.tell(row.before);
    drone.tell(row.after);
    EXPECT_EQ(drone.reconnects.size(), row.rebooted ? 1u : 0u)
        << row.before.ShortDebugString() << " " << row.after.ShortDebugString();
  }
}

// Nanoseconds of it would not fit into 64 bits.
TEST(BlueyeSession, TakesNoClockThatNoneCanShowForAReboot) {
  ScriptedDrone drone;
  drone.connect();
  drone.tell(clockAt(1000));
  drone.tell(clockAt(std::numeric_limits<std::int64_t>::max()));
  drone.tell(clockAt(std::numeric_limits<std::int64_t>::min()));
  drone.tell(clockAt(9'300'000'000));
  drone.tell(clockAt(1002));
  EXPECT_THAT(drone.reconnects, IsEmpty());
  drone.tell(clockAt(3));
  EXPECT_EQ(drone.reconnects.size(), 1u);
}

TEST(BlueyeSession, StopSendsZerosAtOnceAndPausesTheMission) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.tell(missionIn(pb::MISSION_STATE_RUNNING));
  drone.command(forward());
  drone.controls.clear();
  const auto stopped = drone.session.stop(drone.now, drone);
  EXPECT_TRUE(stopped.success);
  EXPECT_THAT(stopped.message, HasSubstr("paused"));
  EXPECT_TRUE(drone.isAtRest());
  EXPECT_EQ(drone.controlsOf("MotionInputCtrl").size(), 1u);
  EXPECT_EQ(drone.controlsOf("TiltVelocityCtrl").size(), 1u);
  EXPECT_EQ(drone.controlsOf("GripperCtrl").size(), 1u);
  EXPECT_EQ(drone.controlsOf("PauseMissionCtrl").size(), 1u);
  drone.controls.clear();
  EXPECT_TRUE(drone.session.abort(drone.now, drone).success);
  EXPECT_EQ(drone.controlsOf("ClearMissionCtrl").size(), 1u);
  drone.tell(missionIn(pb::MISSION_STATE_PAUSED));
  drone.run(1100ms);
  EXPECT_EQ(drone.controlsOf("PauseMissionCtrl").size(), 1u);
  EXPECT_EQ(drone.controlsOf("ClearMissionCtrl").size(), 3u);
  drone.tell(missionIn(pb::MISSION_STATE_INACTIVE));
  drone.run(5s);
  EXPECT_EQ(drone.controlsOf("ClearMissionCtrl").size(), 3u);
}

TEST(BlueyeSession, StopGoesOnPausingForFiveSecondsAndAsksForTheMissionMeanwhile) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(1s);
  drone.controls.clear();
  drone.requests.clear();
  drone.session.step(drone.now, drone);
  const auto stopped = drone.now.steady;
  drone.session.stop(drone.now, drone);
  drone.run(20s);
  const auto pauses = drone.controlsOf("PauseMissionCtrl");
  ASSERT_EQ(pauses.size(), 10u);
  EXPECT_EQ(pauses.back().at - stopped, 4500ms);
  const auto questions = timesOf(drone, "GetTelemetryReq");
  ASSERT_EQ(questions.size(), 16u);  // at 0.3 s, 0.6 s ... 4.8 s
  EXPECT_EQ(questions[0] - stopped, 300ms);
  EXPECT_THAT(spacings(questions), Each(300ms));
}

TEST(BlueyeSession, AbortThatSendsNothingIsNoSuccess) {
  ScriptedDrone drone;
  drone.connect();
  auto answer = drone.session.abort(drone.now, drone);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("nothing was sent"));
  EXPECT_THAT(drone.controls, IsEmpty());
  drone.giveControl();
  drone.link_takes = false;
  answer = drone.session.abort(drone.now, drone);
  EXPECT_FALSE(answer.success);
  drone.link_takes = true;
  drone.run(25ms);
  EXPECT_EQ(drone.controlsOf("ClearMissionCtrl").size(), 1u);
}

TEST(BlueyeSession, StopThatSendsNothingIsNoSuccess) {
  ScriptedDrone drone;
  drone.connect();
  auto answer = drone.session.stop(drone.now, drone);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("nothing was sent"));
  drone.giveControl();
  drone.run(1s);
  drone.link_takes = false;
  answer = drone.session.stop(drone.now, drone);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("sent again"));
  EXPECT_FALSE(drone.session.abort(drone.now, drone).success);
  drone.link_takes = true;
  EXPECT_TRUE(drone.session.stop(drone.now, drone).success);
}

TEST(BlueyeSession, StopGoesOnPausingWhenSomebodyAsksForAPauseAfterIt) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.session.stop(drone.now, drone);
  ConfirmedControls::Control pause;  // sent once, as service mission/pause does
  pause.type = "blueye.protocol.PauseMissionCtrl";
  pause.confirmed_by = "blueye.protocol.MissionStatusTel";
  pause.shows = [](std::string_view) { return false; };
  drone.session.control(drone.now, std::move(pause), drone);
  drone.controls.clear();
  drone.run(1100ms);
  EXPECT_EQ(drone.controlsOf("PauseMissionCtrl").size(), 2u);
}

TEST(BlueyeSession, AMissionThatIsLoadedAnewIsNotClearedByTheAbortBeforeIt) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.session.abort(drone.now, drone);
  drone.session.request(
      drone.now, "blueye.protocol.SetMissionReq", {}, 500ms, [](const auto&) {}, drone);
  drone.controls.clear();
  drone.run(10s);
  EXPECT_THAT(drone.controlsOf("ClearMissionCtrl"), IsEmpty());
}

TEST(BlueyeSession, StopPausesAMissionThatTheDroneHasNotToldOfYet) {
  for (const bool told_ready : {true, false}) {
    ScriptedDrone drone;
    drone.giveControl();
    if (told_ready) drone.tell(missionIn(pb::MISSION_STATE_READY));
    ConfirmedControls::Control run;
    run.type = "blueye.protocol.RunMissionCtrl";
    drone.session.control(drone.now, std::move(run), drone);
    drone.session.stop(drone.now, drone);
    EXPECT_EQ(drone.controls.back().type, "PauseMissionCtrl");
    // What the drone told before it began does not count, nor that it runs.
    drone.tell(missionIn(pb::MISSION_STATE_READY));
    drone.run(600ms);
    drone.tell(missionIn(pb::MISSION_STATE_RUNNING));
    drone.run(600ms);
    EXPECT_EQ(drone.controlsOf("PauseMissionCtrl").size(), 3u);
    EXPECT_THAT(drone.requestNames(), Contains("GetTelemetryReq"));
    drone.tell(missionIn(pb::MISSION_STATE_PAUSED));
    drone.controls.clear();
    drone.run(10s);
    EXPECT_THAT(drone.controlsOf("PauseMissionCtrl"), IsEmpty());
  }
}

TEST(BlueyeSession, StopGoesOnPausingWhenTheGateIsClosedAfterIt) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.tell(missionIn(pb::MISSION_STATE_RUNNING));
  drone.session.stop(drone.now, drone);
  drone.session.setCommandsEnabled(drone.now, false);
  drone.run(1100ms);
  EXPECT_EQ(drone.controlsOf("PauseMissionCtrl").size(), 3u);
  drone.in_control = drone.addClient("Blueye App");
  drone.run(1s);  // past what may be older than a reply
  drone.tellClients();
  drone.controls.clear();
  drone.run(5s);
  EXPECT_THAT(drone.controls, IsEmpty());  // it would pause what the other one runs
}

TEST(BlueyeSession, AMissionThatIsRunAgainIsNotPausedByTheStopBeforeIt) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.session.stop(drone.now, drone);
  ConfirmedControls::Control run;
  run.type = "blueye.protocol.RunMissionCtrl";
  drone.session.control(drone.now, std::move(run), drone);
  drone.controls.clear();
  drone.run(10s);
  EXPECT_THAT(drone.controlsOf("PauseMissionCtrl"), IsEmpty());
}

TEST(BlueyeSession, RefusesCommandsFromBeforeTheStop) {
  ScriptedDrone drone;
  drone.giveControl();
  const auto received = drone.now.steady;
  drone.run(10ms);
  drone.session.stop(drone.now, drone);
  EXPECT_THAT(drone.session.command(drone.now, forward(), received), HasSubstr("before the last"));
  EXPECT_EQ(drone.command(forward()), "");
}

TEST(BlueyeSession, RefusesOtherControlsThatWaitedTooLongOrAcrossAStop) {
  ScriptedDrone drone;
  drone.giveControl();
  const auto send = [&](vehicle::SteadyTime received) {
    std::string refusal = "not answered";
    ConfirmedControls::Control light;
    light.type = "blueye.protocol.LightsCtrl";
    light.respond = [&](const std::string& given) { refusal = given; };
    drone.session.control(drone.now, std::move(light), drone, received);
    return refusal;
  };
  EXPECT_EQ(send(drone.now.steady), "");
  const auto received = drone.now.steady;
  drone.run(10ms);
  drone.session.stop(drone.now, drone);
  EXPECT_THAT(send(received), HasSubstr("before the last stop"));
  drone.run(1s);
  EXPECT_THAT(send(drone.now.steady - 1s), HasSubstr("command_timeout"));
  EXPECT_EQ(drone.controlsOf("LightsCtrl").size(), 1u);
  EXPECT_EQ(drone.session.counters().refused_commands, 2u);
  drone.session.countRefusedCommands(3);
  EXPECT_EQ(drone.session.counters().refused_commands, 5u);
}

TEST(BlueyeSession, RefusesWhatCameWhileTheDriverStoodStill) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  std::string refusal;
  const auto control = [&] {
    ConfirmedControls::Control light;
    light.type = "blueye.protocol.LightsCtrl";
    light.respond = [&](const std::string& given) { refusal = given; };
    drone.session.control(drone.now, std::move(light), drone);
    return refusal;
  };
  const auto request = [&] {
    drone.session.request(
        drone.now, "PingReq", {}, 1s, [&](const BlueyeReply& reply) { refusal = reply.reason; },
        drone);
    drone.run(1ms);
    return refusal;
  };
  drone.session.stoodStill(drone.now);
  const auto read = drone.now.steady;  // it lay in the kernel meanwhile
  EXPECT_THAT(control(), HasSubstr("stood still"));
  EXPECT_THAT(request(), HasSubstr("stood still"));
  drone.run(198ms);
  EXPECT_THAT(drone.command(forward()), HasSubstr("stood still"));
  drone.run(1ms);
  EXPECT_THAT(drone.session.command(drone.now, forward(), read), HasSubstr("stood still"));
  EXPECT_EQ(drone.command(forward()), "");
  EXPECT_EQ(control(), "");
  EXPECT_EQ(request(), "");
}

TEST(BlueyeSession, StandingStillEndsCommanding) {
  BlueyeOptions options;
  options.command_timeout = 5s;
  ScriptedDrone drone(options);
  drone.giveControl();
  drone.run(5s);
  drone.command(forward());
  drone.run(10ms);
  EXPECT_FALSE(drone.isAtRest());
  drone.now.steady += 2s;
  drone.session.stoodStill(drone.now);
  drone.session.step(drone.now, drone);
  EXPECT_TRUE(drone.isAtRest());
  drone.run(3s);
  EXPECT_TRUE(drone.isAtRest());
}

TEST(BlueyeSession, ClosingTheGateSendsZeroAndOpeningRevivesNothing) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.command(forward());
  drone.session.setCommandsEnabled(drone.now, false);
  drone.session.step(drone.now, drone);
  EXPECT_TRUE(drone.isAtRest());
  EXPECT_THAT(drone.command(forward()), HasSubstr("gate is closed"));
  drone.run(5s);
  drone.controls.clear();
  drone.session.setCommandsEnabled(drone.now, true);
  drone.run(3s);
  EXPECT_THAT(drone.controlsOf("MotionInputCtrl"), IsEmpty());
}

TEST(BlueyeSession, LeavesWithZeroMotionAndGoodbye) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.command(forward());
  drone.requests.clear();
  drone.session.leave(drone.now, drone);
  drone.session.step(drone.now, drone);
  EXPECT_TRUE(drone.isAtRest());
  EXPECT_FALSE(drone.session.hasLeft());
  drone.run(50ms);
  EXPECT_TRUE(drone.session.hasLeft());
  EXPECT_THAT(drone.registry, IsEmpty());
  drone.controls.clear();
  EXPECT_EQ(drone.command(forward()), "the driver is stopping");
  drone.run(900ms);
  EXPECT_THAT(drone.controlsOf("WatchdogCtrl"), IsEmpty());
  EXPECT_TRUE(drone.isAtRest());
  EXPECT_THAT(drone.requestNames(), ElementsAre("DisconnectClientReq"));
}

TEST(BlueyeSession, WaitsNoLongerThan50msForTheAnswerToItsGoodbye) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.answers = false;
  drone.session.leave(drone.now, drone);
  drone.session.step(drone.now, drone);
  drone.run(49ms);
  EXPECT_FALSE(drone.session.hasLeft());
  drone.run(1ms);
  EXPECT_TRUE(drone.session.hasLeft());
}

TEST(BlueyeSession, SendsNoZeroAfterItsGoodbye) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.command(forward());
  drone.link_takes = false;
  drone.session.leave(drone.now, drone);
  drone.run(10ms);  // the goodbye is answered: another client may be in control
  drone.link_takes = true;
  drone.controls.clear();
  drone.run(100ms);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_TRUE(drone.session.hasLeft());
}

TEST(BlueyeSession, SendsNoZeroAfterTheGoodbyeOfAReleaseEither) {
  ScriptedDrone drone;
  Answers answers;
  drone.giveControl();
  drone.command(forward());
  drone.link_takes = false;
  drone.hold();
  drone.session.releaseControl(drone.now, answers.keep(), drone);
  drone.run(5ms);
  drone.session.leave(drone.now, drone);
  EXPECT_EQ(answers.all.size(), 1u);
  drone.letGo();
  drone.run(10ms);
  drone.link_takes = true;
  drone.controls.clear();
  drone.run(100ms);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_TRUE(drone.session.hasLeft());
}

// The drone has removed the client, and says of it that it is in control all the same.
TEST(BlueyeSession, SendsNoZeroWhenItLeavesBetweenTwoRegistrations) {
  ScriptedDrone drone;
  Answers answers;
  drone.connect();
  drone.run(1s);
  drone.hold();
  drone.session.takeControl(drone.now, answers.keep(), drone);
  drone.run(5ms);
  pb::DisconnectClientRep gone;
  gone.set_client_id_in_control(drone.session.id());
  drone.session.reply(drone.now, gone.GetTypeName(), gone.SerializeAsString(), drone);
  EXPECT_TRUE(drone.session.inControl());
  drone.controls.clear();
  drone.session.leave(drone.now, drone);
  drone.run(100ms);
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_TRUE(drone.session.hasLeft());
  EXPECT_EQ(answers.all.size(), 1u);
}

TEST(BlueyeSession, LeavesAtOnceWhenItIsNotRegistered) {
  ScriptedDrone drone;
  drone.session.leave(drone.now, drone);
  EXPECT_TRUE(drone.session.hasLeft());
}

TEST(BlueyeSession, SendsTheZeroAgainThatTheLinkDidNotTake) {
  ScriptedDrone drone;
  drone.giveControl();
  drone.run(5s);
  drone.command(forward());
  drone.link_takes = false;
  drone.session.stop(drone.now, drone);
  drone.run(100ms);
  EXPECT_FALSE(drone.isAtRest());
  drone.link_takes = true;
  drone.run(25ms);
  EXPECT_TRUE(drone.isAtRest());
}

TEST(BlueyeSession, PassesOnWhatItDoesNotKnowAndCountsWhatItCannotRead) {
  ScriptedDrone drone;
  drone.connect();
  drone.session.telemetry(drone.now, "blueye.protocol.TeleportTel", "\x01\x02", drone);
  EXPECT_EQ(drone.heard.back(), "TeleportTel");
  EXPECT_EQ(drone.session.counters().malformed, 0u);
  drone.session.telemetry(drone.now, "blueye.protocol.ConnectedClientsTel", "\xff\xff", drone);
  EXPECT_EQ(drone.session.counters().malformed, 1u);
  EXPECT_TRUE(drone.session.registered());
}

TEST(BlueyeSession, CountsTheBytesOfTypesAndPayloads) {
  ScriptedDrone drone;
  drone.session.telemetry(drone.now, "blueye.protocol.DepthTel", {"\x0a\x00", 2}, drone);
  EXPECT_EQ(drone.session.counters().bytes_received, 24u + 2u);
  drone.session.reply(drone.now, "google.protobuf.Empty", {"\x08\x01\x10", 3}, drone);
  EXPECT_EQ(drone.session.counters().bytes_received, 26u + 21u + 3u);
}

TEST(BlueyeSession, ReportsTheMissionInCommonWordsWhenItChanges) {
  ScriptedDrone drone;
  drone.connect();
  for (const auto state :
       {pb::MISSION_STATE_INACTIVE, pb::MISSION_STATE_READY, pb::MISSION_STATE_READY,
        pb::MISSION_STATE_RUNNING, pb::MISSION_STATE_PAUSED, pb::MISSION_STATE_COMPLETED}) {
    drone.tell(missionIn(state));
  }
  EXPECT_THAT(drone.mission, ElementsAre(State::Waiting, State::Ready, State::Running,
                                         State::Stopped, State::Completed));
}

TEST(BlueyeSession, AsksForARateNowAndAfterEveryConnect) {
  ScriptedDrone drone;
  drone.refused_rates = {"NoSuchTel"};
  drone.connect();
  std::optional<BlueyeSession::Answer> answer;
  const auto respond = [&](const auto& given) { answer = given; };
  drone.session.setRate(drone.now, "DepthTel", 40.0, respond, drone);
  drone.run(10ms);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->success);
  drone.session.setRate(drone.now, "NoSuchTel", 10.0, respond, drone);
  drone.run(10ms);
  EXPECT_FALSE(answer->success);
  drone.session.setRate(drone.now, "DepthTel", 101.0, respond, drone);
  EXPECT_THAT(answer->message, HasSubstr("101"));
  for (const auto& [rate_hz, accepted] : {std::pair{0.0, true}, {0.5, true}, {-0.1, false}}) {
    drone.session.setRate(drone.now, "DepthTel", rate_hz, respond, drone);
    drone.run(10ms);
    EXPECT_EQ(answer->success, accepted) << rate_hz;
  }
  drone.loseLink();
  drone.requests.clear();
  drone.connect();
  EXPECT_EQ(std::count_if(drone.requests.begin(), drone.requests.end(),
                          [](const auto& one) { return one.type == "SetPubFrequencyReq"; }),
            2);
}

TEST(BlueyeSession, ConfirmsAControlByTelemetryAndRepeatsItUntilThen) {
  ScriptedDrone drone;
  drone.giveControl();
  std::optional<std::string> answer;
  const auto turn_on = [&] {
    ConfirmedControls::Control control;
    control.type = "blueye.protocol.AutoDepthCtrl";
    control.repeat = true;
    control.confirmed_by = "blueye.protocol.ControlModeTel";
    control.shows = [](std::string_view payload) {
      pb::ControlModeTel message;
      message.ParseFromString(std::string{payload});
      return message.state().auto_depth();
    };
    control.respond = [&](const std::string& refusal) { answer = refusal; };
    drone.session.control(drone.now, std::move(control), drone);
  };
  turn_on();
  drone.run(1100ms);
  EXPECT_EQ(drone.controlsOf("AutoDepthCtrl").size(), 3u);
  EXPECT_FALSE(answer);
  pb::ControlModeTel mode;
  drone.tell(mode);
  EXPECT_FALSE(answer);
  mode.mutable_state()->set_auto_depth(true);
  drone.tell(mode);
  ASSERT_TRUE(answer);
  EXPECT_EQ(*answer, "");
  answer.reset();
  turn_on();
  drone.run(2100ms);
  ASSERT_TRUE(answer);
  EXPECT_THAT(*answer, HasSubstr("did not show it"));
}

struct RefusedControl {
  const char* type;
  const char* reason;
};

TEST(BlueyeSession, RefusesControlsThatHaveOwnersOrDestroy) {
  const RefusedControl kRows[] = {{"MotionInputCtrl", "cmd_motion"},
                                  {"WatchdogCtrl", "watchdog"},
                                  {"TiltVelocityCtrl", "cmd_tilt"},
                                  {"GripperCtrl", "cmd_gripper"},
                                  {"FormatRemovableStorageDeviceCtrl", "allow_format"},
                                  {"PingReq", "does not end in Ctrl"}};
  ScriptedDrone drone;
  drone.giveControl();
  drone.controls.clear();
  for (const RefusedControl& row : kRows) {
    std::string answer;
    ConfirmedControls::Control control;
    control.type = std::string{"blueye.protocol."} + row.type;
    control.respond = [&](const std::string& refusal) { answer = refusal; };
    drone.session.control(drone.now, std::move(control), drone);
    EXPECT_THAT(answer, HasSubstr(row.reason)) << row.type;
  }
  EXPECT_THAT(drone.controls, IsEmpty());
}

TEST(BlueyeSession, AnswersARequestWithItsReplyOrWhyThereIsNone) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(1s);
  std::vector<std::string> answers;
  const auto ask = [&](const char* type) {
    drone.session.request(
        drone.now, type, {}, 500ms,
        [&](const BlueyeReply& reply) {
          answers.push_back(reply.received ? std::string{reply.type} : reply.reason);
        },
        drone);
  };
  ask("blueye.protocol.GetBatteryReq");
  drone.run(10ms);
  drone.answers = false;
  ask("blueye.protocol.GetMissionReq");
  drone.run(600ms);
  ask("blueye.protocol.LightsCtrl");
  ask("blueye.protocol.FlashEscSettingsReq");
  ask("blueye.protocol.PingReq");
  drone.loseLink();
  ASSERT_EQ(answers.size(), 5u);
  EXPECT_EQ(answers[0], "google.protobuf.Empty");
  EXPECT_EQ(answers[1], "no reply");
  EXPECT_THAT(answers[2], HasSubstr("Req"));
  EXPECT_THAT(answers[3], HasSubstr("allow_flash"));
  EXPECT_THAT(answers[4], HasSubstr("connection was lost"));
}

TEST(BlueyeSession, ARecordIsOnlyListenedTo) {
  BlueyeOptions options;
  options.listen_only = true;
  ScriptedDrone drone(options);
  drone.connect();
  drone.tell(clockAt(1000));
  drone.tell(clockAt(1));
  EXPECT_EQ(drone.command(forward()), "a record is being played");
  drone.run(5s);
  EXPECT_THAT(drone.requests, IsEmpty());
  EXPECT_THAT(drone.controls, IsEmpty());
  EXPECT_THAT(drone.reconnects, IsEmpty());
  EXPECT_EQ(drone.heard.size(), 2u);
}

}  // namespace
}  // namespace frontseat_driver::session
