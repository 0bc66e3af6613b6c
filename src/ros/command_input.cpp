#include "command_input.h"

#include <ros/console.h>

#include <cstdio>
#include <utility>

#include "convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr std::uint32_t kNewestOnly = 1;

// What tells its age is judged by that, and how the payload is holds until it changes.
template <class Message>
bool mayBeOfAnyAge(const Message&) {
  return true;
}
bool mayBeOfAnyAge(const Behavior& behavior) { return behavior.header.stamp.isZero(); }
bool mayBeOfAnyAge(const PayloadStatus&) { return false; }

}  // namespace

CommandInput::CommandInput(ros::NodeHandle node, std::string name, const Parameters& parameters,
                           session::NmeaSession& session, const VehiclePublisher& publisher,
                           PostTask post)
    : name_(std::move(name)),
      parameters_(parameters),
      session_(session),
      publisher_(publisher),
      post_(std::move(post)) {
  subscribers_ = {
      subscribe(node, topics::kCmdBehavior, &CommandInput::takeBehavior),
      subscribe(node, topics::kCmdDrive, &CommandInput::takeDrive),
      subscribe(node, topics::kCmdHelm, &CommandInput::takeHelm),
      subscribe(node, topics::kCmdCourse, &CommandInput::takeCourse),
      subscribe(node, topics::kCmdVel, &CommandInput::takeVelocity),
      subscribe(node, topics::kPayloadStatus, &CommandInput::takePayloadStatus),
  };
}

// Without tcpNoDelay small messages wait up to 40 ms for each other.
template <class Message>
ros::Subscriber CommandInput::subscribe(
    ros::NodeHandle& node, const char* topic,
    void (CommandInput::*take)(const ros::MessageEvent<const Message>&)) {
  ros::SubscribeOptions options;
  options.template initByFullCallbackType<const ros::MessageEvent<const Message>&>(
      topic, kNewestOnly, [this, topic, take](const ros::MessageEvent<const Message>& event) {
        const std::string latched = latched_.refusal(event.getConnectionHeaderPtr());
        const bool refused = !latched.empty() && mayBeOfAnyAge(*event.getMessage());
        return refused ? refuse(topic, latched) : (this->*take)(event);
      });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

void CommandInput::takeBehavior(const ros::MessageEvent<const Behavior>& event) {
  const std::string too_old =
      tooOld(*event.getMessage(), ros::Time::now(), parameters_.max_command_age);
  if (!too_old.empty()) return refuse(topics::kCmdBehavior, too_old);
  takeWithHeading(topics::kCmdBehavior, event);
}

void CommandInput::takeDrive(const ros::MessageEvent<const Drive>& event) {
  takeConverted(topics::kCmdDrive, event.getReceiptTime(), toCommand(*event.getMessage()));
}

void CommandInput::takeHelm(const ros::MessageEvent<const Helm>& event) {
  takeConverted(topics::kCmdHelm, event.getReceiptTime(), toCommand(*event.getMessage()));
}

void CommandInput::takeCourse(const ros::MessageEvent<const Course>& event) {
  takeWithHeading(topics::kCmdCourse, event);
}

void CommandInput::takeVelocity(const ros::MessageEvent<const geometry_msgs::Twist>& event) {
  takeConverted(
      topics::kCmdVel, event.getReceiptTime(),
      toCommand(*event.getMessage(), parameters_.max_speed_m_s, parameters_.max_yaw_rate_rad_s));
}

// A heading is turned on the session's thread, where the newest position is.
template <class Message>
void CommandInput::takeWithHeading(const char* topic,
                                   const ros::MessageEvent<const Message>& event) {
  const auto message = event.getMessage();
  const Converted anywhere = toCommand(*message, 0.0);
  if (const auto* refusal = std::get_if<std::string>(&anywhere)) return refuse(topic, *refusal);
  command(topic, event.getReceiptTime(),
          [this, message] { return toCommand(*message, publisher_.builder().northOffset_deg()); });
}

void CommandInput::takeConverted(const char* topic, const ros::Time& receipt,
                                 const Converted& converted) {
  if (const auto* refusal = std::get_if<std::string>(&converted)) return refuse(topic, *refusal);
  command(topic, receipt, [converted] { return converted; });
}

void CommandInput::takePayloadStatus(const ros::MessageEvent<const PayloadStatus>& event) {
  payload_status_.put(
      post_, [this, status = event.getMessage()](const vehicle::Now& now, session::Output&) {
        const auto refusal = session_.setPayloadStatus(now, {status->ok != 0, status->message});
        if (!refusal.empty()) warn(topics::kPayloadStatus, refusal, now);
      });
}

void CommandInput::command(const char* topic, const ros::Time& receipt, Convert convert) {
  const auto received = receivedAt(receipt);
  // One that the vehicle cannot be told must not take the place of one that it can.
  Mailbox& mailbox = topic == topics::kCmdBehavior ? behavior_ : motion_;
  mailbox.put(post_, [this, topic, received, convert = std::move(convert)](const vehicle::Now& now,
                                                                           session::Output& out) {
    const Converted converted = convert();
    if (const auto* refusal = std::get_if<std::string>(&converted)) {
      session_.countRefusedCommands(now, 1, *refusal);
      return warn(topic, *refusal, now);
    }
    const auto& wanted = std::get<vehicle::Command>(converted);
    const std::string refusal = session_.command(now, wanted, received, out);
    if (!refusal.empty()) warn(topic, refusal, now);
  });
}

void CommandInput::refuse(const char* topic, std::string refusal) {
  ++refusals_;
  refused_.put(post_, [this, topic, refusal = std::move(refusal)](const vehicle::Now& now,
                                                                  session::Output&) {
    session_.countRefusedCommands(now, refusals_.exchange(0), refusal);
    warn(topic, refusal, now);
  });
}

void CommandInput::warn(const char* topic, const std::string& refusal, const vehicle::Now& now) {
  if (!logs_[topic].passes(now.steady)) return;
  ROS_WARN("%s: refused %s: %s", name_.c_str(), topic, refusal.c_str());
}

}  // namespace frontseat_driver::ros_layer
