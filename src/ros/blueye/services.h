#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <functional>
#include <string>

#include "blueye/parameters.h"
#include "blueye/post.h"
#include "waiting_services.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// The services of a Blueye. A call waits on a thread of its own for the drone, so that it holds
/// nothing else up, and returns within its time limit even if the link is down.
class Services {
 public:
  /// Session, publisher and catalogue must outlive every posted task.
  Services(ros::NodeHandle node, const Parameters& parameters, session::BlueyeSession& session,
           const Publisher& publisher, const protocol::BlueyeCatalogue& catalogue, Post post);

  /// Answers the calls under way at once and takes no more. Tasks posted before may still run.
  void close() { services_.close(); }

 private:
  /// What came back; `type` and `json` for services that return a message.
  struct Answer {
    bool success = false;
    std::string message;
    std::string type;
    std::string json;
  };
  using Waiting = WaitingServices<Answer, session::BlueyeOutput>;
  using Respond = Waiting::Respond;
  using Shows = std::function<bool(std::string_view payload)>;

  template <class Service>
  void advertise(const char* name, std::function<Answer(typename Service::Request&)> serve,
                 Urgency urgency = Urgency::Usual, Waiting::Fill<Service> fill = nullptr);
  Answer ask(Waiting::Ask work, std::chrono::milliseconds timeout,
             WhenLate when_late = WhenLate::Drop) const;
  Answer ask(Waiting::Ask work) const;

  void addAuthority();
  void addControllers();
  void addTriggers();
  void addMissions();
  void addSettings();
  void addPassthrough();

  template <class Control>
  void addSwitch(const char* name, bool (pb::ControlMode::*state)() const);
  void addTrigger(const char* name, const char* control, const char* confirmed_by, Shows shows);
  Answer control(const std::string& type, std::string payload, const char* confirmed_by,
                 Shows shows, bool repeat) const;
  Answer request(const std::string& type, const std::string& payload,
                 std::chrono::milliseconds timeout) const;
  Answer loadMission(const std::string& json) const;
  Answer json(Answer reply) const;

  ros::NodeHandle node_;
  const std::chrono::milliseconds timeout_;
  const std::chrono::milliseconds control_timeout_;
  session::BlueyeSession& session_;
  const Publisher& publisher_;
  const protocol::BlueyeCatalogue& catalogue_;
  Waiting services_;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
