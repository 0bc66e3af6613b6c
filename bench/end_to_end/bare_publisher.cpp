#include "bare_publisher.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/make_shared.hpp>
#include <cstring>
#include <stdexcept>

namespace frontseat_driver::bench {

BarePublisher::BarePublisher(ros::NodeHandle node, ros::NodeHandle private_node)
    : odom_(node.advertise<nav_msgs::Odometry>("odom", 100)),
      socket_(socket(AF_INET, SOCK_STREAM, 0)) {
  prepared_.header.frame_id = "odom";
  prepared_.child_frame_id = "base_link";
  prepared_.pose.pose.orientation.w = 1.0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(private_node.param("port", 0)));
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error{"no vehicle"};
  }
  thread_ = std::thread([this] { run(); });
}

BarePublisher::~BarePublisher() {
  shutdown(socket_, SHUT_RDWR);
  thread_.join();
  close(socket_);
}

void BarePublisher::run() {
  char buffer[65536];
  for (ssize_t size = 0; (size = recv(socket_, buffer, sizeof buffer, 0)) > 0;) {
    const char* at = buffer;
    const char* const end = buffer + size;
    while (const void* found = std::memchr(at, '\n', static_cast<std::size_t>(end - at))) {
      publish();
      at = static_cast<const char*>(found) + 1;
    }
  }
}

void BarePublisher::publish() {
  const double line = lines_++;
  if (line < 0.0) return;
  const auto message = boost::make_shared<nav_msgs::Odometry>(prepared_);
  message->header.stamp = ros::Time::now();
  message->pose.pose.position.z = -line;
  odom_.publish(message);
}

}  // namespace frontseat_driver::bench
