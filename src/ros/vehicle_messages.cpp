#include "vehicle_messages.h"

#include <utility>

namespace frontseat_driver::ros_layer {

namespace {

/// What becomes of one event.
class Step {
 public:
  Step(MessageBuilder& builder, const vehicle::Now& arrival, MessageOutlet& outlet)
      : builder_(builder), arrival_(arrival), outlet_(outlet) {}

  void operator()(const vehicle::ClockSample& clock) {
    builder_.take(clock, arrival_);
    offer(VehicleTopic::VehicleTime, [&] { return builder_.vehicleTime(clock, arrival_); });
  }

  void operator()(const vehicle::Navigation& navigation) {
    builder_.take(navigation, arrival_);
    offerPose();
    offer(VehicleTopic::NavFix, [&] { return builder_.navFix(); });
    offer(VehicleTopic::Depth, [&] { return builder_.depth(); });
    offer(VehicleTopic::Altitude, [&] { return builder_.altitude(); });
  }

  void operator()(const vehicle::Velocity& velocity) {
    builder_.take(velocity, arrival_);
    offer(VehicleTopic::ImuData, [&] { return builder_.imu(); });
    offer(VehicleTopic::NavVelocity, [&] { return builder_.navVelocity(); });
  }

  void operator()(const vehicle::RawImu& imu) {
    builder_.take(imu, arrival_);
    offer(VehicleTopic::ImuDataRaw, [&] { return builder_.rawImu(); });
  }

  void operator()(const vehicle::Compass& compass) {
    offer(VehicleTopic::CompassData, [&] { return builder_.compass(compass, arrival_); });
  }

  void operator()(const vehicle::Battery& battery) {
    offer(VehicleTopic::Battery, [&] { return builder_.battery(battery, arrival_); });
  }

  void operator()(const vehicle::GpsFix& fix) {
    builder_.take(fix, arrival_);
    offer(VehicleTopic::GpsFix, [&] { return builder_.gpsFix(fix, arrival_); });
  }

  void operator()(const vehicle::GpsVelocity& velocity) {
    builder_.take(velocity, arrival_);
    offer(VehicleTopic::GpsVelocity, [&] { return builder_.gpsVelocity(velocity, arrival_); });
    offer(VehicleTopic::GpsTimeReference, [&] { return builder_.gpsTime(velocity, arrival_); });
  }

  void operator()(const vehicle::MissionStatus& mission) {
    offer(VehicleTopic::MissionStatus, [&] { return builder_.missionStatus(mission, arrival_); });
  }

  void operator()(const vehicle::Control& control) {
    offer(VehicleTopic::Control, [&] { return builder_.controlStatus(control, arrival_); });
  }

  void operator()(const vehicle::Acknowledgement& ack) {
    offer(VehicleTopic::Ack, [&] { return builder_.commandAck(ack, arrival_); });
  }

  void operator()(const vehicle::InterfaceVersion& version) {
    offer(VehicleTopic::InterfaceVersion,
          [&] { return builder_.interfaceVersion(version, arrival_); });
  }

  void operator()(const vehicle::Shutdown& shutdown) {
    offer(VehicleTopic::Shutdown, [&] { return builder_.shutdownNotice(shutdown, arrival_); });
  }

 private:
  template <class Build>
  void offer(VehicleTopic topic, Build build) {
    if (outlet_.wanted(topic)) publish(topic, build());
  }

  template <class Message>
  void publish(VehicleTopic topic, Message&& message) {
    outlet_.publish(topic, std::forward<Message>(message));
  }

  template <class Message>
  void publish(VehicleTopic topic, std::optional<Message>&& message) {
    if (message) outlet_.publish(topic, *std::move(message));
  }

  void offerPose() {
    const bool transform_wanted = outlet_.wanted(VehicleTopic::Transform);
    const bool odometry_wanted = outlet_.wanted(VehicleTopic::Odom);
    if (!transform_wanted && !odometry_wanted) return;
    auto odometry = builder_.odometry();
    if (!odometry) return;
    if (transform_wanted) publish(VehicleTopic::Transform, builder_.transform(*odometry));
    if (odometry_wanted) publish(VehicleTopic::Odom, *std::move(odometry));
  }

  MessageBuilder& builder_;
  const vehicle::Now& arrival_;
  MessageOutlet& outlet_;
};

}  // namespace

void VehicleMessages::take(const vehicle::Now& arrival, const vehicle::Event& event,
                           MessageOutlet& outlet) {
  std::visit(Step{builder_, arrival, outlet}, event);
}

}  // namespace frontseat_driver::ros_layer
