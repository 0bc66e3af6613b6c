// Every sentence of both dialects, both ways: text to values and the same values to text.
#include "frontseat_driver/protocol/message.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "decoding.h"
#include "values.h"

namespace frontseat_driver::protocol {
namespace {

using nmea::LatLon;
using nmea::TimeOfDay;
using std::chrono::milliseconds;
using Mode = bluefin::BehaviorChange;

constexpr TimeOfDay kTime = milliseconds{((8 * 60 + 10) * 60 + 25) * 1000 + 987};  // 081025.987
constexpr TimeOfDay kEarlier = kTime - milliseconds{7};                            // 081025.980
const LatLon kCambridge{42 + 21.81092 / 60, -(71 + 6.84603 / 60)};

/// `text` is what the values are written as; `received` other forms that read as the same values.
struct Row {
  const char* name;
  Message message;
  const char* text;
  std::vector<const char*> received;
};

NavigationUpdate navigation() {
  NavigationUpdate nav;
  nav.sent_at = kTime;
  nav.position = kCambridge;
  nav.from_gps = true;
  nav.altitude_m = 45.3;
  nav.depth_m = 20.1;
  nav.heading_deg = 203.1;
  nav.roll_deg = -3.4;
  nav.pitch_deg = 4.5;
  nav.computed_at = kEarlier;
  return nav;
}

NavigationUpdate surfaceNavigation() {
  NavigationUpdate nav = navigation();
  nav.altitude_m.reset();
  nav.depth_m.reset();
  return nav;
}

NavigationUpdate deadReckoning() {
  NavigationUpdate nav;
  nav.sent_at = TimeOfDay{0};
  nav.position = LatLon{-(33 + 9.123456 / 60), 7 + 5.5 / 60};
  nav.from_gps = false;
  nav.heading_deg = 0.0;
  return nav;
}

VelocityUpdate velocity() { return {kTime, 0.0294, -0.0686, 0.0, 0.0609, -360.0, 360.0}; }

gps::Fix fix() { return {kTime, kCambridge, 2, 10, 0.84, 19.5, -33.2}; }

gps::MinimumData minimumData() {
  return {kTime, true, kCambridge, 0.145, 156.78, nmea::Date{2014, 12, 31}};
}

bluefin::Dvl dvl() {
  bluefin::Dvl dvl;
  dvl.sent_at = kTime;
  dvl.bow_m_s = 1.25;
  dvl.starboard_m_s = -0.5;
  dvl.down_m_s = 0.125;
  dvl.beam_range_m = {10.5, 11.0, std::nullopt, 12.25};
  dvl.temperature_c = -1.5;
  dvl.measured_at = kEarlier;
  return dvl;
}

const Row kRows[] = {
    {"BFNVG",
     navigation(),
     "BFNVG,081025.987,4221.810920,N,07106.846030,W,1,45.300,20.100,203.1000,-3.4000,4.5000,"
     "081025.980",
     {"BFNVG,081025.987,4221.81092,N,07106.84603,W,1,45.3,20.1,203.1,-3.4,4.5,081025.980",
      "BFNVG,081025.987,4221.81092,N,07106.84603,W,1,45.3,20.1,203.1,-3.4,4.5,081025.980,9,x",
      "BFNVG, 081025.987, 4221.81092, N, 07106.84603, W, 1, 45.3, 20.1, 203.1, -3.4, 4.5, "
      "081025.98"}},
    {"CPNVG",
     surfaceNavigation(),
     "CPNVG,081025.987,4221.810920,N,07106.846030,W,1,,,203.1000,-3.4000,4.5000,081025.980",
     {"CPNVG,081025.987,4221.81092,N,07106.84603,W,1,,,203.1,-3.4,4.5,081025.980",
      "CPNVG,081025.987,4221.81092,N,7106.84603,W,2,,,203.1,-3.4,4.5,081025.980"}},
    {"BFNVG_dead_reckoning",
     deadReckoning(),
     "BFNVG,000000.000,3309.123456,S,00705.500000,E,0,,,0.0000,,,",
     {"BFNVG,000000,339.123456,S,0075.5,E,0,,,360,,,",
      "BFNVG,000000,339.123456,S,0075.5,E,0,,,-0,,,"}},
    {"BFNVR",
     velocity(),
     "BFNVR,081025.987,0.0294,-0.0686,0.0000,0.0609,-360.0000,360.0000",
     {"BFNVR,081025.987,0.0294,-0.0686,0,0.0609,-360,360"}},
    {"CPNVR_standing",
     VelocityUpdate{kTime, {}, {}, 0.0, 0.0, 0.0, {}},
     "CPNVR,081025.987,,,0.0000,0.0000,0.0000,",
     {"CPNVR,081025.987,nan,-nan,0,0,0,inf"}},
    {"BFVER", bluefin::VehicleVersion{kTime, "SS_0.0"}, "BFVER,081025.987,SS_0.0", {}},
    {"BFSHT", bluefin::PayloadShutdown{kTime}, "BFSHT,081025.987", {"BFSHT,081025.987,"}},
    {"BFMIS",
     bluefin::MissionStatus{kTime, "survey.dive", "Running /logs/7", "started"},
     "BFMIS,081025.987,survey.dive,Running /logs/7,started",
     {}},
    {"BFMIS_blank_status", bluefin::MissionStatus{kTime, "", "", ""}, "BFMIS,081025.987,,,", {}},
    {"BFACK",
     bluefin::Acknowledgement{kTime, "RMB", kEarlier, "", 2, "all well"},
     "BFACK,081025.987,RMB,081025.980,,2,0,all well,",
     {"BFACK,081025.987,RMB,081025.980,,2,0,all well",
      "BFACK,081025.987,RMB,081025.98,,2,,all well"}},
    {"BFACK_of_log",
     bluefin::Acknowledgement{kTime, "BPLOG", {}, "12", 3, ""},
     "BFACK,081025.987,BPLOG,,12,3,0,,",
     {"BFACK,081025.987,BPLOG,,12,3,0", "BFACK,081025.987,BPLOG,,12,3,0,"}},
    {"BFCTL",
     bluefin::BackseatControl{kTime, true},
     "BFCTL,081025.987,1",
     {"BFCTL,081025.987,1.0"}},
    {"BFCTL_taken_back", bluefin::BackseatControl{kTime, false}, "BFCTL,081025.987,0", {}},
    {"BFDVL",
     dvl(),
     "BFDVL,081025.987,1.2500,-0.5000,0.1250,10.500,11.000,,12.250,-1.500,081025.980",
     {"BFDVL,081025.987,1.25,-0.5,0.125,10.5,11,,12.25,-1.5,081025.980"}},
    {"BFCTD",
     bluefin::Ctd{kTime, 43210.5, 11.25, 101.325, kEarlier},
     "BFCTD,081025.987,43210.500,11.250,101.325,081025.980",
     {}},
    {"BFRVL",
     bluefin::RawVehicleSpeed{kTime, 640.0, {}},
     "BFRVL,081025.987,640.000,",
     {"BFRVL,081025.987,640,"}},
    {"BFMBS",
     bluefin::BehaviorBegin{kTime, "survey.dive", "3", "7", "Waypoint"},
     "BFMBS,081025.987,survey.dive,3,7,Waypoint",
     {}},
    {"BFMBE",
     bluefin::BehaviorEnd{kTime, "survey.dive", "3", "7", "Waypoint"},
     "BFMBE,081025.987,survey.dive,3,7,Waypoint",
     {}},
    {"BFMBE_without_numbers",
     bluefin::BehaviorEnd{kTime, "survey.dive", "", "", "Waypoint"},
     "BFMBE,081025.987,survey.dive,,,Waypoint",
     {}},
    {"BFSVS",
     bluefin::SoundSpeed{kTime, 1498.25},
     "BFSVS,081025.987,1498.250",
     {"BFSVS,081025.987,1498.25"}},
    {"BPVER", bluefin::PayloadVersion{kTime, "0.1"}, "BPVER,081025.987,0.1", {}},
    {"BPLOG", bluefin::LogRequest{"NVG", true}, "BPLOG,NVG,ON", {}},
    {"BPLOG_off", bluefin::LogRequest{"ALL", false}, "BPLOG,ALL,OFF", {}},
    {"BPSTS", bluefin::PayloadStatus{kTime, true, "all well"}, "BPSTS,081025.987,1,all well", {}},
    {"BPSTS_failed", bluefin::PayloadStatus{kTime, false, ""}, "BPSTS,081025.987,0,", {}},
    {"BPRMB",
     bluefin::BehaviorChange{kTime, 203.1, 12.5, Mode::VerticalMode::Depth, 1.5,
                             Mode::SpeedMode::Speed, Mode::HorizontalMode::Heading},
     "BPRMB,081025.987,203.1000,12.500,0,1.500,1,0",
     {"BPRMB,081025.987,203.1,12.5,0,1.5,1,0"}},
    {"BPRMB_other_modes",
     bluefin::BehaviorChange{kTime, -10.0, -5.0, Mode::VerticalMode::Elevator, 600.0,
                             Mode::SpeedMode::Rpm, Mode::HorizontalMode::Rudder},
     "BPRMB,081025.987,-10.0000,-5.000,3,600.000,0,1",
     {}},
    {"BPRMB_left_alone",
     bluefin::BehaviorChange{kTime, {}, 3.0, Mode::VerticalMode::Altitude, {}, {}, {}},
     "BPRMB,081025.987,,3.000,1,,,",
     {}},
    {"BPABT", bluefin::AbortMission{kTime, "leak", true}, "BPABT,081025.987,leak,1", {}},
    {"BPABT_done", bluefin::AbortMission{kTime, "", false}, "BPABT,081025.987,,0", {}},
    {"BPABT_by_default",
     bluefin::AbortMission{kTime, "leak", {}},
     "BPABT,081025.987,leak,",
     {"BPABT,081025.987,leak"}},
    {"CPRCM",
     kingfisher::RawCompass{kTime, 0, 234.3267, -1.6556, -6.6286, kEarlier},
     "CPRCM,081025.987,0,234.3267,-1.6556,-6.6286,081025.980",
     {}},
    {"CPRCM_at_edges",
     kingfisher::RawCompass{kTime, 1, 0.0, 90.0, -180.0, {}},
     "CPRCM,081025.987,1,0.0000,90.0000,-180.0000,",
     {"CPRCM,081025.987,1,360,90,-180,"}},
    {"CPRBS",
     kingfisher::BatteryVoltage{kTime, 2, 15.25, 3.75, 3.875, 21.5},
     "CPRBS,081025.987,2,15.250,3.750,3.875,21.500",
     {"CPRBS,081025.987,2,15.25,3.75,3.875,21.5,x"}},
    {"CPRBS_without_id",
     kingfisher::BatteryVoltage{kTime, {}, 15.25, 3.75, 3.875, 0.0},
     "CPRBS,081025.987,15.250,3.750,3.875,0.000",
     {"CPRBS,081025.987,15.25,3.75,3.875,0", "CPRBS,081025.987,,15.25,3.75,3.875,0"}},
    {"CPRIM",
     kingfisher::RawImu{kTime, 0.25, -0.5, 1.5, 0.125, -0.25, -9.806650, kEarlier},
     "CPRIM,081025.987,0.2500,-0.5000,1.5000,0.125000,-0.250000,-9.806650,081025.980",
     {"CPIMU,081025.987,0.25,-0.5,1.5,0.125,-0.25,-9.80665,081025.980"}},
    {"CPRIM_without_time_of_reading",
     kingfisher::RawImu{kTime, 0.25, -0.5, 1.5, 0.125, -0.25, -9.75, {}},
     "CPRIM,081025.987,0.2500,-0.5000,1.5000,0.125000,-0.250000,-9.750000,",
     {"CPIMU,081025.987,0.25,-0.5,1.5,0.125,-0.25,-9.75"}},
    {"PYDEP", kingfisher::ThrustAndYawRate{-0.25, 40.0, 0}, "PYDEP,-0.2500,40", {"PYDEP,-0.25,40"}},
    {"PYDEP_decimals", kingfisher::ThrustAndYawRate{0.0, -100.0, 2}, "PYDEP,0.0000,-100.00", {}},
    {"PYDEV", kingfisher::HeadingAndSpeed{270.0, 1.5}, "PYDEV,270,1.500", {"PYDEV,270,1.5"}},
    {"PYDEV_north", kingfisher::HeadingAndSpeed{0.0, 0.0}, "PYDEV,0,0.000", {"PYDEV,360,0"}},
    {"PYDIR", kingfisher::MotorThrust{100.0, -100.0, 0}, "PYDIR,100,-100", {"PYDIR,100.0,-100.0"}},
    {"PYDIR_decimals", kingfisher::MotorThrust{12.5, 0.0, 1}, "PYDIR,12.5,0.0", {}},
    {"GPGGA",
     fix(),
     "GPGGA,081025.987,4221.810920,N,07106.846030,W,2,10,0.84,19.5,M,-33.2,M,,",
     {"GPGGA,081025.987,4221.81092,N,07106.84603,W,2,10,0.84,19.5,M,-33.2,M,,0000",
      "GNGGA,081025.987,4221.81092,N,07106.84603,W,2,10,0.84,19.5,M,-33.2,M,,0000"}},
    {"GPGGA_no_fix",
     gps::Fix{kTime, {}, 0, 0, {}, {}, {}},
     "GPGGA,081025.987,,,,,0,0,,,M,,M,,",
     {"GPGGA,081025.987,,,,,0,00,,,,,,,"}},
    {"GPRMC",
     minimumData(),
     "GPRMC,081025.987,A,4221.810920,N,07106.846030,W,0.145,156.78,311214,,,A",
     {"GPRMC,081025.987,A,4221.81092,N,07106.84603,W,0.145,156.78,311214,,,A",
      "GNRMC,081025.987,A,4221.81092,N,07106.84603,W,0.145,156.78,311214,5.0,W,D",
      "IIRMC,081025.987,A,4221.81092,N,7106.84603,W,0.145,156.78,311214"}},
    {"GPRMC_void",
     gps::MinimumData{kTime, false, {}, {}, {}, {}},
     "GPRMC,081025.987,V,,,,,,,,,,N",
     {"GPRMC,081025.987,,,,,,,,"}},
    {"GPVTG",
     gps::CourseAndSpeed{156.78, {}, 0.145, 0.269},
     "GPVTG,156.78,T,,M,0.145,N,0.269,K,A",
     {"GLVTG,156.78,T,,M,0.145,N,0.269,K", "GPVTG,156.78,,,,0.145,,0.269"}},
    {"GPVTG_no_data", gps::CourseAndSpeed{}, "GPVTG,,T,,M,,N,,K,N", {"GPVTG,,T,,M,,N,,K"}},
};

class Messages : public testing::TestWithParam<Row> {};

TEST_P(Messages, AreWrittenAsTheirText) {
  const std::string talker{GetParam().text, 2};
  EXPECT_EQ(written(talker, GetParam().message), test::framed(GetParam().text));
}

TEST_P(Messages, AreReadFromTheirText) {
  const Line line{GetParam().text};
  const auto reading = line.decoded();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->faults.count, 0);
  EXPECT_TRUE(same(reading->message, GetParam().message));
}

TEST_P(Messages, AreReadFromOtherForms) {
  for (const char* text : GetParam().received) {
    const Line line{text};
    const auto reading = line.decoded();
    ASSERT_TRUE(reading) << text;
    EXPECT_EQ(reading->faults.count, 0) << text;
    EXPECT_TRUE(same(reading->message, GetParam().message)) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Messages, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Messages, AreAllInTheTable) {
  std::set<std::size_t> kinds;
  for (const Row& row : kRows) kinds.insert(row.message.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Message>);
}

TEST(Message, OfAnUnknownTypeIsUnknown) {
  for (const char* text :
       {"GPGSA,A,3", "BFRDP,081025.987,3.5", "CPABC,1", "BFNVX,1", "XXNVG,1", "PYNVG,1", "CPVER,1",
        "PGGA,1", "GPGGA1,1", "PSAT,HPR", "GGA,1", "BPNVG,1", "PYRMB,1", "BFPYDIR,1"}) {
    const Line line{text};
    const auto reading = line.decoded();
    ASSERT_FALSE(reading) << text;
    EXPECT_EQ(reading.failure().fault, nmea::Fault::UnknownType) << text;
  }
}

TEST(Dialect, IsToldByTheVehiclesTalker) {
  EXPECT_EQ(dialectOf("BF"), Dialect::Sandshark);
  EXPECT_EQ(dialectOf("CP"), Dialect::Kingfisher);
  for (const char* talker : {"GP", "GN", "BP", "PY", "", "B", "BFN"}) {
    EXPECT_EQ(dialectOf(talker), std::nullopt) << talker;
  }
  EXPECT_STREQ(toString(Dialect::Sandshark), "sandshark");
  EXPECT_STREQ(toString(Dialect::Kingfisher), "kingfisher");
}

}  // namespace
}  // namespace frontseat_driver::protocol
