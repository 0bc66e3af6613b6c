#pragma once

#include <frontseat_driver/LinkStatus.h>
#include <ros/node_handle.h>
#include <ros/publication.h>
#include <ros/publisher.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/vehicle/event.h"
#include "parameters.h"
#include "vehicle_messages.h"

namespace frontseat_driver::ros_layer {

/// Puts what the vehicle tells on its topics. A message nobody subscribes to is not even built,
/// except what is latched. Not safe for concurrent use: one thread tells it everything.
class VehiclePublisher : private MessageOutlet {
 public:
  VehiclePublisher(ros::NodeHandle node, const Parameters& parameters);

  void setDialect(protocol::Dialect dialect) { messages_.builder().setDialect(dialect); }

  void setDatum(const vehicle::Position& datum) { messages_.builder().setDatum(datum); }

  /// Time starts again, as in a replay that is repeated.
  void reset() { messages_.builder().reset(); }

  /// A restarted driver takes over, as in a replay of two.
  void startAfresh() { messages_.builder().startAfresh(); }

  void publish(const vehicle::Now& arrival, const vehicle::Event& event) {
    messages_.take(arrival, event, *this);
  }

  /// `connection` tells a record's connections apart.
  void publishReceived(const vehicle::Now& now, const std::string& connection,
                       std::string_view line) const;
  void publishSent(const vehicle::Now& now, const std::string& connection,
                   std::string_view line) const;
  void publishLink(const LinkStatus& status) const { link_.publish(status); }

  const MessageBuilder& builder() const { return messages_.builder(); }

  /// Every publisher there is.
  std::vector<ros::Publisher> publishers() const;

  /// See MessageBuilder.
  std::chrono::nanoseconds takeHeldBack() { return messages_.builder().takeHeldBack(); }

 private:
  static constexpr auto kTopics = static_cast<std::size_t>(VehicleTopic::Count);

  /// An advertised topic that can tell for each sentence whether somebody subscribes to it. To ask
  /// the publisher costs five times as much (callgrind): it looks the topic up by name, under a
  /// lock that the thread which sends the messages takes, too.
  struct Topic {
    Topic() = default;
    explicit Topic(const ros::Publisher& advertised);
    bool hasSubscribers() const { return publication && publication->hasSubscribers(); }

    ros::Publisher publisher;
    ros::PublicationPtr publication;
  };

  bool wanted(VehicleTopic topic) const override;
  void publish(VehicleTopic topic, VehicleMessage message) override;
  Topic& at(VehicleTopic topic) { return topics_[static_cast<std::size_t>(topic)]; }
  const Topic& at(VehicleTopic topic) const { return topics_[static_cast<std::size_t>(topic)]; }

  VehicleMessages messages_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::array<Topic, kTopics> topics_;
  ros::Publisher link_;
  Topic received_;
  Topic sent_;
};

}  // namespace frontseat_driver::ros_layer
