#include "vehicle_publisher.h"

#include <frontseat_driver/Sentence.h>
#include <ros/topic_manager.h>
#include <tf2_msgs/TFMessage.h>

#include <boost/make_shared.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

// After a network has held a vehicle back for some seconds, hundreds of sentences come at once:
// shorter queues lose some.
constexpr std::uint32_t kQueue = 1000;
// The record must miss nothing at any rate a vehicle can send: half a second at 20,000 a second.
constexpr std::uint32_t kRecordQueue = 10000;
// A record may be played as fast as it can be read, and then all must wait for who is slowest.
constexpr std::uint32_t kUnlimited = 0;

bool isLatched(VehicleTopic topic) {
  return topic == VehicleTopic::MissionStatus || topic == VehicleTopic::Control ||
         topic == VehicleTopic::InterfaceVersion || topic == VehicleTopic::Shutdown;
}

// Shared, so that a nodelet in the same manager gets it without a copy.
template <class Message>
void publishShared(const ros::Publisher& publisher, Message&& message) {
  using Value = std::decay_t<Message>;
  publisher.publish(boost::make_shared<const Value>(std::forward<Message>(message)));
}

void publishSentence(const ros::Publisher& publisher, const vehicle::Now& now,
                     const std::string& connection, std::string_view line) {
  Sentence sentence;
  sentence.header.stamp = toRosTime(now.stamp);
  sentence.header.frame_id = connection;
  sentence.sentence = std::string{line};
  publishShared(publisher, std::move(sentence));
}

}  // namespace

VehiclePublisher::Topic::Topic(const ros::Publisher& advertised)
    : publisher(advertised),
      publication(ros::TopicManager::instance()->lookupPublication(advertised.getTopic())) {}

VehiclePublisher::VehiclePublisher(ros::NodeHandle node, const Parameters& parameters)
    : messages_(parameters) {
  const bool replay = parameters.source == Source::Topic;
  const std::uint32_t queue = replay ? kUnlimited : kQueue;
  const auto advertise = [&](VehicleTopic topic, const char* name, auto message) {
    at(topic) = Topic{node.advertise<decltype(message)>(name, queue, isLatched(topic))};
  };
  advertise(VehicleTopic::Odom, topics::kOdom, nav_msgs::Odometry{});
  advertise(VehicleTopic::ImuData, topics::kImuData, sensor_msgs::Imu{});
  advertise(VehicleTopic::ImuDataRaw, topics::kImuDataRaw, sensor_msgs::Imu{});
  advertise(VehicleTopic::CompassData, topics::kCompassData, sensor_msgs::Imu{});
  advertise(VehicleTopic::NavFix, topics::kNavFix, sensor_msgs::NavSatFix{});
  advertise(VehicleTopic::NavVelocity, topics::kNavVelocity, geometry_msgs::TwistStamped{});
  advertise(VehicleTopic::Depth, topics::kDepth, geometry_msgs::PoseWithCovarianceStamped{});
  advertise(VehicleTopic::Altitude, topics::kAltitude, sensor_msgs::Range{});
  advertise(VehicleTopic::Battery, topics::kBattery, sensor_msgs::BatteryState{});
  advertise(VehicleTopic::GpsFix, topics::kGpsFix, sensor_msgs::NavSatFix{});
  advertise(VehicleTopic::GpsVelocity, topics::kGpsVelocity, geometry_msgs::TwistStamped{});
  advertise(VehicleTopic::GpsTimeReference, topics::kGpsTimeReference,
            sensor_msgs::TimeReference{});
  advertise(VehicleTopic::VehicleTime, topics::kVehicleTime, sensor_msgs::TimeReference{});
  advertise(VehicleTopic::MissionStatus, topics::kMissionStatus, MissionStatus{});
  advertise(VehicleTopic::Control, topics::kControl, ControlStatus{});
  advertise(VehicleTopic::InterfaceVersion, topics::kInterfaceVersion, InterfaceVersion{});
  advertise(VehicleTopic::Shutdown, topics::kShutdown, ShutdownNotice{});
  advertise(VehicleTopic::Ack, topics::kAck, CommandAck{});
  if (parameters.publish_tf) advertise(VehicleTopic::Transform, "/tf", tf2_msgs::TFMessage{});
  link_ = node.advertise<LinkStatus>(topics::kLink, queue, true);
  const std::uint32_t record_queue = replay ? kUnlimited : kRecordQueue;
  received_ = Topic{node.advertise<Sentence>(topics::kNmeaReceived, record_queue)};
  sent_ = Topic{node.advertise<Sentence>(topics::kNmeaSent, record_queue)};
  if (!parameters.publish_frd_frames) return;
  vehicle::Now now;
  now.stamp = toUtcTime(ros::Time::now());
  const auto frames = builder().helperFrames(now);
  static_transforms_.sendTransform(
      std::vector<geometry_msgs::TransformStamped>(frames.begin(), frames.end()));
}

bool VehiclePublisher::wanted(VehicleTopic topic) const {
  return isLatched(topic) || at(topic).hasSubscribers();
}

void VehiclePublisher::publish(VehicleTopic topic, VehicleMessage message) {
  if (auto* transform = std::get_if<geometry_msgs::TransformStamped>(&message)) {
    tf2_msgs::TFMessage transforms;
    transforms.transforms.push_back(std::move(*transform));
    return publishShared(at(topic).publisher, std::move(transforms));
  }
  const ros::Publisher& publisher = at(topic).publisher;
  std::visit([&](auto& any) { publishShared(publisher, std::move(any)); }, message);
}

void VehiclePublisher::publishReceived(const vehicle::Now& now, const std::string& connection,
                                       std::string_view line) const {
  if (received_.hasSubscribers()) publishSentence(received_.publisher, now, connection, line);
}

void VehiclePublisher::publishSent(const vehicle::Now& now, const std::string& connection,
                                   std::string_view line) const {
  if (sent_.hasSubscribers()) publishSentence(sent_.publisher, now, connection, line);
}

std::vector<ros::Publisher> VehiclePublisher::publishers() const {
  std::vector<ros::Publisher> all{link_, received_.publisher, sent_.publisher};
  for (const Topic& topic : topics_) all.push_back(topic.publisher);
  return all;
}

}  // namespace frontseat_driver::ros_layer
