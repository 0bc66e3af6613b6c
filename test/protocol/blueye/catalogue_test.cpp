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
}

}  // namespace
}  // namespace frontseat_driver::protocol
