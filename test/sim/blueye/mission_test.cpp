// Missions in virtual time: states, what each instruction does, and what is said about it.
#include "mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deck.h"
#include "frontseat_driver/sim/geography.h"

namespace frontseat_driver::sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;

/// Instructions one after another, numbered from 0.
class Plan {
 public:
  bp::Instruction& add() {
    bp::Instruction& instruction = *request.mutable_mission()->add_instructions();
    instruction.set_id(static_cast<std::uint32_t>(request.mission().instructions_size() - 1));
    instruction.set_auto_continue(true);
    return instruction;
  }
  void depth(float depth_m, bp::DepthZeroReference zero = bp::DEPTH_ZERO_REFERENCE_SURFACE) {
    auto& set_point = *add().mutable_depth_set_point_command()->mutable_depth_set_point();
    set_point.set_depth(depth_m);
    set_point.set_depth_zero_reference(zero);
  }
  /// Metres from where the drone starts.
  bp::Waypoint& waypoint(double east_m, double north_m) {
    const nmea::LatLon at = fromPlane(quietDrone().environment.datum, {east_m, north_m});
    auto& point = *add().mutable_waypoint_command()->mutable_waypoint();
    point.mutable_global_position()->set_latitude(at.latitude_deg);
    point.mutable_global_position()->set_longitude(at.longitude_deg);
    return point;
  }
  void camera(bp::CameraAction action, float parameter = 0.0F) {
    auto& command = *add().mutable_camera_command();
    command.set_camera_action(action);
    command.set_action_param(parameter);
  }
  void wait(float s) { add().mutable_wait_for_command()->set_wait_for_seconds(s); }

  bp::SetMissionReq request;
};

bp::MissionStatus status(Deck& deck) {
  bp::GetTelemetryReq request;
  request.set_message_type("MissionStatusTel");
  bp::MissionStatusTel message;
  message.ParseFromString(deck.ask<bp::GetTelemetryRep>(request)->payload().value());
  return message.mission_status();
}

void load(Deck& deck, const Plan& plan) { deck.ask<bp::SetMissionRep>(plan.request); }

bool runUntilOver(Deck& deck, double limit_s) {
  return deck.runUntil([&] { return status(deck).state() != bp::MISSION_STATE_RUNNING; }, limit_s);
}

TEST(Mission, GoesThroughItsStates) {
  Deck deck;
  deck.connect();
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_INACTIVE);
  Plan plan;
  plan.depth(3.0F);
  plan.wait(2.0F);
  load(deck, plan);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_READY);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(2.0);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_RUNNING);
  EXPECT_TRUE(deck.latest<bp::ControlModeTel>().state().auto_pilot_heave());
  deck.tell(bp::PauseMissionCtrl{});
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_PAUSED);
  const double depth = deck.state().depth_m;
  deck.run(10.0);
  EXPECT_NEAR(deck.state().depth_m, depth, 0.3);
  deck.tell(bp::RunMissionCtrl{});
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_RUNNING);
  ASSERT_TRUE(runUntilOver(deck, 60.0));
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
  EXPECT_NEAR(deck.state().depth_m, 3.0, 0.3);
  EXPECT_THAT(status(deck).completed_instruction_ids(), ElementsAre(0, 1));
  deck.tell(bp::ClearMissionCtrl{});
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_INACTIVE);
  deck.run(0.1);
  EXPECT_THAT(
      deck.notifications(),
      ElementsAre(bp::NOTIFICATION_TYPE_MISSION_LOADED, bp::NOTIFICATION_TYPE_MISSION_STARTED,
                  bp::NOTIFICATION_TYPE_GO_TO_DEPTH_SET_POINT, bp::NOTIFICATION_TYPE_MISSION_PAUSED,
                  bp::NOTIFICATION_TYPE_MISSION_RESUMED, bp::NOTIFICATION_TYPE_DEPTH_TARGET_REACHED,
                  bp::NOTIFICATION_TYPE_INSTRUCTION_COMPLETE, bp::NOTIFICATION_TYPE_WAIT_FOR,
                  bp::NOTIFICATION_TYPE_INSTRUCTION_COMPLETE,
                  bp::NOTIFICATION_TYPE_MISSION_COMPLETE));
}

TEST(Mission, NotificationsHaveTimesOfTheirOwnAndTheirLevel) {
  Deck deck;
  deck.connect();
  deck.tell(bp::RunMissionCtrl{});  // there is none
  Plan plan;
  plan.wait(0.0F);
  load(deck, plan);
  deck.run(0.1);
  const auto& all = deck.published["blueye.protocol.NotificationTel"];
  ASSERT_EQ(all.size(), 2U);
  bp::NotificationTel none, loaded;
  none.ParseFromString(all[0]);
  loaded.ParseFromString(all[1]);
  EXPECT_EQ(none.notification().type(), bp::NOTIFICATION_TYPE_NO_MISSION_LOADED);
  EXPECT_EQ(none.notification().level(), bp::NOTIFICATION_LEVEL_WARNING);
  EXPECT_EQ(loaded.notification().level(), bp::NOTIFICATION_LEVEL_INFO);
  // Apart by what the least exact of clients tells apart, a microsecond.
  EXPECT_EQ(none.notification().timestamp().nanos() / 1000 + 1,
            loaded.notification().timestamp().nanos() / 1000);
  EXPECT_EQ(none.notification().timestamp().seconds(), 1772366400);
}

TEST(Mission, VisitsWaypointsAtTheirDepthInACurrent) {
  BlueyeConfig config = quietDrone();
  config.environment.current_drift_m_s = 0.2;
  config.environment.current_set_deg = 45.0;
  Deck deck{config};
  deck.connect();
  deck.run(0.1);
  Plan plan;
  const double corners[4][2] = {{10, 0}, {10, 10}, {0, 10}, {0, 0}};
  for (const auto& corner : corners) {
    auto& point = plan.waypoint(corner[0], corner[1]);
    point.set_id(static_cast<std::uint32_t>(plan.request.mission().instructions_size()) + 100);
    point.mutable_depth_set_point()->set_depth(4.0F);
    point.mutable_depth_set_point()->set_depth_zero_reference(bp::DEPTH_ZERO_REFERENCE_SURFACE);
  }
  load(deck, plan);
  const auto loaded = deck.ask<bp::GetMissionRep>(bp::GetMissionReq{})->mission();
  ASSERT_EQ(loaded.path_segments_size(), 4);
  EXPECT_NEAR(loaded.path_segments(1).horizontal_length(), 10.0, 0.05);
  EXPECT_NEAR(loaded.path_segments(1).course_to_target(), 0.0, 0.01);  // north
  EXPECT_EQ(loaded.path_segments(1).from_wp_id(), 101U);
  EXPECT_NEAR(loaded.total_distance(), 40.0, 1.0);
  EXPECT_EQ(status(deck).total_number_of_path_segments(), 4U);
  deck.tell(bp::RunMissionCtrl{});
  double nearest[4] = {99, 99, 99, 99};
  ASSERT_TRUE(deck.runUntil(
      [&] {
        for (int i = 0; i < 4; ++i) {
          nearest[i] = std::min(nearest[i], std::hypot(deck.state().east_m - corners[i][0],
                                                       deck.state().north_m - corners[i][1]));
        }
        return status(deck).state() == bp::MISSION_STATE_COMPLETED;
      },
      300.0));
  for (const double distance : nearest) EXPECT_LT(distance, 1.05);
  EXPECT_NEAR(deck.state().depth_m, 4.0, 0.25);
  EXPECT_THAT(status(deck).completed_path_segment_ids(), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(deck.notifications(),
              IsSupersetOf({int{bp::NOTIFICATION_TYPE_GO_TO_WAYPOINT_WITH_DEPTH_SET_POINT},
                            int{bp::NOTIFICATION_TYPE_WAYPOINT_REACHED}}));
}

TEST(Mission, TellsWhereItIsGoing) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  auto& point = plan.waypoint(0.0, -20.0);
  point.set_speed_to_target(0.5F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
  const auto reference = deck.latest<bp::ReferenceAutoPilotTel>().reference_auto_pilot();
  EXPECT_EQ(reference.instruction_type(), bp::INSTRUCTION_TYPE_GO_TO_WAYPOINT);
  EXPECT_NEAR(std::abs(reference.course_to_target()), 3.14159, 0.02);  // south
  EXPECT_NEAR(reference.horizontal_distance_to_target(), 20.0, 0.3);
  EXPECT_FLOAT_EQ(reference.speed_over_ground(), 0.5F);
  EXPECT_NEAR(status(deck).distance_to_complete(), 20.0, 1.0);
  deck.run(20.0);
  EXPECT_NEAR(deck.state().surge_m_s, 0.5, 0.03);
}

TEST(Mission, GoesDownToTheBottomAndUpAgain) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.add().mutable_go_to_seabed_command()->set_desired_speed(0.4F);
  plan.camera(bp::CAMERA_ACTION_TAKE_PHOTO);
  plan.depth(2.0F, bp::DEPTH_ZERO_REFERENCE_SEABED);
  plan.add().mutable_go_to_surface_command()->set_desired_speed(0.4F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  double lowest = 99.0;
  ASSERT_TRUE(deck.runUntil(
      [&] {
        lowest = std::min(lowest, deck.state().altitude_m);
        return status(deck).state() == bp::MISSION_STATE_COMPLETED;
      },
      300.0));
  EXPECT_NEAR(lowest, 0.6, 0.25);
  EXPECT_LT(deck.state().depth_m, 0.25);
  EXPECT_EQ(deck.drone.pictures(), 1U);
  EXPECT_THAT(
      deck.notifications(),
      IsSupersetOf(
          {int{bp::NOTIFICATION_TYPE_GO_TO_SEABED}, int{bp::NOTIFICATION_TYPE_CAMERA_ACTION},
           int{bp::NOTIFICATION_TYPE_ALTITUDE_TARGET_REACHED},
           int{bp::NOTIFICATION_TYPE_GO_TO_SURFACE}, int{bp::NOTIFICATION_TYPE_MISSION_COMPLETE}}));
}

TEST(Mission, TakesPhotographsByTimeAndByDistance) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.camera(bp::CAMERA_ACTION_TAKE_PHOTOS_TIME, 2.0F);
  plan.wait(10.5F);
  plan.camera(bp::CAMERA_ACTION_STOP_TAKING_PHOTOS);
  plan.camera(bp::CAMERA_ACTION_TAKE_PHOTOS_DISTANCE, 5.0F);
  plan.waypoint(0.0, 21.0);
  plan.camera(bp::CAMERA_ACTION_STOP_TAKING_PHOTOS);
  plan.camera(bp::CAMERA_ACTION_START_RECORDING);
  plan.wait(3.0F);
  plan.camera(bp::CAMERA_ACTION_STOP_RECORDING);
  load(deck, plan);
  EXPECT_EQ(deck.latest<bp::RecordStateTel>().record_state().main_seconds(), -1);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(9.0);
  EXPECT_EQ(deck.latest<bp::TimeLapseStateTel>().time_lapse_state().photos_taken(), 4);
  EXPECT_EQ(deck.latest<bp::TimeLapseStateTel>().time_lapse_state().interval_type(),
            bp::INTERVAL_TYPE_TIME);
  ASSERT_TRUE(runUntilOver(deck, 120.0));
  EXPECT_EQ(deck.drone.pictures(), 5U + 4U);
  std::int32_t longest = -1;
  for (const std::string& data : deck.published["blueye.protocol.RecordStateTel"]) {
    bp::RecordStateTel told;
    ASSERT_TRUE(told.ParseFromString(data));
    EXPECT_EQ(told.record_state().main_is_recording(), told.record_state().main_seconds() >= 0);
    longest = std::max(longest, told.record_state().main_seconds());
  }
  EXPECT_NEAR(longest, 3.0, 1.0);
  EXPECT_FALSE(deck.latest<bp::RecordStateTel>().record_state().main_is_recording());
}

TEST(Mission, TiltsSetsModesAndComesHome) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.add().mutable_tilt_main_camera_command()->mutable_tilt_angle()->set_value(-20.0F);
  plan.add().mutable_tilt_multibeam_command()->mutable_multibeam_servo()->set_angle(15.0F);
  plan.waypoint(8.0, 0.0);
  plan.add().mutable_go_to_home_command()->set_desired_speed(0.8F);
  auto& modes = *plan.add().mutable_control_mode_command();
  modes.set_control_mode_vertical(bp::CONTROL_MODE_VERTICAL_AUTO_DEPTH);
  modes.set_control_mode_horizontal(bp::CONTROL_MODE_HORIZONTAL_STATION_KEEPING);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  ASSERT_TRUE(runUntilOver(deck, 120.0));
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
  deck.run(1.0);
  EXPECT_NEAR(deck.latest<bp::TiltAngleTel>().angle().value(), -20.0, 1e-3);
  EXPECT_NEAR(deck.latest<bp::MultibeamServoTel>().servo().angle(), 15.0, 1e-3);
  EXPECT_LT(std::hypot(deck.state().east_m, deck.state().north_m), 1.1);
  const auto after = deck.latest<bp::ControlModeTel>().state();
  EXPECT_TRUE(after.auto_depth());
  EXPECT_TRUE(after.station_keeping());
  EXPECT_FALSE(after.auto_pilot_surge_yaw());
}

TEST(Mission, SurveysAnAreaInLines) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  auto& survey = *plan.add().mutable_survey_command();
  for (const auto& corner : {std::pair<double, double>{0, 0}, {12, 0}, {12, 15}, {0, 15}}) {
    const nmea::LatLon at =
        fromPlane(quietDrone().environment.datum, {corner.first, corner.second});
    auto* vertex = survey.add_vertices();
    vertex->set_latitude(at.latitude_deg);
    vertex->set_longitude(at.longitude_deg);
  }
  survey.set_lane_spacing(6.0F);
  survey.set_cruise_speed(0.8F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  double nearest_last = 99.0;
  ASSERT_TRUE(deck.runUntil(
      [&] {
        nearest_last =
            std::min(nearest_last, std::hypot(deck.state().east_m - 9.0, deck.state().north_m));
        return status(deck).state() == bp::MISSION_STATE_COMPLETED;
      },
      300.0));
  EXPECT_LT(nearest_last, 1.1);
}

struct Bad {
  const char* name;
  void (*spoil)(Plan&);
  int reason;  ///< a notification, besides that it failed
};
class Refused : public testing::TestWithParam<Bad> {};

TEST_P(Refused, FailsToLoad) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  GetParam().spoil(plan);
  load(deck, plan);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_FAILED_TO_LOAD_MISSION);
  deck.run(0.1);
  EXPECT_THAT(deck.notifications(), Contains(GetParam().reason));
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION));
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_FAILED_TO_LOAD_MISSION);
  deck.tell(bp::ClearMissionCtrl{});
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_INACTIVE);
}

constexpr int kFailed = bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION;

INSTANTIATE_TEST_SUITE_P(
    Table, Refused,
    testing::Values(Bad{"empty", [](Plan&) {}, kFailed},
                    Bad{"fifty_one",
                        [](Plan& plan) {
                          for (int i = 0; i < 51; ++i) plan.wait(1.0F);
                        },
                        kFailed},
                    Bad{"same_id",
                        [](Plan& plan) {
                          plan.wait(1.0F);
                          plan.add().set_id(0);
                        },
                        kFailed},
                    Bad{"not_on_earth",
                        [](Plan& plan) {
                          plan.waypoint(0, 0).mutable_global_position()->set_latitude(91.0);
                        },
                        kFailed},
                    Bad{"too_far", [](Plan& plan) { plan.waypoint(0, 2500); },
                        bp::NOTIFICATION_TYPE_WAYPOINT_IS_TOO_FAR_AWAY},
                    Bad{"too_deep", [](Plan& plan) { plan.depth(400.0F); },
                        bp::NOTIFICATION_TYPE_DEPTH_SET_POINT_IS_TOO_FAR_AWAY},
                    Bad{"survey_line_not_on_earth",
                        [](Plan& plan) {
                          auto& survey = *plan.add().mutable_survey_command();
                          survey.add_waypoints()->mutable_global_position()->set_longitude(181.0);
                        },
                        kFailed},
                    Bad{"survey_corner_not_on_earth",
                        [](Plan& plan) {
                          plan.add().mutable_survey_command()->add_vertices()->set_latitude(1e300);
                        },
                        kFailed},
                    Bad{"too_long", [](Plan& plan) { plan.wait(20000.0F); },
                        bp::NOTIFICATION_TYPE_TIME_TO_COMPLETE_IS_TOO_LONG},
                    Bad{"far_too_long", [](Plan& plan) { plan.wait(1e38F); },
                        bp::NOTIFICATION_TYPE_TIME_TO_COMPLETE_IS_TOO_LONG}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(Mission, NeedsAPositionForWaypoints) {
  BlueyeConfig config = quietDrone();
  config.devices = {BlueyeDevice::Dvl};
  Deck deck{config};
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.waypoint(5.0, 0.0);
  load(deck, plan);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_FAILED_TO_LOAD_MISSION);
  deck.run(0.1);
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_DRONE_POSITION_IS_UNKNOWN));
}

TEST(Mission, DoesNotStartWhereThePositionIsLost) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.waypoint(5.0, 0.0);
  load(deck, plan);
  deck.tell(bp::DeactivateGuestPortsCtrl{});
  deck.run(0.1);
  deck.tell(bp::RunMissionCtrl{});
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_FAILED_TO_START_MISSION);
}

TEST(Mission, SkipsWhatTheDroneCannotDo) {
  BlueyeConfig config = quietDrone();
  config.devices = {};
  Deck deck{config};
  deck.connect();
  Plan plan;
  plan.add().mutable_tilt_multibeam_command()->mutable_multibeam_servo()->set_angle(10.0F);
  plan.add().mutable_go_to_seabed_command();
  plan.add();  // a command of a later protocol
  plan.wait(1.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  ASSERT_TRUE(runUntilOver(deck, 20.0));
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
  EXPECT_THAT(status(deck).completed_instruction_ids(), ElementsAre(3));
  const auto all = deck.notifications();
  EXPECT_EQ(std::count(all.begin(), all.end(), int{bp::NOTIFICATION_TYPE_INSTRUCTION_SKIPPED}), 3);
}

struct Impossible {
  const char* name;
  void (*add)(Plan&);
};
class Skipped : public testing::TestWithParam<Impossible> {};

TEST_P(Skipped, IsSaidAndTheMissionGoesOn) {
  BlueyeConfig config = quietDrone();
  config.devices = {};  // neither a DVL nor a servo
  Deck deck{config};
  deck.connect();
  Plan plan;
  GetParam().add(plan);
  plan.wait(1.0F);
  load(deck, plan);
  ASSERT_EQ(status(deck).state(), bp::MISSION_STATE_READY);
  deck.tell(bp::RunMissionCtrl{});
  ASSERT_TRUE(runUntilOver(deck, 20.0));
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
  EXPECT_THAT(status(deck).completed_instruction_ids(), ElementsAre(1));
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_INSTRUCTION_SKIPPED));
  EXPECT_EQ(deck.drone.pictures(), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Skipped,
    testing::Values(
        Impossible{"height_above_an_unknown_bottom",
                   [](Plan& plan) { plan.depth(2.0F, bp::DEPTH_ZERO_REFERENCE_SEABED); }},
        Impossible{"home_without_a_position",
                   [](Plan& plan) { plan.add().mutable_go_to_home_command(); }},
        Impossible{"altitude_mode_above_an_unknown_bottom",
                   [](Plan& plan) {
                     plan.add().mutable_control_mode_command()->set_control_mode_vertical(
                         bp::CONTROL_MODE_VERTICAL_AUTO_ALTITUDE);
                   }},
        Impossible{"pictures_without_an_interval",
                   [](Plan& plan) { plan.camera(bp::CAMERA_ACTION_TAKE_PHOTOS_TIME); }},
        Impossible{"pictures_without_a_distance",
                   [](Plan& plan) { plan.camera(bp::CAMERA_ACTION_TAKE_PHOTOS_DISTANCE, -1.0F); }},
        Impossible{"no_camera_action",
                   [](Plan& plan) { plan.camera(bp::CAMERA_ACTION_UNSPECIFIED); }}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(Mission, SkipsASurveyWithoutLinesAndWithoutAnArea) {
  Deck deck;
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.add().mutable_survey_command()->set_lane_spacing(5.0F);
  plan.wait(1.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  ASSERT_TRUE(runUntilOver(deck, 20.0));
  EXPECT_THAT(status(deck).completed_instruction_ids(), ElementsAre(1));
}

TEST(Mission, PausesAfterAnInstructionWhereToldToObeyAutoContinue) {
  for (const bool obey : {false, true}) {
    BlueyeConfig config = quietDrone();
    config.conventions.pause_instructions = obey;
    Deck deck{config};
    deck.connect();
    Plan plan;
    plan.wait(1.0F);
    plan.wait(1.0F);
    plan.request.mutable_mission()->mutable_instructions(0)->set_auto_continue(false);
    load(deck, plan);
    deck.tell(bp::RunMissionCtrl{});
    deck.run(4.0);
    EXPECT_EQ(status(deck).state(), obey ? bp::MISSION_STATE_PAUSED : bp::MISSION_STATE_COMPLETED);
    deck.tell(bp::RunMissionCtrl{});
    deck.run(2.0);
    EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
  }
}

TEST(Mission, IsAbortedWhenTheClientInControlIsLost) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.depth(10.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(2.0);
  deck.pets = 0;
  deck.run(4.0);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_ABORTED);
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_MISSION_ABORTED));
  EXPECT_EQ(deck.drone.model().commanded().heave, 0.0);
  EXPECT_FALSE(deck.latest<bp::ControlModeTel>().state().auto_pilot_heave());
}

TEST(Mission, IsAbortedInItsPauseWhenTheClientInControlIsLost) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.depth(10.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(2.0);
  deck.tell(bp::PauseMissionCtrl{});
  deck.run(1.0);
  ASSERT_EQ(status(deck).state(), bp::MISSION_STATE_PAUSED);
  deck.pets = 0;
  deck.run(4.0);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_ABORTED);
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_MISSION_ABORTED));
}

TEST(Mission, IsAbortedWhenItDoesNotGetOn) {
  BlueyeConfig config = quietDrone();
  config.environment.current_drift_m_s = 1.9;  // more than it can swim against
  Deck deck{config};
  deck.connect();
  deck.run(0.1);
  Plan plan;
  plan.waypoint(0.0, -30.0);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  ASSERT_TRUE(runUntilOver(deck, 200.0));
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_ABORTED);
  EXPECT_THAT(deck.notifications(), Contains(bp::NOTIFICATION_TYPE_DRONE_IS_STUCK));
}

TEST(Mission, GivesWayToTheOperator) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.depth(10.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
  bp::AutoPilotHeaveCtrl off;
  off.mutable_state()->set_enabled(false);
  deck.tell(off);
  deck.run(0.1);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_PAUSED);
}

TEST(Mission, IsNotReplacedWhileItRuns) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.wait(5.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
  load(deck, plan);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_RUNNING);
}

TEST(Mission, TakesANewInstructionForOneThatHasNotBegun) {
  Deck deck;
  deck.connect();
  Plan plan;
  plan.wait(5.0F);
  plan.wait(100.0F);
  load(deck, plan);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
  bp::SetInstructionUpdateReq update;
  update.mutable_instruction()->set_id(1);
  update.mutable_instruction()->mutable_wait_for_command()->set_wait_for_seconds(1.0F);
  ASSERT_TRUE(deck.ask<bp::SetInstructionUpdateRep>(update));
  update.mutable_instruction()->set_id(0);  // it is being done
  deck.ask<bp::SetInstructionUpdateRep>(update);
  update.mutable_instruction()->set_id(9);  // there is none
  deck.ask<bp::SetInstructionUpdateRep>(update);
  EXPECT_EQ(deck.drone.counts().refused, 2U);
  deck.run(6.0);
  EXPECT_EQ(status(deck).state(), bp::MISSION_STATE_COMPLETED);
}

}  // namespace
}  // namespace frontseat_driver::sim
