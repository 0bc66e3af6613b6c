#include "latched_messages.h"

#include <ros/master.h>
#include <ros/this_node.h>

namespace frontseat_driver::ros_layer {

namespace {

std::string valueOf(const ros::M_string& header, const char* name) {
  const auto found = header.find(name);
  return found == header.end() ? std::string{} : found->second;
}

}  // namespace

std::set<TopicPublisher> publishersNow() {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  const bool wait_for_master = false;
  if (!ros::master::execute("getSystemState", request, response, state, wait_for_master)) return {};
  std::set<TopicPublisher> found;
  XmlRpc::XmlRpcValue& topics = state[0];  // publishers, subscribers, services
  for (int i = 0; i < topics.size(); ++i) {
    const auto topic = static_cast<std::string>(topics[i][0]);
    XmlRpc::XmlRpcValue& nodes = topics[i][1];
    for (int j = 0; j < nodes.size(); ++j) found.emplace(topic, static_cast<std::string>(nodes[j]));
  }
  return found;
}

std::string LatchedMessages::refusal(const ros::M_stringPtr& header) {
  if (!header || valueOf(*header, "latching") != "1") return {};
  const TopicPublisher publisher{valueOf(*header, "topic"), valueOf(*header, "callerid")};
  boost::weak_ptr<ros::M_string>& connection = connections_[publisher];
  if (connection.lock() == header) return {};
  connection = header;
  if (known_.insert(publisher).second) return {};
  return "its publisher " + publisher.second +
         " latches, so it may be from any time; what is published from now on is accepted";
}

}  // namespace frontseat_driver::ros_layer
