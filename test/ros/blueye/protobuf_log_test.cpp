#include "blueye/protobuf_log.h"

#include <gmock/gmock.h>
#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "blueye/telemetry.pb.h"

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines;

void keep(google::protobuf::LogLevel, const char*, int, const std::string& text) {
  lines.push_back(text);
}

// A drone may send a thousand of them each second.
TEST(ProtobufLog, TellsOfTextsThatAreNoneOnceInAWhile) {
  google::protobuf::SetLogHandler(keep);
  throttleProtobufLog();
  throttleProtobufLog();
  const std::string no_text{"\x0a\x03\x0a\x01\xff", 5};  // blunux_version, one byte FF
  for (int i = 0; i < 1000; ++i) {
    blueye::protocol::DroneInfoTel message;
    EXPECT_FALSE(message.ParseFromString(no_text));
  }
  GOOGLE_LOG(WARNING) << "something else";
  GOOGLE_LOG(WARNING) << "something else";
  EXPECT_THAT(lines, ElementsAre(HasSubstr("UTF-8"), "something else", "something else"));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
