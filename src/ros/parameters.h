#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/session/nmea_session.h"
#include "frontseat_driver/vehicle/event.h"
#include "private_parameters.h"

namespace frontseat_driver::ros_layer {

/// Where sentences come from: the vehicle, or a recorded topic.
enum class Source { Tcp, Topic };

/// Which north the vehicle's headings count from.
enum class HeadingReference { Grid, True };

/// What the stamps of messages tell.
enum class StampMode { Synced, Vehicle, Receive };

/// The unit of PYDEP's rate of turn.
enum class YawRateUnit { Rad, Deg };

/// How CPRCM counts heading and pitch.
enum class CompassConvention { Spec, Heron };

/// The unit of the accelerations in the vehicle's IMU sentence.
enum class AccelerationUnit { MetersPerSecondSquared, StandardGravity };

/// What one propeller speed gives.
struct SpeedPoint {
  double speed_m_s = 0.0;
  double rpm = 0.0;
};

/// Everything the user can set, with the defaults of the README's table.
struct Parameters {
  link::TcpClient::Options link;  ///< host, port, connect_timeout, reconnect_*, silence_timeout
  session::NmeaOptions session;   ///< dialect, interface_version, log_sentences, use_acks,
                                  ///< commands_enabled, control_hook, send_spacing
  Source source = Source::Tcp;

  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_tf = true;
  bool publish_frd_frames = true;

  std::optional<vehicle::Position> datum;             ///< empty: the first valid position
  std::optional<HeadingReference> heading_reference;  ///< empty: by dialect
  StampMode stamp = StampMode::Synced;
  std::optional<std::chrono::seconds> leap_seconds;  ///< GPS - UTC; empty: by dialect

  std::chrono::nanoseconds command_timeout{std::chrono::seconds(1)};
  std::chrono::nanoseconds max_command_age{std::chrono::milliseconds(500)};
  double command_rate_hz = 5.0;
  int thrust_decimals = 0;
  YawRateUnit yaw_rate_unit = YawRateUnit::Rad;
  std::vector<SpeedPoint> speed_table;  ///< strictly increasing in both; empty: speeds go as m/s
  double max_speed_m_s = 2.0;
  double max_yaw_rate_rad_s = 1.0;
  bool fill_behavior_fields = false;
  std::chrono::nanoseconds ack_timeout{std::chrono::seconds(3)};
  std::chrono::nanoseconds effect_timeout{std::chrono::seconds(10)};
  double status_rate_hz = 1.0;  ///< 0: none
  bool allow_raw_sentences = false;

  double max_jump_m_s = 50.0;
  std::chrono::nanoseconds max_data_age{std::chrono::seconds(2)};
  double battery_low_v = 13.2;  ///< 12 NiMH cells at 1.1 V or 4 Li-ion at 3.3 V; 0: never low
  double magnetic_declination_rad = 0.0;  ///< east positive
  CompassConvention compass_convention = CompassConvention::Spec;
  AccelerationUnit acceleration_unit = AccelerationUnit::MetersPerSecondSquared;

  double position_stddev_gps_m = 3.0;
  double position_stddev_dead_reckoning_m = 30.0;
  double depth_stddev_m = 0.1;
  double orientation_stddev_rad = 0.05;
  double velocity_stddev_m_s = 0.1;
  double angular_rate_stddev_rad_s = 0.02;
  double acceleration_stddev_m_s2 = 0.1;
};

/// Reads every parameter; throws ParameterError for the first that cannot be used. `private_params`
/// as ros::NodeHandle::getParam("", value) gives the private namespace.
Parameters readParameters(const XmlRpc::XmlRpcValue& private_params);

/// One line for every private parameter that nobody reads: "parameter hosst is not known; did you
/// mean host?". Throws nothing.
std::vector<std::string> unknownParameterWarnings(const XmlRpc::XmlRpcValue& private_params);

}  // namespace frontseat_driver::ros_layer
