#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "decoding.h"

namespace frontseat_driver::protocol {
namespace {

/// Writes every field as `number name=value`; blank ones as `number name=`.
class Listing : public FieldVisitor {
 public:
  std::string str() const { return out_.str(); }

  void time(const Field& field, const std::optional<nmea::TimeOfDay>& value) override {
    begin(field);
    if (value) out_ << std::chrono::duration<double>(*value).count();
  }
  void date(const Field& field, const std::optional<nmea::Date>& value) override {
    begin(field);
    if (value) out_ << value->year << "-" << value->month << "-" << value->day;
  }
  void position(const Field& field, const std::optional<nmea::LatLon>& value) override {
    begin(field);
    if (value) out_ << value->latitude_deg << "/" << value->longitude_deg;
  }
  void number(const Field& field, const std::optional<double>& value) override {
    begin(field);
    if (value) out_ << *value;
  }
  void integer(const Field& field, const std::optional<std::int64_t>& value) override {
    begin(field);
    if (value) out_ << *value;
  }
  void flag(const Field& field, const std::optional<bool>& value) override {
    begin(field);
    if (value) out_ << (*value ? "yes" : "no");
  }
  void choice(const Field& field, const std::optional<std::size_t>& value, Words words) override {
    begin(field);
    if (value) out_ << words.begin()[*value];
  }
  void text(const Field& field, std::string_view value) override {
    begin(field);
    out_ << value;
  }

 private:
  void begin(const Field& field) {
    out_ << (out_.str().empty() ? "" : " ") << field.number << " " << field.name
         << field.unit.suffix << "=";
  }

  std::ostringstream out_;
};

struct Described {
  const char* name;
  const char* body;
  const char* title;
  const char* fields;
};

// 000102 is 62 seconds after midnight; 1230.0 minutes of arc are 12.5 degrees.
const Described kDescribed[] = {
    {"BFNVG", "BFNVG,000102,1230.0,N,01230.0,W,1,7,8,9,10,11,000103", "navigation update",
     "1 sent_at=62 2 position=12.5/-12.5 6 from_gps=yes 7 altitude_m=7 8 depth_m=8 9 heading_deg=9 "
     "10 roll_deg=10 11 pitch_deg=11 12 computed_at=63"},
    {"CPNVG", "CPNVG,000102,1230.0,S,01230.0,E,0,,,9,,,", "navigation update",
     "1 sent_at=62 2 position=-12.5/12.5 6 from_gps=no 7 altitude_m= 8 depth_m= 9 heading_deg=9 "
     "10 roll_deg= 11 pitch_deg= 12 computed_at="},
    {"BFNVR", "BFNVR,000102,2,3,4,5,6,7", "velocity and rates",
     "1 sent_at=62 2 east_m_s=2 3 north_m_s=3 4 down_m_s=4 5 pitch_rate_deg_s=5 6 "
     "roll_rate_deg_s=6 "
     "7 yaw_rate_deg_s=7"},
    {"CPNVR", "CPNVR,000102,2,3,4,5,6,7", "velocity and rates",
     "1 sent_at=62 2 east_m_s=2 3 north_m_s=3 4 down_m_s=4 5 pitch_rate_deg_s=5 6 "
     "roll_rate_deg_s=6 "
     "7 yaw_rate_deg_s=7"},
    {"BFVER", "BFVER,000102,SS_0.0", "interface version of the vehicle",
     "1 sent_at=62 2 version=SS_0.0"},
    {"BFSHT", "BFSHT,000102", "payload power goes off", "1 sent_at=62"},
    {"BFMIS", "BFMIS,000102,dive,Running,more", "mission status",
     "1 sent_at=62 2 dive_file=dive 3 status=Running 4 details=more"},
    {"BFACK", "BFACK,000102,RMB,000103,4,2,0,fine,", "acknowledgement",
     "1 sent_at=62 2 command=RMB 3 command_time=63 4 behavior_id=4 5 status=done 7 message=fine"},
    {"BFCTL", "BFCTL,000102,1", "backseat control", "1 sent_at=62 2 backseat_in_control=yes"},
    {"BFDVL", "BFDVL,000102,2,3,4,5,6,7,8,9,000103", "Doppler velocity log",
     "1 sent_at=62 2 bow_m_s=2 3 starboard_m_s=3 4 down_m_s=4 5 beam_range_1_m=5 6 "
     "beam_range_2_m=6 "
     "7 beam_range_3_m=7 8 beam_range_4_m=8 9 temperature_c=9 10 measured_at=63"},
    {"BFCTD", "BFCTD,000102,2,3,4,000103", "conductivity, temperature, pressure",
     "1 sent_at=62 2 conductivity_us_cm=2 3 temperature_c=3 4 pressure_kpa=4 5 measured_at=63"},
    {"BFRVL", "BFRVL,000102,2,3", "thruster and water speed",
     "1 sent_at=62 2 thruster_rpm=2 3 water_speed_m_s=3"},
    {"BFMBS", "BFMBS,000102,dive,3,four,five", "behavior begins",
     "1 sent_at=62 2 dive_file=dive 3 number=3 4 payload_behavior_id=four 5 behavior_type=five"},
    {"BFMBE", "BFMBE,000102,dive,3,four,five", "behavior ends",
     "1 sent_at=62 2 dive_file=dive 3 number=3 4 payload_behavior_id=four 5 behavior_type=five"},
    {"BFSVS", "BFSVS,000102,1500", "speed of sound", "1 sent_at=62 2 sound_speed_m_s=1500"},
    {"BPVER", "BPVER,000102,0.1", "interface version of the payload", "1 sent_at=62 2 version=0.1"},
    {"BPLOG", "BPLOG,NVG,ON", "log request", "1 sentence=NVG 2 on=yes"},
    {"BPSTS", "BPSTS,000102,0,low", "status of the payload", "1 sent_at=62 2 ok=no 3 message=low"},
    {"BPRMB", "BPRMB,000102,2,3,1,5,1,0", "change of behavior",
     "1 sent_at=62 2 horizontal=2 3 vertical=3 4 vertical_mode=altitude_m 5 speed=5 6 "
     "speed_mode=m_s "
     "7 horizontal_mode=heading_deg"},
    {"BPABT", "BPABT,000102,done,0", "abort of the mission",
     "1 sent_at=62 2 message=done 3 with_errors=no"},
    {"CPRCM", "CPRCM,000102,2,3,4,5,000103", "compass",
     "1 sent_at=62 2 compass_id=2 3 heading_deg=3 4 pitch_deg=4 5 roll_deg=5 6 measured_at=63"},
    {"CPRBS", "CPRBS,000102,2,3,4,5,6", "battery",
     "1 sent_at=62 2 battery_id=2 3 stack_v=3 4 lowest_cell_v=4 5 highest_cell_v=5 6 "
     "temperature_c=6"},
    {"CPRBS_without_id", "CPRBS,000102,2,3,4,5", "battery",
     "1 sent_at=62 2 battery_id= 2 stack_v=2 3 lowest_cell_v=3 4 highest_cell_v=4 5 "
     "temperature_c=5"},
    {"CPRBS_with_blank_id", "CPRBS,000102,,3,4,5,6", "battery",
     "1 sent_at=62 2 battery_id= 3 stack_v=3 4 lowest_cell_v=4 5 highest_cell_v=5 6 "
     "temperature_c=6"},
    {"CPRIM", "CPRIM,000102,2,3,4,5,6,7,000103", "inertial sensor",
     "1 sent_at=62 2 rate_x_deg_s=2 3 rate_y_deg_s=3 4 rate_z_deg_s=4 5 acceleration_x=5 "
     "6 acceleration_y=6 7 acceleration_z=7 8 measured_at=63"},
    {"CPIMU", "CPIMU,000102,2,3,4,5,6,7", "inertial sensor",
     "1 sent_at=62 2 rate_x_deg_s=2 3 rate_y_deg_s=3 4 rate_z_deg_s=4 5 acceleration_x=5 "
     "6 acceleration_y=6 7 acceleration_z=7 8 measured_at="},
    {"PYDEP", "PYDEP,1,2", "command: thrust and rate of turn", "1 yaw_rate=1 2 thrust_pct=2"},
    {"PYDEV", "PYDEV,1,2", "command: heading and speed", "1 heading_deg=1 2 speed_m_s=2"},
    {"PYDIR", "PYDIR,1,2", "command: thrust of each motor", "1 port_pct=1 2 starboard_pct=2"},
    {"GPGGA", "GPGGA,000102,1230.0,N,01230.0,E,1,7,8,9,M,11,M,13,14", "GPS fix",
     "1 measured_at=62 2 position=12.5/12.5 6 quality=1 7 satellites=7 8 hdop=8 9 altitude_m=9 "
     "11 geoid_separation_m=11"},
    {"GPRMC", "GPRMC,000102,A,1230.0,N,01230.0,E,7,8,191114,,,A", "GPS position, velocity, date",
     "1 measured_at=62 2 valid=yes 3 position=12.5/12.5 7 speed_kn=7 8 course_deg=8 9 "
     "date=2014-11-19"},
    {"GPVTG", "GPVTG,1,T,3,M,5,N,7,K,A", "GPS course and speed",
     "1 course_true_deg=1 3 course_magnetic_deg=3 5 speed_kn=5 7 speed_km_h=7"},
};

class Description : public testing::TestWithParam<Described> {};

TEST_P(Description, ShowsEveryFieldUnderItsNumber) {
  const Line line{GetParam().body};
  const auto reading = line.decoded();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->faults.count, 0);
  EXPECT_EQ(titleOf(reading->message), GetParam().title);
  Listing listing;
  describe(reading->message, listing);
  EXPECT_EQ(listing.str(), GetParam().fields);
}

INSTANTIATE_TEST_SUITE_P(Table, Description, testing::ValuesIn(kDescribed),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Description, LeavesNoSentenceOfTheTableOut) {
  std::set<std::string> described;
  for (const Described& row : kDescribed) described.insert(std::string{row.body}.substr(0, 5));
  std::set<std::string> known;
  for (const KnownSentence& sentence : knownSentences()) {
    const std::string_view talker = sentence.talker.empty() ? "GP" : sentence.talker;
    known.insert(std::string{talker} + std::string{sentence.formatter});
  }
  EXPECT_EQ(described, known);
}

}  // namespace
}  // namespace frontseat_driver::protocol
