#pragma once

#include <variant>

#include "frontseat_driver/vehicle/event.h"
#include "message_builder.h"
#include "parameters.h"

namespace frontseat_driver::ros_layer {

/// A topic that is fed by the vehicle's sentences.
enum class VehicleTopic {
  Odom,
  Transform,
  ImuData,
  ImuDataRaw,
  CompassData,
  NavFix,
  NavVelocity,
  Depth,
  Altitude,
  Battery,
  GpsFix,
  GpsVelocity,
  GpsTimeReference,
  VehicleTime,
  MissionStatus,
  Control,
  InterfaceVersion,
  Shutdown,
  Ack,
  Count
};

/// Any message that the vehicle's sentences become.
using VehicleMessage =
    std::variant<nav_msgs::Odometry, geometry_msgs::TransformStamped, sensor_msgs::Imu,
                 sensor_msgs::NavSatFix, geometry_msgs::TwistStamped,
                 geometry_msgs::PoseWithCovarianceStamped, sensor_msgs::Range,
                 sensor_msgs::BatteryState, sensor_msgs::TimeReference, MissionStatus,
                 ControlStatus, InterfaceVersion, ShutdownNotice, CommandAck>;

/// Where messages go.
class MessageOutlet {
 public:
  virtual ~MessageOutlet() = default;
  /// False: the message need not be built.
  virtual bool wanted(VehicleTopic topic) const = 0;
  virtual void publish(VehicleTopic topic, VehicleMessage message) = 0;
};

/// Turns each event into all messages that come of it, in the order they are published. A message
/// that nobody wants is not even built. Knows no publisher, so that it runs without a ROS master.
class VehicleMessages {
 public:
  explicit VehicleMessages(const Parameters& parameters) : builder_(parameters) {}

  void take(const vehicle::Now& arrival, const vehicle::Event& event, MessageOutlet& outlet);

  MessageBuilder& builder() { return builder_; }
  const MessageBuilder& builder() const { return builder_; }

 private:
  MessageBuilder builder_;
};

}  // namespace frontseat_driver::ros_layer
