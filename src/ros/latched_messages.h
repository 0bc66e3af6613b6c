#pragma once

#include <ros/datatypes.h>

#include <boost/weak_ptr.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace frontseat_driver::ros_layer {

/// A topic and the node that publishes it, by their full names.
using TopicPublisher = std::pair<std::string, std::string>;

/// Those that the master knows now; none if it does not answer.
std::set<TopicPublisher> publishersNow();

/// Finds messages that may be from long ago: a publisher that latches sends its last one again to
/// whoever connects, such as a driver that was restarted, or after its network was away.
class LatchedMessages {
 public:
  /// `before`: publishers that were there before the subscriptions were made.
  explicit LatchedMessages(std::set<TopicPublisher> before) : known_(std::move(before)) {}

  /// Why the message cannot be told from an old one: it is the first of a connection to a publisher
  /// that latches and has been there before. Empty if it can. `header` is that of the connection.
  std::string refusal(const ros::M_stringPtr& header);

 private:
  std::set<TopicPublisher> known_;
  std::map<TopicPublisher, boost::weak_ptr<ros::M_string>> connections_;
};

}  // namespace frontseat_driver::ros_layer
