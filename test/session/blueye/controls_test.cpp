// What counts as rest, and how often the link is offered what it did not take.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "scripted_drone.h"

namespace frontseat_driver::session {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using vehicle::DroneCommand;
using vehicle::GripperCommand;
using vehicle::MotionCommand;
using vehicle::TiltCommand;

/// Every number of a control message.
std::vector<float> valuesOf(const ScriptedDrone::Sent& sent) {
  if (sent.type == "TiltVelocityCtrl") {
    pb::TiltVelocityCtrl message;
    message.ParseFromString(sent.payload);
    return {message.velocity().value()};
  }
  if (sent.type == "GripperCtrl") {
    pb::GripperCtrl message;
    message.ParseFromString(sent.payload);
    return {message.gripper_velocities().grip_velocity(),
            message.gripper_velocities().rotate_velocity()};
  }
  const pb::MotionInput in = ScriptedDrone::motionOf(sent);
  return {in.surge(), in.sway(), in.heave(), in.roll(), in.pitch(), in.yaw()};
}

bool rests(const ScriptedDrone::Sent& sent) {
  const std::vector<float> values = valuesOf(sent);
  return std::all_of(values.begin(), values.end(), [](float value) { return value == 0.0F; });
}

struct Moving {
  const char* name;
  const char* type;
  DroneCommand command;
};

DroneCommand motion(double MotionCommand::*axis, double value) {
  MotionCommand command;
  command.*axis = value;
  return command;
}

const Moving kMoving[] = {
    {"surge", "MotionInputCtrl", motion(&MotionCommand::surge, 1.0)},
    {"sway", "MotionInputCtrl", motion(&MotionCommand::sway, 1.0)},
    {"heave", "MotionInputCtrl", motion(&MotionCommand::heave, 1.0)},
    {"roll", "MotionInputCtrl", motion(&MotionCommand::roll, 1.0)},
    {"pitch", "MotionInputCtrl", motion(&MotionCommand::pitch, 1.0)},
    {"yaw", "MotionInputCtrl", motion(&MotionCommand::yaw, 1.0)},
    {"a_little", "MotionInputCtrl", motion(&MotionCommand::yaw, -0.01)},
    {"tilt", "TiltVelocityCtrl", TiltCommand{1.0}},
    {"grip", "GripperCtrl", GripperCommand{1.0, 0.0}},
    {"rotate", "GripperCtrl", GripperCommand{0.0, 1.0}},
};

DroneCommand restOf(const DroneCommand& command) {
  if (std::holds_alternative<TiltCommand>(command)) return TiltCommand{};
  if (std::holds_alternative<GripperCommand>(command)) return GripperCommand{};
  return MotionCommand{};
}

class AnyMotion : public testing::TestWithParam<Moving> {
 protected:
  void SetUp() override {
    drone_.giveControl();
    drone_.run(5s);  // past the zeros of gaining control
    drone_.controls.clear();
    ASSERT_EQ(drone_.command(GetParam().command), "");
    ASSERT_EQ(ofThisType().size(), 1u);
    ASSERT_FALSE(rests(ofThisType().back()));
  }

  std::vector<ScriptedDrone::Sent> ofThisType() const { return drone_.controlsOf(GetParam().type); }

  ScriptedDrone drone_;
};

// What has just gone out was no zero, so the first one must not wait.
TEST_P(AnyMotion, EndsAtOnceWithAStop) {
  EXPECT_TRUE(drone_.session.stop(drone_.now, drone_).success);
  ASSERT_EQ(ofThisType().size(), 2u);
  EXPECT_TRUE(rests(ofThisType().back()));
}

TEST_P(AnyMotion, EndsAtOnceWithACommandOfZero) {
  EXPECT_EQ(drone_.command(restOf(GetParam().command)), "");
  ASSERT_EQ(ofThisType().size(), 2u);
  EXPECT_TRUE(rests(ofThisType().back()));
}

// Only the first zero does not wait: else a program that sends zeros would flood the drone.
TEST_P(AnyMotion, WaitsItsTurnAfterAZero) {
  drone_.command(restOf(GetParam().command));
  drone_.command(restOf(GetParam().command));
  drone_.command(GetParam().command);
  EXPECT_EQ(ofThisType().size(), 2u);
  drone_.run(66ms);
  EXPECT_EQ(ofThisType().size(), 2u);
  drone_.run(2ms);  // two periods of 33.3 ms after the first
  EXPECT_EQ(ofThisType().size(), 3u);
  EXPECT_FALSE(rests(ofThisType().back()));
}

INSTANTIATE_TEST_SUITE_P(Table, AnyMotion, testing::ValuesIn(kMoving),
                         [](const auto& row) { return std::string{row.param.name}; });

// --- A link that takes nothing ---

/// The pauses between one offer and the next, ms.
std::vector<int> pauses(const std::vector<vehicle::SteadyTime>& offers) {
  std::vector<int> pauses_ms;
  for (std::size_t i = 1; i < offers.size(); ++i) {
    pauses_ms.push_back(static_cast<int>((offers[i] - offers[i - 1]) / 1ms));
  }
  return pauses_ms;
}

class FullLink : public testing::Test {
 protected:
  void SetUp() override {
    drone_.giveControl();
    drone_.run(5s);
    drone_.run(10ms);  // beside the beat of the watchdog
    drone_.link_takes = false;
    drone_.offers.clear();
  }

  const std::vector<int>& every20() const {
    static const std::vector<int> kPauses(9, 20);
    return kPauses;
  }

  ScriptedDrone drone_;
};

TEST_F(FullLink, IsOfferedACommandEvery20ms) {
  drone_.command(MotionCommand{0.5});
  drone_.run(199ms);
  EXPECT_EQ(pauses(drone_.offers["MotionInputCtrl"]), every20());
}

TEST_F(FullLink, IsOfferedTheFirstZeroEvery20ms) {
  drone_.session.stop(drone_.now, drone_);
  drone_.run(199ms);
  EXPECT_EQ(pauses(drone_.offers["MotionInputCtrl"]), every20());
  EXPECT_EQ(pauses(drone_.offers["TiltVelocityCtrl"]), every20());
  EXPECT_EQ(pauses(drone_.offers["GripperCtrl"]), every20());
}

TEST_F(FullLink, IsOfferedAControlThatIsRepeatedAtOnceAndThenEvery20ms) {
  ConfirmedControls::Control control;
  control.type = "blueye.protocol.AutoDepthCtrl";
  control.repeat = true;
  control.confirmed_by = "blueye.protocol.ControlModeTel";
  control.shows = [](std::string_view) { return false; };
  drone_.session.control(drone_.now, std::move(control), drone_);
  drone_.run(100ms);
  const auto offers = drone_.offers["AutoDepthCtrl"];
  EXPECT_EQ(pauses(offers), (std::vector<int>{1, 20, 20, 20, 20}));
  drone_.link_takes = true;
  drone_.run(1ms);
  ASSERT_EQ(drone_.controlsOf("AutoDepthCtrl").size(), 1u);
  drone_.run(499ms);
  EXPECT_EQ(drone_.controlsOf("AutoDepthCtrl").size(), 1u);
  drone_.run(1ms);
  EXPECT_EQ(drone_.controlsOf("AutoDepthCtrl").size(), 2u);
}

TEST(BlueyeRequests, AreOfferedEvery20msToALinkThatTakesNone) {
  ScriptedDrone drone;
  drone.connect();
  drone.takes_requests = false;
  drone.offers.clear();
  bool answered = false;
  drone.session.request(
      drone.now, "blueye.protocol.PingReq", {}, 1s, [&](const auto&) { answered = true; }, drone);
  drone.run(181ms);
  EXPECT_EQ(pauses(drone.offers["PingReq"]), std::vector<int>(9, 20));
  drone.takes_requests = true;
  drone.run(21ms);
  EXPECT_TRUE(answered);
}

TEST(BlueyeRequests, WaitForOneAnotherAndAreNeverMoreThan256) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(1s);
  drone.hold();
  int answered = 0;
  std::string refusal;
  const auto ask = [&] {
    drone.session.request(
        drone.now, "blueye.protocol.PingReq", {}, 1s,
        [&](const BlueyeReply& reply) {
          ++answered;
          refusal = reply.reason;
        },
        drone);
  };
  for (int i = 0; i < 256; ++i) ask();
  EXPECT_EQ(answered, 0);
  ask();
  EXPECT_EQ(answered, 1);
  EXPECT_THAT(refusal, testing::HasSubstr("too many requests"));
  drone.letGo();
  drone.run(600ms);
  EXPECT_EQ(answered, 257);
  EXPECT_EQ(refusal, "");
}

// Whoever asked is told after twice the time limit that there was no answer, and a mission that is
// loaded later, unawares, is worse than none.
TEST(BlueyeRequests, ThatWaitedForTheirWholeTimeLimitAreNotSentAnyMore) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(1s);
  drone.requests.clear();
  std::vector<std::string> answers;
  const auto ask = [&](const char* type, std::chrono::milliseconds timeout) {
    drone.session.request(
        drone.now, type, {}, timeout,
        [&answers, type](const BlueyeReply& reply) {
          answers.push_back(std::string{type} + ": " + reply.reason);
        },
        drone);
  };
  drone.hold();
  ask("SetCameraParametersReq", 5s);
  ask("SetMissionReq", 2s);
  ask("SetHeadingModeReq", 2100ms);
  ask("GetMissionReq", 5s);
  drone.run(2s);
  EXPECT_THAT(answers, IsEmpty());
  drone.letGo();
  drone.run(20ms);
  EXPECT_THAT(drone.requestNames(),
              ElementsAre("SetCameraParametersReq", "SetHeadingModeReq", "GetMissionReq"));
  EXPECT_THAT(answers, ElementsAre("SetCameraParametersReq: ",
                                   AllOf(HasSubstr("SetMissionReq: "), HasSubstr("not sent")),
                                   "SetHeadingModeReq: ", "GetMissionReq: "));
}

TEST(BlueyeRequests, ThatALinkDoesNotTakeEndWithTheirTimeLimit) {
  ScriptedDrone drone;
  drone.connect();
  drone.run(1s);
  drone.takes_requests = false;
  std::string refusal;
  drone.session.request(
      drone.now, "GetMissionReq", {}, 2s,
      [&refusal](const BlueyeReply& reply) { refusal = reply.reason; }, drone);
  drone.run(1980ms);
  EXPECT_EQ(refusal, "");
  drone.run(40ms);
  EXPECT_THAT(refusal, HasSubstr("not sent"));
}

ConfirmedControls::Control laser(float value) {
  pb::LaserCtrl message;
  message.mutable_laser()->set_value(value);
  ConfirmedControls::Control control;
  control.type = message.GetTypeName();
  control.payload = message.SerializeAsString();
  control.stream = control.type;
  return control;
}

ConfirmedControls::Control servo(int port, float value) {
  pb::GenericServoCtrl message;
  message.mutable_servo()->set_value(value);
  message.mutable_servo()->set_guest_port_number(static_cast<pb::GuestPortNumber>(port));
  ConfirmedControls::Control control;
  control.type = message.GetTypeName();
  control.payload = message.SerializeAsString();
  control.stream = control.type + std::to_string(port);
  return control;
}

float laserOf(const ScriptedDrone::Sent& sent) {
  pb::LaserCtrl message;
  message.ParseFromString(sent.payload);
  return message.laser().value();
}

class Streams : public testing::Test {
 protected:
  Streams() {
    drone_.giveControl();
    drone_.run(5s);
    drone_.controls.clear();
  }

  std::string put(ConfirmedControls::Control control) {
    std::string refusal = "not answered";
    control.respond = [&refusal](const std::string& given) { refusal = given; };
    drone_.session.control(drone_.now, std::move(control), drone_, drone_.now.steady);
    return refusal;
  }

  ScriptedDrone drone_;
};

// A drone keeps what comes faster than it is used, and a stop would come after it.
TEST_F(Streams, HaveTheirNewestSentThirtyTimesASecondAtMost) {
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(put(laser(static_cast<float>(i) / 1000.0F)), "");
    const std::size_t before = drone_.controlsOf("LaserCtrl").size();
    EXPECT_TRUE(i > 0 || before == 1) << "the first one has to wait";
    drone_.run(1ms);
  }
  drone_.run(100ms);
  const auto sent = drone_.controlsOf("LaserCtrl");
  EXPECT_GE(sent.size(), 29u);
  EXPECT_LE(sent.size(), 31u);
  for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_GE(sent[i].at - sent[i - 1].at, 33ms);
  EXPECT_FLOAT_EQ(laserOf(sent.back()), 0.999F);
}

TEST_F(Streams, DoNotHoldUpOneAnother) {
  put(laser(0.5F));
  put(servo(1, 0.5F));
  put(servo(2, 0.5F));
  EXPECT_EQ(drone_.controls.size(), 3u);
}

TEST_F(Streams, EndWithCommandingAndAreNotRevived) {
  const auto stop = [this] { drone_.session.stop(drone_.now, drone_); };
  const auto close_and_open = [this] {
    drone_.session.setCommandsEnabled(drone_.now, false);
    drone_.session.setCommandsEnabled(drone_.now, true);
  };
  const auto lose = [this] { drone_.loseLink(); };
  const auto leave = [this] { drone_.session.leave(drone_.now, drone_); };
  for (const std::function<void()>& end :
       {std::function<void()>{stop}, {close_and_open}, {lose}, {leave}}) {
    if (!drone_.session.inControl()) drone_.giveControl();
    drone_.run(100ms);
    drone_.controls.clear();
    EXPECT_EQ(put(laser(0.5F)), "");
    EXPECT_EQ(put(laser(0.75F)), "");
    end();
    drone_.run(200ms);
    EXPECT_EQ(drone_.controlsOf("LaserCtrl").size(), 1u);
  }
}

TEST_F(Streams, EndWhenAnotherClientTakesControl) {
  put(laser(0.5F));
  put(laser(0.75F));
  drone_.removeClient(drone_.in_control);
  drone_.addClient("other");
  drone_.tellClients();
  drone_.run(20ms);
  EXPECT_EQ(drone_.controlsOf("LaserCtrl").size(), 1u);
  drone_.run(200ms);
  EXPECT_EQ(drone_.controlsOf("LaserCtrl").size(), 1u);
}

TEST_F(Streams, TellThatTheLinkDidNotTakeOne) {
  drone_.link_takes = false;
  EXPECT_THAT(put(laser(0.5F)), HasSubstr("did not take"));
}

}  // namespace
}  // namespace frontseat_driver::session
