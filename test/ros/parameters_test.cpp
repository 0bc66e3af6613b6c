#include "parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <locale>
#include <string>
#include <vector>

namespace frontseat_driver::ros_layer {
namespace {

using XmlRpc::XmlRpcValue;
using namespace std::chrono_literals;

XmlRpcValue list(const std::vector<XmlRpcValue>& values) {
  XmlRpcValue out;
  out.setSize(static_cast<int>(values.size()));
  for (int i = 0; i < out.size(); ++i) out[i] = values[static_cast<std::size_t>(i)];
  return out;
}

/// A whole private namespace with one parameter.
XmlRpcValue only(const std::string& name, const XmlRpcValue& value) {
  XmlRpcValue out;
  out[name] = value;
  return out;
}

std::string errorOf(const XmlRpcValue& private_params) {
  try {
    readParameters(private_params);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

// interface.md, "Parameters (private)", column "default".
TEST(Parameters, HaveTheDocumentedDefaults) {
  const Parameters p = readParameters(XmlRpcValue());
  EXPECT_EQ(p.link.host, "localhost");
  EXPECT_EQ(p.link.port, 29500);
  EXPECT_EQ(p.link.connect_timeout, 2000ms);
  EXPECT_EQ(p.link.reconnect_min, 500ms);
  EXPECT_EQ(p.link.reconnect_max, 10000ms);
  EXPECT_EQ(p.link.silence_timeout, 5000ms);
  EXPECT_FALSE(p.session.dialect);
  EXPECT_EQ(p.session.interface_version, "0.1");
  EXPECT_EQ(p.session.log_sentences, (std::vector<std::string>{"NVG", "NVR", "MIS", "CTL"}));
  EXPECT_TRUE(p.session.use_acks);
  EXPECT_TRUE(p.session.commands_enabled);
  EXPECT_EQ(p.session.control_hook, session::ControlHook::Ctl);
  EXPECT_FALSE(p.session.send_spacing);
  EXPECT_EQ(p.source, Source::Tcp);
  EXPECT_EQ(p.odom_frame, "odom");
  EXPECT_EQ(p.base_frame, "base_link");
  EXPECT_TRUE(p.publish_tf);
  EXPECT_TRUE(p.publish_frd_frames);
  EXPECT_FALSE(p.datum);
  EXPECT_FALSE(p.heading_reference);
  EXPECT_EQ(p.stamp, StampMode::Synced);
  EXPECT_FALSE(p.leap_seconds);
  EXPECT_EQ(p.command_timeout, 1s);
  EXPECT_EQ(p.max_command_age, 500ms);
  EXPECT_EQ(p.command_rate_hz, 5.0);
  EXPECT_EQ(p.thrust_decimals, 0);
  EXPECT_EQ(p.yaw_rate_unit, YawRateUnit::Rad);
  EXPECT_TRUE(p.speed_table.empty());
  EXPECT_EQ(p.max_jump_m_s, 50.0);
  EXPECT_EQ(p.battery_low_v, 13.2);
  EXPECT_EQ(p.magnetic_declination_rad, 0.0);
  EXPECT_EQ(p.compass_convention, CompassConvention::Spec);
  EXPECT_EQ(p.acceleration_unit, AccelerationUnit::MetersPerSecondSquared);
  EXPECT_FALSE(p.fill_behavior_fields);
  EXPECT_EQ(p.ack_timeout, 3s);
  EXPECT_EQ(p.max_data_age, 2s);
  EXPECT_FALSE(p.allow_raw_sentences);
  EXPECT_EQ(p.effect_timeout, 10s);
  EXPECT_EQ(p.max_speed_m_s, 2.0);
  EXPECT_EQ(p.max_yaw_rate_rad_s, 1.0);
  EXPECT_EQ(p.status_rate_hz, 1.0);
  EXPECT_EQ(p.position_stddev_gps_m, 3.0);
  EXPECT_EQ(p.position_stddev_dead_reckoning_m, 30.0);
  EXPECT_EQ(p.depth_stddev_m, 0.1);
  EXPECT_EQ(p.orientation_stddev_rad, 0.05);
  EXPECT_EQ(p.velocity_stddev_m_s, 0.1);
  EXPECT_EQ(p.angular_rate_stddev_rad_s, 0.02);
  EXPECT_EQ(p.acceleration_stddev_m_s2, 0.1);
}

struct Accepted {
  const char* name;
  const char* parameter;
  XmlRpcValue value;
  std::function<bool(const Parameters&)> holds;
};

const Accepted kAccepted[] = {
    {"host", "host", "fe80::1%eth0", [](auto& p) { return p.link.host == "fe80::1%eth0"; }},
    {"port_lowest", "port", 1, [](auto& p) { return p.link.port == 1; }},
    {"port_highest", "port", 65535, [](auto& p) { return p.link.port == 65535; }},
    {"port_as_double", "port", 29501.0, [](auto& p) { return p.link.port == 29501; }},
    {"seconds_as_integer", "connect_timeout", 3,
     [](auto& p) { return p.link.connect_timeout == 3s; }},
    {"seconds_as_double", "reconnect_min", 0.3,
     [](auto& p) { return p.link.reconnect_min == 300ms; }},
    {"short_time_stays_above_zero", "connect_timeout", 1e-5,
     [](auto& p) { return p.link.connect_timeout == 1ms; }},
    {"reconnect_min_is_max", "reconnect_min", 10.0,
     [](auto& p) { return p.link.reconnect_min == p.link.reconnect_max; }},
    {"silence_timeout", "silence_timeout", 0.5,
     [](auto& p) { return p.link.silence_timeout == 500ms; }},
    {"sandshark", "dialect", "sandshark",
     [](auto& p) { return p.session.dialect == protocol::Dialect::Sandshark; }},
    {"kingfisher", "dialect", "kingfisher",
     [](auto& p) { return p.session.dialect == protocol::Dialect::Kingfisher; }},
    {"auto", "dialect", "auto", [](auto& p) { return !p.session.dialect; }},
    {"topic", "source", "topic", [](auto& p) { return p.source == Source::Topic; }},
    {"version_as_text", "interface_version", "SS_0.0",
     [](auto& p) { return p.session.interface_version == "SS_0.0"; }},
    {"version_as_double", "interface_version", 0.1,
     [](auto& p) { return p.session.interface_version == "0.1"; }},
    {"version_as_integer", "interface_version", 1,
     [](auto& p) { return p.session.interface_version == "1"; }},
    {"version_as_whole_double", "interface_version", 1.0,
     [](auto& p) { return p.session.interface_version == "1"; }},
    {"log_sentences_list", "log_sentences", list({"NVG", "DVL"}),
     [](auto& p) {
       return p.session.log_sentences == std::vector<std::string>{"NVG", "DVL"};
     }},
    {"log_sentences_text", "log_sentences", "NVG, DVL CTD",
     [](auto& p) {
       return p.session.log_sentences == std::vector<std::string>{"NVG", "DVL", "CTD"};
     }},
    {"log_sentences_twice", "log_sentences", list({"NVG", "NVR", "NVG"}),
     [](auto& p) {
       return p.session.log_sentences == std::vector<std::string>{"NVG", "NVR"};
     }},
    {"log_sentences_none", "log_sentences", list({}),
     [](auto& p) { return p.session.log_sentences.empty(); }},
    {"use_acks", "use_acks", false, [](auto& p) { return !p.session.use_acks; }},
    {"commands_enabled", "commands_enabled", false,
     [](auto& p) { return !p.session.commands_enabled; }},
    {"hook_mis", "control_hook", "mis",
     [](auto& p) { return p.session.control_hook == session::ControlHook::Mis; }},
    {"hook_none", "control_hook", "none",
     [](auto& p) { return p.session.control_hook == session::ControlHook::None; }},
    {"send_spacing", "send_spacing", 0.06, [](auto& p) { return p.session.send_spacing == 60ms; }},
    {"send_spacing_zero", "send_spacing", 0, [](auto& p) { return p.session.send_spacing == 0ms; }},
    {"leading_slashes", "odom_frame", "//map/odom",
     [](auto& p) { return p.odom_frame == "map/odom"; }},
    {"base_frame", "base_frame", "/boat", [](auto& p) { return p.base_frame == "boat"; }},
    {"publish_tf", "publish_tf", false, [](auto& p) { return !p.publish_tf; }},
    {"publish_frd_frames", "publish_frd_frames", false,
     [](auto& p) { return !p.publish_frd_frames; }},
    {"datum_list", "datum", list({42.36, -71}),
     [](auto& p) { return p.datum->latitude_deg == 42.36 && p.datum->longitude_deg == -71.0; }},
    {"datum_text", "datum", "[42.36, -71.5]",
     [](auto& p) { return p.datum->latitude_deg == 42.36 && p.datum->longitude_deg == -71.5; }},
    {"datum_edge", "datum", list({-90.0, 180}),
     [](auto& p) { return p.datum->latitude_deg == -90.0 && p.datum->longitude_deg == 180.0; }},
    {"heading_grid", "heading_reference", "grid",
     [](auto& p) { return p.heading_reference == HeadingReference::Grid; }},
    {"heading_true", "heading_reference", "true",
     [](auto& p) { return p.heading_reference == HeadingReference::True; }},
    {"heading_true_as_yaml_reads_it", "heading_reference", true,
     [](auto& p) { return p.heading_reference == HeadingReference::True; }},
    {"stamp_vehicle", "stamp", "vehicle", [](auto& p) { return p.stamp == StampMode::Vehicle; }},
    {"stamp_receive", "stamp", "receive", [](auto& p) { return p.stamp == StampMode::Receive; }},
    {"leap_seconds", "leap_seconds", 0, [](auto& p) { return p.leap_seconds == 0s; }},
    {"command_timeout_longest", "command_timeout", 5,
     [](auto& p) { return p.command_timeout == 5s; }},
    {"max_command_age", "max_command_age", 0.25,
     [](auto& p) { return p.max_command_age == 250ms; }},
    {"command_rate", "command_rate", 10, [](auto& p) { return p.command_rate_hz == 10.0; }},
    {"thrust_decimals", "thrust_decimals", 6, [](auto& p) { return p.thrust_decimals == 6; }},
    {"yaw_rate_unit", "yaw_rate_unit", "deg",
     [](auto& p) { return p.yaw_rate_unit == YawRateUnit::Deg; }},
    {"speed_pairs", "speed_table", list({list({0, 0}), list({1.5, 900})}),
     [](auto& p) {
       return p.speed_table.size() == 2 && p.speed_table[1].speed_m_s == 1.5 &&
              p.speed_table[1].rpm == 900.0;
     }},
    {"speed_flat", "speed_table", list({0.5, 300.0, 1.5, 900.0}),
     [](auto& p) { return p.speed_table.size() == 2 && p.speed_table[0].rpm == 300.0; }},
    {"speed_empty", "speed_table", list({}), [](auto& p) { return p.speed_table.empty(); }},
    {"max_jump", "max_jump", 5, [](auto& p) { return p.max_jump_m_s == 5.0; }},
    {"battery_low_voltage", "battery_low_voltage", 24,
     [](auto& p) { return p.battery_low_v == 24.0; }},
    {"declination", "magnetic_declination", -0.25,
     [](auto& p) { return p.magnetic_declination_rad == -0.25; }},
    {"compass_heron", "compass_convention", "heron",
     [](auto& p) { return p.compass_convention == CompassConvention::Heron; }},
    {"acceleration_g", "acceleration_unit", "g",
     [](auto& p) { return p.acceleration_unit == AccelerationUnit::StandardGravity; }},
    {"acceleration_si", "acceleration_unit", "m/s2",
     [](auto& p) { return p.acceleration_unit == AccelerationUnit::MetersPerSecondSquared; }},
    {"fill", "fill_behavior_fields", true, [](auto& p) { return p.fill_behavior_fields; }},
    {"ack_timeout", "ack_timeout", 2.5, [](auto& p) { return p.ack_timeout == 2500ms; }},
    {"max_data_age", "max_data_age", 0.5, [](auto& p) { return p.max_data_age == 500ms; }},
    {"raw", "allow_raw_sentences", true, [](auto& p) { return p.allow_raw_sentences; }},
    {"effect_timeout", "effect_timeout", 7, [](auto& p) { return p.effect_timeout == 7s; }},
    {"max_speed", "max_speed", 1.5, [](auto& p) { return p.max_speed_m_s == 1.5; }},
    {"max_yaw_rate", "max_yaw_rate", 0.5, [](auto& p) { return p.max_yaw_rate_rad_s == 0.5; }},
    {"no_status", "status_rate", 0, [](auto& p) { return p.status_rate_hz == 0.0; }},
    {"gps_stddev", "position_stddev_gps", 2, [](auto& p) { return p.position_stddev_gps_m == 2; }},
    {"dr_stddev", "position_stddev_dead_reckoning", 9,
     [](auto& p) { return p.position_stddev_dead_reckoning_m == 9; }},
    {"depth_stddev", "depth_stddev", 2, [](auto& p) { return p.depth_stddev_m == 2; }},
    {"orientation_stddev", "orientation_stddev", 2,
     [](auto& p) { return p.orientation_stddev_rad == 2; }},
    {"velocity_stddev", "velocity_stddev", 2, [](auto& p) { return p.velocity_stddev_m_s == 2; }},
    {"rate_stddev", "angular_rate_stddev", 2,
     [](auto& p) { return p.angular_rate_stddev_rad_s == 2; }},
    {"acceleration_stddev", "acceleration_stddev", 2,
     [](auto& p) { return p.acceleration_stddev_m_s2 == 2; }},
};

class AcceptedParameter : public testing::TestWithParam<Accepted> {};

TEST_P(AcceptedParameter, IsRead) {
  const Parameters parameters = readParameters(only(GetParam().parameter, GetParam().value));
  EXPECT_TRUE(GetParam().holds(parameters));
}

TEST_P(AcceptedParameter, IsKnown) {
  const XmlRpcValue params = only(GetParam().parameter, GetParam().value);
  EXPECT_EQ(unknownParameterWarnings(params), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Table, AcceptedParameter, testing::ValuesIn(kAccepted),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Refused {
  const char* name;
  const char* parameter;
  XmlRpcValue value;
  const char* message;
};

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

const Refused kRefused[] = {
    {"host_number", "host", 7,
     "parameter host is 7: a host name or an address, without blanks, is accepted"},
    {"host_empty", "host", "",
     "parameter host is \"\": a host name or an address, without blanks, is accepted"},
    {"host_blank", "host", "my boat",
     "parameter host is \"my boat\": a host name or an address, without blanks, is accepted"},
    {"host_two_lines", "host", "a\nb",
     "parameter host is \"a\\x0ab\": a host name or an address, without blanks, is accepted"},
    {"port_high", "port", 99999, "parameter port is 99999: a whole number 1..65535 is accepted"},
    {"port_zero", "port", 0, "parameter port is 0: a whole number 1..65535 is accepted"},
    {"port_negative", "port", -1, "parameter port is -1: a whole number 1..65535 is accepted"},
    {"port_half", "port", 29500.5,
     "parameter port is 29500.5: a whole number 1..65535 is accepted"},
    {"port_huge", "port", 1e300, "parameter port is 1e+300: a whole number 1..65535 is accepted"},
    {"port_text", "port", "29500",
     "parameter port is \"29500\": a whole number 1..65535 is accepted"},
    {"port_boolean", "port", true, "parameter port is true: a whole number 1..65535 is accepted"},
    {"port_nan", "port", kNan, "parameter port is nan: a whole number 1..65535 is accepted"},
    {"port_list", "port", list({1, 2.5, "a"}),
     "parameter port is [1, 2.5, \"a\"]: a whole number 1..65535 is accepted"},
    {"port_struct", "port", only("a", list({1})),
     "parameter port is {a: [1]}: a whole number 1..65535 is accepted"},
    {"connect_timeout_zero", "connect_timeout", 0,
     "parameter connect_timeout is 0: a number above 0 and up to 3600 s is accepted"},
    {"connect_timeout_long", "connect_timeout", 3600.5,
     "parameter connect_timeout is 3600.5: a number above 0 and up to 3600 s is accepted"},
    {"connect_timeout_text", "connect_timeout", "2 s",
     "parameter connect_timeout is \"2 s\": a number above 0 and up to 3600 s is accepted"},
    {"reconnect_min_above_max", "reconnect_min", 20,
     "parameter reconnect_min is 20: a number above 0 and up to reconnect_max, 10 s, is accepted"},
    {"reconnect_max_below_min", "reconnect_max", 0.1,
     "parameter reconnect_max is 0.1: a number from reconnect_min, 0.5, to 3600 s is accepted"},
    {"silence_timeout_inf", "silence_timeout", kInf,
     "parameter silence_timeout is inf: a number above 0 and up to 3600 s is accepted"},
    {"dialect", "dialect", "heron",
     "parameter dialect is \"heron\": sandshark, kingfisher or auto is accepted"},
    {"dialect_capital", "dialect", "Sandshark",
     "parameter dialect is \"Sandshark\": sandshark, kingfisher or auto is accepted"},
    {"source", "source", "udp", "parameter source is \"udp\": tcp or topic is accepted"},
    {"version_comma", "interface_version", "1,2",
     "parameter interface_version is \"1,2\": a number or a text of 1 to 20 printable ASCII "
     "characters without comma, asterisk and $ is accepted"},
    {"version_empty", "interface_version", "",
     "parameter interface_version is \"\": a number or a text of 1 to 20 printable ASCII "
     "characters without comma, asterisk and $ is accepted"},
    {"version_long", "interface_version", "123456789012345678901",
     "parameter interface_version is \"123456789012345678901\": a number or a text of 1 to 20 "
     "printable ASCII characters without comma, asterisk and $ is accepted"},
    {"version_non_ascii", "interface_version", "v\xC3\xA9",
     "parameter interface_version is \"v\xC3\xA9\": a number or a text of 1 to 20 printable ASCII "
     "characters without comma, asterisk and $ is accepted"},
    {"version_boolean", "interface_version", false,
     "parameter interface_version is false: a number or a text of 1 to 20 printable ASCII "
     "characters without comma, asterisk and $ is accepted"},
    {"version_with_a_command", "interface_version", "LOGGER 2",
     "parameter interface_version is \"LOGGER 2\": a text without RMB, LOG, ABT, STS and VER, "
     "which "
     "a vehicle takes for commands, is accepted"},
    {"log_sentence_small", "log_sentences", list({"NVG", "nvr"}),
     "parameter log_sentences is [\"NVG\", \"nvr\"]: a list of sentence names of three capitals, "
     "[NVG, NVR], is accepted"},
    {"log_sentence_five", "log_sentences", "BFNVG",
     "parameter log_sentences is \"BFNVG\": a list of sentence names of three capitals, "
     "[NVG, NVR], is accepted"},
    {"log_sentence_number", "log_sentences", list({1}),
     "parameter log_sentences is [1]: a list of sentence names of three capitals, [NVG, NVR], is "
     "accepted"},
    {"log_sentences_command", "log_sentences", list({"NVG", "RMB"}),
     "parameter log_sentences is [\"NVG\", \"RMB\"]: a list without the commands RMB, LOG, ABT, "
     "STS and VER is accepted"},
    {"log_sentences_boolean", "log_sentences", true,
     "parameter log_sentences is true: a list of sentence names of three capitals, [NVG, NVR], is "
     "accepted"},
    {"use_acks_number", "use_acks", 1, "parameter use_acks is 1: true or false is accepted"},
    {"commands_enabled_text", "commands_enabled", "yes",
     "parameter commands_enabled is \"yes\": true or false is accepted"},
    {"publish_tf_number", "publish_tf", 0, "parameter publish_tf is 0: true or false is accepted"},
    {"publish_frd_frames_text", "publish_frd_frames", "true",
     "parameter publish_frd_frames is \"true\": true or false is accepted"},
    {"control_hook", "control_hook", "CTL",
     "parameter control_hook is \"CTL\": ctl, mis or none is accepted"},
    {"send_spacing_negative", "send_spacing", -0.01,
     "parameter send_spacing is -0.01: a number 0..1 s is accepted"},
    {"odom_frame_slashes", "odom_frame", "//",
     "parameter odom_frame is \"//\": a frame name, without blanks, is accepted"},
    {"odom_frame_blank", "odom_frame", "my odom",
     "parameter odom_frame is \"my odom\": a frame name, without blanks, is accepted"},
    {"base_frame_number", "base_frame", 1,
     "parameter base_frame is 1: a frame name, without blanks, is accepted"},
    {"base_frame_same", "base_frame", "/odom",
     "parameter base_frame is \"/odom\": a frame name other than odom_frame is accepted"},
    {"odom_frame_same", "odom_frame", "base_link",
     "parameter odom_frame is \"base_link\": a frame name other than base_frame is accepted"},
    {"datum_latitude", "datum", list({90.5, 0.0}),
     "parameter datum is [90.5, 0]: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_longitude", "datum", list({0, -181}),
     "parameter datum is [0, -181]: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_short", "datum", list({42.0}),
     "parameter datum is [42]: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_empty", "datum", list({}),
     "parameter datum is []: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_long", "datum", list({42, -71, 0}),
     "parameter datum is [42, -71, 0]: a list [latitude -90..90, longitude -180..180] in degrees "
     "is accepted"},
    {"datum_nan", "datum", list({kNan, 0}),
     "parameter datum is [nan, 0]: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_nested", "datum", list({list({42, -71})}),
     "parameter datum is [[42, -71]]: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_text", "datum", "here",
     "parameter datum is \"here\": a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"datum_number", "datum", 42.0,
     "parameter datum is 42: a list [latitude -90..90, longitude -180..180] in degrees is "
     "accepted"},
    {"heading_reference", "heading_reference", "magnetic",
     "parameter heading_reference is \"magnetic\": grid or true is accepted"},
    {"heading_reference_false", "heading_reference", false,
     "parameter heading_reference is false: grid or true is accepted"},
    {"stamp", "stamp", "gps", "parameter stamp is \"gps\": synced, vehicle or receive is accepted"},
    {"leap_seconds_half", "leap_seconds", 17.5,
     "parameter leap_seconds is 17.5: a whole number -60..60 is accepted"},
    {"leap_seconds_many", "leap_seconds", 3600,
     "parameter leap_seconds is 3600: a whole number -60..60 is accepted"},
    {"command_timeout_zero", "command_timeout", 0.0,
     "parameter command_timeout is 0: a number above 0 and up to 5 s is accepted"},
    {"command_timeout_long", "command_timeout", 5.1,
     "parameter command_timeout is 5.1: a number above 0 and up to 5 s is accepted"},
    {"max_command_age", "max_command_age", -1,
     "parameter max_command_age is -1: a number above 0 and up to 3600 s is accepted"},
    {"command_rate", "command_rate", 0,
     "parameter command_rate is 0: a number 0.25..100 Hz is accepted"},
    {"thrust_decimals", "thrust_decimals", 7,
     "parameter thrust_decimals is 7: a whole number 0..6 is accepted"},
    {"yaw_rate_unit", "yaw_rate_unit", "rad/s",
     "parameter yaw_rate_unit is \"rad/s\": rad or deg is accepted"},
    {"speed_table_odd", "speed_table", list({1.0, 2.0, 3.0}),
     "parameter speed_table is [1, 2, 3]: a list of pairs [[m/s, rpm], ...] that increases in "
     "both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_triple", "speed_table", list({list({0, 1, 2}), list({3, 4, 5})}),
     "parameter speed_table is [[0, 1, 2], [3, 4, 5]]: a list of pairs [[m/s, rpm], ...] that "
     "increases in both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_same_speed", "speed_table", list({list({1, 100}), list({1, 200})}),
     "parameter speed_table is [[1, 100], [1, 200]]: a list of pairs [[m/s, rpm], ...] that "
     "increases in both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_same_rpm", "speed_table", list({list({1, 100}), list({2, 100})}),
     "parameter speed_table is [[1, 100], [2, 100]]: a list of pairs [[m/s, rpm], ...] that "
     "increases in both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_fast", "speed_table", list({list({10.5, 100})}),
     "parameter speed_table is [[10.5, 100]]: a list of pairs [[m/s, rpm], ...] that increases in "
     "both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_rpm", "speed_table", list({list({1, 10001})}),
     "parameter speed_table is [[1, 10001]]: a list of pairs [[m/s, rpm], ...] that increases in "
     "both, 0..10 m/s and -10000..10000 rpm, is accepted"},
    {"speed_table_text", "speed_table", "fast",
     "parameter speed_table is \"fast\": a list of pairs [[m/s, rpm], ...] that increases in both, "
     "0..10 m/s and -10000..10000 rpm, is accepted"},
    {"battery_low_voltage", "battery_low_voltage", -1,
     "parameter battery_low_voltage is -1: a number 0..1000 V is accepted"},
    {"max_jump", "max_jump", 0,
     "parameter max_jump is 0: a number above 0 and up to 1000000 m/s is accepted"},
    {"declination_in_degrees", "magnetic_declination", -14.5,
     "parameter magnetic_declination is -14.5: a number -3.141592653589793..3.141592653589793 rad "
     "is accepted"},
    {"compass_convention", "compass_convention", "field",
     "parameter compass_convention is \"field\": spec or heron is accepted"},
    {"acceleration_unit", "acceleration_unit", "m/s^2",
     "parameter acceleration_unit is \"m/s^2\": m/s2 or g is accepted"},
    {"fill_behavior_fields", "fill_behavior_fields", "",
     "parameter fill_behavior_fields is \"\": true or false is accepted"},
    {"ack_timeout", "ack_timeout", 61,
     "parameter ack_timeout is 61: a number above 0 and up to 60 s is accepted"},
    {"max_data_age", "max_data_age", 0,
     "parameter max_data_age is 0: a number above 0 and up to 3600 s is accepted"},
    {"allow_raw_sentences", "allow_raw_sentences", 1,
     "parameter allow_raw_sentences is 1: true or false is accepted"},
    {"effect_timeout", "effect_timeout", 0,
     "parameter effect_timeout is 0: a number above 0 and up to 3600 s is accepted"},
    {"max_speed", "max_speed", -2.0,
     "parameter max_speed is -2: a number above 0 and up to 10 m/s is accepted"},
    {"max_yaw_rate", "max_yaw_rate", 0,
     "parameter max_yaw_rate is 0: a number above 0 and up to 10 rad/s is accepted"},
    {"status_rate", "status_rate", -1,
     "parameter status_rate is -1: a number 0..10 Hz is accepted"},
    {"gps_stddev", "position_stddev_gps", 0,
     "parameter position_stddev_gps is 0: a number above 0 and up to 1000 m is accepted"},
    {"dr_stddev", "position_stddev_dead_reckoning", -30,
     "parameter position_stddev_dead_reckoning is -30: a number above 0 and up to 1000 m is "
     "accepted"},
    {"depth_stddev", "depth_stddev", "0.1",
     "parameter depth_stddev is \"0.1\": a number above 0 and up to 1000 m is accepted"},
    {"orientation_stddev", "orientation_stddev", kNan,
     "parameter orientation_stddev is nan: a number above 0 and up to 1000 rad is accepted"},
    {"velocity_stddev", "velocity_stddev", 0,
     "parameter velocity_stddev is 0: a number above 0 and up to 1000 m/s is accepted"},
    {"rate_stddev", "angular_rate_stddev", 0,
     "parameter angular_rate_stddev is 0: a number above 0 and up to 1000 rad/s is accepted"},
    {"acceleration_stddev", "acceleration_stddev", -kInf,
     "parameter acceleration_stddev is -inf: a number above 0 and up to 1000 m/s2 is accepted"},
};

class RefusedParameter : public testing::TestWithParam<Refused> {};

TEST_P(RefusedParameter, IsNamedWithItsValueAndWhatIsAccepted) {
  EXPECT_EQ(errorOf(only(GetParam().parameter, GetParam().value)), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedParameter, testing::ValuesIn(kRefused),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Parameters, ThatContradictEachOtherNameBothLimits) {
  XmlRpcValue params;
  params["reconnect_min"] = 2.0;
  params["reconnect_max"] = 1.0;
  EXPECT_EQ(errorOf(params),
            "parameter reconnect_max is 1: a number from reconnect_min, 2, to 3600 s is accepted");
}

TEST(Parameters, ThatLeaveASandsharkNothingToSayAreRefused) {
  XmlRpcValue params = only("use_acks", false);
  params["log_sentences"] = list({});
  EXPECT_EQ(errorOf(params),
            "parameter log_sentences is []: at least one sentence name where use_acks is false is "
            "accepted");
  params["dialect"] = "kingfisher";  // it says everything unasked
  EXPECT_EQ(errorOf(params), "accepted");
}

TEST(Parameters, OfLongValuesStayOnALine) {
  const std::string error = errorOf(only("port", std::string(5000, 'x')));
  EXPECT_LT(error.size(), 200U);
  EXPECT_NE(error.find("...: a whole number 1..65535 is accepted"), std::string::npos);
}

struct Unknown {
  const char* name;
  const char* parameter;
  XmlRpcValue value;
  const char* warning;
};

const Unknown kUnknown[] = {
    {"letter_too_many", "hosst", "x", "parameter hosst is not known; did you mean host?"},
    {"letter_missing", "prt", 1, "parameter prt is not known; did you mean port?"},
    {"swapped", "dailect", "auto", "parameter dailect is not known; did you mean dialect?"},
    {"capital", "Datum", "x", "parameter Datum is not known; did you mean datum?"},
    {"of_the_updater", "diagnostics_period", 1,
     "parameter diagnostics_period is not known; did you mean diagnostic_period?"},
    {"of_the_manager", "num_worker_thread", 1,
     "parameter num_worker_thread is not known; did you mean num_worker_threads?"},
    {"in_a_namespace", "link", only("host", "x"),
     "parameter link/host is not known; did you mean host?"},
    {"empty_namespace", "prot", XmlRpcValue(), "parameter prot is not known; did you mean port?"},
};

class UnknownParameter : public testing::TestWithParam<Unknown> {};

TEST_P(UnknownParameter, IsWarnedAboutWithTheNearestName) {
  EXPECT_EQ(unknownParameterWarnings(only(GetParam().parameter, GetParam().value)),
            std::vector<std::string>{GetParam().warning});
}

TEST_P(UnknownParameter, IsNoError) {
  EXPECT_EQ(errorOf(only(GetParam().parameter, GetParam().value)), "accepted");
}

INSTANTIATE_TEST_SUITE_P(Table, UnknownParameter, testing::ValuesIn(kUnknown),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(UnknownParameters, OfOthersAreKnown) {
  XmlRpcValue params;
  params["diagnostic_period"] = 1.0;
  params["num_worker_threads"] = 4;
  EXPECT_EQ(unknownParameterWarnings(params), std::vector<std::string>{});
}

TEST(UnknownParameters, AreWarnedAboutBesideOnesThatCannotBeUsed) {
  XmlRpcValue params;
  params["port"] = -1;
  params["hosst"] = "x";
  params["poort"] = 1;
  EXPECT_EQ(unknownParameterWarnings(params),
            (std::vector<std::string>{"parameter hosst is not known; did you mean host?",
                                      "parameter poort is not known; did you mean port?"}));
}

TEST(UnknownParameters, OfAnEmptyNamespaceAreNone) {
  EXPECT_EQ(unknownParameterWarnings(XmlRpcValue()), std::vector<std::string>{});
}

TEST(NearestName, OfNoneIsEmpty) { EXPECT_EQ(nearestName("host", {}), ""); }

TEST(NearestName, IsTheFirstOfEquallyNear) { EXPECT_EQ(nearestName("b", {"c", "a"}), "a"); }

/// A process may have set a locale with a decimal comma.
struct CommaLocale : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Values, AreWrittenAndReadWithAPointInAnyLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaLocale));
  const std::string text = toText(XmlRpcValue(0.25));
  const Parameters parameters = readParameters(only("datum", "42.5 -71.25"));
  std::locale::global(before);
  EXPECT_EQ(text, "0.25");
  EXPECT_EQ(parameters.datum->longitude_deg, -71.25);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
