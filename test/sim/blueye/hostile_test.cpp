// Whatever arrives costs itself and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "deck.h"
#include "frontseat_driver/sim/random.h"
#include "reflection.h"

namespace frontseat_driver::sim {
namespace {

std::string randomBytes(Random& random, std::size_t most) {
  std::string bytes(random.below(most), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

bool sane(const VehicleState& state) {
  return std::isfinite(state.east_m) && std::isfinite(state.north_m) &&
         std::isfinite(state.depth_m) && std::isfinite(state.heading_rad) &&
         std::isfinite(state.roll_rad) && std::isfinite(state.pitch_rad);
}

TEST(Hostile, RandomBytesUnderEveryName) {
  Deck deck;
  deck.connect();
  Random random{7};
  for (int round = 0; round < 30; ++round) {
    for (const std::string& name : BlueyeDrone::knownControls()) {
      deck.drone.control("blueye.protocol." + name, randomBytes(random, 60));
    }
    for (const std::string& name : BlueyeDrone::knownRequests()) {
      deck.replies.clear();
      deck.drone.request("peer", "blueye.protocol." + name, randomBytes(random, 60));
      deck.drone.step(deck.drone.now(), deck);
      ASSERT_EQ(deck.replies.size(), 1U) << name;
    }
    deck.run(0.2);
    ASSERT_TRUE(sane(deck.state()));
  }
  EXPECT_GT(deck.drone.counts().malformed, 100U);
}

/// What a well-meaning client sends, with one bit wrong: many of these still are messages.
TEST(Hostile, MessagesWithOneWrongBit) {
  bp::SetMissionReq mission;
  for (int i = 0; i < 3; ++i) {
    auto* instruction = mission.mutable_mission()->add_instructions();
    instruction->set_id(static_cast<std::uint32_t>(i));
    auto* waypoint = instruction->mutable_waypoint_command()->mutable_waypoint();
    waypoint->mutable_global_position()->set_latitude(63.4407);
    waypoint->mutable_global_position()->set_longitude(10.3498);
    waypoint->mutable_depth_set_point()->set_depth(2.0F);
    waypoint->set_circle_of_acceptance(1.0F);
    waypoint->set_speed_to_target(0.6F);
  }
  bp::MotionInputCtrl motion;
  motion.mutable_motion_input()->set_surge(0.5F);
  motion.mutable_motion_input()->set_yaw(-0.5F);
  const std::string mission_bytes = mission.SerializeAsString();
  const std::string motion_bytes = motion.SerializeAsString();
  Deck deck;
  deck.connect();
  Random random{8};
  for (int round = 0; round < 600; ++round) {
    std::string request = mission_bytes;
    request[random.below(request.size())] ^= static_cast<char>(1 << random.below(8));
    deck.drone.request("peer", "blueye.protocol.SetMissionReq", request);
    std::string control = motion_bytes;
    control[random.below(control.size())] ^= static_cast<char>(1 << random.below(8));
    deck.drone.control("blueye.protocol.MotionInputCtrl", control);
    deck.tell(bp::RunMissionCtrl{});
    deck.run(0.3);
    deck.tell(bp::ClearMissionCtrl{});
    ASSERT_TRUE(sane(deck.state()));
    ASSERT_LT(std::abs(deck.state().surge_m_s), 2.0);
  }
}

struct Name {
  const char* name;
  const char* message;
};
class Unknown : public testing::TestWithParam<Name> {};

TEST_P(Unknown, RequestIsAnsweredByEmptyAndControlCounted) {
  Deck deck;
  deck.drone.request("peer", GetParam().message, "abc");
  deck.drone.step(deck.drone.now(), deck);
  ASSERT_EQ(deck.replies.size(), 1U);
  EXPECT_EQ(deck.replies[0].first, "google.protobuf.Empty");
  EXPECT_EQ(deck.replies[0].second, "");
  deck.drone.control(GetParam().message, "abc");
  EXPECT_EQ(deck.drone.counts().unknown, 2U);
}

INSTANTIATE_TEST_SUITE_P(Table, Unknown,
                         testing::Values(Name{"nothing", ""}, Name{"no_package", "Ping"},
                                         Name{"other_package", "other.protocol.PingReq"},
                                         Name{"later", "blueye.protocol.BrewCoffeeReq"},
                                         Name{"package_only", "blueye.protocol."},
                                         Name{"telemetry", "blueye.protocol.DepthTel"}),
                         [](const auto& row) { return std::string{row.param.name}; });

class NotANumber : public testing::TestWithParam<float> {};

TEST_P(NotANumber, IsRefusedWhole) {
  Deck deck;
  deck.connect();
  deck.push(0.2F, 0, 0, 0);
  deck.push(0.5F, GetParam(), 0, 0);
  deck.run(1.0);
  EXPECT_FLOAT_EQ(deck.latest<bp::ReferenceTel>().reference().surge(), 0.2F);
  bp::TiltVelocityCtrl tilt;
  tilt.mutable_velocity()->set_value(GetParam());
  deck.tell(tilt);
  bp::PilotGPSPositionCtrl pilot;
  pilot.mutable_position()->set_latitude(GetParam());
  deck.tell(pilot);
  EXPECT_EQ(deck.drone.counts().refused, 3U);
  deck.run(1.0);
  EXPECT_EQ(deck.latest<bp::TiltAngleTel>().angle().value(), 0.0F);
}

INSTANTIATE_TEST_SUITE_P(Table, NotANumber,
                         testing::Values(std::numeric_limits<float>::quiet_NaN(),
                                         std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity()));

/// NaN as the first number of a message, or of the message that is its first field.
TEST(Hostile, NaNIsRefusedUnderEveryNameThatHasANumberThere) {
  using std::string_literals::operator""s;
  const std::string kPayloads[] = {"\x0d\x00\x00\xc0\x7f"s, "\x0a\x05\x0d\x00\x00\xc0\x7f"s,
                                   "\x0a\x09\x09\x00\x00\x00\x00\x00\x00\xf8\x7f"s};
  Deck deck;
  deck.connect();
  for (const std::string& payload : kPayloads) {
    for (const std::string& name : BlueyeDrone::knownControls()) {
      const std::uint64_t before = deck.drone.counts().refused;
      deck.drone.control("blueye.protocol." + name, payload);
      const std::uint64_t after = isFinite(name, payload) ? before : before + 1;
      EXPECT_GE(deck.drone.counts().refused, after) << name;
    }
    for (const std::string& name : BlueyeDrone::knownRequests()) {
      deck.replies.clear();
      deck.drone.request("peer", "blueye.protocol." + name, payload);
      deck.drone.step(deck.drone.now(), deck);
      ASSERT_EQ(deck.replies.size(), 1U) << name;
    }
  }
  EXPECT_GT(deck.drone.counts().refused, 20U);
  deck.run(0.2);
  EXPECT_TRUE(sane(deck.state()));
}

class NoTime : public testing::TestWithParam<std::pair<std::int64_t, std::int32_t>> {};

TEST_P(NoTime, LeavesTheClockAsItIs) {
  Deck deck;
  deck.connect();
  google::protobuf::Timestamp time;
  time.set_seconds(GetParam().first);
  time.set_nanos(GetParam().second);
  bp::SyncTimeReq request;
  *request.mutable_time()->mutable_unix_timestamp() = time;
  const auto reply = deck.ask<bp::SyncTimeRep>(request);
  ASSERT_TRUE(reply);
  EXPECT_FALSE(reply->success());
  bp::SystemTimeCtrl told;
  *told.mutable_system_time()->mutable_unix_timestamp() = time;
  deck.tell(told);
  EXPECT_EQ(deck.drone.counts().refused, 1U);
  deck.run(2.0);
  const auto clock = deck.latest<bp::DroneTimeTel>().real_time_clock().unix_timestamp();
  EXPECT_NEAR(static_cast<double>(clock.seconds()), 1772366401.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Table, NoTime,
                         testing::Values(std::pair{std::numeric_limits<std::int64_t>::max(), 0},
                                         std::pair{std::numeric_limits<std::int64_t>::min(), 0},
                                         std::pair{std::int64_t{-1}, 0},
                                         std::pair{std::int64_t{7258118400}, 0},
                                         std::pair{std::int64_t{1772366400}, -1},
                                         std::pair{std::int64_t{1772366400}, 1000000000}));

TEST(Hostile, ARateThatIsHardlyAnyIsSeldom) {
  Deck deck;
  deck.connect();
  bp::SetPubFrequencyReq request;
  request.set_message_type("DepthTel");
  request.set_frequency(1e-38F);
  EXPECT_TRUE(deck.ask<bp::SetPubFrequencyRep>(request)->success());
  const std::size_t before = deck.count<bp::DepthTel>();
  deck.run(10.0);
  EXPECT_LE(deck.count<bp::DepthTel>(), before + 1);
}

TEST(Hostile, ASonarThatSeesNoDistanceSendsItsImage) {
  Deck deck;
  deck.connect();
  bp::ActivateMultibeamCtrl activate;
  activate.mutable_config()->set_range(1e-300);
  deck.tell(activate);
  deck.run(1.0);
  EXPECT_GT(deck.count<bp::MultibeamPingTel>(), 0U);
}

TEST(Hostile, ValuesBeyondTheirRangeAreLimited) {
  Deck deck;
  deck.connect();
  deck.push(5.0F, -5.0F, 0, 0);
  bp::LightsCtrl lights;
  lights.mutable_lights()->set_value(40.0F);
  deck.tell(lights);
  deck.run(1.0);
  EXPECT_EQ(deck.latest<bp::ReferenceTel>().reference().surge(), 1.0F);
  EXPECT_EQ(deck.latest<bp::ReferenceTel>().reference().sway(), -1.0F);
  EXPECT_EQ(deck.latest<bp::LightsTel>().lights().value(), 1.0F);
}

}  // namespace
}  // namespace frontseat_driver::sim
