#pragma once

// The protocol's messages, each by its name: bp::DepthTel.

#include <google/protobuf/any.pb.h>
#include <google/protobuf/empty.pb.h>
#include <google/protobuf/message_lite.h>
#include <google/protobuf/wrappers.pb.h>

#include <string>

#include "blueye/aquatroll.pb.h"
#include "blueye/control.pb.h"
#include "blueye/message_formats.pb.h"
#include "blueye/mission_planning.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"

namespace frontseat_driver::sim {

namespace bp = ::blueye::protocol;

/// What comes before every message's name on the wire.
constexpr const char* kBlueyePackage = "blueye.protocol.";

/// A message's name without its package.
inline std::string nameOf(const google::protobuf::MessageLite& message) {
  return message.GetTypeName().substr(std::string{kBlueyePackage}.size());
}
template <class Message>
std::string nameOf() {
  return nameOf(Message{});
}

}  // namespace frontseat_driver::sim
