#pragma once

#include <frontseat_driver/BlueyeMessage.h>
#include <frontseat_driver/Gripper.h>
#include <frontseat_driver/MotionInput.h>
#include <geometry_msgs/Twist.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/Float64.h>

#include <list>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "blueye/parameters.h"
#include "blueye/post.h"
#include "latched_messages.h"
#include "mailbox.h"
#include "throttle.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// Takes commands from topics to the session. Of each topic only the newest message waits, however
/// fast they come. What cannot be used, and what waited too long or across a stop, is refused
/// whole and counted, with a throttled warning for each topic.
class Input {
 public:
  /// `name` stands before log lines. Session and catalogue must outlive every posted task.
  Input(ros::NodeHandle node, std::string name, const Parameters& parameters,
        session::BlueyeSession& session, const protocol::BlueyeCatalogue& catalogue, Post post);

  /// Takes no more commands. Tasks posted before may still run.
  void close() { subscribers_.clear(); }

 private:
  using Mailbox = ros_layer::Mailbox<Task>;

  template <class Message, class Function>
  void subscribe(const char* topic, Function take);

  /// A control message ready to be sent.
  struct Wanted {
    std::string type;  ///< with package
    std::string payload;
  };
  /// Or why it is refused.
  using Checked = std::variant<std::string, Wanted>;

  template <class Message>
  static Checked ready(const Message& message) {
    return Wanted{message.GetTypeName(), message.SerializeAsString()};
  }

  // On the session's thread; each returns why it was refused, or nothing.
  std::string move(const vehicle::Now& now, const ConvertedMotion& wanted,
                   vehicle::SteadyTime received);
  template <class Message>
  std::string level(const vehicle::Now& now, const char* type, double value,
                    vehicle::SteadyTime received, session::BlueyeOutput& out);
  std::string turn(const vehicle::Now& now, const sensor_msgs::JointState& joints,
                   vehicle::SteadyTime received, session::BlueyeOutput& out);
  Checked turn(const std::string& joint, double position_rad) const;
  std::string pilotAt(const vehicle::Now& now, const sensor_msgs::NavSatFix& fix,
                      vehicle::SteadyTime received, session::BlueyeOutput& out);
  std::string raw(const vehicle::Now& now, const BlueyeMessage& message,
                  vehicle::SteadyTime received, session::BlueyeOutput& out);
  /// `stream` as ConfirmedControls::Control has it.
  std::string control(const vehicle::Now& now, Wanted wanted, vehicle::SteadyTime received,
                      session::BlueyeOutput& out, const std::string& stream = {});
  template <class Take>
  void takeCounted(const vehicle::Now& now, const char* topic, Take take);
  void warn(const vehicle::Now& now, const char* topic, const std::string& refusal);

  ros::NodeHandle node_;
  const std::string name_;
  const Parameters parameters_;
  session::BlueyeSession& session_;
  const protocol::BlueyeCatalogue& catalogue_;
  const Post post_;
  std::list<Mailbox> mailboxes_;          ///< one for each topic
  Mailbox* motion_ = nullptr;             ///< of cmd_vel and cmd_motion together
  std::map<std::string, Throttle> logs_;  ///< by topic
  vehicle::SteadyTime next_pilot_{};
  LatchedMessages latched_{publishersNow()};  ///< asked for before anything is subscribed to
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
