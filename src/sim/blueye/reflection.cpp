#include "reflection.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>

#include <cmath>
#include <memory>

#include "blueye/descriptors.h"

namespace frontseat_driver::sim {
namespace {

namespace pb = google::protobuf;

/// The generated classes know no descriptors; these do.
class Dynamic {
 public:
  Dynamic() {
    pb::FileDescriptorSet files;
    const std::string_view data = ::blueye::descriptorSet();
    files.ParseFromArray(data.data(), static_cast<int>(data.size()));
    for (const pb::FileDescriptorProto& file : files.file()) pool.BuildFile(file);
  }

  std::unique_ptr<pb::Message> make(const std::string& name) {
    const pb::Descriptor* type = pool.FindMessageTypeByName(kBlueyePackage + name);
    if (type == nullptr) return nullptr;
    return std::unique_ptr<pb::Message>{factory.GetPrototype(type)->New()};
  }

  pb::DescriptorPool pool;
  pb::DynamicMessageFactory factory;
};

Dynamic& dynamic() {
  static Dynamic all;
  return all;
}

bool allFinite(const pb::Message& message);

bool isFinite(const pb::Message& message, const pb::FieldDescriptor& field) {
  const pb::Reflection& reflection = *message.GetReflection();
  const int count = field.is_repeated() ? reflection.FieldSize(message, &field) : 1;
  for (int i = 0; i < count; ++i) {
    const bool repeated = field.is_repeated();
    switch (field.cpp_type()) {
      case pb::FieldDescriptor::CPPTYPE_FLOAT:
        if (!std::isfinite(repeated ? reflection.GetRepeatedFloat(message, &field, i)
                                    : reflection.GetFloat(message, &field)))
          return false;
        break;
      case pb::FieldDescriptor::CPPTYPE_DOUBLE:
        if (!std::isfinite(repeated ? reflection.GetRepeatedDouble(message, &field, i)
                                    : reflection.GetDouble(message, &field)))
          return false;
        break;
      case pb::FieldDescriptor::CPPTYPE_MESSAGE:
        if (!allFinite(repeated ? reflection.GetRepeatedMessage(message, &field, i)
                                : reflection.GetMessage(message, &field)))
          return false;
        break;
      default:
        return true;
    }
  }
  return true;
}

bool allFinite(const pb::Message& message) {
  std::vector<const pb::FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const pb::FieldDescriptor* field : fields) {
    if (!isFinite(message, *field)) return false;
  }
  return true;
}

}  // namespace

bool isFinite(const std::string& name, std::string_view data) {
  const auto message = dynamic().make(name);
  return message && message->ParseFromArray(data.data(), static_cast<int>(data.size())) &&
         allFinite(*message);
}

bool setFlag(bp::ErrorFlags& flags, const std::string& field, bool value) {
  const auto message = dynamic().make("ErrorFlags");
  message->ParseFromString(flags.SerializeAsString());
  const pb::FieldDescriptor* found = message->GetDescriptor()->FindFieldByName(field);
  if (found == nullptr || found->cpp_type() != pb::FieldDescriptor::CPPTYPE_BOOL) return false;
  message->GetReflection()->SetBool(message.get(), found, value);
  return flags.ParseFromString(message->SerializeAsString());
}

std::vector<std::string> messagesEndingIn(std::string_view ending) {
  std::vector<std::string> names;
  pb::FileDescriptorSet files;
  const std::string_view data = ::blueye::descriptorSet();
  files.ParseFromArray(data.data(), static_cast<int>(data.size()));
  for (const pb::FileDescriptorProto& file : files.file()) {
    if (file.package() + "." != kBlueyePackage) continue;
    for (const pb::DescriptorProto& message : file.message_type()) {
      const std::string& name = message.name();
      if (name.size() < ending.size()) continue;
      if (name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
        names.push_back(name);
      }
    }
  }
  return names;
}

}  // namespace frontseat_driver::sim
