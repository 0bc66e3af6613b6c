// The session against the simulated drone, in virtual time: what the vehicle itself does when
// commanding ends in each of the ways in which it can end.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"
#include "frontseat_driver/session/blueye_session.h"
#include "frontseat_driver/sim/blueye/drone.h"

namespace frontseat_driver {
namespace {

namespace pb = ::blueye::protocol;
using namespace std::chrono_literals;
using session::BlueyeSession;

constexpr double kStill_m_s = 0.02;

sim::BlueyeConfig calmDrone() {
  sim::BlueyeConfig config;
  config.noise = false;
  config.buoyancy_n = 0.0;
  config.start_time = 1'772'366'400s;
  return config;
}

class Loop : public session::BlueyeOutput,
             public session::BlueyeListener,
             public sim::BlueyeDrone::Sink {
 public:
  Loop() : drone(calmDrone()), session(session::BlueyeOptions{}, *this) {
    now.steady += 1h;
    now.utc = now.stamp = drone.now();
    session.connected(now, *this);
    run(1s);
  }

  /// Ten milliseconds at a time; the driver's part only while it `lives`.
  void run(std::chrono::milliseconds time) {
    for (auto left = time; left > 0ms; left -= 10ms) {
      now.steady += 10ms;
      now.utc += 10ms;
      now.stamp += 10ms;
      if (program && lives) session.command(now, *program, now.steady);
      if (lives && now.steady >= session.nextStep()) session.step(now, *this);
      drone.step(now.utc, *this);
      deliver();
      if (reconnects_) linkAnew();
    }
  }

  /// Empty when this client is in control then, else what it was told.
  std::string takeControl() {
    std::optional<BlueyeSession::Answer> answer;
    session.takeControl(
        now, [&](const auto& given) { answer = given; }, *this);
    run(2s);
    if (!answer) return "no answer";
    if (!answer->success) return answer->message;
    return session.inControl() ? "" : "success without control";
  }

  /// In control, with a program that says `ahead` again and again, and moving.
  void drive() {
    ASSERT_EQ(takeControl(), "");
    vehicle::MotionCommand ahead;
    ahead.surge = 0.8;
    program = ahead;
    run(5s);
    ASSERT_GT(speed(), 0.5);
  }

  double speed() const {
    const sim::VehicleState& state = drone.model().state();
    return std::hypot(state.velocity_east_m_s, state.velocity_north_m_s, state.velocity_down_m_s);
  }
  /// Part of the full force ahead that the drone is told to give.
  double thrust() const { return drone.model().commanded().surge; }

  /// Another client asks the drone itself.
  template <class Reply, class Request>
  Reply askAsOther(const Request& request) {
    drone.request("other", request.GetTypeName(), request.SerializeAsString());
    drone.step(drone.now(), *this);
    Reply reply;
    reply.ParseFromString(other_reply);
    deliver();
    return reply;
  }

  bool publish(const vehicle::Now&, std::string_view type, std::string_view payload) override {
    if (link) drone.control(type, payload);
    return true;
  }
  bool request(const vehicle::Now& at, std::string_view type, std::string_view payload,
               std::chrono::milliseconds timeout) override {
    if (deadline_) return false;
    deadline_ = at.steady + timeout;
    if (link) drone.request("driver", type, payload);
    return true;
  }
  void reconnect(const vehicle::Now&, const std::string&) override { reconnects_ = true; }

  void telemetry(const vehicle::Now&, std::string_view, std::string_view) override {}
  void event(const vehicle::Now&, const vehicle::Event&) override {}
  void clients(const vehicle::Now&) override {}
  void note(const std::string&) override {}

  void publish(const std::string& name, std::string data) override {
    if (link) heard_.emplace_back(name, std::move(data));
  }
  void reply(const std::string& peer, const std::string& name, std::string data) override {
    if (peer == "other") {
      other_reply = std::move(data);
    } else if (link) {
      replies_.emplace_back(name, std::move(data));
    }
  }
  void truth(const sim::Truth&) override {}

  vehicle::Now now;
  sim::BlueyeDrone drone;
  BlueyeSession session;
  bool link = true;   ///< what is sent arrives
  bool lives = true;  ///< the driver's process runs
  std::optional<vehicle::DroneCommand> program;
  std::string other_reply;

 private:
  void linkAnew() {
    reconnects_ = false;
    deadline_.reset();
    heard_.clear();
    replies_.clear();
    session.disconnected(now, *this);
    session.connected(now, *this);
  }

  void deliver() {
    while (!heard_.empty()) {
      const auto message = std::move(heard_.front());
      heard_.pop_front();
      if (lives) session.telemetry(now, message.first, message.second, *this);
    }
    while (!replies_.empty()) {
      const auto message = std::move(replies_.front());
      replies_.pop_front();
      deadline_.reset();
      if (lives) session.reply(now, message.first, message.second, *this);
    }
    if (lives && deadline_ && now.steady >= *deadline_) {
      deadline_.reset();
      session.noReply(now, "no reply", *this);
    }
  }

  std::deque<std::pair<std::string, std::string>> heard_;
  std::deque<std::pair<std::string, std::string>> replies_;
  std::optional<vehicle::SteadyTime> deadline_;
  bool reconnects_ = false;
};

TEST(BlueyeClosedLoop, AnObserverMovesNothing) {
  Loop loop;
  ASSERT_TRUE(loop.session.registered());
  vehicle::MotionCommand ahead;
  ahead.surge = 1.0;
  loop.program = ahead;
  loop.run(10s);
  EXPECT_EQ(loop.thrust(), 0.0);
  EXPECT_LT(loop.speed(), kStill_m_s);
}

TEST(BlueyeClosedLoop, InControlItMovesAsLongAsItIsTold) {
  Loop loop;
  loop.drive();
  loop.run(60s);
  EXPECT_GT(loop.speed(), 0.5);
  EXPECT_TRUE(loop.session.inControl());
}

TEST(BlueyeClosedLoop, AProgramThatStopsTalkingStopsTheDrone) {
  Loop loop;
  loop.drive();
  loop.program.reset();
  loop.run(1200ms);  // command_timeout, and what one repetition takes
  EXPECT_EQ(loop.thrust(), 0.0);
  loop.run(60s);
  EXPECT_LT(loop.speed(), kStill_m_s);
  EXPECT_TRUE(loop.session.inControl());
}

TEST(BlueyeClosedLoop, ADriverThatDiesIsNoticedByTheDrone) {
  Loop loop;
  loop.drive();
  loop.lives = false;
  loop.run(4200ms);  // the drone's own limit and the time since the last watchdog
  EXPECT_EQ(loop.thrust(), 0.0);
  loop.run(60s);
  EXPECT_LT(loop.speed(), kStill_m_s);
}

TEST(BlueyeClosedLoop, ACutTetherIsNoticedByTheDroneAndNothingOldComesAfterIt) {
  Loop loop;
  loop.drive();
  loop.link = false;
  loop.session.disconnected(loop.now, loop);
  loop.run(4200ms);
  EXPECT_EQ(loop.thrust(), 0.0);
  loop.link = true;
  loop.session.connected(loop.now, loop);
  loop.run(20s);  // the program still says "ahead", but this client is an observer now
  EXPECT_EQ(loop.thrust(), 0.0);
  EXPECT_FALSE(loop.session.inControl());
  EXPECT_TRUE(loop.session.registered());
}

TEST(BlueyeClosedLoop, ARebootIsNoticedAndMovesNothing) {
  Loop loop;
  loop.drive();
  loop.drone.reboot();
  loop.run(8s);
  EXPECT_EQ(loop.thrust(), 0.0);
  loop.run(30s);
  EXPECT_TRUE(loop.drone.online());
  EXPECT_TRUE(loop.session.registered());
  EXPECT_FALSE(loop.session.inControl());
  EXPECT_EQ(loop.thrust(), 0.0);
  EXPECT_EQ(loop.takeControl(), "");
}

TEST(BlueyeClosedLoop, WhoeverTakesControlIsNotDisturbed) {
  Loop loop;
  loop.drive();
  const auto other = loop.askAsOther<pb::ConnectClientRep>(pb::ConnectClientReq{});
  pb::DisconnectClientReq away;
  away.set_client_id(loop.session.id());
  const auto reply = loop.askAsOther<pb::DisconnectClientRep>(away);
  ASSERT_EQ(reply.client_id_in_control(), other.client_id());
  loop.run(1s);
  EXPECT_FALSE(loop.session.inControl());
  EXPECT_FALSE(loop.session.refusal().empty());
  loop.run(10s);  // the other one sends no watchdog: nobody may move it
  EXPECT_EQ(loop.thrust(), 0.0);
}

TEST(BlueyeClosedLoop, LeavingInOrderStopsTheDroneAndGivesControlBack) {
  Loop loop;
  loop.drive();
  loop.program.reset();
  loop.session.leave(loop.now, loop);
  loop.run(500ms);
  EXPECT_EQ(loop.thrust(), 0.0);
  EXPECT_TRUE(loop.session.hasLeft());
  pb::ConnectClientReq observer;
  observer.mutable_client_info()->set_is_observer(true);
  EXPECT_EQ(loop.askAsOther<pb::ConnectClientRep>(observer).client_id_in_control(), 0U);
}

}  // namespace
}  // namespace frontseat_driver
