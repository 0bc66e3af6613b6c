#pragma once

#include <frontseat_driver/Behavior.h>
#include <frontseat_driver/Course.h>
#include <frontseat_driver/Drive.h>
#include <frontseat_driver/Helm.h>
#include <frontseat_driver/PayloadStatus.h>
#include <geometry_msgs/Twist.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "command_convert.h"
#include "frontseat_driver/session/nmea_session.h"
#include "latched_messages.h"
#include "mailbox.h"
#include "parameters.h"
#include "throttle.h"
#include "vehicle_publisher.h"

namespace frontseat_driver::ros_layer {

/// A piece of work for the thread that the session lives on.
using SessionTask = std::function<void(const vehicle::Now& now, session::Output& out)>;
using PostTask = std::function<void(SessionTask)>;

/// Takes commands from topics to the session. Of motion commands only the newest waits, whatever
/// topic it came on and however fast they come; one that cannot be used never takes a good one's
/// place.
class CommandInput {
 public:
  /// `name` stands before log lines. Session and publisher must outlive every posted task.
  CommandInput(ros::NodeHandle node, std::string name, const Parameters& parameters,
               session::NmeaSession& session, const VehiclePublisher& publisher, PostTask post);

  /// Takes no more commands. Tasks posted before may still run.
  void close() { subscribers_.clear(); }

 private:
  using Convert = std::function<Converted()>;

  using Mailbox = ros_layer::Mailbox<SessionTask>;

  template <class Message>
  ros::Subscriber subscribe(ros::NodeHandle& node, const char* topic,
                            void (CommandInput::*take)(const ros::MessageEvent<const Message>&));
  void takeBehavior(const ros::MessageEvent<const Behavior>& event);
  void takeDrive(const ros::MessageEvent<const Drive>& event);
  void takeHelm(const ros::MessageEvent<const Helm>& event);
  void takeCourse(const ros::MessageEvent<const Course>& event);
  void takeVelocity(const ros::MessageEvent<const geometry_msgs::Twist>& event);
  void takePayloadStatus(const ros::MessageEvent<const PayloadStatus>& event);

  template <class Message>
  void takeWithHeading(const char* topic, const ros::MessageEvent<const Message>& event);
  void takeConverted(const char* topic, const ros::Time& receipt, const Converted& converted);
  void command(const char* topic, const ros::Time& receipt, Convert convert);
  void refuse(const char* topic, std::string refusal);
  void warn(const char* topic, const std::string& refusal, const vehicle::Now& now);

  const std::string name_;
  const Parameters parameters_;
  session::NmeaSession& session_;
  const VehiclePublisher& publisher_;
  const PostTask post_;
  Mailbox behavior_;  ///< of a Sandshark, where the other is refused
  Mailbox motion_;    ///< of a Kingfisher
  Mailbox refused_;
  std::atomic<std::uint32_t> refusals_{0};  ///< not counted by the session yet
  Mailbox payload_status_;
  std::map<std::string, Throttle> logs_;      ///< by topic
  LatchedMessages latched_{publishersNow()};  ///< asked for before anything is subscribed to
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace frontseat_driver::ros_layer
