#pragma once

#include <blueye/mission_planning.pb.h>
#include <blueye/req_rep.pb.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "frontseat_driver/protocol/blueye_catalogue.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// The request that loads a mission, or why the text is none.
using MissionRequest = std::variant<blueye::protocol::SetMissionReq, std::string>;

/// `json` is a blueye.protocol.Mission with 1 to 50 instructions. An instruction that does not say
/// whether the mission goes on after it (auto_continue) lets it go on. A mission without an id gets
/// one made of its content, so that the drone tells it from others.
MissionRequest toMissionRequest(const protocol::BlueyeCatalogue& catalogue,
                                const std::string& json);

/// What the drone's telemetry tells of the mission that was sent to it: SetMissionRep tells
/// nothing.
class MissionVerdict {
 public:
  explicit MissionVerdict(std::uint32_t id) : id_(id) {}

  /// Whether this MissionStatusTel decides. A drone that is ready for a mission of another id,
  /// which may be the one before, does not; one that tells no id does.
  bool shownBy(std::string_view payload);

  bool ready() const { return state_ == blueye::protocol::MISSION_STATE_READY; }

  /// For people. `late`: why nothing has decided; empty if something has.
  std::string message(const std::string& late) const;

 private:
  const std::uint32_t id_;
  std::uint32_t kept_id_ = 0;  ///< of the other mission that the drone is ready for
  blueye::protocol::MissionState state_ = blueye::protocol::MISSION_STATE_UNSPECIFIED;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
