#include "frontseat_driver/session/to_vehicle.h"

#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::session {
namespace {

using namespace std::chrono_literals;
using State = vehicle::MissionStatus::State;

struct MissionRow {
  const char* name;
  const char* status;
  State state;
  const char* words;
  const char* log_directory;
};

const MissionRow kMissions[] = {
    {"offline", "Offline", State::Offline, "Offline", ""},
    {"invalid_dive_file", "Invalid Dive File", State::InvalidDiveFile, "Invalid Dive File", ""},
    {"invalid_wrapup", "Invalid Wrapup File", State::InvalidWrapupFile, "Invalid Wrapup File", ""},
    {"running", "Running", State::Running, "Running", ""},
    {"running_with_directory", "Running /logs/dive 7", State::Running, "Running", "/logs/dive 7"},
    {"running_with_colon", "Running: /logs/7", State::Running, "Running", "/logs/7"},
    {"wrapping_up", "WrappingUp", State::WrappingUp, "WrappingUp", ""},
    {"stopped", "Stopped", State::Stopped, "Stopped", ""},
    {"blank_on_field_vehicles", "", State::Unknown, "", ""},
    {"to_come", "Hovering", State::Unknown, "Hovering", ""},
    {"case_matters", "running", State::Unknown, "running", ""},
};

class MissionState : public testing::TestWithParam<MissionRow> {};

TEST_P(MissionState, IsReadFromTheStatus) {
  protocol::bluefin::MissionStatus mission;
  mission.status = GetParam().status;
  const vehicle::MissionStatus out = toVehicle(mission);
  EXPECT_EQ(out.state, GetParam().state);
  EXPECT_EQ(out.status, GetParam().words);
  EXPECT_EQ(out.log_directory, GetParam().log_directory);
}

INSTANTIATE_TEST_SUITE_P(Table, MissionState, testing::ValuesIn(kMissions),
                         [](const auto& row) { return std::string{row.param.name}; });

template <class Out, class In>
Out as(const In& in) {
  const auto event = toVehicle(protocol::Message{in});
  return event ? std::get<Out>(*event) : Out{};
}

TEST(ToVehicle, TimeOfSolutionOrOfTheSentence) {
  protocol::NavigationUpdate nav;
  nav.sent_at = 10s;
  EXPECT_EQ(as<vehicle::Navigation>(nav).measured_at, vehicle::TimeOfDay{10s});
  nav.computed_at = 9s;
  EXPECT_EQ(as<vehicle::Navigation>(nav).measured_at, vehicle::TimeOfDay{9s});
}

TEST(ToVehicle, AltitudeZeroIsNoBottom) {
  protocol::NavigationUpdate nav;
  nav.altitude_m = 0.0;
  EXPECT_FALSE(as<vehicle::Navigation>(nav).altitude_m);
  nav.altitude_m = 0.1;
  EXPECT_EQ(as<vehicle::Navigation>(nav).altitude_m, 0.1);
}

TEST(ToVehicle, NavigationKeepsItsNames) {
  protocol::NavigationUpdate nav;
  nav.position = nmea::LatLon{34.5, -122.25};
  nav.from_gps = true;
  nav.altitude_m = 1.0;
  nav.depth_m = 2.0;
  nav.heading_deg = 3.0;
  nav.roll_deg = 4.0;
  nav.pitch_deg = 5.0;
  const auto out = as<vehicle::Navigation>(nav);
  ASSERT_TRUE(out.position);
  EXPECT_EQ(out.position->latitude_deg, 34.5);
  EXPECT_EQ(out.position->longitude_deg, -122.25);
  EXPECT_TRUE(out.from_gps);
  EXPECT_EQ(out.altitude_m, 1.0);
  EXPECT_EQ(out.depth_m, 2.0);
  EXPECT_EQ(out.heading_deg, 3.0);
  EXPECT_EQ(out.roll_deg, 4.0);
  EXPECT_EQ(out.pitch_deg, 5.0);
}

TEST(ToVehicle, VelocitiesAndRatesKeepTheirNames) {
  protocol::VelocityUpdate velocity;
  velocity.east_m_s = -1.0;
  velocity.north_m_s = -2.0;
  velocity.down_m_s = -3.0;
  velocity.pitch_rate_deg_s = 1.0;
  velocity.roll_rate_deg_s = 2.0;
  velocity.yaw_rate_deg_s = 3.0;
  const auto out = as<vehicle::Velocity>(velocity);
  EXPECT_EQ(out.east_m_s, -1.0);
  EXPECT_EQ(out.north_m_s, -2.0);
  EXPECT_EQ(out.down_m_s, -3.0);
  EXPECT_EQ(out.pitch_rate_deg_s, 1.0);
  EXPECT_EQ(out.roll_rate_deg_s, 2.0);
  EXPECT_EQ(out.yaw_rate_deg_s, 3.0);
}

TEST(ToVehicle, AxesOfTheImuKeepTheirNames) {
  protocol::kingfisher::RawImu imu;
  imu.rate_x_deg_s = 1.0;
  imu.rate_y_deg_s = 2.0;
  imu.rate_z_deg_s = 3.0;
  imu.acceleration_x = 4.0;
  imu.acceleration_y = 5.0;
  imu.acceleration_z = 6.0;
  const auto out = as<vehicle::RawImu>(imu);
  EXPECT_EQ(out.rate_x_deg_s, 1.0);
  EXPECT_EQ(out.rate_y_deg_s, 2.0);
  EXPECT_EQ(out.rate_z_deg_s, 3.0);
  EXPECT_EQ(out.acceleration_x, 4.0);
  EXPECT_EQ(out.acceleration_y, 5.0);
  EXPECT_EQ(out.acceleration_z, 6.0);
}

TEST(ToVehicle, AnglesOfACompassKeepTheirNames) {
  protocol::kingfisher::RawCompass compass;
  compass.compass_id = 7;
  compass.heading_deg = 1.0;
  compass.pitch_deg = 2.0;
  compass.roll_deg = 3.0;
  const auto out = as<vehicle::Compass>(compass);
  EXPECT_EQ(out.id, 7);
  EXPECT_EQ(out.heading_deg, 1.0);
  EXPECT_EQ(out.pitch_deg, 2.0);
  EXPECT_EQ(out.roll_deg, 3.0);
}

TEST(ToVehicle, VoltagesOfABatteryKeepTheirNames) {
  protocol::kingfisher::BatteryVoltage battery;
  battery.battery_id = 7;
  battery.stack_v = 1.0;
  battery.lowest_cell_v = 2.0;
  battery.highest_cell_v = 3.0;
  battery.temperature_c = 4.0;
  const auto out = as<vehicle::Battery>(battery);
  EXPECT_EQ(out.id, 7);
  EXPECT_EQ(out.stack_v, 1.0);
  EXPECT_EQ(out.lowest_cell_v, 2.0);
  EXPECT_EQ(out.highest_cell_v, 3.0);
  EXPECT_EQ(out.temperature_c, 4.0);
}

TEST(ToVehicle, ABatteryWithoutIdAndTemperatureZeroHasNone) {
  protocol::kingfisher::BatteryVoltage battery;
  battery.stack_v = 15.1;
  battery.temperature_c = 0.0;
  EXPECT_EQ(as<vehicle::Battery>(battery).temperature_c, std::nullopt);
  battery.temperature_c = -0.5;
  EXPECT_EQ(as<vehicle::Battery>(battery).temperature_c, -0.5);
}

TEST(ToVehicle, ABatteryWithIdMayHaveTemperatureZero) {
  protocol::kingfisher::BatteryVoltage battery;
  battery.battery_id = 1;
  battery.temperature_c = 0.0;
  EXPECT_EQ(as<vehicle::Battery>(battery).temperature_c, 0.0);
}

TEST(ToVehicle, AFixKeepsItsNames) {
  protocol::gps::Fix fix;
  fix.quality = 2;
  fix.position = nmea::LatLon{-34.5, 122.25};
  fix.altitude_m = 1.0;
  fix.geoid_separation_m = 2.0;
  const auto out = as<vehicle::GpsFix>(fix);
  EXPECT_EQ(out.quality, 2);
  ASSERT_TRUE(out.position);
  EXPECT_EQ(out.position->latitude_deg, -34.5);
  EXPECT_EQ(out.position->longitude_deg, 122.25);
  EXPECT_EQ(out.altitude_m, 1.0);
  EXPECT_EQ(out.geoid_separation_m, 2.0);
}

TEST(ToVehicle, KnotsBecomeMetresPerSecond) {
  protocol::gps::MinimumData rmc;
  rmc.speed_kn = 3600.0;
  rmc.course_deg = 5.0;
  rmc.date = nmea::Date{2014, 12, 31};
  const auto out = as<vehicle::GpsVelocity>(rmc);
  EXPECT_DOUBLE_EQ(*out.speed_m_s, 1852.0);
  EXPECT_EQ(out.course_deg, 5.0);
  EXPECT_EQ(*out.date, std::chrono::seconds{1419984000});
}

TEST(ToVehicle, AnAcknowledgementWithoutStatusTellsNothing) {
  EXPECT_FALSE(toVehicle(protocol::Message{protocol::bluefin::Acknowledgement{}}));
}

TEST(ToVehicle, ShutdownLeavesAMinute) {
  protocol::bluefin::PayloadShutdown shutdown;
  shutdown.sent_at = 5s;
  const auto out = as<vehicle::Shutdown>(shutdown);
  EXPECT_EQ(out.sent_at, vehicle::TimeOfDay{5s});
  EXPECT_EQ(out.notice, 60s);
}

}  // namespace
}  // namespace frontseat_driver::session
