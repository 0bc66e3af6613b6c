#include "frontseat_driver/session/nmea_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nmea_session_fixture.h"

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(NmeaSessionTest, SandsharkHandshakeInOrderAndSpaced) {
  start(withDialect(Dialect::Sandshark));
  pass(1s);
  EXPECT_THAT(out_.sentences(), ElementsAre("$BPVER,120000.000,0.1*61\r\n", "$BPLOG,ACK,ON*1E\r\n",
                                            "$BPLOG,NVG,ON*08\r\n", "$BPLOG,NVR,ON*1D\r\n",
                                            "$BPLOG,MIS,ON*00\r\n", "$BPLOG,CTL,ON*0C\r\n"));
  for (std::size_t i = 1; i < out_.sent.size(); ++i) {
    EXPECT_EQ(out_.sent[i].at - out_.sent[i - 1].at, 60ms);
  }
}

TEST_F(NmeaSessionTest, HandshakeAgainAfterEveryReconnect) {
  start(withDialect(Dialect::Sandshark));
  pass(100ms);  // in the middle of it
  disconnect();
  out_.sent.clear();
  pass(5s);
  EXPECT_THAT(out_.sent, IsEmpty());
  connect();
  pass(1s);
  EXPECT_THAT(out_.sent, SizeIs(6));
  EXPECT_EQ(out_.sent.front().sentence.substr(0, 7), "$BPVER,");
}

TEST_F(NmeaSessionTest, SpacingAndSentencesAsChosen) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.use_acks = false;
  options.log_sentences = {"ALL"};
  options.send_spacing = 250ms;
  options.interface_version = "1.9";
  start(options);
  pass(2s);
  EXPECT_THAT(out_.sentences(),
              ElementsAre("$BPVER,120000.000,1.9*68\r\n", "$BPLOG,ALL,ON*16\r\n"));
  EXPECT_EQ(out_.sent[1].at - out_.sent[0].at, 250ms);
}

TEST_F(NmeaSessionTest, AcksAreAskedForOnce) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.log_sentences = {"NVG", "ACK"};
  start(options);
  pass(2s);
  EXPECT_THAT(out_.sent, SizeIs(3));
}

TEST_F(NmeaSessionTest, ASentenceTheLinkDoesNotTakeIsTriedAgain) {
  out_.link_takes = false;
  start(withDialect(Dialect::Sandshark));
  pass(1s);
  out_.link_takes = true;
  pass(1s);
  EXPECT_THAT(out_.sent, SizeIs(6));
  EXPECT_EQ(session_->counters().sentences_sent, 6u);
  std::uint64_t bytes = 0;
  for (const auto& sent : out_.sent) bytes += sent.sentence.size();
  EXPECT_EQ(session_->counters().bytes_sent, bytes);
}

TEST_F(NmeaSessionTest, EveryByteIsDecodedRefusedALineEndOrPending) {
  start(withDialect(Dialect::Sandshark));
  receive("$BFVER,120000.000,SS_0.0*29\r\nnoise\r\n$BFXYZ,1*42\r\n$BFNVG,12");
  NmeaCounters counters = session_->counters();
  EXPECT_EQ(counters.bytes_received, 27u + 5 + 11 + 6 + 9);
  EXPECT_EQ(counters.decoded, 1u);
  EXPECT_EQ(counters.decoded_bytes, 27u);
  EXPECT_EQ(counters.refused_bytes, 5u + 11);
  EXPECT_EQ(counters.line_end_bytes, 6u);
  EXPECT_EQ(counters.pending_bytes, 9u);
  disconnect();
  counters = session_->counters();
  EXPECT_EQ(counters.pending_bytes, 0u);
  EXPECT_EQ(counters.refused_bytes, 5u + 11 + 9);
}

TEST_F(NmeaSessionTest, KingfisherIsSentNothing) {
  start(withDialect(Dialect::Kingfisher));
  hear("CPNVR,120000.000,0.1,0.2,0,0,0,0");
  pass(1min);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(NmeaSessionTest, FirstTalkerDecidesTheDialect) {
  start(quiet());
  EXPECT_FALSE(session_->dialect());
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_EQ(session_->dialect(), Dialect::Sandshark);
  pass(1s);
  EXPECT_THAT(out_.sent, SizeIs(6));
  hear("CPNVR,120000.000,0.1,0.2,0,0,0,0");
  EXPECT_EQ(session_->dialect(), Dialect::Sandshark);
  EXPECT_EQ(session_->counters().other_dialect, 1u);
  EXPECT_THAT(out_.eventsOf<vehicle::Velocity>(), IsEmpty());
}

TEST_F(NmeaSessionTest, GpsTalkersDecideNothingAndVersionGoesOutAfterTwoSeconds) {
  start(quiet());
  hear("GPVTG,156.78,T,,M,0.145,N,0.269,K,A");
  pass(1999ms);
  EXPECT_THAT(out_.sent, IsEmpty());
  pass(1ms);
  EXPECT_THAT(out_.sentences(), ElementsAre("$BPVER,120002.000,0.1*63\r\n"));
  pass(1min);
  EXPECT_THAT(out_.sent, SizeIs(1));
  EXPECT_FALSE(session_->dialect());
  hear("BFVER,120102.000,SS_0.0");
  pass(1s);
  EXPECT_THAT(out_.sent, SizeIs(6));  // BPVER went out already
}

TEST_F(NmeaSessionTest, ABoatInAutoIsSentNothing) {
  start(quiet());
  hear("CPRBS,120000.000,1,15.1,15.1,15.1,20");
  EXPECT_EQ(session_->dialect(), Dialect::Kingfisher);
  pass(1min);
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(NmeaSessionTest, DialectIsLearntAnewOnEveryConnection) {
  start(quiet());
  hear("CPRBS,120000.000,1,15.1,15.1,15.1,20");
  disconnect();
  EXPECT_FALSE(session_->dialect());
  connect();
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_EQ(session_->dialect(), Dialect::Sandshark);
}

TEST_F(NmeaSessionTest, ARecordIsNeverAnswered) {
  NmeaOptions options = quiet();
  options.listen_only = true;
  start(options);
  pass(5s);
  hear("BFVER,120000.000,SS_0.0");
  pass(1min);
  EXPECT_EQ(out_.version, "SS_0.0");
  EXPECT_THAT(out_.sent, IsEmpty());
}

TEST_F(NmeaSessionTest, EveryLineIsHeardAndOnlyGoodOnesCount) {
  start(withDialect(Dialect::Sandshark));
  receive("noise\r\n\n\n");
  EXPECT_EQ(out_.confirmations, 0);
  receive("$BFVER,120000.000,SS_0.0*00\r\n");  // wrong checksum
  receive("$BFVER,120000.000,SS_0.0\r\n");     // none
  EXPECT_EQ(out_.confirmations, 0);
  hear("BFXYZ,120000.000,1");
  hear("BFNVR,120000.000,one,2,3,4,5,6");
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_THAT(out_.lines, SizeIs(5));
  EXPECT_EQ(out_.confirmations, 1);
  const NmeaCounters counters = session_->counters();
  EXPECT_EQ(counters.sentences_received, 5u);
  EXPECT_EQ(counters.bad_checksums, 1u);
  EXPECT_EQ(counters.bad_frames, 2u);  // noise, no checksum
  EXPECT_EQ(counters.no_sentences, 1u);
  EXPECT_EQ(counters.unknown, 1u);
  EXPECT_EQ(counters.decoded, 2u);
  EXPECT_EQ(counters.bad_fields, 1u);
  const auto velocities = out_.eventsOf<vehicle::Velocity>();
  ASSERT_THAT(velocities, SizeIs(1));
  EXPECT_FALSE(velocities[0].east_m_s);
  EXPECT_EQ(velocities[0].north_m_s, 2.0);
}

TEST_F(NmeaSessionTest, NoTailOfAnOldConnectionIsJoinedToTheNext) {
  start(withDialect(Dialect::Sandshark));
  receive("$BFVER,120000.000,");
  disconnect();
  connect();
  receive("SS_0.0*29\r\n");
  EXPECT_THAT(out_.lines, IsEmpty());
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_EQ(out_.version, "SS_0.0");
}

TEST_F(NmeaSessionTest, ConfirmsEachConnectionOnce) {
  start(withDialect(Dialect::Sandshark));
  hear("BFVER,120000.000,SS_0.0");
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_EQ(out_.confirmations, 1);
  disconnect();
  connect();
  hear("BFVER,120000.000,SS_0.0");
  EXPECT_EQ(out_.confirmations, 2);
}

TEST_F(NmeaSessionTest, AcknowledgementsByThreeOrFiveLetters) {
  start(withDialect(Dialect::Sandshark));
  hear("BFACK,120000.100,RMB,120000.000,,2,0,done,");
  EXPECT_EQ(out_.acknowledged_command, "RMB");
  hear("BFACK,120000.100,BPABT,120000.000,,3,0,");
  EXPECT_EQ(out_.acknowledged_command, "ABT");
  const auto acks = out_.eventsOf<vehicle::Acknowledgement>();
  ASSERT_THAT(acks, SizeIs(2));
  EXPECT_EQ(acks[0].status, vehicle::Acknowledgement::Status::Done);
  EXPECT_EQ(acks[0].command_time, vehicle::TimeOfDay{12h});
  EXPECT_EQ(acks[1].status, vehicle::Acknowledgement::Status::Pending);
}

TEST_F(NmeaSessionTest, ControlIsUnknownAfterEveryConnectAndFollowsBfctl) {
  start(withDialect(Dialect::Sandshark));
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Unknown);
  EXPECT_EQ(out_.reason, "the vehicle has sent no BFCTL since the connection was made");
  hear("BFCTL,120000.000,1");
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Granted);
  EXPECT_EQ(out_.reason, "");
  hear("BFCTL,120000.000,0");
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Denied);
  EXPECT_EQ(out_.reason, "the vehicle keeps control (BFCTL 0)");
  hear("BFCTL,120000.000,1");
  disconnect();
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Unknown);
  EXPECT_EQ(out_.reason, "there is no connection to the vehicle");
  connect();
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Unknown);
}

TEST_F(NmeaSessionTest, ControlIsReportedOnChangeOnly) {
  start(withDialect(Dialect::Sandshark));
  hear("BFCTL,120000.000,1");
  const auto reports = out_.eventsOf<vehicle::Control>().size();
  hear("BFCTL,120001.000,1");
  hear("BFNVR,120000.000,1,2,3,4,5,6");
  EXPECT_EQ(out_.eventsOf<vehicle::Control>().size(), reports);
}

TEST_F(NmeaSessionTest, ControlByMissionStatus) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.control_hook = ControlHook::Mis;
  start(options);
  hear("BFCTL,120000.000,1");
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Unknown);
  hear("BFMIS,120000.000,survey.dive,Running /logs/7,");
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Granted);
  hear("BFMIS,120000.000,survey.dive,WrappingUp,");
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Denied);
}

TEST_F(NmeaSessionTest, ControlWithoutHookAndOnABoat) {
  NmeaOptions options = withDialect(Dialect::Sandshark);
  options.control_hook = ControlHook::None;
  start(options);
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Granted);
  start(withDialect(Dialect::Kingfisher));
  EXPECT_EQ(out_.control.grant, vehicle::Grant::Granted);
  EXPECT_EQ(out_.reason, "");
}

TEST_F(NmeaSessionTest, ClosedGateIsTheReason) {
  NmeaOptions options = withDialect(Dialect::Kingfisher);
  options.commands_enabled = false;
  start(options);
  EXPECT_FALSE(out_.control.commands_enabled);
  EXPECT_EQ(out_.reason, "the command gate is closed; service enable_commands opens it");
}

TEST_F(NmeaSessionTest, TellsWhoIsInControlAtOnce) {
  NmeaSession session{NmeaOptions{}};
  EXPECT_LE(session.nextStep(), now().steady);
}

TEST(NmeaOptions, DefaultsAreThoseOfTheInterface) {
  const NmeaOptions options;
  EXPECT_EQ(options.command_timeout, 1s);
  EXPECT_EQ(options.command_rate_hz, 5.0);
  EXPECT_EQ(options.ack_timeout, 3s);
  EXPECT_EQ(options.effect_timeout, 10s);
  EXPECT_EQ(options.max_data_age, 2s);
  EXPECT_EQ(options.status_rate_hz, 1.0);
}

// Else the driver's thread would go round without a pause.
TEST_F(NmeaSessionTest, NothingIsDueBeforeTheFirstConnection) {
  NmeaSession session{NmeaOptions{}};
  session.step(now(), out_);
  EXPECT_EQ(session.nextStep(), SteadyTime::max());
  EXPECT_TRUE(out_.sent.empty());
}

TEST_F(NmeaSessionTest, NothingIsDueAfterAReconnectUntilTheVehicleSpeaks) {
  for (const bool listen_only : {false, true}) {
    NmeaOptions options;
    options.listen_only = listen_only;
    start(options);
    disconnect();
    connect();
    elapsed_ += 1ms;
    session_->step(now(), out_);
    EXPECT_GT(session_->nextStep(), now().steady) << listen_only;
    EXPECT_TRUE(out_.sent.empty());
  }
}

}  // namespace
}  // namespace frontseat_driver::session
