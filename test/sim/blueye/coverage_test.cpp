// Every message of the protocol is known to the simulated drone: the descriptors tell which.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "deck.h"
#include "reflection.h"

namespace frontseat_driver::sim {
namespace {

using testing::UnorderedElementsAreArray;

TEST(Coverage, TablesHoldWhatTheProtocolHolds) {
  EXPECT_THAT(BlueyeDrone::knownTelemetry(), UnorderedElementsAreArray(messagesEndingIn("Tel")));
  EXPECT_THAT(BlueyeDrone::knownRequests(), UnorderedElementsAreArray(messagesEndingIn("Req")));
  EXPECT_THAT(BlueyeDrone::knownControls(), UnorderedElementsAreArray(messagesEndingIn("Ctrl")));
  EXPECT_GE(BlueyeDrone::knownTelemetry().size(), 62U);
  EXPECT_GE(BlueyeDrone::knownRequests().size(), 20U);
  EXPECT_GE(BlueyeDrone::knownControls().size(), 44U);
}

class Requests : public testing::TestWithParam<std::string> {};

TEST_P(Requests, AreAnsweredByTheirOwnReplyAtOnce) {
  Deck deck;
  deck.connect();
  deck.replies.clear();
  deck.drone.request("peer", "blueye.protocol." + GetParam(), "");
  deck.drone.step(deck.drone.now(), deck);
  ASSERT_EQ(deck.replies.size(), 1U);
  const std::string stem = GetParam().substr(0, GetParam().size() - 3);
  EXPECT_EQ(deck.replies[0].first, "blueye.protocol." + stem + "Rep");
  EXPECT_TRUE(isFinite(stem + "Rep", deck.replies[0].second));  // and is one
}

INSTANTIATE_TEST_SUITE_P(Table, Requests, testing::ValuesIn(BlueyeDrone::knownRequests()),
                         [](const auto& row) { return row.param; });

class Controls : public testing::TestWithParam<std::string> {};

TEST_P(Controls, AreTakenEvenWhenTheyAreEmpty) {
  Deck deck;
  deck.connect();
  deck.drone.control("blueye.protocol." + GetParam(), "");
  deck.run(2.0);
  EXPECT_EQ(deck.drone.counts().unknown, 0U);
  EXPECT_EQ(deck.drone.counts().malformed, 0U);
}

INSTANTIATE_TEST_SUITE_P(Table, Controls, testing::ValuesIn(BlueyeDrone::knownControls()),
                         [](const auto& row) { return row.param; });

/// A drone in which everything goes on that can.
void wakeEverything(Deck& deck) {
  deck.connect();
  deck.tell(bp::TakePictureCtrl{});
  deck.tell(bp::StartLogStreamingCtrl{});
  deck.tell(bp::ActivateMultibeamCtrl{});
  bp::AnnotationCtrl annotation;
  annotation.mutable_annotation()->set_title("wreck");
  deck.tell(annotation);
  bp::PilotGPSPositionCtrl pilot;
  pilot.mutable_position()->set_latitude(63.0);
  pilot.mutable_position()->set_longitude(10.0);
  deck.tell(pilot);
  bp::SetIperfStatusReq iperf;
  iperf.set_enabled(true);
  deck.ask<bp::SetIperfStatusRep>(iperf);
  bp::SetMissionReq mission;
  auto* photos = mission.mutable_mission()->add_instructions();
  photos->mutable_camera_command()->set_camera_action(bp::CAMERA_ACTION_TAKE_PHOTOS_TIME);
  photos->mutable_camera_command()->set_action_param(1.0F);
  auto* wait = mission.mutable_mission()->add_instructions();
  wait->set_id(1);
  wait->mutable_wait_for_command()->set_wait_for_seconds(1000.0F);
  deck.ask<bp::SetMissionRep>(mission);
  deck.tell(bp::RunMissionCtrl{});
  deck.run(1.0);
}

class Telemetry : public testing::TestWithParam<std::string> {};

TEST_P(Telemetry, IsSentAtTheRateAskedForAndOnRequest) {
  Deck deck;
  wakeEverything(deck);
  const std::string name = "blueye.protocol." + GetParam();
  bp::SetPubFrequencyReq frequency;
  frequency.set_message_type(GetParam());
  frequency.set_frequency(20.0F);
  ASSERT_TRUE(deck.ask<bp::SetPubFrequencyRep>(frequency)->success());
  deck.published.clear();
  deck.run(5.0);
  EXPECT_NEAR(static_cast<double>(deck.published[name].size()), 100.0, 2.0);
  for (const std::string& data : deck.published[name]) {
    ASSERT_TRUE(isFinite(GetParam(), data));
  }
  bp::GetTelemetryReq get;
  get.set_message_type(GetParam());
  const auto reply = deck.ask<bp::GetTelemetryRep>(get);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->payload().type_url(), "type.googleapis.com/" + name);
  frequency.set_frequency(0.0F);
  ASSERT_TRUE(deck.ask<bp::SetPubFrequencyRep>(frequency)->success());
  deck.run(0.1);  // what was to be said at once is said
  deck.published.clear();
  deck.run(3.0);
  EXPECT_EQ(deck.published[name].size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Table, Telemetry, testing::ValuesIn(BlueyeDrone::knownTelemetry()),
                         [](const auto& row) { return row.param; });

TEST(Rates, AreThoseOfADroneUntilToldOtherwise) {
  Deck deck;
  deck.run(10.0);
  for (const std::string& name : BlueyeDrone::knownTelemetry()) {
    const double hz = BlueyeDrone::defaultRate(name).value();
    const std::size_t sent = deck.published["blueye.protocol." + name].size();
    if (hz == 0.0) {
      EXPECT_LE(sent, 1U) << name;  // an event at most
    } else if (sent > 0) {
      EXPECT_NEAR(static_cast<double>(sent), 10.0 * hz, 2.0) << name;
    }
  }
  EXPECT_EQ(BlueyeDrone::defaultRate("DroneTimeTel"), 1.0);
  EXPECT_EQ(BlueyeDrone::defaultRate("CalibratedImuTel"), 0.0);
  EXPECT_EQ(BlueyeDrone::defaultRate("NoSuchTel"), std::nullopt);
}

struct Rate {
  const char* name;
  const char* message;
  float hz;
  bool success;
};
class SetRate : public testing::TestWithParam<Rate> {};

TEST_P(SetRate, SaysWhetherItCould) {
  Deck deck;
  bp::SetPubFrequencyReq request;
  request.set_message_type(GetParam().message);
  request.set_frequency(GetParam().hz);
  EXPECT_EQ(deck.ask<bp::SetPubFrequencyRep>(request)->success(), GetParam().success);
}

INSTANTIATE_TEST_SUITE_P(
    Table, SetRate,
    testing::Values(Rate{"fastest", "DepthTel", 100.0F, true}, Rate{"off", "DepthTel", 0.0F, true},
                    Rate{"too_fast", "DepthTel", 100.5F, false},
                    Rate{"negative", "DepthTel", -1.0F, false},
                    Rate{"not_a_number", "DepthTel", std::nanf(""), false},
                    Rate{"unknown", "NoSuchTel", 1.0F, false},
                    Rate{"with_package", "blueye.protocol.DepthTel", 1.0F, false},
                    Rate{"no_telemetry", "PingReq", 1.0F, false}, Rate{"nothing", "", 1.0F, false}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(GetTelemetry, IsEmptyWhereThereIsNothing) {
  Deck deck;
  for (const char* name : {"NotificationTel", "TimeLapseStateTel", "NoSuchTel", ""}) {
    bp::GetTelemetryReq request;
    request.set_message_type(name);
    const auto reply = deck.ask<bp::GetTelemetryRep>(request);
    ASSERT_TRUE(reply) << name;
    EXPECT_FALSE(reply->has_payload()) << name;
  }
}

TEST(Settings, ReadBackAsTheyWereWritten) {
  Deck deck;
  bp::GetCameraParametersReq which;
  which.set_camera(bp::CAMERA_GUESTPORT);
  bp::SetCameraParametersReq camera;
  *camera.mutable_camera_parameters() =
      deck.ask<bp::GetCameraParametersRep>(which)->camera_parameters();
  EXPECT_EQ(camera.camera_parameters().camera(), bp::CAMERA_GUESTPORT);
  camera.mutable_camera_parameters()->set_hue(12);
  ASSERT_TRUE(deck.ask<bp::SetCameraParametersRep>(camera));
  EXPECT_EQ(deck.ask<bp::GetCameraParametersRep>(which)->camera_parameters().hue(), 12);
  which.set_camera(bp::CAMERA_MAIN);
  EXPECT_EQ(deck.ask<bp::GetCameraParametersRep>(which)->camera_parameters().hue(), 0);

  bp::SetOverlayParametersReq overlay;
  overlay.mutable_overlay_parameters()->set_title("dive 7");
  ASSERT_TRUE(deck.ask<bp::SetOverlayParametersRep>(overlay));
  EXPECT_EQ(deck.ask<bp::GetOverlayParametersRep>(bp::GetOverlayParametersReq{})
                ->overlay_parameters()
                .title(),
            "dive 7");

  bp::SetPersistentStorageSettingsReq storage;
  storage.mutable_persistent_storage_settings()->set_multibeam(true);
  EXPECT_TRUE(deck.ask<bp::SetPersistentStorageSettingsRep>(storage)->success());
  const auto kept =
      deck.ask<bp::GetPersistentStorageSettingsRep>(bp::GetPersistentStorageSettingsReq{});
  EXPECT_TRUE(kept->persistent_storage_settings().multibeam());
  EXPECT_FALSE(kept->persistent_storage_settings().videos());
}

TEST(Settings, TimeIsSetToTheClients) {
  Deck deck;
  bp::SyncTimeReq request;
  request.mutable_time()->mutable_unix_timestamp()->set_seconds(1800000000);
  EXPECT_TRUE(deck.ask<bp::SyncTimeRep>(request)->success());
  deck.run(10.0);
  const auto time = deck.latest<bp::DroneTimeTel>();
  EXPECT_NEAR(static_cast<double>(time.real_time_clock().unix_timestamp().seconds()), 1800000010.0,
              1.0);
  EXPECT_NEAR(static_cast<double>(time.monotonic_clock().unix_timestamp().seconds()), 10.0, 1.0);
}

TEST(Battery, IsTheSameInRequestAndTelemetry) {
  Deck deck;
  deck.run(5.0);
  const auto reply = deck.ask<bp::GetBatteryRep>(bp::GetBatteryReq{});
  const auto told = deck.latest<bp::BatteryTel>().battery();
  EXPECT_NEAR(reply->battery().voltage(), told.voltage(), 0.05);
  EXPECT_NEAR(reply->battery().level(), told.level(), 0.01);
  EXPECT_GT(told.level(), 0.9F);
  const auto details = deck.latest<bp::BatteryBQ40Z50Tel>().battery();
  EXPECT_NEAR(details.voltage().cell_1() * 4.0, details.voltage().total(), 0.01);
  EXPECT_LT(details.current(), 0.0F);  // it discharges
}

}  // namespace
}  // namespace frontseat_driver::sim
