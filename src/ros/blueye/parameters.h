#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <string>
#include <vector>

#include "blueye/publisher.h"
#include "frontseat_driver/link/zmq_client.h"
#include "frontseat_driver/session/blueye_session.h"
#include "private_parameters.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// Where telemetry comes from: the drone, or a recorded topic.
enum class Source { Zmq, Topic };

/// Everything the user can set for a Blueye, with the defaults of the README's table.
struct Parameters {
  link::ZmqClient::Options link;
  session::BlueyeOptions session;
  Publisher::Options publisher;
  FullSpeed full_speed;
  Source source = Source::Zmq;
};

/// Reads every parameter; throws ParameterError for the first that cannot be used.
Parameters readParameters(const XmlRpc::XmlRpcValue& private_params);

/// One line for every private parameter that nobody reads.
std::vector<std::string> unknownParameterWarnings(const XmlRpc::XmlRpcValue& private_params);

}  // namespace frontseat_driver::ros_layer::blueye_layer
