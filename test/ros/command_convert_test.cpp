#include "command_convert.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include "convert.h"
#include "frontseat_driver/session/command_sentence.h"

// The exact bytes of ROS commands on the wire, worked out by hand: plain arithmetic from the two
// documents, checksums as the XOR of the bytes between `$` and `*`. What cannot be sent is refused
// with field, value and range.

namespace frontseat_driver::ros_layer {
namespace {

using session::CommandFormat;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Convergence of the meridians, by the series of Snyder (Map Projections, 1987, p. 51) on WGS84
// with l = longitude - central meridian:
//   l sin(lat) (1 + l^2 cos^2(lat) (1 + 3 eta^2 + 2 eta^4) / 3 + ...)
// At 42.36 N 71.11 W (zone 19, 69 W) it is -1.42204 deg, at 22.9 S 43.17 W (zone 23, 45 W)
// -0.71231. A heading on the wire is 90 - yaw - convergence.
const NorthOffset kBoston = meridianConvergence_deg({42.36, -71.11});
const NorthOffset kRio = meridianConvergence_deg({-22.9, -43.17});
constexpr double kTrueNorth = 0.0;

Behavior horizontal(std::uint8_t mode, double value) {
  Behavior message;
  message.horizontal_mode = mode;
  message.horizontal = value;
  return message;
}

Behavior vertical(std::uint8_t mode, double value) {
  Behavior message;
  message.vertical_mode = mode;
  message.vertical = value;
  return message;
}

Behavior speed(std::uint8_t mode, double value) {
  Behavior message;
  message.speed_mode = mode;
  message.speed = value;
  return message;
}

Converted heading(double yaw, NorthOffset north) {
  return toCommand(horizontal(Behavior::HORIZONTAL_HEADING, yaw), north);
}

Converted rudder(double angle) {
  return toCommand(horizontal(Behavior::HORIZONTAL_RUDDER, angle), {});
}

Converted depth(double value) { return toCommand(vertical(Behavior::VERTICAL_DEPTH, value), {}); }

Converted altitude(double value) {
  return toCommand(vertical(Behavior::VERTICAL_ALTITUDE, value), {});
}

Converted pitch(double angle) { return toCommand(vertical(Behavior::VERTICAL_PITCH, angle), {}); }

Converted elevator(double angle) {
  return toCommand(vertical(Behavior::VERTICAL_ELEVATOR, angle), {});
}

Converted rpm(double value) { return toCommand(speed(Behavior::SPEED_RPM, value), {}); }

Converted metresPerSecond(double value) {
  return toCommand(speed(Behavior::SPEED_SPEED, value), {});
}

Converted everything() {
  Behavior message = horizontal(Behavior::HORIZONTAL_HEADING, 0.0);
  message.vertical_mode = Behavior::VERTICAL_DEPTH;
  message.vertical = 12.5;
  message.speed_mode = Behavior::SPEED_SPEED;
  message.speed = 1.5;
  return toCommand(message, kBoston);
}

Converted drive(double left, double right) {
  Drive message;
  message.left = left;
  message.right = right;
  return toCommand(message);
}

Converted helm(double thrust, double yaw_rate) {
  Helm message;
  message.thrust = thrust;
  message.yaw_rate = yaw_rate;
  return toCommand(message);
}

Converted course(double yaw, double speed_m_s, NorthOffset north = kTrueNorth) {
  Course message;
  message.yaw = yaw;
  message.speed = speed_m_s;
  return toCommand(message, north);
}

geometry_msgs::Twist twist(double x, double y, double z, double about_x, double about_y,
                           double about_z) {
  geometry_msgs::Twist message;
  message.linear.x = x;
  message.linear.y = y;
  message.linear.z = z;
  message.angular.x = about_x;
  message.angular.y = about_y;
  message.angular.z = about_z;
  return message;
}

/// With max_speed 2 m/s and max_yaw_rate 1 rad/s.
Converted velocity(double forward, double turn) {
  return toCommand(twist(forward, 0.0, 0.0, 0.0, 0.0, turn), 2.0, 1.0);
}

CommandFormat withDecimals(int thrust_decimals) {
  CommandFormat format;
  format.thrust_decimals = thrust_decimals;
  return format;
}

CommandFormat inDegrees() {
  CommandFormat format;
  format.yaw_rate_in_degrees = true;
  return format;
}

CommandFormat byTable() {
  CommandFormat format;
  format.speed_table = {{0.5, 300.0}, {1.5, 900.0}};
  return format;
}

// --- What is sent ---

struct Bytes {
  const char* name;
  Converted command;
  const char* sentence;
  CommandFormat format = {};
};

void PrintTo(const Bytes& row, std::ostream* out) { *out << row.name; }

const Bytes kBytes[] = {
    // 90 - 0 + 1.42204
    {"heading_east", heading(0.0, kBoston), "$BPRMB,120000.250,91.4220,,,,,0*6B\r\n"},
    {"heading_north", heading(M_PI_2, kBoston), "$BPRMB,120000.250,1.4220,,,,,0*52\r\n"},
    // 90 - 180 + 1.42204 + 360
    {"heading_west", heading(M_PI, kBoston), "$BPRMB,120000.250,271.4220,,,,,0*57\r\n"},
    {"heading_south", heading(-M_PI_2, kBoston), "$BPRMB,120000.250,181.4220,,,,,0*5B\r\n"},
    // 90 - 57.29578 + 1.42204
    {"heading_one_radian", heading(1.0, kBoston), "$BPRMB,120000.250,34.1263,,,,,0*66\r\n"},
    // 90 - 229.18312 + 1.42204 + 360
    {"heading_beyond_pi", heading(4.0, kBoston), "$BPRMB,120000.250,222.2389,,,,,0*55\r\n"},
    // 90 + 572.95780 + 1.42204 - 360
    {"heading_beyond_minus_pi", heading(-10.0, kBoston), "$BPRMB,120000.250,304.3798,,,,,0*55\r\n"},
    // 90 - 0 + 0.71231
    {"heading_east_in_the_south", heading(0.0, kRio), "$BPRMB,120000.250,90.7123,,,,,0*69\r\n"},
    // 90 + 143.23945 + 0.71231
    {"heading_south_west_in_the_south", heading(-2.5, kRio),
     "$BPRMB,120000.250,233.9518,,,,,0*50\r\n"},
    // 90 - 114.59156 + 360
    {"heading_from_true_north", heading(2.0, kTrueNorth),
     "$BPRMB,120000.250,335.4084,,,,,0*5A\r\n"},
    // 90 - 90.0000057: 359.9999943 has no four decimals below 360
    {"heading_that_rounds_to_360", heading(M_PI_2 + 1e-7, kTrueNorth),
     "$BPRMB,120000.250,0.0000,,,,,0*57\r\n"},
    {"heading_just_east_of_north", heading(M_PI_2 - 1e-7, kTrueNorth),
     "$BPRMB,120000.250,0.0000,,,,,0*57\r\n"},
    // 90 - 90.0001 + 360
    {"heading_just_below_360", heading(90.0001 * M_PI / 180.0, kTrueNorth),
     "$BPRMB,120000.250,359.9999,,,,,0*58\r\n"},

    {"rudder_most", rudder(M_PI_2), "$BPRMB,120000.250,90.0000,,,,,1*6F\r\n"},
    {"rudder_least", rudder(-M_PI_2), "$BPRMB,120000.250,-90.0000,,,,,1*42\r\n"},
    {"rudder_to_port", rudder(-0.1), "$BPRMB,120000.250,-5.7296,,,,,1*74\r\n"},
    {"rudder_to_starboard", rudder(0.25), "$BPRMB,120000.250,14.3239,,,,,1*68\r\n"},
    {"rudder_amidships", rudder(0.0), "$BPRMB,120000.250,0.0000,,,,,1*56\r\n"},
    {"rudder_minus_zero", rudder(-0.0), "$BPRMB,120000.250,0.0000,,,,,1*56\r\n"},
    {"rudder_almost_minus_zero", rudder(-1e-9), "$BPRMB,120000.250,0.0000,,,,,1*56\r\n"},

    {"depth_surface", depth(0.0), "$BPRMB,120000.250,,0.000,0,,,*67\r\n"},
    {"depth_minus_zero", depth(-0.0), "$BPRMB,120000.250,,0.000,0,,,*67\r\n"},
    {"depth", depth(5.5), "$BPRMB,120000.250,,5.500,0,,,*67\r\n"},
    {"depth_most", depth(6000.0), "$BPRMB,120000.250,,6000.000,0,,,*51\r\n"},
    {"altitude_least", altitude(0.0), "$BPRMB,120000.250,,0.000,1,,,*66\r\n"},
    {"altitude", altitude(2.25), "$BPRMB,120000.250,,2.250,1,,,*63\r\n"},
    {"altitude_most", altitude(6000.0), "$BPRMB,120000.250,,6000.000,1,,,*50\r\n"},
    {"pitch_up", pitch(M_PI_2), "$BPRMB,120000.250,,90.000,2,,,*5C\r\n"},
    {"pitch_down", pitch(-0.2), "$BPRMB,120000.250,,-11.459,2,,,*70\r\n"},
    {"pitch_level", pitch(-0.0), "$BPRMB,120000.250,,0.000,2,,,*65\r\n"},
    {"elevator_down", elevator(-M_PI_2), "$BPRMB,120000.250,,-90.000,3,,,*70\r\n"},
    {"elevator_up", elevator(0.1), "$BPRMB,120000.250,,5.730,3,,,*65\r\n"},

    {"rpm_most", rpm(10000.0), "$BPRMB,120000.250,,,,10000.000,0,*66\r\n"},
    {"rpm_least", rpm(-10000.0), "$BPRMB,120000.250,,,,-10000.000,0,*4B\r\n"},
    {"rpm", rpm(333.25), "$BPRMB,120000.250,,,,333.250,0,*63\r\n"},
    {"rpm_minus_zero", rpm(-0.0), "$BPRMB,120000.250,,,,0.000,0,*67\r\n"},
    {"speed_most", metresPerSecond(10.0), "$BPRMB,120000.250,,,,10.000,1,*57\r\n"},
    {"speed_least", metresPerSecond(0.0), "$BPRMB,120000.250,,,,0.000,1,*66\r\n"},
    {"speed", metresPerSecond(1.25), "$BPRMB,120000.250,,,,1.250,1,*60\r\n"},
    // 300 + (900 - 300) * 0.25
    {"speed_by_table", metresPerSecond(0.75), "$BPRMB,120000.250,,,,450.000,0,*66\r\n", byTable()},
    {"everything", everything(), "$BPRMB,120000.250,91.4220,12.500,0,1.500,1,0*58\r\n"},
    {"nothing", toCommand(Behavior{}, {}), "$BPRMB,120000.250,,,,,,*79\r\n"},

    {"drive_edges", drive(1.0, -1.0), "$PYDIR,100,-100*7B\r\n"},
    {"drive_zero", drive(0.0, 0.0), "$PYDIR,0,0*56\r\n"},
    {"drive_minus_zero", drive(-0.0, -0.0), "$PYDIR,0,0*56\r\n"},
    {"drive_almost_minus_zero", drive(-0.004, 0.004), "$PYDIR,0,0*56\r\n"},
    {"drive_left_is_port", drive(-0.5, 0.25), "$PYDIR,-50,25*79\r\n"},
    {"drive_rounds", drive(0.336, -0.006), "$PYDIR,34,-1*4D\r\n"},
    {"drive_decimals", drive(0.1235, -0.004), "$PYDIR,12.35,-0.40*4A\r\n", withDecimals(2)},

    // Clockwise on the wire.
    {"helm", helm(0.5, 0.5), "$PYDEP,-0.5000,50*6B\r\n"},
    {"helm_zero", helm(0.0, 0.0), "$PYDEP,0.0000,0*76\r\n"},
    {"helm_minus_zero", helm(-0.0, -0.0), "$PYDEP,0.0000,0*76\r\n"},
    {"helm_edges", helm(-1.0, -M_PI), "$PYDEP,3.1416,-100*5B\r\n"},
    {"helm_other_edges", helm(1.0, M_PI), "$PYDEP,-3.1416,100*5B\r\n"},
    {"helm_decimals", helm(0.125, 0.25), "$PYDEP,-0.2500,12.5*74\r\n", withDecimals(1)},
    {"helm_degrees", helm(0.5, 0.5), "$PYDEP,-28.6479,50*58\r\n", inDegrees()},
    {"helm_degrees_edge", helm(0.0, -M_PI), "$PYDEP,180.0000,0*7F\r\n", inDegrees()},
    {"helm_degrees_zero", helm(0.0, 0.0), "$PYDEP,0.0000,0*76\r\n", inDegrees()},

    {"course_east", course(0.0, 1.25), "$PYDEV,90,1.250*7F\r\n"},
    {"course_north", course(M_PI_2, 1.25), "$PYDEV,0,1.250*46\r\n"},
    {"course_west", course(M_PI, 1.25), "$PYDEV,270,1.250*43\r\n"},
    {"course_south", course(-M_PI_2, 1.25), "$PYDEV,180,1.250*4F\r\n"},
    // 90 - 57.296 = 32.704
    {"course_one_radian", course(1.0, 1.25), "$PYDEV,33,1.250*76\r\n"},
    // 90 - 286.479 + 360 = 163.521
    {"course_beyond_pi", course(5.0, 1.25), "$PYDEV,164,1.250*45\r\n"},
    // 90 + 200.535 = 290.535
    {"course_beyond_minus_pi", course(-3.5, 1.25), "$PYDEV,291,1.250*4C\r\n"},
    // 90 - 359.6 deg
    {"course_359_6", course(-4.705407663376713, 10.0), "$PYDEV,0,10.000*71\r\n"},
    {"course_359_4", course(-4.7019170048727235, 10.0), "$PYDEV,359,10.000*7E\r\n"},
    {"course_0_4", course(1.5638150097869192, 10.0), "$PYDEV,0,10.000*71\r\n"},
    {"course_stop", course(0.0, -0.0), "$PYDEV,90,0.000*79\r\n"},
    // 32.704 + 1.422 = 34.126
    {"course_from_grid_north", course(1.0, 1.25, kBoston), "$PYDEV,34,1.250*71\r\n"},

    {"velocity", velocity(1.0, 0.5), "$PYDEP,-0.5000,50*6B\r\n"},
    {"velocity_zero", velocity(0.0, 0.0), "$PYDEP,0.0000,0*76\r\n"},
    {"velocity_minus_zero", velocity(-0.0, -0.0), "$PYDEP,0.0000,0*76\r\n"},
    {"velocity_astern", velocity(-0.5, -0.25), "$PYDEP,0.2500,-25*6B\r\n"},
    {"velocity_clamped", velocity(5.0, 7.0), "$PYDEP,-1.0000,100*5B\r\n"},
    {"velocity_clamped_astern", velocity(-1e300, -1e300), "$PYDEP,1.0000,-100*5B\r\n"},
    {"velocity_degrees", velocity(-0.5, 0.25), "$PYDEP,-14.3239,-25*7F\r\n", inDegrees()},
    {"velocity_other_axes", toCommand(twist(1.0, 9.0, 9.0, 9.0, 9.0, 0.5), 2.0, 1.0),
     "$PYDEP,-0.5000,50*6B\r\n"},
};

class ExactBytes : public testing::TestWithParam<Bytes> {};

TEST_P(ExactBytes, AsWorkedOutByHand) {
  const auto* command = std::get_if<vehicle::Command>(&GetParam().command);
  ASSERT_NE(command, nullptr) << std::get<std::string>(GetParam().command);
  constexpr std::chrono::milliseconds kNoon{12 * 3600 * 1000 + 250};
  nmea::SentenceWriter writer = session::commandSentence(*command, GetParam().format, {}, kNoon);
  EXPECT_EQ(writer.finish(), std::string_view{GetParam().sentence});
}

INSTANTIATE_TEST_SUITE_P(Table, ExactBytes, testing::ValuesIn(kBytes),
                         [](const auto& row) { return std::string{row.param.name}; });

// --- What is refused ---

struct Refusal {
  const char* name;
  Converted command;
  const char* message;
};

void PrintTo(const Refusal& row, std::ostream* out) { *out << row.name; }

const Refusal kRefusals[] = {
    {"yaw_nan", heading(kNan, 0.0), "horizontal is nan; a finite number is accepted"},
    {"yaw_infinite", heading(kInfinity, 0.0), "horizontal is inf; a finite number is accepted"},
    {"yaw_minus_infinite", heading(-kInfinity, 0.0),
     "horizontal is -inf; a finite number is accepted"},
    {"yaw_of_countless_turns", heading(1e307, 0.0),
     "horizontal is 1e+307; -1000000..1000000 is accepted"},
    {"yaw_without_position", heading(1.0, {}),
     "horizontal is a heading, and no position of the vehicle is known yet to tell how its grid "
     "north lies"},
    {"rudder_nan", rudder(kNan), "horizontal is nan; -1.570796327..1.570796327 is accepted"},
    {"rudder_infinite", rudder(kInfinity),
     "horizontal is inf; -1.570796327..1.570796327 is accepted"},
    {"rudder_above", rudder(1.5708), "horizontal is 1.5708; -1.570796327..1.570796327 is accepted"},
    {"rudder_below", rudder(-1.5708),
     "horizontal is -1.5708; -1.570796327..1.570796327 is accepted"},
    {"rudder_in_degrees", rudder(20.0), "horizontal is 20; -1.570796327..1.570796327 is accepted"},
    {"horizontal_mode", toCommand(horizontal(3, 0.0), 0.0),
     "horizontal_mode is 3; 0 (none), 1 (heading) or 2 (rudder) is accepted"},
    {"horizontal_mode_most", toCommand(horizontal(255, 0.0), 0.0),
     "horizontal_mode is 255; 0 (none), 1 (heading) or 2 (rudder) is accepted"},

    {"depth_nan", depth(kNan), "vertical is nan; 0..6000 is accepted"},
    {"depth_infinite", depth(kInfinity), "vertical is inf; 0..6000 is accepted"},
    {"depth_in_the_air", depth(-0.001), "vertical is -0.001; 0..6000 is accepted"},
    {"depth_below_all", depth(6000.001), "vertical is 6000.001; 0..6000 is accepted"},
    {"altitude_nan", altitude(kNan), "vertical is nan; 0..6000 is accepted"},
    {"altitude_below", altitude(-1.0), "vertical is -1; 0..6000 is accepted"},
    {"altitude_above", altitude(6001.0), "vertical is 6001; 0..6000 is accepted"},
    {"pitch_nan", pitch(kNan), "vertical is nan; -1.570796327..1.570796327 is accepted"},
    {"pitch_above", pitch(1.5708), "vertical is 1.5708; -1.570796327..1.570796327 is accepted"},
    {"pitch_below", pitch(-1.5708), "vertical is -1.5708; -1.570796327..1.570796327 is accepted"},
    {"elevator_infinite", elevator(-kInfinity),
     "vertical is -inf; -1.570796327..1.570796327 is accepted"},
    {"elevator_above", elevator(1.5708),
     "vertical is 1.5708; -1.570796327..1.570796327 is accepted"},
    {"elevator_below", elevator(-1.5708),
     "vertical is -1.5708; -1.570796327..1.570796327 is accepted"},
    {"vertical_mode", toCommand(vertical(5, 0.0), {}),
     "vertical_mode is 5; 0 (none), 1 (depth), 2 (altitude), 3 (pitch) or 4 (elevator) is "
     "accepted"},

    {"rpm_nan", rpm(kNan), "speed is nan; -10000..10000 is accepted"},
    {"rpm_above", rpm(10000.5), "speed is 10000.5; -10000..10000 is accepted"},
    {"rpm_below", rpm(-10000.5), "speed is -10000.5; -10000..10000 is accepted"},
    {"speed_nan", metresPerSecond(kNan), "speed is nan; 0..10 is accepted"},
    {"speed_infinite", metresPerSecond(kInfinity), "speed is inf; 0..10 is accepted"},
    {"speed_above", metresPerSecond(10.001), "speed is 10.001; 0..10 is accepted"},
    {"speed_below", metresPerSecond(-0.001), "speed is -0.001; 0..10 is accepted"},
    {"speed_mode", toCommand(speed(3, 0.0), {}),
     "speed_mode is 3; 0 (none), 1 (rpm) or 2 (speed) is accepted"},

    {"left_nan", drive(kNan, 0.0), "left is nan; -1..1 is accepted"},
    {"right_infinite", drive(0.0, kInfinity), "right is inf; -1..1 is accepted"},
    {"left_above", drive(1.0001, 0.0), "left is 1.0001; -1..1 is accepted"},
    {"left_below", drive(-1.0001, 0.0), "left is -1.0001; -1..1 is accepted"},
    {"right_above", drive(0.0, 1.0001), "right is 1.0001; -1..1 is accepted"},
    {"right_below", drive(0.0, -1.0001), "right is -1.0001; -1..1 is accepted"},
    {"drive_in_percent", drive(50.0, 50.0), "left is 50; -1..1 is accepted"},

    {"thrust_nan", helm(kNan, 0.0), "thrust is nan; -1..1 is accepted"},
    {"thrust_above", helm(1.0001, 0.0), "thrust is 1.0001; -1..1 is accepted"},
    {"thrust_below", helm(-1.0001, 0.0), "thrust is -1.0001; -1..1 is accepted"},
    {"yaw_rate_nan", helm(0.0, kNan), "yaw_rate is nan; -3.141592654..3.141592654 is accepted"},
    {"yaw_rate_above", helm(0.0, 3.1416),
     "yaw_rate is 3.1416; -3.141592654..3.141592654 is accepted"},
    {"yaw_rate_below", helm(0.0, -3.1416),
     "yaw_rate is -3.1416; -3.141592654..3.141592654 is accepted"},
    {"yaw_rate_infinite", helm(0.0, kInfinity),
     "yaw_rate is inf; -3.141592654..3.141592654 is accepted"},

    {"course_nan", course(kNan, 1.0), "yaw is nan; a finite number is accepted"},
    {"course_infinite", course(-kInfinity, 1.0), "yaw is -inf; a finite number is accepted"},
    {"course_speed_nan", course(0.0, kNan), "speed is nan; 0..10 is accepted"},
    {"course_speed_above", course(0.0, 10.001), "speed is 10.001; 0..10 is accepted"},
    {"course_speed_astern", course(0.0, -0.001), "speed is -0.001; 0..10 is accepted"},
    {"course_without_position", course(0.0, 1.0, {}),
     "yaw is a heading, and no position of the vehicle is known yet to tell how its grid north "
     "lies"},

    {"twist_forward_nan", velocity(kNan, 0.0), "linear.x is nan; a finite number is accepted"},
    {"twist_forward_infinite", velocity(kInfinity, 0.0),
     "linear.x is inf; a finite number is accepted"},
    {"twist_turn_infinite", velocity(0.0, -kInfinity),
     "angular.z is -inf; a finite number is accepted"},
    {"twist_left_nan", toCommand(twist(0.0, kNan, 0.0, 0.0, 0.0, 0.0), 2.0, 1.0),
     "linear.y is nan; a finite number is accepted"},
    {"twist_up_nan", toCommand(twist(0.0, 0.0, kNan, 0.0, 0.0, 0.0), 2.0, 1.0),
     "linear.z is nan; a finite number is accepted"},
    {"twist_roll_nan", toCommand(twist(0.0, 0.0, 0.0, kNan, 0.0, 0.0), 2.0, 1.0),
     "angular.x is nan; a finite number is accepted"},
    {"twist_pitch_nan", toCommand(twist(0.0, 0.0, 0.0, 0.0, kNan, 0.0), 2.0, 1.0),
     "angular.y is nan; a finite number is accepted"},
};

class RefusedCommand : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedCommand, NamesFieldValueAndRange) {
  const auto* message = std::get_if<std::string>(&GetParam().command);
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(*message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedCommand, testing::ValuesIn(kRefusals),
                         [](const auto& row) { return std::string{row.param.name}; });

/// An edge of a range: the value itself is taken, the next number beyond it is not.
struct Edge {
  const char* name;
  Converted (*command)(double);
  double value;
  double beyond;
};

void PrintTo(const Edge& row, std::ostream* out) { *out << row.name; }

const Edge kEdges[] = {
    {"rudder_most", rudder, M_PI_2, kInfinity},
    {"rudder_least", rudder, -M_PI_2, -kInfinity},
    {"depth_least", depth, 0.0, -kInfinity},
    {"depth_most", depth, 6000.0, kInfinity},
    {"altitude_least", altitude, 0.0, -kInfinity},
    {"altitude_most", altitude, 6000.0, kInfinity},
    {"pitch_most", pitch, M_PI_2, kInfinity},
    {"pitch_least", pitch, -M_PI_2, -kInfinity},
    {"elevator_most", elevator, M_PI_2, kInfinity},
    {"elevator_least", elevator, -M_PI_2, -kInfinity},
    {"rpm_most", rpm, 10000.0, kInfinity},
    {"rpm_least", rpm, -10000.0, -kInfinity},
    {"speed_most", metresPerSecond, 10.0, kInfinity},
    {"speed_least", metresPerSecond, 0.0, -kInfinity},
    {"left_most", [](double value) { return drive(value, 0.0); }, 1.0, kInfinity},
    {"left_least", [](double value) { return drive(value, 0.0); }, -1.0, -kInfinity},
    {"right_most", [](double value) { return drive(0.0, value); }, 1.0, kInfinity},
    {"right_least", [](double value) { return drive(0.0, value); }, -1.0, -kInfinity},
    {"thrust_most", [](double value) { return helm(value, 0.0); }, 1.0, kInfinity},
    {"thrust_least", [](double value) { return helm(value, 0.0); }, -1.0, -kInfinity},
    {"yaw_rate_most", [](double value) { return helm(0.0, value); }, M_PI, kInfinity},
    {"yaw_rate_least", [](double value) { return helm(0.0, value); }, -M_PI, -kInfinity},
    {"course_speed_most", [](double value) { return course(0.0, value); }, 10.0, kInfinity},
    {"course_speed_least", [](double value) { return course(0.0, value); }, 0.0, -kInfinity},
};

class RangeEdge : public testing::TestWithParam<Edge> {};

TEST_P(RangeEdge, IsTakenAndTheNextNumberIsNot) {
  const Edge& edge = GetParam();
  EXPECT_TRUE(std::holds_alternative<vehicle::Command>(edge.command(edge.value)));
  const double outside = std::nextafter(edge.value, edge.beyond);
  EXPECT_TRUE(std::holds_alternative<std::string>(edge.command(outside)));
}

INSTANTIATE_TEST_SUITE_P(Table, RangeEdge, testing::ValuesIn(kEdges),
                         [](const auto& row) { return std::string{row.param.name}; });

// What is left alone has no range, but a command with NaN or infinity is refused whole.
TEST(CommandConvert, ValuesOfAspectsLeftAloneMustBeFinite) {
  Behavior message;
  message.speed = -1e300;
  EXPECT_TRUE(std::holds_alternative<vehicle::Command>(toCommand(message, {})));
  message.horizontal = kNan;
  EXPECT_EQ(std::get<std::string>(toCommand(message, {})),
            "horizontal is nan; a finite number is accepted");
  message.horizontal = 0.0;
  message.vertical = kInfinity;
  EXPECT_EQ(std::get<std::string>(toCommand(message, {})),
            "vertical is inf; a finite number is accepted");
}

// The whole command goes, whichever part is wrong.
TEST(CommandConvert, OneWrongFieldRefusesAll) {
  Behavior message = horizontal(Behavior::HORIZONTAL_HEADING, 0.0);
  message.vertical_mode = Behavior::VERTICAL_DEPTH;
  message.vertical = 5.0;
  message.speed_mode = Behavior::SPEED_SPEED;
  message.speed = kNan;
  EXPECT_EQ(std::get<std::string>(toCommand(message, 0.0)), "speed is nan; 0..10 is accepted");
}

struct Age {
  const char* name;
  double stamp_s;  ///< 0: none
  const char* refusal;
};

const Age kAges[] = {
    {"without_a_stamp", 0.0, ""},
    {"just_made", 100.0, ""},
    {"at_the_limit", 99.5, ""},
    {"beyond_it", 99.484375,
     "header.stamp is 0.516 s old; at most 0.500 s (max_command_age) is accepted"},
    {"of_another_day", 1.0,
     "header.stamp is 99.000 s old; at most 0.500 s (max_command_age) is accepted"},
    {"by_a_clock_that_is_ahead", 100.5, ""},
    {"by_one_further_ahead", 100.515625,
     "header.stamp is 0.516 s ahead of this computer's clock; at most 0.500 s (max_command_age) is "
     "accepted"},
    {"the_last_that_ros_knows", 4294967295.0,
     "header.stamp is 4294967195.000 s ahead of this computer's clock; at most 0.500 s "
     "(max_command_age) is accepted"},
};

class BehaviorAge : public testing::TestWithParam<Age> {};

TEST_P(BehaviorAge, IsTakenFromTheStamp) {
  Behavior message;
  message.header.stamp = ros::Time{GetParam().stamp_s};
  EXPECT_EQ(tooOld(message, ros::Time{100.0}, std::chrono::milliseconds{500}), GetParam().refusal);
}

INSTANTIATE_TEST_SUITE_P(Table, BehaviorAge, testing::ValuesIn(kAges),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::ros_layer
