#include "expected_subscribers.h"

#include <ros/master.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace frontseat_driver::ros_layer {

namespace {

const ros::WallDuration kPatience{1.0};
const ros::WallDuration kLook{0.01};

/// How many nodes subscribe to each topic; nothing if the master does not answer.
std::map<std::string, std::size_t> registeredSubscribers() {
  std::map<std::string, std::size_t> counts;
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  const bool wait_for_master = false;
  if (!ros::master::execute("getSystemState", request, response, state, wait_for_master)) return {};
  XmlRpc::XmlRpcValue& topics = state[1];  // publishers, subscribers, services
  for (int i = 0; i < topics.size(); ++i) {
    counts[static_cast<std::string>(topics[i][0])] = static_cast<std::size_t>(topics[i][1].size());
  }
  return counts;
}

}  // namespace

ExpectedSubscribers::ExpectedSubscribers(ros::NodeHandle node,
                                         const std::vector<ros::Publisher>& publishers,
                                         std::function<void()> ready)
    : ready_(std::move(ready)), give_up_(ros::SteadyTime::now() + kPatience) {
  const auto registered = registeredSubscribers();
  for (const ros::Publisher& publisher : publishers) {
    const auto found = registered.find(publisher.getTopic());
    if (found != registered.end()) expected_.push_back({publisher, found->second});
  }
  if (complete()) {
    ready_();
  } else {
    timer_ = node.createWallTimer(kLook, [this](const ros::WallTimerEvent&) { look(); });
  }
}

void ExpectedSubscribers::look() {
  if (!complete() && ros::SteadyTime::now() < give_up_) return;
  timer_.stop();
  ready_();
}

bool ExpectedSubscribers::complete() const {
  return std::all_of(expected_.begin(), expected_.end(), [](const Expected& one) {
    return one.publisher.getNumSubscribers() >= one.subscribers;
  });
}

}  // namespace frontseat_driver::ros_layer
