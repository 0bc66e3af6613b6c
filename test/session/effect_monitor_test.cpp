#include "frontseat_driver/session/effect_monitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using vehicle::BehaviorCommand;
using H = BehaviorCommand::Horizontal;
using V = BehaviorCommand::Vertical;
using S = BehaviorCommand::Speed;

constexpr vehicle::SteadyTime kStart{100s};
constexpr auto kTimeout = 10s;

struct State {
  std::optional<double> heading_deg;
  std::optional<double> depth_m;
  std::optional<double> speed_m_s;
};

PresentState present(const State& state) {
  PresentState out;
  out.heading_deg = state.heading_deg;
  out.depth_m = state.depth_m;
  out.speed_m_s = state.speed_m_s;
  return out;
}

BehaviorCommand behavior(std::optional<BehaviorCommand::Aspect<H>> horizontal,
                         std::optional<BehaviorCommand::Aspect<V>> vertical = {},
                         std::optional<BehaviorCommand::Aspect<S>> speed = {}) {
  BehaviorCommand out;
  out.horizontal = horizontal;
  out.vertical = vertical;
  out.speed = speed;
  return out;
}

/// A vehicle that stays as it is for the whole time-out.
struct Still {
  const char* name;
  vehicle::Command command;
  State state;
  bool complained;
};

const Still kStill[] = {
    {"heading_reached", behavior({{H::Heading, 90.0}}), {105.0, {}, {}}, false},
    {"heading_not_reached", behavior({{H::Heading, 90.0}}), {106.0, {}, {}}, true},
    {"heading_not_reached_port", behavior({{H::Heading, 90.0}}), {74.0, {}, {}}, true},
    {"heading_over_north", behavior({{H::Heading, 355.0}}), {9.0, {}, {}}, false},
    {"heading_too_far_over_north", behavior({{H::Heading, 355.0}}), {11.0, {}, {}}, true},
    {"heading_unknown", behavior({{H::Heading, 90.0}}), {}, false},
    {"rudder", behavior({{H::Rudder, 20.0}}), {270.0, 5.0, 1.0}, false},
    {"depth_reached", behavior({}, {{V::Depth, 5.0}}), {{}, 4.0, {}}, false},
    {"depth_not_reached", behavior({}, {{V::Depth, 5.0}}), {{}, 3.9375, {}}, true},
    {"too_deep", behavior({}, {{V::Depth, 5.0}}), {{}, 6.0625, {}}, true},
    {"depth_of_both_groups",
     behavior({{H::Heading, 90.0}}, {{V::Depth, 5.0}}),
     {90.0, 0.0, {}},
     true},
    {"altitude", behavior({}, {{V::Altitude, 5.0}}), {{}, 50.0, {}}, false},
    {"speed_reached", behavior({}, {}, {{S::MetresPerSecond, 1.25}}), {{}, {}, 0.96875}, false},
    {"speed_not_reached", behavior({}, {}, {{S::MetresPerSecond, 1.25}}), {{}, {}, 0.9375}, true},
    {"rpm", behavior({}, {}, {{S::Rpm, 600.0}}), {{}, {}, 0.0}, false},
    {"course_of_a_boat_that_stays", vehicle::CourseCommand{90.0, 0.1}, {270.0, {}, 0.0}, false},
    {"course_not_turned_to", vehicle::CourseCommand{90.0, 0.105}, {270.0, {}, 0.1}, true},
    {"course_at_a_crawl", vehicle::CourseCommand{90.0, 0.3}, {90.0, {}, 0.0}, false},
    {"course_without_speed_known", vehicle::CourseCommand{90.0, 0.3}, {90.0, {}, {}}, false},
    {"course_that_must_move", vehicle::CourseCommand{90.0, 0.325}, {90.0, {}, {}}, true},
    {"drive_moves", vehicle::DriveCommand{0.5, 0.5}, {{}, {}, 0.1}, false},
    {"drive_hardly_moves", vehicle::DriveCommand{0.5, 0.5}, {{}, {}, 0.095}, true},
    {"drive_stands_without_velocity", vehicle::DriveCommand{0.5, 0.5}, {}, true},
    {"drive_astern_stands", vehicle::DriveCommand{-0.5, -0.5}, {}, true},
    {"drive_turns_on_the_spot", vehicle::DriveCommand{0.5, -0.5}, {}, false},
    {"drive_with_port_alone", vehicle::DriveCommand{0.41, 0.0}, {}, true},
    {"drive_with_starboard_alone", vehicle::DriveCommand{0.0, 0.41}, {}, true},
    {"drive_with_too_little", vehicle::DriveCommand{0.2, 0.2}, {}, false},
    {"drive_with_enough", vehicle::DriveCommand{0.21, 0.21}, {}, true},
    {"helm_with_too_little", vehicle::HelmCommand{0.2, 1.0}, {}, false},
    {"helm_with_enough", vehicle::HelmCommand{0.21, 0.0}, {}, true},
    {"helm_astern", vehicle::HelmCommand{-0.21, 0.0}, {}, true},
};

class StillVehicle : public testing::TestWithParam<Still> {};

TEST_P(StillVehicle, IsToldAfterTheTimeout) {
  EffectMonitor effect{kTimeout};
  const PresentState state = present(GetParam().state);
  effect.commanded(GetParam().command, state, kStart);
  effect.measured(state, kStart + kTimeout - 1ms);
  EXPECT_EQ(effect.complaint(), "");
  effect.measured(state, kStart + kTimeout);
  EXPECT_EQ(!effect.complaint().empty(), GetParam().complained) << effect.complaint();
}

INSTANTIATE_TEST_SUITE_P(Table, StillVehicle, testing::ValuesIn(kStill),
                         [](const auto& row) { return std::string{row.param.name}; });

/// A vehicle that comes nearer by a bit, halfway through the time-out.
struct Moving {
  const char* name;
  vehicle::Command command;
  State before;
  State after;
  bool answers;
};

const Moving kMoving[] = {
    {"turns_enough", behavior({{H::Heading, 0.0}}), {90.0, {}, {}}, {85.0, {}, {}}, true},
    {"turns_too_little", behavior({{H::Heading, 0.0}}), {90.0, {}, {}}, {85.25, {}, {}}, false},
    {"turns_away", behavior({{H::Heading, 0.0}}), {90.0, {}, {}}, {100.0, {}, {}}, false},
    {"dives_enough", behavior({}, {{V::Depth, 9.0}}), {{}, 2.0, {}}, {{}, 2.5, {}}, true},
    {"dives_too_little", behavior({}, {{V::Depth, 9.0}}), {{}, 2.0, {}}, {{}, 2.46875, {}}, false},
    {"rises", behavior({}, {{V::Depth, 9.0}}), {{}, 2.0, {}}, {{}, 1.0, {}}, false},
    {"is_faster",
     behavior({}, {}, {{S::MetresPerSecond, 2.0}}),
     {{}, {}, 1.0},
     {{}, {}, 1.15625},
     true},
    {"is_hardly_faster",
     behavior({}, {}, {{S::MetresPerSecond, 2.0}}),
     {{}, {}, 1.0},
     {{}, {}, 1.140625},
     false},
};

class MovingVehicle : public testing::TestWithParam<Moving> {};

TEST_P(MovingVehicle, HasTheTimeoutAgainIfItComesNearer) {
  EffectMonitor effect{kTimeout};
  effect.commanded(GetParam().command, present(GetParam().before), kStart);
  effect.measured(present(GetParam().after), kStart + 5s);
  effect.measured(present(GetParam().after), kStart + kTimeout);
  EXPECT_EQ(effect.complaint().empty(), GetParam().answers) << effect.complaint();
  effect.measured(present(GetParam().after), kStart + 5s + kTimeout);
  EXPECT_NE(effect.complaint(), "");
}

INSTANTIATE_TEST_SUITE_P(Table, MovingVehicle, testing::ValuesIn(kMoving),
                         [](const auto& row) { return std::string{row.param.name}; });

/// Another command while the vehicle stays as it is: what counts as another target begins with the
/// distance to it, so that the vehicle that has not moved is not taken for one that came nearer.
struct Retarget {
  const char* name;
  vehicle::Command first;
  vehicle::Command second;
  State state;
  bool answers;  ///< the same target, which the change has brought nearer
};

const Retarget kRetargets[] = {
    {"heading_is_another",
     behavior({{H::Heading, 90.0}}),
     behavior({{H::Heading, 84.0}}),
     {0.0, {}, {}},
     false},
    {"heading_comes_another_way",
     behavior({{H::Heading, 90.0}}),
     behavior({}, {{V::Depth, 5.0}}),
     {0.0, 0.0, {}},
     false},
    {"depth_is_another",
     behavior({}, {{V::Depth, 9.0}}),
     behavior({}, {{V::Depth, 8.375}}),
     {{}, 0.0, {}},
     false},
    {"speed_is_another",
     behavior({}, {}, {{S::MetresPerSecond, 2.0}}),
     behavior({}, {}, {{S::MetresPerSecond, 1.828125}}),
     {{}, {}, 1.0},
     false},
};

class RetargetedVehicle : public testing::TestWithParam<Retarget> {};

TEST_P(RetargetedVehicle, IsNotTakenForOneThatAnswers) {
  EffectMonitor effect{kTimeout};
  const PresentState state = present(GetParam().state);
  effect.commanded(GetParam().first, state, kStart);
  effect.commanded(GetParam().second, state, kStart + 5s);
  effect.measured(state, kStart + 5s);
  effect.measured(state, kStart + kTimeout);
  EXPECT_EQ(effect.complaint().empty(), GetParam().answers) << effect.complaint();
}

INSTANTIATE_TEST_SUITE_P(Table, RetargetedVehicle, testing::ValuesIn(kRetargets),
                         [](const auto& row) { return std::string{row.param.name}; });

// A command that is repeated with little changes is measured from where the first one found the
// vehicle, or one that turns a degree at a time would never have turned five.
TEST(EffectMonitor, ATargetThatCreepsKeepsItsBeginning) {
  const vehicle::Command kCommands[][2] = {
      {behavior({{H::Heading, 0.0}}), behavior({{H::Heading, 356.0}})},
      {behavior({}, {{V::Depth, 9.0}}), behavior({}, {{V::Depth, 9.5}})},
      {behavior({}, {}, {{S::MetresPerSecond, 2.0}}),
       behavior({}, {}, {{S::MetresPerSecond, 2.125}})},
  };
  const State kStates[][3] = {
      {{90.0, {}, {}}, {80.0, {}, {}}, {80.0, {}, {}}},
      {{{}, 2.0, {}}, {{}, 3.5, {}}, {{}, 3.5, {}}},
      {{{}, {}, 1.0}, {{}, {}, 1.5}, {{}, {}, 1.5}},
  };
  for (int i = 0; i < 3; ++i) {
    EffectMonitor effect{kTimeout};
    effect.commanded(kCommands[i][0], present(kStates[i][0]), kStart);
    effect.commanded(kCommands[i][1], present(kStates[i][1]), kStart + 5s);
    effect.measured(present(kStates[i][2]), kStart + 6s);
    effect.measured(present(kStates[i][2]), kStart + kTimeout);
    EXPECT_EQ(effect.complaint(), "") << i;
  }
}

TEST(EffectMonitor, SaysWhatIsWrong) {
  EffectMonitor effect{kTimeout};
  const PresentState state = present({270.0, 2.0, 0.5});
  effect.commanded(behavior({{H::Heading, 90.0}}, {{V::Depth, 5.0}}, {{S::MetresPerSecond, 1.5}}),
                   state, kStart);
  effect.measured(state, kStart + 12s);
  EXPECT_EQ(effect.complaint(),
            "heading 90.0 deg commanded, 270.0 deg measured; depth 5.0 m commanded, 2.0 m "
            "measured; speed 1.5 m/s commanded, 0.5 m/s measured; no answer for 12 s");
  effect.measured(present({90.0, 5.0, 1.5}), kStart + 13s);
  EXPECT_EQ(effect.complaint(), "");
}

}  // namespace
}  // namespace frontseat_driver::session
