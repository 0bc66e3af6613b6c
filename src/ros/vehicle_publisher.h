#pragma once

#include <frontseat_driver/LinkStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string_view>

#include "frontseat_driver/vehicle/event.h"
#include "message_builder.h"
#include "parameters.h"

namespace frontseat_driver::ros_layer {

/// Puts what the vehicle tells on its topics. A message nobody subscribes to is not even built,
/// except what is latched and tf. Not safe for concurrent use: one thread tells it everything.
class VehiclePublisher {
 public:
  VehiclePublisher(ros::NodeHandle node, const Parameters& parameters);

  void setDialect(protocol::Dialect dialect) { builder_.setDialect(dialect); }

  void setDatum(const vehicle::Position& datum) { builder_.setDatum(datum); }

  /// Time starts again, as in a replay that is repeated.
  void reset() { builder_.reset(); }

  void publish(const vehicle::Now& arrival, const vehicle::Event& event);
  void publishReceived(const vehicle::Now& now, std::string_view line) const;
  void publishSent(const vehicle::Now& now, std::string_view line) const;
  void publishLink(const LinkStatus& status) const { link_.publish(status); }

  const MessageBuilder& builder() const { return builder_; }

 private:
  void take(const vehicle::Now& arrival, const vehicle::ClockSample& clock);
  void take(const vehicle::Now& arrival, const vehicle::Navigation& navigation);
  void take(const vehicle::Now& arrival, const vehicle::Velocity& velocity);
  void take(const vehicle::Now& arrival, const vehicle::RawImu& imu);
  void take(const vehicle::Now& arrival, const vehicle::Compass& compass);
  void take(const vehicle::Now& arrival, const vehicle::Battery& battery);
  void take(const vehicle::Now& arrival, const vehicle::GpsFix& fix);
  void take(const vehicle::Now& arrival, const vehicle::GpsVelocity& velocity);
  void take(const vehicle::Now& arrival, const vehicle::MissionStatus& mission);
  void take(const vehicle::Now& arrival, const vehicle::Control& control);
  void take(const vehicle::Now& arrival, const vehicle::Acknowledgement& ack);
  void take(const vehicle::Now& arrival, const vehicle::InterfaceVersion& version);
  void take(const vehicle::Now& arrival, const vehicle::Shutdown& shutdown);
  void publishOdometry();

  MessageBuilder builder_;
  const bool publish_tf_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;

  ros::Publisher odom_;
  ros::Publisher imu_;
  ros::Publisher raw_imu_;
  ros::Publisher compass_;
  ros::Publisher nav_fix_;
  ros::Publisher nav_velocity_;
  ros::Publisher depth_;
  ros::Publisher altitude_;
  ros::Publisher battery_;
  ros::Publisher gps_fix_;
  ros::Publisher gps_velocity_;
  ros::Publisher gps_time_;
  ros::Publisher vehicle_time_;
  ros::Publisher mission_status_;
  ros::Publisher control_;
  ros::Publisher interface_version_;
  ros::Publisher shutdown_;
  ros::Publisher ack_;
  ros::Publisher link_;
  ros::Publisher received_;
  ros::Publisher sent_;
};

}  // namespace frontseat_driver::ros_layer
