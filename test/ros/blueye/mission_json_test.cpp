#include "blueye/mission_json.h"

#include <blueye/telemetry.pb.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using testing::HasSubstr;

MissionRequest read(const std::string& json) {
  static const protocol::BlueyeCatalogue kCatalogue;
  return toMissionRequest(kCatalogue, json);
}

TEST(MissionJson, GoesOnAfterAnInstructionThatDoesNotSay) {
  const auto request = read(R"({"id": 7, "instructions": [
      {"id": 1, "auto_continue": false}, {"id": 2}, {"id": 3, "autoContinue": false},
      {"id": 4, "auto_continue": true, "wait_for_command": {"wait_for_seconds": 2.5}}]})");
  ASSERT_TRUE(std::holds_alternative<blueye::protocol::SetMissionReq>(request));
  const auto& mission = std::get<blueye::protocol::SetMissionReq>(request).mission();
  std::vector<bool> goes_on;
  for (const auto& instruction : mission.instructions()) {
    goes_on.push_back(instruction.auto_continue());
  }
  EXPECT_EQ(mission.id(), 7u);
  EXPECT_EQ(goes_on, (std::vector<bool>{false, true, false, true}));
  EXPECT_EQ(mission.instructions(3).wait_for_command().wait_for_seconds(), 2.5F);
}

std::uint32_t idOf(const std::string& json) {
  const auto request = read(json);
  return std::get<blueye::protocol::SetMissionReq>(request).mission().id();
}

TEST(MissionJson, HasAnIdOfItsOwnUnlessItTellsOne) {
  const std::string shallow =
      R"({"instructions": [{"wait_for_command": {"wait_for_seconds": 1}}]})";
  const std::string longer = R"({"instructions": [{"wait_for_command": {"wait_for_seconds": 2}}]})";
  EXPECT_NE(idOf(shallow), 0u);
  EXPECT_EQ(idOf(shallow), idOf(shallow));
  EXPECT_NE(idOf(shallow), idOf(longer));
  EXPECT_LE(idOf(shallow), 2147483647u);  // also where it is taken for a signed number
  EXPECT_EQ(idOf(R"({"id": 4294967295, "instructions": [{}]})"), 4294967295u);
}

struct Told {
  const char* name;
  blueye::protocol::MissionState state;
  std::uint32_t id;
  bool decides, ready;
};

constexpr std::uint32_t kLoaded = 7;

// A mission that was loaded before may still be told of, or be the one that the drone keeps.
const Told kTold[] = {
    {"ready", blueye::protocol::MISSION_STATE_READY, kLoaded, true, true},
    {"ready_for_an_unknown_one", blueye::protocol::MISSION_STATE_READY, 0, true, true},
    {"ready_for_another", blueye::protocol::MISSION_STATE_READY, 6, false, false},
    {"failed", blueye::protocol::MISSION_STATE_FAILED_TO_LOAD_MISSION, 0, true, false},
    {"failed_with_the_id", blueye::protocol::MISSION_STATE_FAILED_TO_LOAD_MISSION, kLoaded, true,
     false},
    {"failed_with_the_id_before", blueye::protocol::MISSION_STATE_FAILED_TO_LOAD_MISSION, 6, true,
     false},
    {"inactive", blueye::protocol::MISSION_STATE_INACTIVE, 0, false, false},
    {"running", blueye::protocol::MISSION_STATE_RUNNING, kLoaded, false, false}};

class AMissionStatus : public testing::TestWithParam<Told> {};

std::string bytesOf(const Told& row) {
  blueye::protocol::MissionStatusTel told;
  told.mutable_mission_status()->set_state(row.state);
  told.mutable_mission_status()->set_id(row.id);
  return told.SerializeAsString();
}

TEST_P(AMissionStatus, DecidesOnTheMissionThatWasLoaded) {
  MissionVerdict verdict(kLoaded);
  EXPECT_EQ(verdict.shownBy(bytesOf(GetParam())), GetParam().decides);
  EXPECT_EQ(verdict.ready(), GetParam().ready);
}

INSTANTIATE_TEST_SUITE_P(Table, AMissionStatus, testing::ValuesIn(kTold),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(MissionVerdict, TellsWhichMissionTheDroneKeeps) {
  MissionVerdict verdict(kLoaded);
  EXPECT_FALSE(verdict.shownBy(bytesOf(kTold[2])));
  EXPECT_THAT(verdict.message("too late"), HasSubstr("ready for mission 6, not for mission 7"));
  EXPECT_TRUE(verdict.shownBy(bytesOf(kTold[0])));
  EXPECT_EQ(verdict.message(""), "the mission is ready");
}

TEST(MissionVerdict, GivesTheReasonThatThereIsNone) {
  MissionVerdict verdict(kLoaded);
  EXPECT_FALSE(verdict.shownBy("\xff"));
  EXPECT_EQ(verdict.message("too late"), "too late");
  EXPECT_TRUE(verdict.shownBy(bytesOf(kTold[3])));
  EXPECT_EQ(verdict.message(""), "the drone cannot load it");
}

std::string instructions(int count) {
  std::string json = R"({"instructions": [)";
  for (int i = 0; i < count; ++i) json += std::string{i == 0 ? "" : ", "} + "{\"id\": 1}";
  return json + "]}";
}

TEST(MissionJson, HasOneToFiftyInstructions) {
  EXPECT_EQ(read(instructions(1)).index(), 0u);
  EXPECT_EQ(read(instructions(50)).index(), 0u);
}

struct Refused {
  const char* name;
  std::string json;
  const char* reason;
};

class RefusedMission : public testing::TestWithParam<Refused> {};

TEST_P(RefusedMission, SaysWhy) {
  const auto request = read(GetParam().json);
  ASSERT_TRUE(std::holds_alternative<std::string>(request));
  EXPECT_THAT(std::get<std::string>(request), HasSubstr(GetParam().reason));
}

// The first five are read as a mission with an instruction or two by the reader of messages.
INSTANTIATE_TEST_SUITE_P(
    Table, RefusedMission,
    testing::Values(
        Refused{"an_object_alone", R"({"instructions": {"id": 1}})", "no list of objects"},
        Refused{"a_list_in_the_list", R"({"instructions": [[{"id": 1}]]})", "no list of objects"},
        Refused{"an_empty_list_in_it", R"({"instructions": [[], {"id": 1}]})",
                "no list of objects"},
        Refused{"null_in_the_list",
                R"({"instructions": [null, {"id": 1, "auto_continue": false}]})",
                "no list of objects"},
        Refused{"two_lists", R"({"instructions": [{"id": 1}, {"id": 2}], "instructions": [{}]})",
                "a name twice"},
        Refused{"no_json", "instructions", "the JSON is not a Mission"},
        Refused{"no_object", "[]", "the JSON is not a Mission"},
        Refused{"another_field", R"({"waypoints": []})", "waypoints"},
        Refused{"nothing", "", "instructions are 0; 1 to 50"},
        Refused{"no_instruction", R"({"instructions": []})", "instructions are 0; 1 to 50"},
        Refused{"too_many", instructions(51), "instructions are 51; 1 to 50"},
        Refused{"not_a_number",
                R"({"instructions": [{"wait_for_command": {"wait_for_seconds": "NaN"}}]})",
                "wait_for_seconds is nan"}),
    [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
