// Messages by name: every one of the protocol, to JSON and back.

#include <gmock/gmock.h>
#include <google/protobuf/wrappers.pb.h>
#include <gtest/gtest.h>

#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"
#include "frontseat_driver/protocol/blueye_catalogue.h"

namespace frontseat_driver::protocol {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(BlueyeCatalogue, HasEveryKindOfMessage) {
  const BlueyeCatalogue catalogue;
  EXPECT_EQ(catalogue.names("Tel").size(), 66u);
  EXPECT_EQ(catalogue.names("Ctrl").size(), 51u);
  EXPECT_EQ(catalogue.names("Req").size(), 23u);
  EXPECT_EQ(catalogue.names("Rep").size(), 23u);
  EXPECT_TRUE(catalogue.knows("DepthTel"));
  EXPECT_TRUE(catalogue.knows("blueye.protocol.DepthTel"));
  EXPECT_FALSE(catalogue.knows("TeleportTel"));
}

TEST(BlueyeCatalogue, GivesTheSameBytesAsTheClasses) {
  const BlueyeCatalogue catalogue;
  blueye::protocol::SetPubFrequencyReq request;
  request.set_message_type("DepthTel");
  request.set_frequency(12.5F);
  const auto bytes = catalogue.fromJson("SetPubFrequencyReq",
                                        R"({"message_type": "DepthTel", "frequency": 12.5})");
  ASSERT_TRUE(bytes.ok) << bytes.text;
  EXPECT_EQ(bytes.text, request.SerializeAsString());
  const auto json = catalogue.toJson("SetPubFrequencyReq", bytes.text);
  ASSERT_TRUE(json.ok);
  EXPECT_EQ(json.text, R"({"message_type":"DepthTel","frequency":12.5})");
}

TEST(BlueyeCatalogue, BringsEveryMessageThroughJsonAndBack) {
  const BlueyeCatalogue catalogue;
  for (const char* end : {"Tel", "Ctrl", "Req", "Rep"}) {
    for (const std::string& name : catalogue.names(end)) {
      const auto empty = catalogue.fromJson(name, "");
      ASSERT_TRUE(empty.ok) << name;
      EXPECT_THAT(empty.text, IsEmpty()) << name;
      const auto json = catalogue.toJson(name, "");
      ASSERT_TRUE(json.ok) << name;
      EXPECT_TRUE(catalogue.fromJson(name, json.text).ok) << name << json.text;
    }
  }
}

TEST(BlueyeCatalogue, WritesOutWhatAnAnyHolds) {
  google::protobuf::FloatValue value;
  value.set_value(1.5F);
  blueye::protocol::NotificationTel told;
  told.mutable_notification()->mutable_value()->set_type_url(
      "type.googleapis.com/google.protobuf.FloatValue");
  told.mutable_notification()->mutable_value()->set_value(value.SerializeAsString());
  const auto json = BlueyeCatalogue{}.toJson("NotificationTel", told.SerializeAsString());
  ASSERT_TRUE(json.ok) << json.text;
  EXPECT_THAT(json.text, HasSubstr("1.5"));
}

struct Refused {
  const char* type;
  const char* json;
  const char* reason;
};

TEST(BlueyeCatalogue, RefusesWhatIsNoSuchMessage) {
  const Refused kRows[] = {{"TeleportReq", "", "no message TeleportReq"},
                           {"LightsCtrl", R"({"brightness": 1})", "brightness"},
                           {"LightsCtrl", "{", "JSON is not a LightsCtrl"},
                           {"LightsCtrl", R"({"lights": {"value": "NaN"}})", "value is nan"},
                           {"LightsCtrl", R"({"lights": {"value": "Infinity"}})", "value is inf"}};
  const BlueyeCatalogue catalogue;
  for (const Refused& row : kRows) {
    const auto result = catalogue.fromJson(row.type, row.json);
    EXPECT_FALSE(result.ok) << row.json;
    EXPECT_THAT(result.text, HasSubstr(row.reason));
  }
  EXPECT_FALSE(catalogue.toJson("DepthTel", "\xff\xff").ok);
}

TEST(BlueyeCatalogue, TellsFieldsByTheirPaths) {
  blueye::protocol::SystemPerformanceInfoTel told;
  auto& info = *told.mutable_system_performance_info();
  info.add_cpu_cores()->set_load(0.25F);
  info.mutable_memory()->set_total_bytes(1000);
  const BlueyeCatalogue catalogue;
  const auto values = catalogue.values("SystemPerformanceInfoTel", told.SerializeAsString());
  EXPECT_THAT(values, Contains(Pair("system_performance_info.cpu_cores[0].load", "0.25")));
  EXPECT_THAT(values, Contains(Pair("system_performance_info.memory.total_bytes", "1000")));
  EXPECT_THAT(catalogue.values("TeleportTel", ""), IsEmpty());
  EXPECT_THAT(catalogue.values("DepthTel", "\xff\xff"), IsEmpty());
}

struct Written {
  const char* type;
  const char* json;
  const char* path;
  const char* value;
};

void PrintTo(const Written& row, std::ostream* out) { *out << row.type << " " << row.path; }

class BlueyeValue : public testing::TestWithParam<Written> {};

TEST_P(BlueyeValue, IsTextOfItsKind) {
  const BlueyeCatalogue catalogue;
  const auto bytes = catalogue.fromJson(GetParam().type, GetParam().json);
  ASSERT_TRUE(bytes.ok) << bytes.text;
  EXPECT_THAT(catalogue.values(GetParam().type, bytes.text),
              Contains(Pair(GetParam().path, GetParam().value)));
}

constexpr Written kWritten[] = {
    {"RecordStateTel", R"({"record_state": {"main_is_recording": true, "main_seconds": -1}})",
     "record_state.main_is_recording", "true"},
    {"RecordStateTel", R"({"record_state": {"main_seconds": -1}})",
     "record_state.main_is_recording", "false"},
    {"RecordStateTel", R"({"record_state": {"main_seconds": -1}})", "record_state.main_seconds",
     "-1"},
    {"DepthTel", R"({"depth": {"value": 1.25}})", "depth.value", "1.25"},
    {"PositionEstimateTel", R"({"position_estimate": {"northing": -0.1}})",
     "position_estimate.northing", "-0.1"},
    {"ConnectedClientsTel", R"({"connected_clients": [{"client_id": 4000000000}]})",
     "connected_clients[0].client_id", "4000000000"},
    {"ConnectedClientsTel", R"({"connected_clients": [{}, {"client_info": {"name": "a b"}}]})",
     "connected_clients[1].client_info.name", "a b"},
    {"CalibrationStateTel", R"({"calibration_state": {"status": 3}})", "calibration_state.status",
     "STATUS_CALIBRATING_X_POSITIVE"},
    {"CalibrationStateTel", R"({"calibration_state": {"status": 99}})", "calibration_state.status",
     "99"},
    {"MultibeamPingTel", R"({"ping": {"bearings": [0.5, -0.25]}})", "ping.bearings[1]", "-0.25"},
    {"MissionStatusTel", R"({"mission_status": {"completed_instruction_ids": [7, 8]}})",
     "mission_status.completed_instruction_ids[0]", "7"},
    {"BinlogRecord", R"({"unix_timestamp": "1970-01-01T00:00:01Z"})", "unix_timestamp.seconds",
     "1"},
};

INSTANTIATE_TEST_SUITE_P(Table, BlueyeValue, testing::ValuesIn(kWritten));

TEST(BlueyeCatalogue, TellsOfOneofOnlyTheOneThatIsThere) {
  const BlueyeCatalogue catalogue;
  const auto bytes =
      catalogue.fromJson("GuestPortInfo", R"({"gp1": {"error": "GUEST_PORT_ERROR_READ_ERROR"}})");
  ASSERT_TRUE(bytes.ok) << bytes.text;
  const auto values = catalogue.values("blueye.protocol.GuestPortInfo", bytes.text);
  EXPECT_THAT(values, Contains(Pair("gp1.error", "GUEST_PORT_ERROR_READ_ERROR")));
  const auto none = catalogue.fromJson("GuestPortInfo", R"({"gp1": {}})");
  ASSERT_TRUE(none.ok) << none.text;
  for (const auto& [path, value] : catalogue.values("GuestPortInfo", none.text)) {
    EXPECT_NE(path, "gp1.error") << value;
  }
}

}  // namespace
}  // namespace frontseat_driver::protocol
