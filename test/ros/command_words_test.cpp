#include "command_words.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace frontseat_driver::ros_layer {
namespace {

using vehicle::BehaviorCommand;
using H = BehaviorCommand::Horizontal;
using V = BehaviorCommand::Vertical;
using S = BehaviorCommand::Speed;

BehaviorCommand behavior(std::optional<BehaviorCommand::Aspect<H>> horizontal,
                         std::optional<BehaviorCommand::Aspect<V>> vertical,
                         std::optional<BehaviorCommand::Aspect<S>> speed) {
  BehaviorCommand command;
  command.horizontal = horizontal;
  command.vertical = vertical;
  command.speed = speed;
  return command;
}

struct Row {
  const char* name;
  vehicle::Command command;
  const char* words;
};

const Row kRows[] = {
    {"heading_depth_speed",
     behavior({{H::Heading, 90.0}}, {{V::Depth, 5.0}}, {{S::MetresPerSecond, 1.5}}),
     "heading 90.0 deg, depth 5.0 m, speed 1.50 m/s"},
    {"rudder_altitude_rpm",
     behavior({{H::Rudder, -12.5}}, {{V::Altitude, 3.25}}, {{S::Rpm, 600.0}}),
     "rudder -12.5 deg, altitude 3.2 m, 600 rpm"},
    {"pitch_alone", behavior({}, {{V::Pitch, -10.0}}, {}), "pitch -10.0 deg"},
    {"elevator_alone", behavior({}, {{V::Elevator, 4.0}}, {}), "elevator 4.0 deg"},
    {"nothing", behavior({}, {}, {}), "everything as the vehicle has it"},
    {"drive", vehicle::DriveCommand{0.5, -1.0}, "port 50 %, starboard -100 %"},
    {"helm", vehicle::HelmCommand{0.25, -0.5}, "thrust 25 %, turn -0.50 rad/s clockwise"},
    {"course", vehicle::CourseCommand{270.4, 1.25}, "heading 270.4 deg, speed 1.25 m/s"},
};

class CommandWords : public testing::TestWithParam<Row> {};

TEST_P(CommandWords, NameEachFigureWithItsUnit) {
  EXPECT_EQ(toWords(GetParam().command), GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(Table, CommandWords, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::ros_layer
