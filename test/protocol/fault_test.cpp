// What is wrong with single fields: it costs that field and nothing else.
#include <gtest/gtest.h>

#include "decoding.h"
#include "values.h"

namespace frontseat_driver::protocol {
namespace {

using nmea::Fault;

struct Row {
  const char* name;
  const char* text;  ///< with one bad field
  Fault fault;
  int field;
  const char* blanked;  ///< the same with that field blank
};

const Row kRows[] = {
    {"nvg_bad_time", "BFNVG,25x,4230,N,07106,W,1,1,2,3,4,5,000000", Fault::BadValue, 1,
     "BFNVG,,4230,N,07106,W,1,1,2,3,4,5,000000"},
    {"nvg_hemisphere", "BFNVG,000000,4230,X,07106,W,1,1,2,3,4,5,000000", Fault::BadValue, 3,
     "BFNVG,000000,4230,,07106,W,1,1,2,3,4,5,000000"},
    {"nvg_longitude_181", "BFNVG,000000,4230,N,18100,W,1,1,2,3,4,5,000000", Fault::OutOfRange, 4,
     "BFNVG,000000,4230,N,,W,1,1,2,3,4,5,000000"},
    {"nvg_quality_negative", "BFNVG,000000,4230,N,07106,W,-1,1,2,3,4,5,000000", Fault::OutOfRange,
     6, "BFNVG,000000,4230,N,07106,W,,1,2,3,4,5,000000"},
    {"nvg_altitude_text", "BFNVG,000000,4230,N,07106,W,1,none,2,3,4,5,000000", Fault::BadValue, 7,
     "BFNVG,000000,4230,N,07106,W,1,,2,3,4,5,000000"},
    {"nvg_heading_above_360", "CPNVG,000000,4230,N,07106,W,1,1,2,360.0001,4,5,000000",
     Fault::OutOfRange, 9, "CPNVG,000000,4230,N,07106,W,1,1,2,,4,5,000000"},
    {"nvg_heading_negative", "CPNVG,000000,4230,N,07106,W,1,1,2,-0.0001,4,5,000000",
     Fault::OutOfRange, 9, "CPNVG,000000,4230,N,07106,W,1,1,2,,4,5,000000"},
    {"nvg_roll_above_180", "CPNVG,000000,4230,N,07106,W,1,1,2,3,180.1,5,000000", Fault::OutOfRange,
     10, "CPNVG,000000,4230,N,07106,W,1,1,2,3,,5,000000"},
    {"nvg_roll_below_180", "CPNVG,000000,4230,N,07106,W,1,1,2,3,-180.1,5,000000", Fault::OutOfRange,
     10, "CPNVG,000000,4230,N,07106,W,1,1,2,3,,5,000000"},
    {"nvg_pitch_above_90", "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,90.1,000000", Fault::OutOfRange,
     11, "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,,000000"},
    {"nvg_pitch_below_90", "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,-90.1,000000", Fault::OutOfRange,
     11, "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,,000000"},
    {"nvg_time_of_solution", "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,5,240000", Fault::OutOfRange,
     12, "CPNVG,000000,4230,N,07106,W,1,1,2,3,4,5,"},
    {"nvr_yaw_rate_text", "BFNVR,000000,1,2,3,4,5,fast", Fault::BadValue, 7,
     "BFNVR,000000,1,2,3,4,5,"},
    {"ack_status_4", "BFACK,000000,RMB,000000,,4,0,m,", Fault::OutOfRange, 5,
     "BFACK,000000,RMB,000000,,,0,m,"},
    {"ctl_2", "BFCTL,000000,2", Fault::OutOfRange, 2, "BFCTL,000000,"},
    {"ctl_text", "BFCTL,000000,true", Fault::BadValue, 2, "BFCTL,000000,"},
    {"log_lower_case", "BPLOG,NVG,on", Fault::BadValue, 2, "BPLOG,NVG,"},
    {"rmb_vertical_mode_4", "BPRMB,000000,1,2,4,3,1,0", Fault::OutOfRange, 4,
     "BPRMB,000000,1,2,,3,1,0"},
    {"rmb_speed_mode_2", "BPRMB,000000,1,2,3,3,2,0", Fault::OutOfRange, 6,
     "BPRMB,000000,1,2,3,3,,0"},
    {"rmb_horizontal_mode_2", "BPRMB,000000,1,2,3,3,1,2", Fault::OutOfRange, 7,
     "BPRMB,000000,1,2,3,3,1,"},
    {"rcm_pitch_above_90", "CPRCM,000000,0,1,90.1,3,000000", Fault::OutOfRange, 4,
     "CPRCM,000000,0,1,,3,000000"},
    {"rbs_id", "CPRBS,000000,a,15,3,4,20", Fault::BadValue, 2, "CPRBS,000000,,15,3,4,20"},
    {"dep_thrust_above_100", "PYDEP,0.1,100.5", Fault::OutOfRange, 2, "PYDEP,0.1,"},
    {"dep_thrust_below_100", "PYDEP,0.1,-100.5", Fault::OutOfRange, 2, "PYDEP,0.1,"},
    {"dir_port_below_100", "PYDIR,-100.5,5", Fault::OutOfRange, 1, "PYDIR,,5"},
    {"dir_port_above_100", "PYDIR,100.5,5", Fault::OutOfRange, 1, "PYDIR,,5"},
    {"dir_starboard_below_100", "PYDIR,5,-100.5", Fault::OutOfRange, 2, "PYDIR,5,"},
    {"dir_starboard_above_100", "PYDIR,5,100.5", Fault::OutOfRange, 2, "PYDIR,5,"},
    {"dev_heading_361", "PYDEV,361,1", Fault::OutOfRange, 1, "PYDEV,,1"},
    {"gga_quality", "GPGGA,000000,4230,N,07106,W,x,6,1,2,M,3,M,,", Fault::BadValue, 6,
     "GPGGA,000000,4230,N,07106,W,,6,1,2,M,3,M,,"},
    {"rmc_status", "GPRMC,000000,B,4230,N,07106,W,1,2,311214,,,A", Fault::BadValue, 2,
     "GPRMC,000000,,4230,N,07106,W,1,2,311214,,,A"},
    {"rmc_date", "GPRMC,000000,A,4230,N,07106,W,1,2,321214,,,A", Fault::OutOfRange, 9,
     "GPRMC,000000,A,4230,N,07106,W,1,2,,,,A"},
};

class Faults : public testing::TestWithParam<Row> {};

TEST_P(Faults, CostOneField) {
  const Line line{GetParam().text};
  const Line blanked_line{GetParam().blanked};
  const auto reading = line.decoded();
  const auto blanked = blanked_line.decoded();
  ASSERT_TRUE(reading);
  ASSERT_TRUE(blanked);
  EXPECT_EQ(reading->faults.count, 1);
  EXPECT_EQ(reading->faults.first.fault, GetParam().fault);
  EXPECT_EQ(reading->faults.first.field, GetParam().field);
  EXPECT_EQ(blanked->faults.count, 0);
  EXPECT_TRUE(same(reading->message, blanked->message));
}

INSTANTIATE_TEST_SUITE_P(Table, Faults, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Extreme {
  const char* name;
  const char* text;
};

const Extreme kExtremes[] = {
    {"nvg_least", "CPNVG,000000,9000,S,18000,W,0,0,0,0,-180,-90,000000"},
    {"nvg_most", "CPNVG,235959.999999,9000,N,18000,E,9,1,2,360,180,90,235959.999999"},
    {"nvg_upside_down", "CPNVG,000000,4230,N,07106,W,1,1,2,3,120,5,000000"},
    {"rcm_least", "CPRCM,000000,0,0,-90,-180,000000"},
    {"rcm_most", "CPRCM,000000,9,360,90,180,000000"},
    {"dep_least", "PYDEP,-1,-100"},
    {"dep_most", "PYDEP,1,100"},
    {"dir_least", "PYDIR,-100,-100"},
    {"dir_most", "PYDIR,100,100"},
    {"dev_most", "PYDEV,360,1"},
};

class Extremes : public testing::TestWithParam<Extreme> {};

TEST_P(Extremes, AreInRange) {
  const Line line{GetParam().text};
  const auto reading = line.decoded();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->faults.count, 0) << "field " << reading->faults.first.field;
}

INSTANTIATE_TEST_SUITE_P(Table, Extremes, testing::ValuesIn(kExtremes),
                         [](const auto& row) { return std::string{row.param.name}; });

/// How many fields a sentence must have; all of them may be blank.
struct Length {
  const char* address;
  int fields;
};

const Length kLengths[] = {
    {"BFNVG", 12}, {"CPNVG", 12}, {"BFNVR", 7}, {"CPNVR", 7},  {"BFVER", 2}, {"BFSHT", 1},
    {"BFMIS", 4},  {"BFACK", 6},  {"BFCTL", 2}, {"BFDVL", 10}, {"BFCTD", 5}, {"BFRVL", 3},
    {"BFMBS", 5},  {"BFMBE", 5},  {"BFSVS", 2}, {"BPVER", 2},  {"BPLOG", 2}, {"BPSTS", 3},
    {"BPRMB", 7},  {"BPABT", 2},  {"CPRCM", 6}, {"CPRBS", 5},  {"CPRIM", 7}, {"CPIMU", 7},
    {"PYDEP", 2},  {"PYDEV", 2},  {"PYDIR", 2}, {"GPGGA", 11}, {"GPRMC", 9}, {"GPVTG", 7},
};

class Lengths : public testing::TestWithParam<Length> {};

nmea::FieldFaults faultsOf(const std::string& address, int commas) {
  const Line line{address + std::string(static_cast<std::size_t>(commas), ',')};
  return line.decoded()->faults;
}

TEST_P(Lengths, MayBeBlank) { EXPECT_EQ(faultsOf(GetParam().address, GetParam().fields).count, 0); }

TEST_P(Lengths, MayBeOneLonger) {
  EXPECT_EQ(faultsOf(GetParam().address, GetParam().fields + 1).count, 0);
}

TEST_P(Lengths, OneShortMissTheLastField) {
  const nmea::FieldFaults faults = faultsOf(GetParam().address, GetParam().fields - 1);
  EXPECT_EQ(faults.count, 1);
  EXPECT_EQ(faults.first.fault, Fault::MissingField);
  EXPECT_EQ(faults.first.field, GetParam().fields);
}

INSTANTIATE_TEST_SUITE_P(Table, Lengths, testing::ValuesIn(kLengths),
                         [](const auto& row) { return std::string{row.param.address}; });

TEST(Blank, NavigationHasNothing) {
  const Line line{"BFNVG,,,,,,,,,,,,"};
  const auto reading = line.decoded();
  ASSERT_TRUE(reading);
  EXPECT_TRUE(same(reading->message, NavigationUpdate{}));
}

TEST(Rates, ThatJumpAreNoneAndNoFault) {
  const Line jumps{"BFNVR,000000,1,2,3,360.1,-360.1,-7197.3"};
  const auto reading = jumps.decoded();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->faults.count, 0);
  EXPECT_TRUE(same(reading->message, Line{"BFNVR,000000,1,2,3,,,"}.decoded()->message));
  const auto fast = std::get<VelocityUpdate>(Line{"BFNVR,0,1,2,3,360,0,-360"}.decoded()->message);
  EXPECT_EQ(fast.pitch_rate_deg_s, 360.0);
  EXPECT_EQ(fast.yaw_rate_deg_s, -360.0);
}

TEST(Position, OfASandsharkIsSplitFromTheLeft) {
  const Line line{"BFNVG,000000,429.5,N,0715.5,W,1,,,,,,"};
  const auto nav = std::get<NavigationUpdate>(line.decoded()->message);
  EXPECT_EQ(nav.position, (nmea::LatLon{42 + 9.5 / 60, -(71 + 5.5 / 60)}));
}

TEST(Position, OfAHeronIsSplitFromThePoint) {
  const Line line{"CPNVG,000000,429.5,N,0715.5,W,1,,,,,,"};
  const auto nav = std::get<NavigationUpdate>(line.decoded()->message);
  EXPECT_EQ(nav.position, (nmea::LatLon{4 + 29.5 / 60, -(7 + 15.5 / 60)}));
}

}  // namespace
}  // namespace frontseat_driver::protocol
