#include "frontseat_driver/sim/faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench.h"
#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

KingfisherConfig kingfisherWith(const Faults& faults) {
  KingfisherConfig config = restingKingfisher();
  config.rates = {{"RCM", 0.0}, {"IMU", 0.0}, {"RBS", 0.0}, {"RMC", 0.0},
                  {"GGA", 0.0}, {"NVG", 0.0}, {"NVR", 10.0}};
  config.faults = faults;
  return config;
}

std::size_t wrongOnes(const std::vector<std::string>& lines) {
  std::size_t wrong = 0;
  for (const std::string& line : lines) {
    if (!nmea::parseSentence(line, nmea::ChecksumRule::Required)) ++wrong;
  }
  return wrong;
}

TEST(Faulty, DropLosesThatShareOfTheSentencesWhole) {
  Faults faults;
  faults.drop = 0.3;
  Bench bench{kingfisherWith(faults)};
  bench.connect(1);
  bench.run(1000.0);
  const auto heard = bench.heard(1);
  EXPECT_NEAR(static_cast<double>(heard.size()), 7000.0, 150.0);
  EXPECT_EQ(wrongOnes(heard), 0U);
}

TEST(Faulty, CorruptChangesOneByteAfterTheChecksumWasMade) {
  Faults faults;
  faults.corrupt = 1.0;
  Bench bench{kingfisherWith(faults)};
  Bench clean{kingfisherWith(Faults{})};
  for (Bench* each : {&bench, &clean}) {
    each->connect(1);
    each->run(100.0);
  }
  const std::string spoilt = bench.heardBytes(1);
  const std::string right = clean.heardBytes(1);
  ASSERT_EQ(spoilt.size(), right.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < right.size(); ++i) different += spoilt[i] == right[i] ? 0 : 1;
  EXPECT_EQ(different, 1001U);
}

TEST(Faulty, EachClientHasFaultsOfItsOwn) {
  Faults faults;
  faults.drop = 0.5;
  Bench bench{kingfisherWith(faults)};
  bench.connect(1);
  bench.connect(2);
  bench.run(20.0);
  EXPECT_NE(bench.heardBytes(1), bench.heardBytes(2));
}

TEST(Faulty, SplitLosesNothing) {
  Faults faults;
  faults.split = true;
  Bench bench{kingfisherWith(faults)};
  Bench clean{kingfisherWith(Faults{})};
  for (Bench* each : {&bench, &clean}) {
    each->connect(1);
    each->run(100.0);
  }
  const std::string pieces = bench.heardBytes(1);
  const std::string whole = clean.heardBytes(1);
  EXPECT_GT(pieces.size(), whole.size() - 4096);
  EXPECT_EQ(pieces, whole.substr(0, pieces.size()));
}

/// Counts writes that end in the middle of a sentence.
class Writes : public Frontseat::Sink {
 public:
  void send(ClientId, std::string_view bytes) override { broken += bytes.back() == '\n' ? 0 : 1; }
  void disconnect(ClientId) override {}
  void navigation(const Truth&) override {}
  int broken = 0;
};

TEST(Faulty, SplitEndsWritesInTheMiddle) {
  Faults faults;
  faults.split = true;
  KingfisherFrontseat frontseat{kingfisherWith(faults)};
  Writes writes;
  frontseat.clientConnected(1, kNoon);
  for (int i = 0; i < 1000; ++i) frontseat.step(kNoon + i * std::chrono::milliseconds{10}, writes);
  EXPECT_GT(writes.broken, 50);
}

TEST(Faulty, FaultsBeginAndEndWhileItRuns) {
  Bench bench{kingfisherWith(Faults{})};
  bench.connect(1);
  bench.run(0.99);
  EXPECT_THAT(bench.heard(1), SizeIs(10));
  Faults all_lost;
  all_lost.drop = 1.0;
  bench.frontseat().setFaults(all_lost);
  bench.run(1.0);
  EXPECT_THAT(bench.heard(1), IsEmpty());
  bench.frontseat().setFaults(Faults{});
  bench.run(1.0);
  EXPECT_THAT(bench.heard(1), SizeIs(10));
}

TEST(Faulty, AClockStepShowsInTheNextSentence) {
  Bench bench{kingfisherWith(Faults{})};
  bench.connect(1);
  bench.run(0.99);
  EXPECT_EQ(fields(bench.heard(1).back())[1], "120018.900");  // GPS time
  bench.frontseat().stepClock(-std::chrono::seconds{90});
  bench.run(0.1);
  EXPECT_EQ(fields(bench.heard(1).back())[1], "115849.000");
}

TEST(Faulty, ALongTickBundlesWhatIsSaid) {
  KingfisherConfig config = kingfisherWith(Faults{});
  config.tick = std::chrono::milliseconds{500};
  Bench bench{config};
  bench.connect(1);
  bench.run(0.49);
  bench.heard(1);
  bench.run(0.6);
  EXPECT_THAT(bench.heard(1), SizeIs(2));
}

TEST(Faulty, StallIsSilence) {
  Faults faults;
  faults.stall_s = 3.0;
  faults.stall_every_s = 10.0;
  Bench bench{kingfisherWith(faults)};
  bench.connect(1);
  bench.run(9.99);
  EXPECT_THAT(bench.heard(1), SizeIs(100));
  bench.run(3.0);
  EXPECT_THAT(bench.heard(1), IsEmpty());
  bench.run(7.0);
  EXPECT_THAT(bench.heard(1), SizeIs(70));
}

TEST(Faulty, DisconnectEndsAllConnectionsAgainAndAgain) {
  Faults faults;
  faults.disconnect_every_s = 10.0;
  Bench bench{kingfisherWith(faults)};
  bench.connect(1);
  bench.connect(2);
  bench.run(9.99);
  EXPECT_THAT(bench.disconnected, IsEmpty());
  bench.run(0.01);
  EXPECT_THAT(bench.disconnected, ElementsAre(1, 2));
  bench.heard(1);
  bench.run(1.0);
  EXPECT_THAT(bench.heard(1), IsEmpty());
  bench.connect(3);
  bench.run(9.0);
  EXPECT_THAT(bench.disconnected, ElementsAre(1, 2, 3));
}

/// A running Sandshark with faults and a client that wants acknowledgements.
class FaultySandshark {
 public:
  explicit FaultySandshark(const Faults& faults) : bench(config(faults)) {
    bench.connect(1);
    bench.tell(1, "BPLOG,ACK,ON");
    bench.run(1.0);
    bench.heard(1);
    bench.tell(1, "BPRMB,120000.000,,5,0,,,");
  }
  Bench bench;

 private:
  static SandsharkConfig config(const Faults& faults) {
    SandsharkConfig config = runningSandshark();
    config.faults = faults;
    return config;
  }
};

TEST(Faulty, WithheldAcknowledgementsAreObeyedCommands) {
  Faults faults;
  faults.withhold_acks = true;
  FaultySandshark vehicle{faults};
  vehicle.bench.run(1.0);
  EXPECT_THAT(vehicle.bench.heard(1), IsEmpty());
  EXPECT_TRUE(vehicle.bench.sandshark().backseatSteers());
}

TEST(Faulty, DelayedAcknowledgementsAreLateAndSaySo) {
  Faults faults;
  faults.delay_acks_s = 2.5;
  FaultySandshark vehicle{faults};
  vehicle.bench.run(2.4);
  EXPECT_THAT(vehicle.bench.heard(1), IsEmpty());
  vehicle.bench.run(0.2);
  EXPECT_THAT(vehicle.bench.heard(1),
              ElementsAre(HasSubstr("$BFACK,120003.500,RMB,120000.000,,2,")));
}

TEST(Faulty, ALiarAcknowledgesWhatItDoesNotDo) {
  Faults faults;
  faults.lie = true;
  FaultySandshark vehicle{faults};
  vehicle.bench.tell(1, "BPABT,120000.500,stop,1");
  vehicle.bench.run(0.1);
  EXPECT_THAT(vehicle.bench.heard(1, "BFACK"),
              ElementsAre(HasSubstr(",RMB,120000.000,,2,"), HasSubstr(",ABT,120000.500,,2,")));
  EXPECT_FALSE(vehicle.bench.sandshark().backseatSteers());
  EXPECT_EQ(vehicle.bench.sandshark().mission().state(), Mission::State::Running);
}

TEST(Faulty, ALyingBoatDoesNotMove) {
  Faults faults;
  faults.lie = true;
  Bench bench{kingfisherWith(faults)};
  bench.connect(1);
  bench.tell(1, "PYDIR,50,50");
  bench.run(0.5);
  EXPECT_DOUBLE_EQ(bench.kingfisher().thrust().port, 0.0);
}

}  // namespace
}  // namespace frontseat_driver::sim
