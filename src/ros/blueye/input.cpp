#include "blueye/input.h"

#include <blueye/control.pb.h>
#include <ros/console.h>

#include <cmath>
#include <utility>

#include "blueye/service_requests.h"
#include "blueye/topics.h"
#include "check.h"
#include "frontseat_driver/protocol/blueye_parse.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using namespace std::chrono_literals;
using session::BlueyeOutput;

constexpr std::uint32_t kNewestOnly = 1;
constexpr auto kPilotAtMostEvery = 1s;

}  // namespace

Input::Input(ros::NodeHandle node, std::string name, const Parameters& parameters,
             session::BlueyeSession& session, const protocol::BlueyeCatalogue& catalogue, Post post)
    : node_(node),
      name_(std::move(name)),
      parameters_(parameters),
      session_(session),
      catalogue_(catalogue),
      post_(std::move(post)) {
  motion_ = &mailboxes_.emplace_back();
  subscribe<MotionInput>(topics::kCmdMotion,
                         [this](const auto& now, const auto& wanted, auto at, auto&) {
                           return move(now, toCommand(wanted), at);
                         });
  subscribe<geometry_msgs::Twist>(topics::kCmdVel,
                                  [this](const auto& now, const auto& wanted, auto at, auto&) {
                                    return move(now, toCommand(wanted, parameters_.full_speed), at);
                                  });
  subscribe<std_msgs::Float64>(
      topics::kCmdTilt, [this](const auto& now, const auto& wanted, auto at, auto&) {
        const std::string refusal = outside("data", wanted.data, -1.0, 1.0);
        if (!refusal.empty()) return refusal;
        return session_.command(now, vehicle::TiltCommand{wanted.data}, at);
      });
  subscribe<Gripper>(
      topics::kCmdGripper, [this](const auto& now, const auto& wanted, auto at, auto&) {
        std::string refusal = outside("grip", wanted.grip, -1.0, 1.0);
        if (refusal.empty()) refusal = outside("rotate", wanted.rotate, -1.0, 1.0);
        if (!refusal.empty()) return refusal;
        return session_.command(now, vehicle::GripperCommand{wanted.grip, wanted.rotate}, at);
      });
  subscribe<std_msgs::Float64>(
      topics::kCmdLights, [this](const auto& now, const auto& wanted, auto at, auto& out) {
        return level<pb::LightsCtrl>(now, "LightsTel", wanted.data, at, out);
      });
  subscribe<std_msgs::Float64>(
      topics::kCmdGuestPortLights, [this](const auto& now, const auto& wanted, auto at, auto& out) {
        return level<pb::GuestportLightsCtrl>(now, "GuestPortLightsTel", wanted.data, at, out);
      });
  subscribe<std_msgs::Float64>(
      topics::kCmdLaser, [this](const auto& now, const auto& wanted, auto at, auto& out) {
        const std::string refusal = outside("data", wanted.data, 0.0, 1.0);
        if (!refusal.empty()) return refusal;
        pb::LaserCtrl message;
        message.mutable_laser()->set_value(static_cast<float>(wanted.data));
        const std::string type = message.GetTypeName();
        return control(now, {type, message.SerializeAsString()}, at, out, type);
      });
  subscribe<sensor_msgs::JointState>(
      topics::kCmdJoint, [this](const auto& now, const auto& wanted, auto at, auto& out) {
        return turn(now, wanted, at, out);
      });
  subscribe<sensor_msgs::NavSatFix>(
      topics::kPilotPosition, [this](const auto& now, const auto& wanted, auto at, auto& out) {
        return pilotAt(now, wanted, at, out);
      });
  subscribe<BlueyeMessage>(topics::kControlIn,
                           [this](const auto& now, const auto& wanted, auto at, auto& out) {
                             return raw(now, wanted, at, out);
                           });
}

// Without tcpNoDelay small messages wait up to 40 ms for each other.
template <class Message, class Function>
void Input::subscribe(const char* topic, Function take) {
  const bool moves = topic == topics::kCmdVel || topic == topics::kCmdMotion;
  Mailbox& mailbox = moves ? *motion_ : mailboxes_.emplace_back();
  ros::SubscribeOptions options;
  options.template initByFullCallbackType<const ros::MessageEvent<const Message>&>(
      topic, kNewestOnly,
      [this, take, topic, &mailbox](const ros::MessageEvent<const Message>& event) {
        const std::string latched = latched_.refusal(event.getConnectionHeaderPtr());
        if (!latched.empty()) {
          return post_([this, topic, latched](const vehicle::Now& now, BlueyeOutput&) {
            takeCounted(now, topic, [&] { return latched; });
          });
        }
        const auto received = receivedAt(event.getReceiptTime());
        mailbox.put(post_, [this, take, topic, received, message = event.getConstMessage()](
                               const vehicle::Now& now, BlueyeOutput& out) {
          takeCounted(now, topic, [&] { return take(now, *message, received, out); });
        });
      });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(node_.subscribe(options));
}

// The session counts what it refuses itself.
template <class Take>
void Input::takeCounted(const vehicle::Now& now, const char* topic, Take take) {
  const std::uint64_t before = session_.counters().refused_commands;
  const std::string refusal = take();
  if (refusal.empty()) return;
  if (session_.counters().refused_commands == before) session_.countRefusedCommands(1);
  warn(now, topic, refusal);
}

void Input::warn(const vehicle::Now& now, const char* topic, const std::string& refusal) {
  if (!logs_[topic].passes(now.steady)) return;
  ROS_WARN("%s: refused %s: %s", name_.c_str(), topic, refusal.c_str());
}

std::string Input::move(const vehicle::Now& now, const ConvertedMotion& wanted,
                        vehicle::SteadyTime received) {
  if (const auto* refusal = std::get_if<std::string>(&wanted)) return *refusal;
  return session_.command(now, std::get<vehicle::DroneCommand>(wanted), received);
}

std::string Input::control(const vehicle::Now& now, Wanted wanted, vehicle::SteadyTime received,
                           BlueyeOutput& out, const std::string& stream) {
  std::string refusal;
  session::ConfirmedControls::Control once;
  once.type = std::move(wanted.type);
  once.payload = std::move(wanted.payload);
  once.stream = stream;
  // Nothing confirms it, so it is answered before control() returns.
  once.respond = [&refusal](const std::string& reason) { refusal = reason; };
  session_.control(now, std::move(once), out, received);
  return refusal;
}

template <class Message>
std::string Input::level(const vehicle::Now& now, const char* type, double value,
                         vehicle::SteadyTime received, BlueyeOutput& out) {
  std::string refusal = outside("data", value, 0.0, 1.0);
  if (refusal.empty()) refusal = session_.refusal(now, received);
  if (!refusal.empty()) return refusal;
  Message message;
  message.mutable_lights()->set_value(static_cast<float>(value));
  session::ConfirmedControls::Control wanted;
  wanted.type = message.GetTypeName();
  wanted.payload = message.SerializeAsString();
  wanted.stream = wanted.type;
  wanted.repeat = true;
  wanted.confirmed_by = protocol::BlueyeCatalogue::fullName(type);
  wanted.shows = [value](std::string_view payload) {
    constexpr double kClose = 0.02;
    pb::LightsTel told;  // GuestPortLightsTel is the same
    return protocol::parse(payload, told) && std::abs(told.lights().value() - value) < kClose;
  };
  session_.control(now, std::move(wanted), out);
  return {};
}

std::string Input::turn(const vehicle::Now& now, const sensor_msgs::JointState& joints,
                        vehicle::SteadyTime received, BlueyeOutput& out) {
  if (joints.name.size() != joints.position.size()) {
    return "it has " + std::to_string(joints.name.size()) + " names and " +
           std::to_string(joints.position.size()) + " positions; as many of both are accepted";
  }
  std::string refusal = session_.refusal(now, received);
  if (!refusal.empty()) return refusal;
  std::vector<Wanted> all;  // none is sent before each is known to be good
  for (std::size_t i = 0; i < joints.name.size(); ++i) {
    Checked one = turn(joints.name[i], joints.position[i]);
    if (const auto* wrong = std::get_if<std::string>(&one)) return *wrong;
    all.push_back(std::get<Wanted>(std::move(one)));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string failed = control(now, std::move(all[i]), received, out, joints.name[i]);
    if (refusal.empty()) refusal = failed;
  }
  return refusal;
}

Input::Checked Input::turn(const std::string& joint, double position_rad) const {
  const auto converted =
      toJointControl(joint, position_rad, parameters_.publisher.navigation.conventions);
  if (const auto* refusal = std::get_if<std::string>(&converted)) return *refusal;
  if (const auto* servo = std::get_if<pb::GenericServoCtrl>(&converted)) return ready(*servo);
  return ready(std::get<pb::MultibeamServoCtrl>(converted));
}

std::string Input::pilotAt(const vehicle::Now& now, const sensor_msgs::NavSatFix& fix,
                           vehicle::SteadyTime received, BlueyeOutput& out) {
  const bool has_fix = fix.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX;
  if (!has_fix || now.steady < next_pilot_) return {};
  std::string refusal = outside("latitude", fix.latitude, -90.0, 90.0);
  if (refusal.empty()) refusal = outside("longitude", fix.longitude, -180.0, 180.0);
  if (!refusal.empty()) return refusal;
  next_pilot_ = now.steady + kPilotAtMostEvery;
  pb::PilotGPSPositionCtrl message;
  message.mutable_position()->set_latitude(fix.latitude);
  message.mutable_position()->set_longitude(fix.longitude);
  return control(now, {message.GetTypeName(), message.SerializeAsString()}, received, out);
}

std::string Input::raw(const vehicle::Now& now, const BlueyeMessage& message,
                       vehicle::SteadyTime received, BlueyeOutput& out) {
  const std::string bytes{message.data.begin(), message.data.end()};
  // Through JSON and back: so a NaN is found, and bytes that are not of the type.
  const auto json = catalogue_.toJson(message.type, bytes);
  const auto checked = json.ok ? catalogue_.fromJson(message.type, json.text) : json;
  if (!checked.ok) return checked.text;
  return control(now, {protocol::BlueyeCatalogue::fullName(message.type), bytes}, received, out);
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
