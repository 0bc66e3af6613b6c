#include "blueye/mission_json.h"

#include <blueye/telemetry.pb.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <boost/crc.hpp>

#include "frontseat_driver/protocol/blueye_parse.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

namespace pb = blueye::protocol;
using google::protobuf::ListValue;
using google::protobuf::Value;

constexpr int kMostInstructions = 50;
constexpr const char* kNoList =
    "instructions is no list of objects, as in {\"instructions\": [{}]}";

bool isObject(const Value& value) { return value.kind_case() == Value::kStructValue; }

/// Each instruction of the mission as it was written; empty if they are not one to one. The reader
/// of messages takes more for a list than a list of objects: an object alone, lists in a list, and
/// null for nothing.
const ListValue* instructionsIn(const google::protobuf::Struct& given, int instructions) {
  const auto found = given.fields().find("instructions");
  if (found == given.fields().end()) return nullptr;
  const ListValue& list = found->second.list_value();
  const bool all = std::all_of(list.values().begin(), list.values().end(), isObject);
  return all && list.values_size() == instructions ? &list : nullptr;
}

bool tellsAutoContinue(const Value& instruction) {
  const auto& fields = instruction.struct_value().fields();
  return fields.count("auto_continue") != 0 || fields.count("autoContinue") != 0;
}

/// Not 0, which the wire leaves out, and positive also for whoever takes it for a signed number.
std::uint32_t idFor(const std::string& content) {
  constexpr std::uint32_t kMost = 2147483647;
  boost::crc_32_type sum;
  sum.process_bytes(content.data(), content.size());
  return sum.checksum() % kMost + 1;
}

}  // namespace

MissionRequest toMissionRequest(const protocol::BlueyeCatalogue& catalogue,
                                const std::string& json) {
  const auto bytes = catalogue.fromJson("Mission", json);
  if (!bytes.ok) return bytes.text;
  pb::SetMissionReq request;
  pb::Mission& mission = *request.mutable_mission();
  if (!mission.ParseFromString(bytes.text)) return "the mission cannot be read";
  const int instructions = mission.instructions_size();
  if (instructions < 1 || instructions > kMostInstructions) {
    return "instructions are " + std::to_string(instructions) + "; 1 to 50 are accepted";
  }
  google::protobuf::Struct given;
  if (!google::protobuf::util::JsonStringToMessage(json, &given).ok()) {
    return "it is no JSON object, or has a name twice";
  }
  const ListValue* const written = instructionsIn(given, instructions);
  if (written == nullptr) return kNoList;
  for (int i = 0; i < instructions; ++i) {
    const bool told = tellsAutoContinue(written->values(i));
    if (!told) mission.mutable_instructions(i)->set_auto_continue(true);
  }
  if (mission.id() == 0) mission.set_id(idFor(mission.SerializeAsString()));
  return request;
}

bool MissionVerdict::shownBy(std::string_view payload) {
  pb::MissionStatusTel told;
  if (!protocol::parse(payload, told)) return false;
  const pb::MissionStatus& status = told.mission_status();
  const bool tells_another = status.id() != 0 && status.id() != id_;
  kept_id_ = status.state() == pb::MISSION_STATE_READY && tells_another ? status.id() : 0;
  if (kept_id_ != 0) return false;
  state_ = status.state();
  return ready() || state_ == pb::MISSION_STATE_FAILED_TO_LOAD_MISSION;
}

std::string MissionVerdict::message(const std::string& late) const {
  if (late.empty()) return ready() ? "the mission is ready" : "the drone cannot load it";
  if (kept_id_ == 0) return late;
  return "the drone is ready for mission " + std::to_string(kept_id_) + ", not for mission " +
         std::to_string(id_) + " that was sent; clear it and load again";
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
