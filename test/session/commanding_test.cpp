#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nmea_session_fixture.h"

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;
using vehicle::BehaviorCommand;

const char* const kZero = "$PYDIR,0,0*56\r\n";

BehaviorCommand heading(double heading_deg) {
  BehaviorCommand command;
  command.horizontal = {BehaviorCommand::Horizontal::Heading, heading_deg};
  return command;
}

class Commanding : public NmeaSessionTest {
 protected:
  void startSandshark(NmeaOptions options = withDialect(Dialect::Sandshark)) {
    options.log_sentences = {};
    start(options);
    pass(1s);
    hear("BFCTL,120001.000,1");
    pass(100ms);
    out_.sent.clear();
  }

  void startKingfisher(NmeaOptions options = withDialect(Dialect::Kingfisher)) {
    start(options);
    pass(100ms);
  }

  std::string command(const vehicle::Command& wanted) {
    const std::string refusal = session_->command(now(), wanted, now().steady, out_);
    session_->step(now(), out_);
    return refusal;
  }

  void request(Request wanted) {
    session_->request(
        now(), std::move(wanted), [this](const Answer& answer) { answers_.push_back(answer); },
        out_);
    session_->step(now(), out_);
  }

  void stop() {
    session_->stop(now(), out_);
    session_->step(now(), out_);
  }

  void gate(bool open) {
    session_->setCommandsEnabled(now(), open, out_);
    session_->step(now(), out_);
  }

  /// The vehicle's answer to the last sentence with this name.
  void acknowledge(const std::string& formatter, int status, const std::string& message = "") {
    const auto sent = std::find_if(out_.sent.rbegin(), out_.sent.rend(), [&](const auto& one) {
      return one.sentence.substr(3, 3) == formatter;
    });
    ASSERT_NE(sent, out_.sent.rend());
    const std::string time = formatter == "LOG" ? "" : sent->sentence.substr(7, 10);
    hear("BFACK,120001.000," + formatter + "," + time + ",," + std::to_string(status) + ",0," +
         message + ",");
  }

  std::vector<Answer> answers_;
};

// --- The command slot ---

TEST_F(Commanding, AFreshCommandIsRepeatedAndAStaleOneIsGone) {
  startSandshark();
  EXPECT_EQ(command(heading(90.0)), "");
  EXPECT_TRUE(out_.control.commanding);
  pass(990ms);
  EXPECT_THAT(out_.sent, SizeIs(5));
  for (const auto& sent : out_.sent) {
    EXPECT_THAT(sent.sentence, testing::EndsWith(sent.sentence.substr(17)));
    EXPECT_EQ(sent.sentence.substr(17, 13), ",90.0000,,,,,");
  }
  for (std::size_t i = 1; i < out_.sent.size(); ++i) {
    EXPECT_EQ(out_.sent[i].at - out_.sent[i - 1].at, 200ms);
  }
  pass(1min);
  EXPECT_THAT(out_.sent, SizeIs(5));
  EXPECT_FALSE(out_.control.commanding);
}

TEST_F(Commanding, AStaleKingfisherHearsOneZeroThrust) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, -0.25});
  pass(1min);
  ASSERT_THAT(out_.sent, SizeIs(6));
  EXPECT_EQ(out_.sent[0].sentence, "$PYDIR,50,-25*79\r\n");
  EXPECT_EQ(out_.sent[5].sentence, kZero);
  EXPECT_EQ(out_.sent[5].at - out_.sent[0].at, 1s);
}

TEST_F(Commanding, OnlyTheNewestWaitsAndSpacingIsKept) {
  startKingfisher();
  for (int i = 0; i < 1000; ++i) {
    command(vehicle::DriveCommand{i / 1000.0, 0.0});
    pass(1ms);
  }
  command(vehicle::DriveCommand{0.0, 0.0});
  const SteadyTime asked = now().steady;
  pass(100ms);
  for (std::size_t i = 1; i < out_.sent.size(); ++i) {
    EXPECT_GE(out_.sent[i].at - out_.sent[i - 1].at, 20ms);
  }
  const auto zero = std::find_if(out_.sent.begin(), out_.sent.end(),
                                 [](const auto& one) { return one.sentence == kZero; });
  ASSERT_NE(zero, out_.sent.end());
  EXPECT_LE(zero->at - asked, 20ms);
  EXPECT_THAT(out_.sent, SizeIs(testing::Le(52u)));
}

TEST_F(Commanding, AFastPublisherLeavesRoomForTheRest) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.status_rate_hz = 1.0;
  startSandshark(options);
  request(LogSwitch{"CTD", true});
  for (int i = 0; i < 2000; ++i) {
    command(heading(i % 360));
    pass(1ms);
  }
  const auto texts = out_.sentences();
  EXPECT_THAT(texts, testing::Contains(StartsWith("$BPLOG,CTD,ON")));
  EXPECT_THAT(texts, testing::Contains(StartsWith("$BPSTS,")).Times(testing::Ge(2)));
}

TEST_F(Commanding, AgeCountsFromWhenTheCommandReachedThisComputer) {
  startKingfisher();
  pass(10s);
  session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, now().steady - 900ms, out_);
  session_->step(now(), out_);
  pass(100ms);
  EXPECT_EQ(out_.sent.back().sentence, kZero);
}

TEST_F(Commanding, AStepOfTheSystemClockNeitherEndsNorLengthensACommand) {
  for (const auto step : {std::chrono::hours{-3}, std::chrono::hours{5}}) {
    startKingfisher();
    out_.sent.clear();
    command(vehicle::DriveCommand{0.5, 0.5});
    const auto stepped = [&] {
      Now later = now();
      later.utc += step;
      later.stamp = {};  // and ROS time stands still
      return later;
    };
    const SteadyTime began = now().steady;
    while (session_->nextStep() <= began + 3s) {
      const std::chrono::nanoseconds due = session_->nextStep().time_since_epoch();
      elapsed_ = std::max(elapsed_, due);
      session_->step(stepped(), out_);
    }
    ASSERT_THAT(out_.sent, SizeIs(6)) << step.count();  // at once, four times more, and zero
    EXPECT_EQ(out_.sent[4].at - began, 800ms);
    EXPECT_EQ(out_.sent[5].at - began, 1s);
    EXPECT_EQ(out_.sent[5].sentence, kZero);
  }
}

TEST_F(Commanding, AZeroThrustThatTheLinkDoesNotTakeIsTriedAgain) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  out_.sent.clear();
  out_.link_takes = false;
  pass(1500ms);
  EXPECT_THAT(out_.sent, IsEmpty());
  out_.link_takes = true;
  pass(20ms);
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
}

// --- What the link holds back ---

TEST_F(Commanding, TellsSinceWhenTheLinkTakesNoCommand) {
  startKingfisher();
  EXPECT_FALSE(session_->heldBackSince());
  for (const bool full : {false, true}) {
    out_.link_takes = full;  // full: it takes, but has not got rid of what it took
    out_.link_is_full = full;
    const auto began = now().steady;
    for (int i = 0; i < 20; ++i) {
      command(vehicle::DriveCommand{0.5, 0.5});
      pass(100ms);
      ASSERT_TRUE(session_->heldBackSince()) << i;
      EXPECT_EQ(*session_->heldBackSince() - began, 0ms) << i;
    }
    out_.link_takes = true;
    out_.link_is_full = false;
    pass(100ms);
    EXPECT_FALSE(session_->heldBackSince());
    pass(2s);
  }
}

TEST_F(Commanding, ZeroThrustIsHeldBackToo) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  out_.link_takes = false;
  const auto began = now().steady;
  stop();
  pass(3s);
  ASSERT_TRUE(session_->heldBackSince());
  EXPECT_LE(*session_->heldBackSince() - began, 20ms);  // send_spacing
  out_.link_takes = true;
  pass(100ms);
  EXPECT_FALSE(session_->heldBackSince());
  out_.link_takes = false;
  stop();
  pass(100ms);
  EXPECT_TRUE(session_->heldBackSince());
  session_->disconnected(now(), out_);
  EXPECT_FALSE(session_->heldBackSince());
}

TEST_F(Commanding, WhatElseTheLinkDoesNotTakeHoldsNoCommandBackBeforeOneIsDue) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.command_timeout = 5s;
  options.command_rate_hz = 0.25;
  startSandshark(options);
  command(heading(90.0));
  ASSERT_THAT(out_.sent, SizeIs(1));
  out_.link_takes = false;
  session_->setPayloadStatus(now(), {true, "well"});
  pass(1s);
  EXPECT_FALSE(session_->heldBackSince());
  pass(3100ms);
  ASSERT_TRUE(session_->heldBackSince());
  EXPECT_LE(now().steady - *session_->heldBackSince(), 160ms);  // due after 4 s
}

TEST_F(Commanding, SandsharkHearsABehaviorAtLeastEveryFiveSeconds) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.command_timeout = 5s;
  options.command_rate_hz = 0.25;
  startSandshark(options);
  for (int i = 0; i < 15; ++i) {
    command(heading(90.0));
    pass(4s);
  }
  for (std::size_t i = 1; i < out_.sent.size(); ++i) {
    EXPECT_LT(out_.sent[i].at - out_.sent[i - 1].at, 5s);
  }
}

// --- Permission ---

TEST_F(Commanding, NothingIsSentWhileTheVehicleKeepsControl) {
  start(withDialect(Dialect::Sandshark));
  pass(1s);
  out_.sent.clear();
  EXPECT_EQ(command(heading(90.0)), "the vehicle has sent no BFCTL since the connection was made");
  hear("BFCTL,120001.000,0");
  EXPECT_EQ(command(heading(90.0)), "the vehicle keeps control (BFCTL 0)");
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
  EXPECT_EQ(session_->counters().refused_commands, 2u);
}

TEST_F(Commanding, TakingControlBackEndsTheCommand) {
  startSandshark();
  command(heading(90.0));
  hear("BFCTL,120001.000,0");
  out_.sent.clear();
  hear("BFCTL,120002.000,1");
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, AWordOnControlThatCannotBeReadEndsTheCommand) {
  for (const char* word : {"2", "-1", "0.5", "no"}) {
    startSandshark();
    command(heading(90.0));
    out_.sent.clear();
    hear(std::string{"BFCTL,120001.000,"} + word);
    EXPECT_EQ(command(heading(90.0)), "the vehicle's last BFCTL cannot be read") << word;
    pass(10s);
    EXPECT_THAT(out_.sent, IsEmpty()) << word;
    hear("BFCTL,120002.000,1");
    EXPECT_EQ(command(heading(90.0)), "") << word;
  }
}

TEST_F(Commanding, ReconnectForgetsTheCommand) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  disconnect();
  out_.sent.clear();
  connect();
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
  command(vehicle::DriveCommand{0.5, 0.5});
  EXPECT_THAT(out_.sent, SizeIs(1));
}

TEST_F(Commanding, NoConnectionNoCommand) {
  startKingfisher();
  disconnect();
  EXPECT_EQ(command(vehicle::DriveCommand{0.5, 0.5}), "there is no connection to the vehicle");
  connect();
  pass(1s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, TheOtherVehiclesCommandIsRefused) {
  startKingfisher();
  EXPECT_EQ(command(heading(90.0)), "it is for a sandshark, and the vehicle is a kingfisher");
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, ClosingTheGateSendsZeroAndReopeningRevivesNothing) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  pass(50ms);
  out_.sent.clear();
  gate(false);
  pass(20ms);
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
  EXPECT_EQ(command(vehicle::DriveCommand{0.5, 0.5}),
            "the command gate is closed; service enable_commands opens it");
  gate(true);
  pass(10s);
  EXPECT_THAT(out_.sent, SizeIs(1));
}

TEST_F(Commanding, ARecordTakesNoCommand) {
  NmeaOptions options = withDialect(Dialect::Kingfisher);
  options.listen_only = true;
  startKingfisher(options);
  EXPECT_EQ(session_->control().reason, "a record is being played");
  EXPECT_EQ(command(vehicle::DriveCommand{0.5, 0.5}), "a record is being played");
  stop();
  pass(1s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

// --- Stopping and leaving ---

TEST_F(Commanding, StopIsNextAheadOfEverything) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  command(vehicle::DriveCommand{0.6, 0.6});
  stop();
  out_.sent.clear();
  pass(20ms);
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
  pass(10s);
  EXPECT_THAT(out_.sent, SizeIs(1));
}

TEST_F(Commanding, StopWithoutACommandStillSendsZero) {
  startKingfisher();
  stop();
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
}

TEST_F(Commanding, StopASandsharkIsSilence) {
  startSandshark();
  command(heading(90.0));
  out_.sent.clear();
  stop();
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, ACommandAfterAStopDoesNotOvertakeTheZero) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  pass(5ms);
  out_.sent.clear();
  stop();
  command(vehicle::DriveCommand{0.7, 0.7});
  pass(50ms);
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero, "$PYDIR,70,70*56\r\n"));
}

TEST_F(Commanding, LeavingAKingfisherSaysZeroFirst) {
  startKingfisher();
  command(vehicle::DriveCommand{0.5, 0.5});
  out_.sent.clear();
  session_->leave(now(), out_);
  EXPECT_FALSE(session_->hasLeft());
  pass(20ms);
  EXPECT_TRUE(session_->hasLeft());
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
  EXPECT_EQ(command(vehicle::DriveCommand{0.5, 0.5}), "the driver is stopping");
}

TEST_F(Commanding, LeavingAKingfisherThatWasNotCommandedSaysNothing) {
  startKingfisher();
  session_->leave(now(), out_);
  EXPECT_TRUE(session_->hasLeft());
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, LeavingASandsharkSaysNothingMore) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.status_rate_hz = 1.0;
  startSandshark(options);
  command(heading(90.0));
  request(LogSwitch{"CTD", true});
  out_.sent.clear();
  session_->leave(now(), out_);
  EXPECT_TRUE(session_->hasLeft());
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "the driver is stopping");
}

TEST_F(Commanding, ABehaviorThatWaitsIsNotSentAfterCommandingHasEnded) {
  const std::function<void()> ends[] = {
      [this] { hear("BFCTL,120001.000,0"); },
      [this] { gate(false); },
      [this] { stop(); },
      [this] {
        request(AbortRequest{"leak", true});
      },
  };
  for (const auto& end : ends) {
    answers_.clear();
    startSandshark();
    request(LogSwitch{"CTD", true});  // holds the next one back by the spacing
    request(heading(45.0));
    end();
    ASSERT_GE(answers_.size(), 1u);
    EXPECT_FALSE(answers_[0].success);
    pass(10s);
    EXPECT_THAT(out_.sentences(), testing::Not(testing::Contains(StartsWith("$BPRMB"))));
  }
}

TEST_F(Commanding, ACommandFromBeforeThePermissionIsRefused) {
  startKingfisher();
  const SteadyTime before = now().steady;
  pass(10ms);
  disconnect();
  connect();
  pass(100ms);
  EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, before, out_),
            "it is from before the last stop, abort or permission");
  gate(false);
  const SteadyTime closed = now().steady;
  pass(10ms);
  gate(true);
  EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, closed, out_),
            "it is from before the last stop, abort or permission");
  pass(10s);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, ACommandThatWaitedTooLongDoesNotTakeAGoodOnesPlace) {
  startKingfisher();
  pass(10s);
  command(vehicle::DriveCommand{0.5, 0.5});
  EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{0.9, 0.9}, now().steady - 1s, out_),
            "it waited in this computer for longer than command_timeout");
  pass(500ms);
  EXPECT_THAT(out_.sentences(), testing::Each(StartsWith("$PYDIR,50,50*")));
}

TEST_F(Commanding, WhatCameWhileTheDriverStoodStillIsRefused) {
  startKingfisher();
  pass(10s);
  session_->stoodStill(now(), out_);
  const SteadyTime read = now().steady;  // it lay in the kernel meanwhile
  pass(1ms);
  EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, read, out_),
            "it may have come long ago, while the driver stood still");
  pass(198ms);
  EXPECT_THAT(command(vehicle::DriveCommand{0.5, 0.5}), HasSubstr("stood still"));
  pass(1ms);
  EXPECT_THAT(out_.sent, IsEmpty());
  EXPECT_EQ(command(vehicle::DriveCommand{0.5, 0.5}), "");
}

TEST_F(Commanding, StandingStillEndsCommanding) {
  NmeaOptions options = withDialect(Dialect::Kingfisher);
  options.command_timeout = 5s;
  startKingfisher(options);
  command(vehicle::DriveCommand{0.5, 0.5});
  elapsed_ += 2s;
  session_->stoodStill(now(), out_);
  session_->step(now(), out_);
  pass(5s);
  EXPECT_THAT(out_.sentences(), ElementsAre(StartsWith("$PYDIR,50,50*"), kZero));
}

TEST_F(Commanding, LeavingDoesNotWaitForALongSpacing) {
  NmeaOptions options = withDialect(Dialect::Kingfisher);
  options.send_spacing = 1s;
  startKingfisher(options);
  command(vehicle::DriveCommand{0.5, 0.5});
  session_->leave(now(), out_);
  pass(30ms);
  EXPECT_TRUE(session_->hasLeft());
  EXPECT_EQ(out_.sent.back().sentence, kZero);
}

TEST_F(Commanding, ACommandFromBeforeAStopOrAnAbortIsRefused) {
  startKingfisher();
  const SteadyTime before = now().steady;
  pass(10ms);
  stop();
  EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{1.0, 1.0}, before, out_),
            "it is from before the last stop, abort or permission");
  startSandshark();
  const SteadyTime before_abort = now().steady;
  pass(10ms);
  request(AbortRequest{"leak", true});
  EXPECT_EQ(session_->command(now(), heading(90.0), before_abort, out_),
            "it is from before the last stop, abort or permission");
}

TEST_F(Commanding, ALinkThatHoldsBytesBackGetsNoMoreCommandsButAStop) {
  startKingfisher();
  out_.link_is_full = true;
  command(vehicle::DriveCommand{0.5, 0.5});
  pass(500ms);
  EXPECT_THAT(out_.sent, IsEmpty());
  stop();
  EXPECT_THAT(out_.sentences(), ElementsAre(kZero));
}

// --- Requests and their acknowledgements ---

TEST_F(Commanding, AbortIsAnsweredByItsFinalAcknowledgement) {
  startSandshark();
  request(AbortRequest{"leak", true});
  EXPECT_EQ(out_.sent[0].sentence, "$BPABT,120001.100,leak,1*46\r\n");
  acknowledge("ABT", 3);
  EXPECT_THAT(answers_, IsEmpty());
  acknowledge("ABT", 2, "surfacing");
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_TRUE(answers_[0].success);
  EXPECT_EQ(answers_[0].message, "surfacing");
  const auto acks = out_.eventsOf<vehicle::Acknowledgement>();
  EXPECT_EQ(acks.back().round_trip, 0ns);
}

TEST_F(Commanding, AbortNeedsNoPermissionAndEndsTheCommand) {
  startSandshark();
  command(heading(90.0));
  gate(false);
  hear("BFCTL,120001.000,0");
  out_.sent.clear();
  request(AbortRequest{"done", false});
  pass(60ms);
  EXPECT_THAT(out_.sentences(), ElementsAre(StartsWith("$BPABT,")));
}

TEST_F(Commanding, AbortOvertakesWhatWaits) {
  startSandshark();
  for (const char* name : {"CTD", "DVL", "RVL"}) request(LogSwitch{name, true});
  command(heading(90.0));
  request(AbortRequest{"leak", true});
  pass(60ms);
  ASSERT_GE(out_.sent.size(), 2u);
  EXPECT_THAT(out_.sent[1].sentence, StartsWith("$BPABT,"));
}

TEST_F(Commanding, TextThatNamesACommandIsSentInLowerCase) {
  startSandshark();
  request(AbortRequest{"LOG is FULL", true});
  EXPECT_THAT(out_.sent[0].sentence, HasSubstr(",log is full,1*"));
  acknowledge("ABT", 2);
  EXPECT_EQ(answers_[0].message,
            "done; the reason was sent in lower case: it held a command's name");
}

TEST_F(Commanding, TextThatBreaksTheSentenceIsRefused) {
  startSandshark();
  const std::pair<const char*, const char*> rows[] = {
      {"a,b",
       "reason holds ',' as character 2, which would break the sentence; printable ASCII "
       "without comma, asterisk and $ is accepted"},
      {"ab*", "reason holds '*' as character 3, which"},
      {"$BPABT", "reason holds '$' as character 1, which"},
      {"a\r\nb", "reason holds byte 0x0D as character 2, which"},
      {"\xC3\xA4", "reason holds byte 0xC3 as character 1, which"}};
  for (const auto& [text, refusal] : rows) {
    request(AbortRequest{text, true});
    EXPECT_FALSE(answers_.back().success);
    EXPECT_THAT(answers_.back().message, StartsWith(refusal));
  }
  request(AbortRequest{std::string(10000, 'x'), true});
  EXPECT_EQ(answers_.back().message,
            "reason has 10000 characters; a sentence takes 200 bytes in all");
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, ARequestThatIsNeverAcknowledgedIsRepeatedAndThenAnswered) {
  startSandshark();
  request(AbortRequest{"leak", true});
  pass(2999ms);
  EXPECT_THAT(answers_, IsEmpty());
  pass(1ms);
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "sent, but the vehicle did not acknowledge it within 3.0 s");
  EXPECT_THAT(out_.sent, SizeIs(3));
}

TEST_F(Commanding, ABehaviorRequestIsSentOnce) {
  startSandshark();
  request(heading(45.0));
  pass(10s);
  EXPECT_THAT(out_.sent, SizeIs(1));
  EXPECT_THAT(answers_, SizeIs(1));
}

TEST_F(Commanding, ABehaviorRequestObeysThePermission) {
  startSandshark();
  hear("BFCTL,120001.000,0");
  request(heading(45.0));
  EXPECT_THAT(out_.sent, IsEmpty());
  EXPECT_EQ(answers_[0].message, "the vehicle keeps control (BFCTL 0)");
}

TEST_F(Commanding, RefusalsAreTheVehiclesWords) {
  startSandshark();
  request(heading(45.0));
  acknowledge("RMB", 1, "too deep");
  EXPECT_FALSE(answers_[0].success);
  EXPECT_EQ(answers_[0].message, "the vehicle could not do it (acknowledgement 1): too deep");
  request(heading(46.0));
  pass(60ms);
  acknowledge("RMB", 0);
  EXPECT_EQ(answers_[1].message, "the vehicle calls it invalid (acknowledgement 0)");
}

TEST_F(Commanding, AcknowledgementsAreMatchedByTimeNotByOrder) {
  startSandshark();
  request(heading(10.0));
  pass(60ms);
  request(heading(20.0));
  pass(60ms);
  ASSERT_THAT(out_.sent, SizeIs(2));
  hear("BFACK,120001.000,BPRMB," + out_.sent[1].sentence.substr(7, 10) + ",,2,0,second,");
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "second");
  hear("BFACK,120001.000,RMB," + out_.sent[1].sentence.substr(7, 10) + ",,1,0,again,");
  EXPECT_THAT(answers_, SizeIs(1));
  hear("BFACK,120001.000,RMB," + out_.sent[0].sentence.substr(7, 10) + ",,1,0,first,");
  ASSERT_THAT(answers_, SizeIs(2));
  EXPECT_FALSE(answers_[1].success);
}

TEST_F(Commanding, LogRequestsAreMatchedByOrder) {
  startSandshark();
  request(LogSwitch{"CTD", true});
  request(LogSwitch{"DVL", true});
  pass(60ms);
  acknowledge("LOG", 2, "first");
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "first");
  acknowledge("LOG", 1, "second");
  EXPECT_FALSE(answers_[1].success);
}

TEST_F(Commanding, LogRequestsAreRememberedAcrossReconnects) {
  startSandshark();
  request(LogSwitch{"CTD", true});
  disconnect();
  EXPECT_EQ(answers_[0].message, "the connection was lost before the vehicle answered");
  request(LogSwitch{"DVL", true});
  EXPECT_EQ(answers_[1].message,
            "there is no connection to the vehicle; it will be asked for when there is");
  request(LogSwitch{"CTD", false});
  out_.sent.clear();
  connect();
  pass(1s);
  EXPECT_THAT(out_.sentences(), ElementsAre(StartsWith("$BPVER"), StartsWith("$BPLOG,ACK,ON"),
                                            StartsWith("$BPLOG,DVL,ON")));
}

TEST_F(Commanding, WhatAllTurnedOnStaysOffOnceItIsTurnedOff) {
  startSandshark();
  request(LogSwitch{"ALL", true});
  request(LogSwitch{"DVL", false});
  disconnect();
  out_.sent.clear();
  connect();
  pass(1s);
  EXPECT_THAT(out_.sentences(),
              ElementsAre(StartsWith("$BPVER"), StartsWith("$BPLOG,ACK,ON"),
                          StartsWith("$BPLOG,ALL,ON"), StartsWith("$BPLOG,DVL,OFF")));
}

TEST_F(Commanding, LogRequestsOfTheStartAreNotTakenForTheUsers) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.log_sentences = {"NVG"};
  start(options);
  pass(1s);
  request(LogSwitch{"DVL", true});
  acknowledge("LOG", 1, "no NVG here");  // of the start
  EXPECT_THAT(answers_, IsEmpty());
  acknowledge("LOG", 2, "DVL on");
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "DVL on");
}

TEST_F(Commanding, AVehicleThatAcknowledgesNothingAtTheStartStillAnswersTheUser) {
  start(withDialect(Dialect::Sandshark));
  pass(500ms);
  request(LogSwitch{"XYZ", false});
  acknowledge("LOG", 2);  // may be of the start
  for (int i = 0; i < 3 && answers_.empty(); ++i) {
    pass(1s);
    acknowledge("LOG", 2, "XYZ off");
  }
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_EQ(answers_[0].message, "XYZ off");
}

TEST_F(Commanding, ALostAcknowledgementDoesNotEatTheNextOne) {
  startSandshark();
  request(LogSwitch{"CTD", true});
  pass(3s);
  EXPECT_FALSE(answers_[0].success);
  request(LogSwitch{"DVL", true});
  acknowledge("LOG", 2, "DVL on");
  ASSERT_THAT(answers_, SizeIs(2));
  EXPECT_EQ(answers_[1].message, "DVL on");
}

TEST_F(Commanding, AcknowledgingItselfIsNotWaitedFor) {
  startSandshark();
  request(LogSwitch{"ACK", true});
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_TRUE(answers_[0].success);
}

TEST_F(Commanding, AnAbortGoesOutHoweverManyRequestsWait) {
  startSandshark();
  for (int i = 0; i < 100; ++i) request(LogSwitch{"CTD", true});
  request(AbortRequest{"leak", true});
  pass(60ms);
  EXPECT_THAT(out_.sentences(), testing::Contains(StartsWith("$BPABT")));
}

TEST_F(Commanding, AnAbortNeedsNotKnowTheDialect) {
  start(quiet());
  request(AbortRequest{"leak", true});
  EXPECT_THAT(out_.sentences(), ElementsAre(StartsWith("$BPABT")));
}

TEST_F(Commanding, ALogNameMustBeOne) {
  startSandshark();
  for (const char* name : {"nvg", "RMB", "ABT"}) {
    request(LogSwitch{name, true});
    EXPECT_EQ(answers_.back().message,
              std::string{"sentence is '"} + name +
                  "'; three capital letters such as NVG, or ALL, are accepted (RMB, LOG, ABT, STS "
                  "and VER are commands)");
  }
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, WithoutAcknowledgementsSentIsTheAnswer) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.use_acks = false;
  startSandshark(options);
  request(AbortRequest{"leak", true});
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_TRUE(answers_[0].success);
}

TEST_F(Commanding, AnyNumberOfCallersIsAnsweredInTime) {
  startSandshark();
  for (int i = 0; i < 100; ++i) request(LogSwitch{"CTD", true});
  pass(3s);
  EXPECT_THAT(answers_, SizeIs(100));
}

TEST_F(Commanding, RawSentencesGetTheirChecksum) {
  startKingfisher();
  request(RawSentence{"$PYDIR,1,2"});
  EXPECT_THAT(out_.sentences(), ElementsAre("$PYDIR,1,2*55\r\n"));
  EXPECT_TRUE(answers_[0].success);
  const std::pair<std::string, const char*> rows[] = {
      {"PY*DIR",
       "sentence is 'PY*DIR'; an address such as PYDIR and fields of printable ASCII without "
       "asterisk and $ are accepted, and the checksum is added"},
      {"$PYDIR,1,2*55", "sentence is '$PYDIR,1,2*55'; an address"},
      {"", "sentence is ''; an address"},
      {"PY*DIR," + std::string(187, '1'), "sentence is 'PY*DIR,1"},  // not for its length
      {"PYDIR," + std::string(189, '1'), "sentence has 195 characters; a sentence takes 200 bytes"},
      {"PYDIR,1\n", "sentence is 'PYDIR,1\n'; an address"}};
  for (const auto& [text, refusal] : rows) {
    request(RawSentence{text});
    EXPECT_FALSE(answers_.back().success);
    EXPECT_THAT(answers_.back().message, StartsWith(refusal));
  }
  EXPECT_THAT(out_.sent, SizeIs(1));
}

TEST_F(Commanding, ABoatKnowsNoAbort) {
  startKingfisher();
  request(AbortRequest{"leak", true});
  EXPECT_EQ(answers_[0].message, "it is for a sandshark, and the vehicle is a kingfisher");
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, AnAbortEndsCommandingABoat) {
  for (const char* reason : {"leak", "leak, so stop"}) {
    answers_.clear();
    startKingfisher();
    const SteadyTime before = now().steady;
    command(vehicle::DriveCommand{0.5, 0.5});
    out_.sent.clear();
    pass(30ms);
    request(AbortRequest{reason, true});
    EXPECT_FALSE(answers_[0].success);
    EXPECT_THAT(answers_[0].message, HasSubstr("; commanding has ended"));
    EXPECT_EQ(session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, before, out_),
              "it is from before the last stop, abort or permission");
    pass(10s);
    EXPECT_THAT(out_.sentences(), ElementsAre(kZero)) << reason;
  }
}

TEST_F(Commanding, ARawSentenceThatWaitsIsNotSentAfterAStop) {
  startKingfisher();
  request(RawSentence{"PYDIR,100,100"});
  request(RawSentence{"PYDIR,90,90"});  // held back by the spacing
  stop();
  pass(10s);
  EXPECT_THAT(out_.sentences(), ElementsAre(StartsWith("$PYDIR,100,100*"), kZero));
  ASSERT_THAT(answers_, SizeIs(2));
  EXPECT_FALSE(answers_[1].success);
}

TEST_F(Commanding, AHeartbeatOfAnAgeIsNoFlood) {
  for (const double rate_hz : {1e-3, 1e-12, 1e-300}) {
    NmeaOptions options = withDialect(Dialect::Sandshark);
    options.status_rate_hz = rate_hz;
    startSandshark(options);
    pass(10min);
    EXPECT_THAT(out_.sent, IsEmpty()) << rate_hz;
  }
}

TEST_F(Commanding, PayloadStatusBeatsAtItsRate) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.status_rate_hz = 1.0;
  startSandshark(options);
  pass(10s);
  EXPECT_THAT(out_.sent, SizeIs(10));
  EXPECT_THAT(out_.sent[0].sentence, HasSubstr(",1,OK*"));
  EXPECT_EQ(session_->setPayloadStatus(now(), {false, "no DVL"}), "");
  session_->step(now(), out_);
  pass(60ms);
  EXPECT_THAT(out_.sent.back().sentence, HasSubstr(",0,no DVL*"));
  EXPECT_THAT(session_->setPayloadStatus(now(), {true, "a,b"}), StartsWith("message holds"));
  EXPECT_THAT(session_->setPayloadStatus(now(), {true, std::string(300, 'x')}),
              HasSubstr("300 characters"));
}

TEST_F(Commanding, PayloadStatusWithoutAHeartbeatIsSentOnce) {
  startSandshark();
  session_->setPayloadStatus(now(), {false, "leak"});
  session_->step(now(), out_);
  pass(10s);
  EXPECT_THAT(out_.sentences(), ElementsAre(HasSubstr(",0,leak*")));
}

// --- Effect ---

TEST_F(Commanding, AVehicleThatDoesNotFollowIsNoticed) {
  startSandshark();
  const auto drift = [&](double heading_deg, std::chrono::seconds duration) {
    for (auto passed = 0ms; passed < duration; passed += 100ms) {
      hear("BFNVG,120000.000,,,,,1,,0," + std::to_string(heading_deg) + ",0,0,");
      command(heading(90.0));
      pass(100ms);
    }
  };
  drift(270.0, 9s);
  EXPECT_EQ(session_->effectComplaint(), "");
  drift(270.0, 2s);
  EXPECT_EQ(session_->effectComplaint(),
            "heading 90.0 deg commanded, 270.0 deg measured; no answer for 10 s");
  drift(250.0, 1s);  // it begins to turn
  EXPECT_EQ(session_->effectComplaint(), "");
  drift(90.0, 30s);
  EXPECT_EQ(session_->effectComplaint(), "");
}

TEST_F(Commanding, TheVehiclesRefusalIsKeptWithItsTime) {
  startSandshark();
  command(heading(90.0));
  EXPECT_FALSE(session_->lastRefusal());
  acknowledge("RMB", 2);
  EXPECT_FALSE(session_->lastRefusal());
  pass(200ms);
  acknowledge("RMB", 3);  // on its way
  EXPECT_FALSE(session_->lastRefusal());
  acknowledge("RMB", 1, "dynamic requests are off");
  ASSERT_TRUE(session_->lastRefusal());
  EXPECT_EQ(session_->lastRefusal()->words,
            "the vehicle could not do it (acknowledgement 1): dynamic requests are off");
  EXPECT_EQ(session_->lastRefusal()->at, now().steady);
  pass(200ms);
  acknowledge("RMB", 0, "heading");
  EXPECT_EQ(session_->lastRefusal()->words,
            "the vehicle calls it invalid (acknowledgement 0): heading");
  EXPECT_EQ(session_->lastRefusal()->at, now().steady);
  disconnect();
  EXPECT_FALSE(session_->lastRefusal());
}

TEST_F(Commanding, WhatAServiceWaitsForIsNoRefusalOfTheRepeatedCommand) {
  startSandshark();
  request(heading(90.0));
  acknowledge("RMB", 0, "heading");
  ASSERT_THAT(answers_, SizeIs(1));
  EXPECT_FALSE(session_->lastRefusal());
  hear("BFACK,120001.000,RMB,115959.000,,0,0,another client's,");
  EXPECT_FALSE(session_->lastRefusal());
}

TEST_F(Commanding, WhatIsCommandedCanBeSeen) {
  startKingfisher();
  EXPECT_FALSE(session_->commanded());
  command(vehicle::DriveCommand{0.5, 0.25});
  ASSERT_TRUE(session_->commanded());
  EXPECT_EQ(std::get<vehicle::DriveCommand>(*session_->commanded()).port, 0.5);
  pass(2s);
  EXPECT_FALSE(session_->commanded());
}

TEST_F(Commanding, ABoatThatTellsNoVelocityUnderThrustIsNoticed) {
  for (const char* velocity : {"nan,nan", "0.5,nan", "nan,0.5"}) {
    startKingfisher();
    for (auto passed = 0ms; passed < 11s; passed += 100ms) {
      hear(std::string{"CPNVR,120000.000,"} + velocity + ",0,0,0,0");
      command(vehicle::DriveCommand{1.0, 1.0});
      pass(100ms);
    }
    EXPECT_THAT(session_->effectComplaint(), HasSubstr("the vehicle does not move")) << velocity;
  }
}

TEST_F(Commanding, TheLastZeroWaitsForNoLongSpacing) {
  NmeaOptions options = withDialect(Dialect::Kingfisher);
  options.send_spacing = 1s;
  startKingfisher(options);
  command(vehicle::DriveCommand{0.5, 0.5});
  pass(10ms);
  ASSERT_THAT(out_.sent, SizeIs(1));
  session_->leave(now(), out_);
  pass(29ms);
  EXPECT_THAT(out_.sent, SizeIs(1));
  pass(1ms);
  ASSERT_THAT(out_.sent, SizeIs(2));
  EXPECT_EQ(out_.sent.back().sentence, kZero);
}

TEST_F(Commanding, NamesOfSentencesAreThreeCapitalsOrDigits) {
  startSandshark();
  for (const char* name : {"nvg", "NV", "NVGX", "N.1", "N/1", "N:1", "N@V", "N[V", ""}) {
    answers_.clear();
    out_.sent.clear();
    request(LogSwitch{name, true});
    pass(100ms);
    ASSERT_THAT(answers_, SizeIs(1)) << name;
    EXPECT_FALSE(answers_[0].success) << name;
    EXPECT_THAT(out_.sent, IsEmpty()) << name;
  }
  for (const char* name : {"AZ0", "NV9"}) {
    out_.sent.clear();
    request(LogSwitch{name, true});
    pass(100ms);
    ASSERT_THAT(out_.sent, SizeIs(1)) << name;
    EXPECT_THAT(out_.sent[0].sentence, HasSubstr(std::string{"BPLOG,"} + name + ",ON"));
  }
}

TEST_F(Commanding, ASwitchWithinTheHandshakeLeavesNothingOut) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.log_sentences = {"NVG", "NVR", "MIS"};
  start(options);
  request(LogSwitch{"CTD", true});
  pass(5s);
  for (const char* name : {"NVG", "NVR", "MIS", "CTD"}) {
    const std::string wanted = std::string{"BPLOG,"} + name + ",ON";
    EXPECT_THAT(out_.sentences(), testing::Contains(HasSubstr(wanted)));
  }
}

TEST_F(Commanding, ASwitchAfterTheHandshakeAsksForNothingElse) {
  start(withDialect(Dialect::Sandshark));
  pass(5s);
  out_.sent.clear();
  request(LogSwitch{"CTD", true});
  pass(100ms);
  EXPECT_THAT(out_.sent, SizeIs(1));
  EXPECT_THAT(out_.sent.back().sentence, HasSubstr("BPLOG,CTD,ON"));
}

TEST_F(Commanding, AMovingTargetDoesNotHideAJammedRudder) {
  startSandshark();
  double target_deg = 90.0;
  for (auto passed = 0ms; passed < 15s; passed += 100ms) {
    hear("BFNVG,120000.000,,,,,1,,0,270,0,0,");
    if (passed % 2000 == 0ms) target_deg += 6.0;
    command(heading(target_deg));
    pass(100ms);
  }
  EXPECT_THAT(session_->effectComplaint(), HasSubstr("270.0 deg measured"));
}

// --- Formats, by hand from the documents ---

struct Format {
  const char* name;
  vehicle::Command command;
  const char* sentence;
  int thrust_decimals = 0;
  bool degrees = false;
};

BehaviorCommand behavior(std::optional<BehaviorCommand::Aspect<BehaviorCommand::Horizontal>> h,
                         std::optional<BehaviorCommand::Aspect<BehaviorCommand::Vertical>> v,
                         std::optional<BehaviorCommand::Aspect<BehaviorCommand::Speed>> s) {
  BehaviorCommand command;
  command.horizontal = h;
  command.vertical = v;
  command.speed = s;
  return command;
}

using H = BehaviorCommand::Horizontal;
using V = BehaviorCommand::Vertical;
using S = BehaviorCommand::Speed;

const Format kFormats[] = {
    {"everything", behavior({{H::Heading, 90.0}}, {{V::Depth, 5.0}}, {{S::MetresPerSecond, 1.5}}),
     "$BPRMB,120000.000,90.0000,5.000,0,1.500,1,0*69\r\n"},
    {"altitude_and_rpm", behavior({}, {{V::Altitude, 3.25}}, {{S::Rpm, 600.0}}),
     "$BPRMB,120000.000,,3.250,1,600.000,0,*7D\r\n"},
    {"rudder_and_pitch", behavior({{H::Rudder, -12.5}}, {{V::Pitch, -10.0}}, {}),
     "$BPRMB,120000.000,-12.5000,-10.000,2,,,1*4A\r\n"},
    {"elevator", behavior({}, {{V::Elevator, 4.0}}, {}), "$BPRMB,120000.000,,4.000,3,,,*67\r\n"},
    {"nothing", behavior({}, {}, {}), "$BPRMB,120000.000,,,,,,*7E\r\n"},
    {"drive", vehicle::DriveCommand{1.0, -1.0}, "$PYDIR,100,-100*7B\r\n"},
    {"drive_rounds", vehicle::DriveCommand{0.126, -0.004}, "$PYDIR,13,0*64\r\n"},
    {"drive_decimals", vehicle::DriveCommand{0.126, -0.004}, "$PYDIR,12.60,-0.40*4A\r\n", 2},
    {"helm", vehicle::HelmCommand{0.5, -0.25}, "$PYDEP,-0.2500,50*69\r\n"},
    {"helm_degrees", vehicle::HelmCommand{0.5, 0.5}, "$PYDEP,28.6479,50*75\r\n", 0, true},
    {"course", vehicle::CourseCommand{270.4, 1.25}, "$PYDEV,270,1.250*43\r\n"},
    {"course_never_360", vehicle::CourseCommand{359.6, 0.0}, "$PYDEV,0,0.000*40\r\n"},
};

class CommandFormats : public testing::TestWithParam<Format> {};

TEST_P(CommandFormats, AsTheDocumentHasIt) {
  CommandFormat format;
  format.thrust_decimals = GetParam().thrust_decimals;
  format.yaw_rate_in_degrees = GetParam().degrees;
  nmea::SentenceWriter writer = commandSentence(GetParam().command, format, {}, 12h);
  EXPECT_EQ(writer.finish(), std::string_view{GetParam().sentence});
}

INSTANTIATE_TEST_SUITE_P(Table, CommandFormats, testing::ValuesIn(kFormats),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(CommandFormat, FillsWhatIsLeftAloneWithThePresent) {
  CommandFormat format;
  format.fill_behavior_fields = true;
  PresentState present;
  present.heading_deg = 123.5;
  present.depth_m = 3.0;
  present.speed_m_s = 0.75;
  nmea::SentenceWriter writer =
      commandSentence(behavior({}, {{V::Pitch, 2.0}}, {}), format, present, 12h);
  EXPECT_EQ(writer.finish(), "$BPRMB,120000.000,123.5000,2.000,2,0.750,1,0*56\r\n");
}

TEST(CommandFormat, FillsNoDepthAboveTheSurface) {
  CommandFormat format;
  format.fill_behavior_fields = true;
  PresentState present;
  const auto filled = [&](double depth_m) {
    present.depth_m = depth_m;
    nmea::SentenceWriter writer = commandSentence(
        behavior({{H::Heading, 90.0}}, {}, {{S::Rpm, 600.0}}), format, present, 12h);
    return std::string{writer.finish().value_or("")};
  };
  EXPECT_THAT(filled(-0.1), HasSubstr(",90.0000,0.000,0,600.000,0,0*"));
  EXPECT_THAT(filled(0.5), HasSubstr(",90.0000,0.500,0,600.000,0,0*"));
}

TEST(CommandFormat, FillingNeedsWhatTheCommandLeavesOpen) {
  PresentState present;
  present.heading_deg = 1.0;
  present.depth_m = 2.0;
  present.speed_m_s = 3.0;
  CommandFormat format;
  EXPECT_TRUE(canBeSent(behavior({}, {}, {}), format, {}));
  format.fill_behavior_fields = true;
  EXPECT_TRUE(canBeSent(behavior({}, {}, {}), format, present));
  EXPECT_TRUE(canBeSent(vehicle::DriveCommand{}, format, {}));
  const BehaviorCommand whole =
      behavior({{H::Heading, 90.0}}, {{V::Depth, 5.0}}, {{S::Rpm, 600.0}});
  EXPECT_TRUE(canBeSent(whole, format, {}));
  EXPECT_FALSE(canBeSent(behavior({}, whole.vertical, whole.speed), format, {}));
  EXPECT_FALSE(canBeSent(behavior(whole.horizontal, {}, whole.speed), format, {}));
  EXPECT_FALSE(canBeSent(behavior(whole.horizontal, whole.vertical, {}), format, {}));
}

TEST(SpeedTable, IsInterpolatedAndNeverLeft) {
  const std::vector<SpeedPoint> table = {{0.5, 300.0}, {1.5, 900.0}};
  EXPECT_DOUBLE_EQ(rpmFor(0.0, table), 0.0);
  EXPECT_DOUBLE_EQ(rpmFor(0.25, table), 150.0);
  EXPECT_DOUBLE_EQ(rpmFor(0.5, table), 300.0);
  EXPECT_DOUBLE_EQ(rpmFor(1.0, table), 600.0);
  EXPECT_DOUBLE_EQ(rpmFor(3.0, table), 900.0);
  CommandFormat format;
  format.speed_table = table;
  nmea::SentenceWriter writer =
      commandSentence(behavior({}, {}, {{S::MetresPerSecond, 1.0}}), format, {}, 12h);
  EXPECT_EQ(writer.finish(), "$BPRMB,120000.000,,,,600.000,0,*66\r\n");
}

TEST_F(Commanding, NoEmptyFieldGoesOutWhenThePresentIsLost) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.format.fill_behavior_fields = true;
  startSandshark(options);
  EXPECT_EQ(command(behavior({{H::Heading, 1.0}}, {{V::Depth, 2.0}}, {{S::Rpm, 3.0}})), "");
  stop();
  pass(100ms);
  hear("BFNVG,120000.000,,,,,1,,3.5,45,0,0,");
  hear("BFNVR,120000.000,0.3,0.4,0,0,0,0");
  EXPECT_EQ(command(heading(90.0)), "");
  pass(60ms);
  out_.sent.clear();
  hear("BFNVR,120000.000,nan,nan,0,0,0,0");
  pass(900ms);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(Commanding, FillingNeedsToKnowThePresent) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.format.fill_behavior_fields = true;
  startSandshark(options);
  EXPECT_THAT(command(heading(90.0)), HasSubstr("fill_behavior_fields"));
  hear("BFNVG,120000.000,,,,,1,,3.5,45,0,0,");
  hear("BFNVR,120000.000,0.3,0.4,0,0,0,0");
  EXPECT_EQ(command(heading(90.0)), "");
  EXPECT_THAT(out_.sent.back().sentence, HasSubstr(",90.0000,3.500,0,0.500,1,0*"));
}

/// Found by fuzzing: the driver's thread took all of a processor.
TEST_F(NmeaSessionTest, ALinkThatTakesNothingIsNotOfferedItWithoutPause) {
  for (const bool full : {false, true}) {
    NmeaOptions options = withDialect(protocol::Dialect::Kingfisher);
    options.send_spacing = 0ms;
    start(options);
    out_.link_takes = full;  // full: it takes, but has not got rid of what it took
    out_.link_is_full = full;
    session_->command(now(), vehicle::DriveCommand{0.5, 0.5}, now().steady, out_);
    for (int i = 0; i < 10; ++i) {
      session_->step(now(), out_);
      EXPECT_GT(session_->nextStep(), now().steady) << (full ? "full" : "takes nothing");
      elapsed_ += 5ms;
    }
  }
}

}  // namespace
}  // namespace frontseat_driver::session
