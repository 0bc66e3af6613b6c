#pragma once

#include <blueye/req_rep.pb.h>

#include <string>
#include <variant>

#include "frontseat_driver/protocol/blueye_catalogue.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// The request that loads a mission, or why the text is none.
using MissionRequest = std::variant<blueye::protocol::SetMissionReq, std::string>;

/// `json` is a blueye.protocol.Mission with 1 to 50 instructions. An instruction that does not say
/// whether the mission goes on after it (auto_continue) lets it go on.
MissionRequest toMissionRequest(const protocol::BlueyeCatalogue& catalogue,
                                const std::string& json);

}  // namespace frontseat_driver::ros_layer::blueye_layer
