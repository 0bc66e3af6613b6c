// The floor for a Blueye: every telemetry message from ZeroMQ to one topic, nothing looked into.

#include <frontseat_driver/BlueyeMessage.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <zmq.h>

#include <boost/make_shared.hpp>
#include <string>

namespace {

constexpr int kLook_ms = 100;
constexpr int kQueue = 2000;

/// The next frame; empty if none came in time.
std::string frame(void* socket) {
  zmq_msg_t message;
  zmq_msg_init(&message);
  std::string out;
  if (zmq_msg_recv(&message, socket, 0) >= 0) {
    out.assign(static_cast<const char*>(zmq_msg_data(&message)), zmq_msg_size(&message));
  }
  zmq_msg_close(&message);
  return out;
}

void relay(void* socket, const ros::Publisher& telemetry) {
  const auto message = boost::make_shared<frontseat_driver::BlueyeMessage>();
  message->type = frame(socket);
  if (message->type.empty()) return;
  message->header.stamp = ros::Time::now();
  const std::string payload = frame(socket);
  message->data.assign(payload.begin(), payload.end());
  telemetry.publish(message);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "bare");
  ros::NodeHandle node;
  const auto telemetry =
      node.advertise<frontseat_driver::BlueyeMessage>("blueye/telemetry", kQueue);
  const int port = ros::NodeHandle{"~"}.param("telemetry_port", 0);
  void* const context = zmq_ctx_new();
  void* const socket = zmq_socket(context, ZMQ_SUB);
  zmq_setsockopt(socket, ZMQ_SUBSCRIBE, "", 0);
  zmq_setsockopt(socket, ZMQ_RCVTIMEO, &kLook_ms, sizeof kLook_ms);
  zmq_connect(socket, ("tcp://127.0.0.1:" + std::to_string(port)).c_str());
  while (ros::ok()) relay(socket, telemetry);
  zmq_close(socket);
  zmq_ctx_term(context);
}
