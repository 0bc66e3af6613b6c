// Every message of the protocol with every field filled: telemetry to the listener, control and
// requests from JSON to the drone. The descriptors are walked, so none can be left out.

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "blueye/descriptors.h"
#include "frontseat_driver/protocol/blueye_catalogue.h"
#include "scripted_drone.h"

namespace frontseat_driver::session {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::DynamicMessageFactory;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptorSet;
using google::protobuf::Message;
using google::protobuf::Reflection;

/// Makes messages in which no field has its default.
class Filler {
 public:
  Filler() {
    FileDescriptorSet files;
    const std::string_view bytes = blueye::descriptorSet();
    files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
    for (const auto& file : files.file()) pool_.BuildFile(file);
  }

  std::string bytesOf(const std::string& name) {
    const auto* type = pool_.FindMessageTypeByName("blueye.protocol." + name);
    const std::unique_ptr<Message> message{factory_.GetPrototype(type)->New()};
    fill(*message);
    return message->SerializeAsString();
  }

 private:
  void fill(Message& message) {
    const Descriptor& type = *message.GetDescriptor();
    if (type.full_name() == "google.protobuf.Any") return fillAny(message);
    for (int i = 0; i < type.field_count(); ++i) fill(message, *type.field(i));
  }

  void fillAny(Message& message) {
    const Descriptor& type = *message.GetDescriptor();
    const Reflection& out = *message.GetReflection();
    out.SetString(&message, type.FindFieldByName("type_url"),
                  "type.googleapis.com/blueye.protocol.Depth");
    out.SetString(&message, type.FindFieldByName("value"), std::string{"\x0d\0\0\x80\x3f", 5});
  }

  void fill(Message& message, const FieldDescriptor& field) {
    const Reflection& out = *message.GetReflection();
    const bool list = field.is_repeated();
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return fill(list ? *out.AddMessage(&message, &field)
                         : *out.MutableMessage(&message, &field));
      case FieldDescriptor::CPPTYPE_BOOL:
        return list ? out.AddBool(&message, &field, true) : out.SetBool(&message, &field, true);
      case FieldDescriptor::CPPTYPE_INT32:
        return list ? out.AddInt32(&message, &field, 7) : out.SetInt32(&message, &field, 7);
      case FieldDescriptor::CPPTYPE_INT64:
        return list ? out.AddInt64(&message, &field, 7) : out.SetInt64(&message, &field, 7);
      case FieldDescriptor::CPPTYPE_UINT32:
        return list ? out.AddUInt32(&message, &field, 7) : out.SetUInt32(&message, &field, 7);
      case FieldDescriptor::CPPTYPE_UINT64:
        return list ? out.AddUInt64(&message, &field, 7) : out.SetUInt64(&message, &field, 7);
      case FieldDescriptor::CPPTYPE_FLOAT:
        return list ? out.AddFloat(&message, &field, 1.5F) : out.SetFloat(&message, &field, 1.5F);
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return list ? out.AddDouble(&message, &field, 1.5) : out.SetDouble(&message, &field, 1.5);
      case FieldDescriptor::CPPTYPE_ENUM: {
        const auto* last = field.enum_type()->value(field.enum_type()->value_count() - 1);
        return list ? out.AddEnum(&message, &field, last) : out.SetEnum(&message, &field, last);
      }
      default:
        return list ? out.AddString(&message, &field, "text")
                    : out.SetString(&message, &field, "text");
    }
  }

  DescriptorPool pool_;
  DynamicMessageFactory factory_;
};

/// Keeps what a scripted drone's listener hears.
class RoundTrip : public testing::Test {
 protected:
  static BlueyeOptions options() {
    BlueyeOptions options;
    options.allow_format = true;
    options.allow_flash = true;
    return options;
  }

  /// What a user writes, as bytes: through JSON.
  std::string throughJson(const std::string& name, const std::string& bytes) {
    const auto json = catalogue_.toJson(name, bytes);
    EXPECT_TRUE(json.ok) << name << ": " << json.text;
    const auto back = catalogue_.fromJson(name, json.text);
    EXPECT_TRUE(back.ok) << name << ": " << back.text;
    return back.text;
  }

  Filler filler_;
  const protocol::BlueyeCatalogue catalogue_;
  ScriptedDrone drone_{options()};
};

TEST_F(RoundTrip, EveryTelemetryMessageReachesTheListenerAsItIs) {
  drone_.connect();
  drone_.run(2s);  // past what may be older than a reply
  for (const std::string& name : catalogue_.names("Tel")) {
    drone_.heard.clear();
    const std::string bytes = filler_.bytesOf(name);
    EXPECT_FALSE(bytes.empty()) << name;
    drone_.session.telemetry(drone_.now, "blueye.protocol." + name, bytes, drone_);
    ASSERT_FALSE(drone_.heard.empty()) << name;
    EXPECT_EQ(drone_.heard.front(), name);
    EXPECT_EQ(drone_.heard_bytes, bytes) << name;
    EXPECT_EQ(throughJson(name, bytes), bytes) << name;
  }
  EXPECT_EQ(drone_.session.counters().malformed, 0u);
}

TEST_F(RoundTrip, EveryControlMessageReachesTheDroneOrHasItsOwnWay) {
  const std::map<std::string, std::string> kOwners{{"MotionInputCtrl", "cmd_motion"},
                                                   {"TiltVelocityCtrl", "cmd_tilt"},
                                                   {"GripperCtrl", "cmd_gripper"},
                                                   {"WatchdogCtrl", "watchdog"}};
  drone_.giveControl();
  for (const std::string& name : catalogue_.names("Ctrl")) {
    drone_.controls.clear();
    const std::string bytes = filler_.bytesOf(name);
    ConfirmedControls::Control control;
    control.type = "blueye.protocol." + name;
    control.payload = throughJson(name, bytes);
    std::string refusal = "not answered";
    control.respond = [&](const std::string& given) { refusal = given; };
    drone_.session.control(drone_.now, std::move(control), drone_);
    const auto owner = kOwners.find(name);
    if (owner != kOwners.end()) {
      EXPECT_THAT(refusal, testing::HasSubstr(owner->second));
      continue;
    }
    EXPECT_EQ(refusal, "") << name;
    ASSERT_EQ(drone_.controls.size(), 1u) << name;
    EXPECT_EQ(drone_.controls[0].type, name);
    EXPECT_EQ(drone_.controls[0].payload, bytes) << name;
  }
}

TEST_F(RoundTrip, EveryRequestReachesTheDroneAndItsReplyComesBack) {
  drone_.connect();
  drone_.run(1s);
  drone_.echoes = true;
  for (const std::string& name : catalogue_.names("Req")) {
    drone_.requests.clear();
    const std::string bytes = filler_.bytesOf(name);
    const std::string reply_name = name.substr(0, name.size() - 3) + "Rep";
    drone_.echo = {"blueye.protocol." + reply_name, filler_.bytesOf(reply_name)};
    bool answered = false;
    drone_.session.request(
        drone_.now, "blueye.protocol." + name, throughJson(name, bytes), 1s,
        [&](const BlueyeReply& reply) {
          answered = true;
          EXPECT_EQ(reply.type, drone_.echo.first);
          EXPECT_EQ(reply.payload, drone_.echo.second);
        },
        drone_);
    drone_.run(10ms);
    EXPECT_TRUE(answered) << name;
    ASSERT_EQ(drone_.requests.size(), 1u) << name;
    EXPECT_EQ(drone_.requests[0].type, name);
    EXPECT_EQ(drone_.requests[0].payload, bytes) << name;
    EXPECT_EQ(throughJson(reply_name, drone_.echo.second), drone_.echo.second) << reply_name;
  }
}

}  // namespace
}  // namespace frontseat_driver::session
