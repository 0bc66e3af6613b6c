// What a Blueye's session is made of, part by part: what is due when, and what takes whose place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "frontseat_driver/session/blueye_controls.h"
#include "frontseat_driver/session/blueye_requests.h"

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using vehicle::SteadyTime;

/// A link that takes everything and keeps the names.
struct Taking : BlueyeOutput {
  bool publish(const vehicle::Now&, std::string_view type, std::string_view) override {
    published.emplace_back(type.substr(type.rfind('.') + 1));
    return true;
  }
  bool request(const vehicle::Now&, std::string_view type, std::string_view payload,
               std::chrono::milliseconds) override {
    requested.emplace_back(type);
    payloads.emplace_back(payload);
    return true;
  }
  void reconnect(const vehicle::Now&, const std::string&) override {}

  std::vector<std::string> published, requested, payloads;
};

class Parts : public testing::Test {
 protected:
  Parts() { now_.steady += 1h; }

  /// As the session is stepped: when something is due.
  template <class Part>
  void run(Part& part, std::chrono::nanoseconds time) {
    const SteadyTime end = now_.steady + time;
    for (int steps = 0; part.nextStep() <= end; ++steps) {
      ASSERT_LT(steps, 1000) << "it goes round without a pause";
      now_.steady = std::max(now_.steady, part.nextStep());
      part.step(now_, out_);
    }
    now_.steady = end;
  }

  vehicle::Now now_;
  Taking out_;
};

TEST_F(Parts, NothingIsDueWhereThereIsNothing) {
  EXPECT_EQ(HeldControls(1s, 100ms, true).nextStep(), SteadyTime::max());
  EXPECT_EQ(ConfirmedControls{}.nextStep(), SteadyTime::max());
  EXPECT_EQ(BlueyeRequests{}.nextStep(), SteadyTime::max());
}

TEST_F(Parts, ARequestUnderWayIsWaitedFor) {
  BlueyeRequests requests;
  requests.add(
      now_, "PingReq", "", 1s, [](auto&, auto&, auto&) {}, out_);
  requests.step(now_, out_);
  EXPECT_THAT(out_.requested, ElementsAre("PingReq"));
  EXPECT_EQ(requests.nextStep(), SteadyTime::max());
}

TEST_F(Parts, APayloadIsMadeWhenItIsSent) {
  const auto respond = [](const vehicle::Now&, const BlueyeReply&, BlueyeOutput&) {};
  const auto tell = [](const vehicle::Now& now) { return std::to_string(now.utc.count()); };
  BlueyeRequests requests;
  requests.add(now_, "PingReq", "asked", 1s, respond, out_);
  requests.add(now_, "SyncTimeReq", tell, 1s, respond, out_);
  requests.step(now_, out_);
  now_.utc = 800ns;
  requests.reply(now_, "PingRep", "", out_);
  requests.step(now_, out_);
  EXPECT_THAT(out_.payloads, ElementsAre("asked", "800"));
}

struct Kind {
  vehicle::DroneCommand command, rest;
  const char* type;
};

const Kind kKinds[] = {
    {vehicle::MotionCommand{0.5}, vehicle::MotionCommand{}, "MotionInputCtrl"},
    {vehicle::TiltCommand{0.5}, vehicle::TiltCommand{}, "TiltVelocityCtrl"},
    {vehicle::GripperCommand{0.5, 0.0}, vehicle::GripperCommand{}, "GripperCtrl"}};

TEST_F(Parts, ZerosAreOfTheKindThatHasEnded) {
  for (const Kind& kind : kKinds) {
    HeldControls held(1s, 100ms, true);
    out_.published.clear();
    held.put(kind.command, now_.steady);
    run(held, 10s);
    EXPECT_EQ(out_.published.size(), 10u + 4u) << kind.type;  // a second at 10 Hz, and four zeros
    EXPECT_THAT(out_.published, Each(kind.type));
  }
}

TEST_F(Parts, AZeroThatHasJustGoneOutIsTheFirstOfFour) {
  for (const Kind& kind : kKinds) {
    HeldControls held(1s, 100ms, true);
    out_.published.clear();
    held.put(kind.rest, now_.steady);
    held.step(now_, out_);
    held.end(now_.steady, false);
    run(held, 10s);
    EXPECT_EQ(out_.published.size(), 4u) << kind.type;
  }
}

ConfirmedControls::Control control(const std::string& type, std::vector<std::string>& answers) {
  ConfirmedControls::Control out;
  out.type = type;
  out.confirmed_by = "Tel";
  out.shows = [](std::string_view) { return true; };
  out.respond = [type, &answers](const std::string& refusal) {
    answers.push_back(type + ": " + refusal);
  };
  return out;
}

TEST_F(Parts, AConfirmationIsWaitedForUntilItsTimeIsUp) {
  std::vector<std::string> answers;
  ConfirmedControls controls;
  controls.add(now_, control("A", answers), out_);
  EXPECT_EQ(controls.nextStep(), now_.steady + 2s);
  run(controls, 1999ms);
  EXPECT_THAT(answers, IsEmpty());
  run(controls, 1ms);
  EXPECT_EQ(answers.size(), 1u);
  EXPECT_EQ(controls.nextStep(), SteadyTime::max());
}

TEST_F(Parts, AControlTakesThePlaceOfOneOfItsTypeAlone) {
  std::vector<std::string> answers;
  ConfirmedControls controls;
  controls.add(now_, control("A", answers), out_);
  controls.add(now_, control("B", answers), out_);
  EXPECT_THAT(answers, IsEmpty());
  controls.add(now_, control("A", answers), out_);
  EXPECT_THAT(answers, ElementsAre("A: a newer one took its place"));
  controls.telemetry("Tel", "");
  EXPECT_THAT(answers, ElementsAre("A: a newer one took its place", "B: ", "A: "));
}

}  // namespace
}  // namespace frontseat_driver::session
