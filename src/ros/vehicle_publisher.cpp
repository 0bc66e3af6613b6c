#include "vehicle_publisher.h"

#include <frontseat_driver/Sentence.h>

#include <boost/make_shared.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

// A frontseat sends bundles of ten sentences and more in one write: shorter queues lose some.
constexpr std::uint32_t kQueue = 100;
// The record must miss nothing at any rate a vehicle can send: half a second at 20,000 a second.
constexpr std::uint32_t kRecordQueue = 10000;
constexpr bool kLatched = true;

bool wanted(const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; }

// Shared, so that a nodelet in the same manager gets it without a copy.
template <class Message>
void publishShared(const ros::Publisher& publisher, Message message) {
  publisher.publish(boost::make_shared<const Message>(std::move(message)));
}

template <class Message>
void publishIfAny(const ros::Publisher& publisher, std::optional<Message> message) {
  if (message) publishShared(publisher, *std::move(message));
}

void publishSentence(const ros::Publisher& publisher, const vehicle::Now& now,
                     std::string_view line) {
  if (!wanted(publisher)) return;
  Sentence sentence;
  sentence.header.stamp = toRosTime(now.stamp);
  sentence.sentence = std::string{line};
  publishShared(publisher, std::move(sentence));
}

}  // namespace

VehiclePublisher::VehiclePublisher(ros::NodeHandle node, const Parameters& parameters)
    : builder_(parameters),
      publish_tf_(parameters.publish_tf),
      odom_(node.advertise<nav_msgs::Odometry>(topics::kOdom, kQueue)),
      imu_(node.advertise<sensor_msgs::Imu>(topics::kImuData, kQueue)),
      raw_imu_(node.advertise<sensor_msgs::Imu>(topics::kImuDataRaw, kQueue)),
      compass_(node.advertise<sensor_msgs::Imu>(topics::kCompassData, kQueue)),
      nav_fix_(node.advertise<sensor_msgs::NavSatFix>(topics::kNavFix, kQueue)),
      nav_velocity_(node.advertise<geometry_msgs::TwistStamped>(topics::kNavVelocity, kQueue)),
      depth_(node.advertise<geometry_msgs::PoseWithCovarianceStamped>(topics::kDepth, kQueue)),
      altitude_(node.advertise<sensor_msgs::Range>(topics::kAltitude, kQueue)),
      battery_(node.advertise<sensor_msgs::BatteryState>(topics::kBattery, kQueue)),
      gps_fix_(node.advertise<sensor_msgs::NavSatFix>(topics::kGpsFix, kQueue)),
      gps_velocity_(node.advertise<geometry_msgs::TwistStamped>(topics::kGpsVelocity, kQueue)),
      gps_time_(node.advertise<sensor_msgs::TimeReference>(topics::kGpsTimeReference, kQueue)),
      vehicle_time_(node.advertise<sensor_msgs::TimeReference>(topics::kVehicleTime, kQueue)),
      mission_status_(node.advertise<MissionStatus>(topics::kMissionStatus, kQueue, kLatched)),
      control_(node.advertise<ControlStatus>(topics::kControl, kQueue, kLatched)),
      interface_version_(
          node.advertise<InterfaceVersion>(topics::kInterfaceVersion, kQueue, kLatched)),
      shutdown_(node.advertise<ShutdownNotice>(topics::kShutdown, kQueue, kLatched)),
      ack_(node.advertise<CommandAck>(topics::kAck, kQueue)),
      link_(node.advertise<LinkStatus>(topics::kLink, kQueue, kLatched)),
      received_(node.advertise<Sentence>(topics::kNmeaReceived, kRecordQueue)),
      sent_(node.advertise<Sentence>(topics::kNmeaSent, kRecordQueue)) {
  if (!parameters.publish_frd_frames) return;
  vehicle::Now now;
  now.stamp = toUtcTime(ros::Time::now());
  const auto frames = builder_.helperFrames(now);
  static_transforms_.sendTransform(
      std::vector<geometry_msgs::TransformStamped>(frames.begin(), frames.end()));
}

void VehiclePublisher::publish(const vehicle::Now& arrival, const vehicle::Event& event) {
  std::visit([&](const auto& told) { take(arrival, told); }, event);
}

void VehiclePublisher::publishReceived(const vehicle::Now& now, std::string_view line) const {
  publishSentence(received_, now, line);
}

void VehiclePublisher::publishSent(const vehicle::Now& now, std::string_view line) const {
  publishSentence(sent_, now, line);
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::ClockSample& clock) {
  builder_.take(clock, arrival);
  if (wanted(vehicle_time_)) publishShared(vehicle_time_, builder_.vehicleTime(clock, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Navigation& navigation) {
  builder_.take(navigation, arrival);
  if (publish_tf_ || wanted(odom_)) publishOdometry();
  if (wanted(nav_fix_)) publishIfAny(nav_fix_, builder_.navFix());
  if (wanted(depth_)) publishIfAny(depth_, builder_.depth());
  if (wanted(altitude_)) publishIfAny(altitude_, builder_.altitude());
}

void VehiclePublisher::publishOdometry() {
  auto odometry = builder_.odometry();
  if (!odometry) return;
  if (publish_tf_) {
    const auto transform = builder_.transform(*odometry);
    if (transform) transforms_.sendTransform(*transform);
  }
  if (wanted(odom_)) publishShared(odom_, *std::move(odometry));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Velocity& velocity) {
  builder_.take(velocity, arrival);
  if (wanted(imu_)) publishIfAny(imu_, builder_.imu());
  if (wanted(nav_velocity_)) publishIfAny(nav_velocity_, builder_.navVelocity());
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::RawImu& imu) {
  builder_.take(imu, arrival);
  if (wanted(raw_imu_)) publishIfAny(raw_imu_, builder_.rawImu());
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Compass& compass) {
  if (wanted(compass_)) publishIfAny(compass_, builder_.compass(compass, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Battery& battery) {
  if (wanted(battery_)) publishShared(battery_, builder_.battery(battery, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::GpsFix& fix) {
  builder_.take(fix, arrival);
  if (wanted(gps_fix_)) publishShared(gps_fix_, builder_.gpsFix(fix, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::GpsVelocity& velocity) {
  builder_.take(velocity, arrival);
  if (wanted(gps_velocity_)) publishIfAny(gps_velocity_, builder_.gpsVelocity(velocity, arrival));
  if (wanted(gps_time_)) publishIfAny(gps_time_, builder_.gpsTime(velocity, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::MissionStatus& mission) {
  publishShared(mission_status_, builder_.missionStatus(mission, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Control& control) {
  publishShared(control_, builder_.controlStatus(control, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Acknowledgement& ack) {
  if (wanted(ack_)) publishShared(ack_, builder_.commandAck(ack, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::InterfaceVersion& version) {
  publishShared(interface_version_, builder_.interfaceVersion(version, arrival));
}

void VehiclePublisher::take(const vehicle::Now& arrival, const vehicle::Shutdown& shutdown) {
  publishShared(shutdown_, builder_.shutdownNotice(shutdown, arrival));
}

}  // namespace frontseat_driver::ros_layer
