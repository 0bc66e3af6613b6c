#include <gtest/gtest.h>

#include <string>

#include "deck.h"
#include "frontseat_driver/sim/blueye/parameters.h"
#include "test/sim/refusals.h"

namespace frontseat_driver::sim {
namespace {

TEST(Faults, LostRepliesAreObeyedAllTheSame) {
  Deck deck;
  deck.drone.faults().lose_replies = 1.0;
  EXPECT_FALSE(deck.ask<bp::ConnectClientRep>(bp::ConnectClientReq{}));
  deck.drone.faults().lose_replies = 0.0;
  const auto second = deck.ask<bp::ConnectClientRep>(bp::ConnectClientReq{});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->client_id(), 2U);
}

TEST(Faults, SomeRepliesAreLost) {
  Deck deck;
  deck.drone.faults().lose_replies = 0.3;
  int answered = 0;
  for (int i = 0; i < 1000; ++i) answered += deck.ask<bp::PingRep>(bp::PingReq{}) ? 1 : 0;
  EXPECT_NEAR(answered, 700, 60);  // four sigma
}

TEST(Faults, RepliesComeLate) {
  Deck deck;
  deck.drone.faults().reply_delay_s = 0.5;
  EXPECT_FALSE(deck.ask<bp::PingRep>(bp::PingReq{}));
  deck.run(0.45);
  EXPECT_TRUE(deck.replies.empty());
  deck.run(0.1);
  EXPECT_EQ(deck.replies.size(), 1U);
}

TEST(Faults, SilenceBeginsAndEnds) {
  Deck deck;
  deck.drone.faults().silence_every_s = 10.0;
  deck.drone.faults().silence_s = 4.0;
  deck.run(10.1);
  deck.published.clear();
  deck.run(3.5);
  EXPECT_TRUE(deck.published.empty());
  EXPECT_FALSE(deck.ask<bp::PingRep>(bp::PingReq{}));
  deck.run(2.0);
  EXPECT_FALSE(deck.published.empty());
  EXPECT_TRUE(deck.ask<bp::PingRep>(bp::PingReq{}));
}

TEST(Faults, RebootForgetsAllButWhereItIs) {
  Deck deck;
  const auto client = deck.connect();
  EXPECT_EQ(client, 1U);
  deck.push(1, 0, 0.5F, 0);
  bp::SetPubFrequencyReq rate;
  rate.set_message_type("Imu1Tel");
  rate.set_frequency(50.0F);
  deck.ask<bp::SetPubFrequencyRep>(rate);
  deck.run(5.0);
  deck.drone.reboot();
  EXPECT_FALSE(deck.drone.online());
  deck.published.clear();
  deck.run(7.9);
  EXPECT_TRUE(deck.published.empty());
  EXPECT_FALSE(deck.ask<bp::PingRep>(bp::PingReq{}));
  EXPECT_EQ(deck.drone.model().commanded().surge, 0.0);
  EXPECT_GT(deck.state().north_m, 2.0);
  deck.run(0.2);
  EXPECT_TRUE(deck.drone.online());
  const double north = deck.state().north_m;
  deck.run(0.8);
  deck.run(1.0);
  EXPECT_EQ(deck.count<bp::Imu1Tel>(), 0U);
  EXPECT_EQ(deck.latest<bp::ConnectedClientsTel>().connected_clients_size(), 0);
  EXPECT_LE(deck.latest<bp::DroneTimeTel>().monotonic_clock().unix_timestamp().seconds(), 2);
  // The estimate begins anew, the drone is where it was.
  EXPECT_NEAR(deck.latest<bp::PositionEstimateTel>().position_estimate().northing(),
              deck.state().north_m - north, 0.05);
  deck.pets = 0;
  EXPECT_EQ(deck.connect(), 1U);
}

TEST(Faults, RebootsComeByThemselves) {
  Deck deck;
  deck.drone.faults().reboot_every_s = 20.0;
  deck.drone.faults().reboot_s = 2.0;
  deck.run(20.5);
  EXPECT_FALSE(deck.drone.online());
  deck.run(2.5);
  EXPECT_TRUE(deck.drone.online());
  deck.run(18.0);
  EXPECT_FALSE(deck.drone.online());
}

TEST(Faults, SpoilMessagesOrLoseThem) {
  Deck clean;
  Deck spoilt;
  spoilt.drone.faults().corrupt = 0.5;
  Deck lossy;
  lossy.drone.faults().lose_telemetry = 0.5;
  for (Deck* deck : {&clean, &spoilt, &lossy}) deck->run(10.0);
  const auto& good = clean.published["blueye.protocol.AttitudeTel"];
  const auto& bad = spoilt.published["blueye.protocol.AttitudeTel"];
  ASSERT_EQ(good.size(), bad.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < good.size(); ++i) different += good[i] != bad[i] ? 1 : 0;
  // 200 messages: half of them, six sigma.
  EXPECT_NEAR(static_cast<double>(different), 0.5 * static_cast<double>(good.size()), 42.0);
  EXPECT_NEAR(static_cast<double>(lossy.count<bp::AttitudeTel>()), 100.0, 42.0);
}

TEST(Seed, DecidesEverything) {
  const auto record = [](std::uint64_t seed) {
    BlueyeConfig config = quietDrone();
    config.noise = true;
    config.seed = seed;
    config.faults.corrupt = 0.1;
    config.faults.lose_telemetry = 0.1;
    Deck deck{config};
    deck.connect();
    deck.push(0.5F, 0.2F, 0.3F, 0.1F);
    deck.run(5.0);
    return deck.published;
  };
  EXPECT_EQ(record(1), record(1));
  EXPECT_NE(record(1), record(2));
}

TEST(Noise, IsOnTheInstrumentsNotOnTheTruth) {
  BlueyeConfig config = quietDrone();
  config.noise = true;
  Deck deck{config};
  deck.run(20.0);
  EXPECT_EQ(deck.state().heading_rad, 0.0);
  const auto& all = deck.published["blueye.protocol.AttitudeTel"];
  double sum = 0.0;
  for (const std::string& data : all) {
    bp::AttitudeTel message;
    message.ParseFromString(data);
    EXPECT_LT(std::abs(message.attitude().yaw()), 1.0F);
    sum += std::abs(message.attitude().yaw());
  }
  EXPECT_GT(sum / static_cast<double>(all.size()), 0.03);
}

TEST(Truth, ComesTwentyTimesASecond) {
  Deck deck;
  deck.connect();
  deck.push(1, 0, 0, 0);
  deck.run(10.0);
  EXPECT_NEAR(static_cast<double>(deck.truths.size()), 200.0, 2.0);
  EXPECT_NEAR(deck.truths.back().state.north_m, deck.state().north_m, 0.1);
  EXPECT_GT(deck.truths.back().stamp, kBlueyeNoon + std::chrono::seconds{9});
}

TEST(Parameters, TakeTheirOwnDefaultsAndStayTheSame) {
  const BlueyeSimulatorConfig defaults;
  for (const auto& parameter : blueyeParameters()) {
    BlueyeSimulatorConfig config;
    const std::string before = parameter.get(defaults);
    EXPECT_EQ(setParameter(blueyeParameters(), config, parameter.name, before), std::nullopt)
        << parameter.name;
    EXPECT_EQ(parameter.get(config), before) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
  }
}

TEST(Parameters, NumbersAndFlagsRefuseWhatIsNone) { expectRefusals(blueyeParameters()); }

struct Value {
  const char* name;
  const char* value;
  const char* reads_back;
};
class AcceptedValue : public testing::TestWithParam<Value> {};

TEST_P(AcceptedValue, IsKept) {
  BlueyeSimulatorConfig config;
  ASSERT_EQ(setParameter(blueyeParameters(), config, GetParam().name, GetParam().value),
            std::nullopt);
  for (const auto& parameter : blueyeParameters()) {
    if (parameter.name != GetParam().name) continue;
    EXPECT_EQ(parameter.get(config), GetParam().reads_back);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, AcceptedValue,
    testing::Values(
        Value{"bind", "::1", "::1"}, Value{"telemetry_port", "0", "0"},
        Value{"devices", "[gripper, dvl]", "[dvl, gripper]"}, Value{"devices", "[]", "[]"},
        Value{"rates", "{DepthTel: 40, Imu1Tel: 100}", "{DepthTel: 40, Imu1Tel: 100}"},
        Value{"yaw_positive", "left", "left"}, Value{"accelerometer_sign", "gravity", "gravity"},
        Value{"accelerometer_sign", "specific_force", "specific_force"},
        Value{"devices", "dvl dvl", "[dvl]"}, Value{"rates", "{}", "{}"},
        Value{"http", "0", "false"}, Value{"http", "True", "true"},
        Value{"start", "1 2 0.5", "[1, 2, 0.5]"}, Value{"current", "[0, 2]", "[0, 2]"},
        Value{"serial_number", "SIM7", "SIM7"}, Value{"datum", "[-42.5, 147]", "[-42.5, 147]"}));

class RefusedValue : public testing::TestWithParam<Value> {};

TEST_P(RefusedValue, IsNamedWithWhatIsAccepted) {
  BlueyeSimulatorConfig config;
  const auto wrong = setParameter(blueyeParameters(), config, GetParam().name, GetParam().value);
  ASSERT_TRUE(wrong);
  EXPECT_NE(wrong->find(GetParam().name), std::string::npos) << *wrong;
  EXPECT_NE(wrong->find(GetParam().reads_back), std::string::npos) << *wrong;
}

INSTANTIATE_TEST_SUITE_P(
    Table, RefusedValue,
    testing::Values(Value{"bind", "localhost", "in numbers"}, Value{"http_port", "65536", "65535"},
                    Value{"devices", "[kraken]", "gripper"},
                    Value{"rates", "{NoSuchTel: 4}", "telemetry message"},
                    Value{"rates", "{DepthTel: 101}", "from 0 to 100"},
                    Value{"rates", "{DepthTel: -1}", "from 0 to 100"},
                    Value{"rates", "{DepthTel: fast}", "a number"},
                    Value{"rates", "DepthTel", "pairs"}, Value{"datum", "[91, 0]", "latitude"},
                    Value{"datum", "[0, 181]", "longitude"}, Value{"datum", "[0]", "latitude"},
                    Value{"datum", "here", "latitude"}, Value{"start", "1 2", "yaw"},
                    Value{"current", "[2, 2]", "2 m/s at most"},
                    Value{"current", "[1]", "[east, north]"}, Value{"serial_number", "", "text"},
                    Value{"yaw_positive", "up", "right or left"},
                    Value{"lose_reply", "1", "lose_replies"}));

}  // namespace
}  // namespace frontseat_driver::sim
