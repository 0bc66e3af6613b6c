#include "blueye/mission_json.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>

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
  return request;
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
