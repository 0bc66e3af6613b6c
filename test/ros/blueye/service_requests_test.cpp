#include "blueye/service_requests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

namespace pb = blueye::protocol;

ResetPositionRequest someReset() {
  ResetPositionRequest wanted;
  wanted.heading_source = ResetPositionRequest::HEADING_MANUAL;
  wanted.yaw = M_PI;  // west
  wanted.coordinate_source = ResetPositionRequest::COORDINATE_MANUAL;
  wanted.latitude = 63.4;
  wanted.longitude = -10.4;
  wanted.heading_mode = ResetPositionRequest::MODE_GYRO;
  return wanted;
}

TEST(Reset, CarriesEveryFieldWithTheHeadingFromNorth) {
  const ConvertedReset converted = toReset(someReset());
  ASSERT_TRUE(std::holds_alternative<pb::ResetPositionCtrl>(converted));
  const auto& settings = std::get<pb::ResetPositionCtrl>(converted).settings();
  EXPECT_EQ(settings.heading_source_during_reset(), pb::HEADING_SOURCE_MANUAL_INPUT);
  EXPECT_FLOAT_EQ(settings.manual_heading(), 270.0F);
  EXPECT_EQ(settings.reset_coordinate_source(), pb::RESET_COORDINATE_SOURCE_MANUAL);
  EXPECT_DOUBLE_EQ(settings.reset_coordinate().latitude(), 63.4);
  EXPECT_DOUBLE_EQ(settings.reset_coordinate().longitude(), -10.4);
  EXPECT_EQ(settings.heading_mode(), pb::HEADING_MODE_GYRO_ONLY);
}

TEST(Reset, AHeadingThatRoundsToAFullTurnIsNorth) {
  ResetPositionRequest wanted = someReset();
  wanted.yaw = M_PI_2 + 1e-9;
  const ConvertedReset converted = toReset(wanted);
  ASSERT_TRUE(std::holds_alternative<pb::ResetPositionCtrl>(converted));
  EXPECT_EQ(std::get<pb::ResetPositionCtrl>(converted).settings().manual_heading(), 0.0F);
}

TEST(Reset, NamesTheFieldItsValueAndWhatIsAccepted) {
  struct Row {
    void (*spoil)(ResetPositionRequest&);
    const char* refusal;
  };
  const Row rows[] = {
      {[](auto& w) { w.heading_source = 0; },
       "heading_source is 0; 1 (COMPASS) or 2 (MANUAL) is accepted"},
      {[](auto& w) { w.heading_source = 3; },
       "heading_source is 3; 1 (COMPASS) or 2 (MANUAL) is accepted"},
      {[](auto& w) { w.yaw = NAN; }, "yaw is nan; a finite number is accepted"},
      {[](auto& w) { w.yaw = 1e307; }, "yaw is 1e+307; -1000000..1000000 is accepted"},
      {[](auto& w) { w.coordinate_source = 4; },
       "coordinate_source is 4; 1 (DEVICE_GPS), 2 (MANUAL) or 3 (BLUEYE_GNSS) is accepted"},
      {[](auto& w) { w.latitude = 90.5; }, "latitude is 90.5; -90..90 is accepted"},
      {[](auto& w) { w.longitude = NAN; }, "longitude is nan; -180..180 is accepted"},
      {[](auto& w) { w.heading_mode = 0; },
       "heading_mode is 0; 1 (COMPASS) or 2 (GYRO) is accepted"},
  };
  for (const Row& row : rows) {
    ResetPositionRequest wanted = someReset();
    row.spoil(wanted);
    const ConvertedReset converted = toReset(wanted);
    ASSERT_TRUE(std::holds_alternative<std::string>(converted)) << row.refusal;
    EXPECT_EQ(std::get<std::string>(converted), row.refusal);
  }
}

RecordRequest record(std::uint8_t main, std::uint8_t guestport, std::uint8_t multibeam) {
  RecordRequest wanted;
  wanted.main = main;
  wanted.guestport = guestport;
  wanted.multibeam = multibeam;
  return wanted;
}

constexpr std::uint8_t kKeep = RecordRequest::KEEP;
constexpr std::uint8_t kStart = RecordRequest::START;
constexpr std::uint8_t kStop = RecordRequest::STOP;

std::vector<bool> cameras(const ConvertedRecord& converted) {
  const auto& on = std::get<pb::RecordCtrl>(converted).record_on();
  return {on.main(), on.guestport(), on.multibeam()};
}

TEST(Recording, KeepsStartsAndStopsEachCameraByItself) {
  pb::RecordState present;
  present.set_main_is_recording(true);
  present.set_multibeam_is_recording(true);
  EXPECT_EQ(cameras(toRecord(record(kKeep, kKeep, kKeep), present)),
            (std::vector<bool>{true, false, true}));
  EXPECT_EQ(cameras(toRecord(record(kStop, kStart, kKeep), present)),
            (std::vector<bool>{false, true, true}));
  EXPECT_EQ(cameras(toRecord(record(kStart, kStop, kStop), std::nullopt)),
            (std::vector<bool>{true, false, false}));
}

TEST(Recording, RefusesWhatIsNoChoiceInsteadOfStopping) {
  const pb::RecordState present;
  EXPECT_EQ(std::get<std::string>(toRecord(record(3, kKeep, kKeep), present)),
            "main is 3; 0 (KEEP), 1 (START) or 2 (STOP) is accepted");
  EXPECT_EQ(std::get<std::string>(toRecord(record(kKeep, 255, kKeep), present)),
            "guestport is 255; 0 (KEEP), 1 (START) or 2 (STOP) is accepted");
  EXPECT_EQ(std::get<std::string>(toRecord(record(kKeep, kKeep, 7), present)),
            "multibeam is 7; 0 (KEEP), 1 (START) or 2 (STOP) is accepted");
}

TEST(Recording, KeepsNothingThatTheDroneHasNotTold) {
  EXPECT_EQ(std::get<std::string>(toRecord(record(kStart, kKeep, kStop), std::nullopt)),
            "the drone has not told yet what it records; nothing can be kept");
}

float servo(double position_rad, const Conventions& how = {}) {
  const auto converted = toJointControl("guest_port_2_servo", position_rad, how);
  const auto& wanted = std::get<pb::GenericServoCtrl>(converted).servo();
  EXPECT_EQ(wanted.guest_port_number(), pb::GUEST_PORT_NUMBER_PORT_2);
  return wanted.value();
}

TEST(Joints, TurnAServoBetweenItsEnds) {
  EXPECT_FLOAT_EQ(servo(-M_PI_4), 0.0F);
  EXPECT_FLOAT_EQ(servo(0.0), 0.5F);
  EXPECT_FLOAT_EQ(servo(M_PI_4), 1.0F);
  Conventions how;
  how.servo_min_rad = 0.0;
  how.servo_max_rad = 2.0;
  EXPECT_FLOAT_EQ(servo(0.5, how), 0.25F);
}

float sonar(double position_rad, const Conventions& how = {}) {
  const auto converted = toJointControl("multibeam_tilt", position_rad, how);
  return std::get<pb::MultibeamServoCtrl>(converted).servo().angle();
}

// Up is a turn to the back about the axis to port: negative.
TEST(Joints, TiltTheSonarUpByANegativeTurnAndNoFurtherThanItGoes) {
  EXPECT_FLOAT_EQ(sonar(-0.1), 5.7295780F);
  EXPECT_FLOAT_EQ(sonar(0.1), -5.7295780F);
  EXPECT_FLOAT_EQ(sonar(-1.0), 28.0F);
  EXPECT_FLOAT_EQ(sonar(1.0), -28.0F);
  Conventions how;
  how.multibeam_tilt_up = false;
  EXPECT_FLOAT_EQ(sonar(0.1, how), 5.7295780F);
}

TEST(Joints, AreKnownByTheirWholeNameOnly) {
  EXPECT_TRUE(
      std::holds_alternative<pb::GenericServoCtrl>(toJointControl("guest_port_6_servo", 0.0, {})));
  for (const std::string other :
       {"guest_port_0_servo", "guest_port_7_servo", "guest_port_1_servo_2", "guest_port_1_wrist",
        "guest_port_01_servo", "guest_port_+1_servo", "guest_port_ 1_servo", "camera_tilt", ""}) {
    const auto converted = toJointControl(other, 0.0, {});
    ASSERT_TRUE(std::holds_alternative<std::string>(converted)) << other;
    EXPECT_EQ(std::get<std::string>(converted),
              "joint is '" + other + "'; multibeam_tilt and guest_port_1_servo to 6 are accepted");
  }
}

TEST(Joints, AreRefusedBeyondTheirEnds) {
  EXPECT_EQ(std::get<std::string>(toJointControl("guest_port_1_servo", 0.8, {})),
            "position is 0.8; -0.7853981634..0.7853981634 is accepted");
  EXPECT_EQ(std::get<std::string>(toJointControl("guest_port_1_servo", NAN, {})),
            "position is nan; -0.7853981634..0.7853981634 is accepted");
  EXPECT_EQ(std::get<std::string>(toJointControl("multibeam_tilt", -1.6, {})),
            "position is -1.6; -1.570796327..1.570796327 is accepted");
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
