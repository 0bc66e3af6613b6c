// What the parameters of a Blueye accept.

#include "blueye/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <initializer_list>
#include <string>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using namespace std::chrono_literals;

std::string errorOf(const std::string& host) {
  XmlRpc::XmlRpcValue parameters;
  parameters["host"] = host;
  try {
    readParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BlueyeHost, IsANameOrAnAddress) {
  for (const char* host : {"192.168.1.101", "localhost", "blueye-x3.local", "my_drone", "::1",
                           "[::1]", "fe80::1%eth0", "drone.example.org."}) {
    EXPECT_EQ(errorOf(host), "accepted") << host;
  }
}

TEST(BlueyeHost, IsRefusedWhenZeroMqWouldReadMoreIntoIt) {
  for (const char* host :
       {"tcp://192.168.1.101", "192.168.1.101:5555", "drone:5555", "a;b", "*", "a/b", "user@drone",
        "[::1]:5555", "[::1", "::1]", "::g", "", "two words", "d\xc3\xb8ne"}) {
    EXPECT_THAT(errorOf(host), testing::HasSubstr("a host name or an address")) << host;
  }
}

XmlRpc::XmlRpcValue with(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue out;
  out[name] = value;
  return out;
}

/// Empty if they are accepted.
std::string refusalOf(const XmlRpc::XmlRpcValue& parameters) {
  try {
    readParameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return {};
}

TEST(BlueyeHost, IsNoLongerThanANameMayBe) {
  EXPECT_EQ(errorOf(std::string(255, 'a')), "accepted");
  EXPECT_NE(errorOf(std::string(256, 'a')), "accepted");
  EXPECT_NE(errorOf("[]"), "accepted");
  EXPECT_NE(errorOf("fe80::1%"), "accepted");
}

TEST(BlueyeParameters, DefaultsAreThoseOfTheInterface) {
  const Parameters read = readParameters({});
  EXPECT_FALSE(read.session.water_density_kg_m3);
  EXPECT_EQ(read.publisher.navigation.conventions.water_density_kg_m3, 1025.0);
  EXPECT_FALSE(read.session.listen_only);
  EXPECT_FALSE(read.publisher.navigation.datum);
  EXPECT_TRUE(read.session.rates_hz.empty());
  EXPECT_EQ(read.full_speed.surge_m_s, 1.0);
  EXPECT_EQ(read.full_speed.sway_m_s, 0.5);
  EXPECT_EQ(read.full_speed.heave_m_s, 0.5);
  EXPECT_EQ(read.full_speed.yaw_rate_rad_s, 1.0);
}

TEST(BlueyeParameters, DefaultsOfTheConversationAreThoseOfTheInterface) {
  const session::BlueyeOptions read = readParameters({}).session;
  EXPECT_EQ(read.client_name, "frontseat_driver");
  EXPECT_TRUE(read.observer);
  EXPECT_TRUE(read.commands_enabled);
  EXPECT_TRUE(read.sync_time);
  EXPECT_TRUE(read.clockwise_yaw);
  EXPECT_EQ(read.pinger_mounting, session::PingerMounting::Unset);
  EXPECT_FALSE(read.allow_format);
  EXPECT_FALSE(read.allow_flash);
  EXPECT_EQ(read.command_timeout, 1s);
  EXPECT_EQ(read.command_rate_hz, 10.0);
  EXPECT_EQ(read.request_timeout, 2s);
  EXPECT_EQ(read.control_timeout, 1s);
}

TEST(BlueyeParameters, DefaultsOfTheLinkAreThoseOfTheInterface) {
  const link::ZmqClient::Options read = readParameters({}).link;
  EXPECT_EQ(read.host, "192.168.1.101");
  EXPECT_EQ(read.telemetry_port, 5555);
  EXPECT_EQ(read.request_port, 5556);
  EXPECT_EQ(read.control_port, 5557);
  EXPECT_EQ(read.connect_timeout, 2s);
  EXPECT_EQ(read.reconnect_min, 500ms);
  EXPECT_EQ(read.reconnect_max, 10s);
  EXPECT_EQ(read.silence_timeout, 5s);
}

TEST(BlueyeParameters, WhatIsSentAndWhatIsToldOfYawHaveOneSign) {
  XmlRpc::XmlRpcValue values;
  values["yaw_positive"] = "left";
  const Parameters read = readParameters(values);
  EXPECT_FALSE(read.session.clockwise_yaw);
  EXPECT_FALSE(read.publisher.navigation.conventions.yaw_clockwise);
}

TEST(BlueyeParameters, DefaultsOfTheConversionsAreThoseOfTheInterface) {
  const NavigationOptions read = readParameters({}).publisher.navigation;
  EXPECT_TRUE(read.conventions.yaw_clockwise);
  EXPECT_TRUE(read.conventions.dvl_y_right);
  EXPECT_EQ(read.conventions.accelerometer_sign, AccelerometerSign::Auto);
  EXPECT_TRUE(read.conventions.battery_discharge_negative);
  EXPECT_TRUE(read.conventions.heave_velocity_down);
  EXPECT_TRUE(read.conventions.bearings_clockwise);
  EXPECT_TRUE(read.conventions.multibeam_tilt_up);
  EXPECT_EQ(read.conventions.add_declination_rad, 0.0);
  EXPECT_EQ(read.conventions.servo_min_rad, -0.7853981633974483);
  EXPECT_EQ(read.conventions.servo_max_rad, 0.7853981633974483);
  EXPECT_EQ(read.max_speed_m_s, 5.0);
  EXPECT_EQ(read.max_data_age, 2s);
  EXPECT_EQ(read.deviations.depth_m, 0.1);
  EXPECT_EQ(read.deviations.orientation_rad, 0.05);
  EXPECT_EQ(read.deviations.velocity_m_s, 0.1);
  EXPECT_EQ(read.deviations.angular_rate_rad_s, 0.02);
  EXPECT_EQ(read.deviations.acceleration_m_s2, 0.1);
}

struct Limits {
  const char* name;
  double lowest, highest;  ///< that are accepted
  double below, above;     ///< that are not
};

const Limits kLimits[] = {
    {"water_density", 900.0, 1300.0, 899.0, 1301.0},
    {"add_declination", -3.1415, 3.1415, -3.1417, 3.1417},
    {"servo_min", -3.1415, 0.78, -3.1417, 3.1417},
    {"servo_max", -0.78, 3.1415, -3.1417, 3.1417},
    {"max_surge", 0.01, 10.0, 0.0, 10.1},
    {"max_sway", 0.01, 10.0, 0.0, 10.1},
    {"max_heave", 0.01, 10.0, 0.0, 10.1},
    {"max_yaw_rate", 0.01, 10.0, 0.0, 10.1},
    {"max_jump", 0.01, 1e6, 0.0, 1.01e6},
    {"max_data_age", 0.01, 3600.0, 0.0, 3601.0},
    {"connect_timeout", 0.01, 3600.0, 0.0, 3601.0},
    {"silence_timeout", 0.01, 3600.0, 0.0, 3601.0},
    {"depth_stddev", 0.001, 1000.0, 0.0, 1001.0},
    {"command_rate", 1.0, 30.0, 0.99, 30.1},
};

class BlueyeLimits : public testing::TestWithParam<Limits> {};

TEST_P(BlueyeLimits, AreAcceptedAndNothingBeyond) {
  const Limits& row = GetParam();
  for (const double good : {row.lowest, row.highest}) {
    EXPECT_EQ(refusalOf(with(row.name, good)), "") << good;
  }
  for (const double wrong : {row.below, row.above}) {
    EXPECT_THAT(refusalOf(with(row.name, wrong)), testing::HasSubstr(row.name)) << wrong;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BlueyeLimits, testing::ValuesIn(kLimits),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(BlueyeParameters, EachFullSpeedIsItsOwn) {
  XmlRpc::XmlRpcValue given;
  given["max_surge"] = 2.0;
  given["max_sway"] = 3.0;
  given["max_heave"] = 4.0;
  given["max_yaw_rate"] = 5.0;
  const FullSpeed read = readParameters(given).full_speed;
  EXPECT_EQ(read.surge_m_s, 2.0);
  EXPECT_EQ(read.sway_m_s, 3.0);
  EXPECT_EQ(read.heave_m_s, 4.0);
  EXPECT_EQ(read.yaw_rate_rad_s, 5.0);
}

TEST(BlueyeParameters, WhatHasToFitTogetherDoes) {
  XmlRpc::XmlRpcValue waits;
  waits["reconnect_min"] = 2.0;
  waits["reconnect_max"] = 2.0;
  EXPECT_EQ(refusalOf(waits), "");
  waits["reconnect_max"] = 1.0;
  EXPECT_THAT(refusalOf(waits), testing::HasSubstr("reconnect_min up to reconnect_max"));
  XmlRpc::XmlRpcValue servo;
  servo["servo_min"] = 0.5;
  servo["servo_max"] = 0.5;
  EXPECT_THAT(refusalOf(servo), testing::HasSubstr("an angle above servo_min"));
  servo["servo_min"] = 3.0;
  servo["servo_max"] = 3.1;
  EXPECT_EQ(refusalOf(servo), "");
  servo["servo_min"] = -3.1;
  servo["servo_max"] = -3.0;
  EXPECT_EQ(refusalOf(servo), "");
  EXPECT_THAT(refusalOf(with("base_frame", "odom")), testing::HasSubstr("other than odom_frame"));
  EXPECT_THAT(refusalOf(with("map_frame", "odom")), testing::HasSubstr("other than odom_frame"));
  EXPECT_THAT(refusalOf(with("odom_frame", "two words")), testing::HasSubstr("without blanks"));
}

TEST(BlueyeParameters, ARecordIsListenedToAndADensityIsThatOfTheConversions) {
  EXPECT_TRUE(readParameters(with("source", "topic")).session.listen_only);
  EXPECT_FALSE(readParameters(with("source", "zmq")).session.listen_only);
  const Parameters read = readParameters(with("water_density", 1000.0));
  EXPECT_EQ(*read.session.water_density_kg_m3, 1000.0);
  EXPECT_EQ(read.publisher.navigation.conventions.water_density_kg_m3, 1000.0);
}

XmlRpc::XmlRpcValue listOf(std::initializer_list<double> numbers) {
  XmlRpc::XmlRpcValue out;
  out.setSize(static_cast<int>(numbers.size()));
  int i = 0;
  for (const double number : numbers) out[i++] = number;
  return out;
}

TEST(BlueyeParameters, ADatumIsALatitudeAndALongitude) {
  const auto read = readParameters(with("datum", listOf({63.5, 100.0}))).publisher.navigation.datum;
  EXPECT_EQ(read->latitude_deg, 63.5);
  EXPECT_EQ(read->longitude_deg, 100.0);
  EXPECT_EQ(refusalOf(with("datum", listOf({-90.0, -180.0}))), "");
  for (const auto& wrong : {listOf({91.0, 0.0}), listOf({-91.0, 0.0}), listOf({0.0, 181.0}),
                            listOf({0.0, -181.0}), listOf({1.0}), listOf({1.0, 2.0, 3.0})}) {
    EXPECT_THAT(refusalOf(with("datum", wrong)), testing::HasSubstr("datum"));
  }
}

TEST(BlueyeParameters, RatesAreOfTelemetryAndUpTo100Hz) {
  XmlRpc::XmlRpcValue given;
  given["DepthTel"] = 40.5;
  given["BatteryTel"] = 0;
  given["ImuTel"] = 100.0;
  const auto read = readParameters(with("rates", given)).session.rates_hz;
  EXPECT_EQ(read.at("DepthTel"), 40.5);
  EXPECT_EQ(read.at("BatteryTel"), 0.0);
  EXPECT_EQ(read.at("ImuTel"), 100.0);
  EXPECT_EQ(refusalOf(with("rates", with("DepthTel", 0.5))), "");
  for (const auto& wrong :
       {with("DepthTel", -0.5), with("DepthTel", 100.5), with("DepthTel", -1), with("Depth", 1.0),
        with("Tel", 1.0), with("DepthTel", "fast"), XmlRpc::XmlRpcValue(1.0)}) {
    EXPECT_THAT(refusalOf(with("rates", wrong)), testing::HasSubstr("names of telemetry messages"));
  }
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
