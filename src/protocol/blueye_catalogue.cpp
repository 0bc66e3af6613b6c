#include "frontseat_driver/protocol/blueye_catalogue.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "blueye/descriptors.h"

namespace frontseat_driver::protocol {

namespace {

namespace pb = google::protobuf;
using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view kPackage = "blueye.protocol.";

bool endsWith(const std::string& text, std::string_view end) {
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), end.size(), end.data(), end.size()) == 0;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

/// One field that is no message; `index` -1 for one that is no list.
std::string valueOf(const pb::Message& message, const pb::FieldDescriptor& field, int index) {
  const pb::Reflection& in = *message.GetReflection();
  const bool list = index >= 0;
  switch (field.cpp_type()) {
    case pb::FieldDescriptor::CPPTYPE_BOOL:
      return (list ? in.GetRepeatedBool(message, &field, index) : in.GetBool(message, &field))
                 ? "true"
                 : "false";
    case pb::FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(list ? in.GetRepeatedInt32(message, &field, index)
                                 : in.GetInt32(message, &field));
    case pb::FieldDescriptor::CPPTYPE_INT64:
      return std::to_string(list ? in.GetRepeatedInt64(message, &field, index)
                                 : in.GetInt64(message, &field));
    case pb::FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(list ? in.GetRepeatedUInt32(message, &field, index)
                                 : in.GetUInt32(message, &field));
    case pb::FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(list ? in.GetRepeatedUInt64(message, &field, index)
                                 : in.GetUInt64(message, &field));
    case pb::FieldDescriptor::CPPTYPE_FLOAT:
      return number(list ? in.GetRepeatedFloat(message, &field, index)
                         : in.GetFloat(message, &field));
    case pb::FieldDescriptor::CPPTYPE_DOUBLE:
      return number(list ? in.GetRepeatedDouble(message, &field, index)
                         : in.GetDouble(message, &field));
    case pb::FieldDescriptor::CPPTYPE_ENUM: {
      const int given =
          list ? in.GetRepeatedEnumValue(message, &field, index) : in.GetEnumValue(message, &field);
      const auto* known = field.enum_type()->FindValueByNumber(given);
      return known != nullptr ? known->name() : std::to_string(given);
    }
    default:
      return list ? in.GetRepeatedString(message, &field, index) : in.GetString(message, &field);
  }
}

void collect(const pb::Message& message, const std::string& path, Values& out) {
  const pb::Descriptor& descriptor = *message.GetDescriptor();
  const pb::Reflection& in = *message.GetReflection();
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const pb::FieldDescriptor& field = *descriptor.field(i);
    const bool is_message = field.cpp_type() == pb::FieldDescriptor::CPPTYPE_MESSAGE;
    const std::string name = path.empty() ? field.name() : path + "." + field.name();
    if (field.is_repeated()) {
      for (int k = 0; k < in.FieldSize(message, &field); ++k) {
        const std::string element = name + "[" + std::to_string(k) + "]";
        if (is_message) {
          collect(in.GetRepeatedMessage(message, &field, k), element, out);
        } else {
          out.emplace_back(element, valueOf(message, field, k));
        }
      }
    } else if (!is_message) {
      const bool other_of_oneof =
          field.containing_oneof() != nullptr && !in.HasField(message, &field);
      if (!other_of_oneof) out.emplace_back(name, valueOf(message, field, -1));
    } else if (in.HasField(message, &field)) {
      collect(in.GetMessage(message, &field), name, out);
    }
  }
}

bool isNumber(const pb::FieldDescriptor& field) {
  return field.cpp_type() == pb::FieldDescriptor::CPPTYPE_FLOAT ||
         field.cpp_type() == pb::FieldDescriptor::CPPTYPE_DOUBLE;
}

/// The first number that is none; empty if there is none such.
std::string notFinite(const pb::Message& message) {
  std::vector<const pb::FieldDescriptor*> fields;
  const pb::Reflection& in = *message.GetReflection();
  in.ListFields(message, &fields);
  for (const pb::FieldDescriptor* field : fields) {
    const int size = field->is_repeated() ? in.FieldSize(message, field) : 1;
    for (int i = 0; i < size; ++i) {
      const int index = field->is_repeated() ? i : -1;
      if (isNumber(*field)) {
        const std::string text = valueOf(message, *field, index);
        if (text.find_first_of("ni") != std::string::npos) return field->name() + " is " + text;
      } else if (field->cpp_type() == pb::FieldDescriptor::CPPTYPE_MESSAGE) {
        const std::string inner =
            notFinite(field->is_repeated() ? in.GetRepeatedMessage(message, field, i)
                                           : in.GetMessage(message, field));
        if (!inner.empty()) return inner;
      }
    }
  }
  return {};
}

}  // namespace

class BlueyeCatalogue::Impl {
 public:
  Impl() {
    pb::FileDescriptorSet files;
    const std::string_view bytes = blueye::descriptorSet();
    files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
    for (const pb::FileDescriptorProto& file : files.file())
      built_.push_back(pool_.BuildFile(file));
  }

  const pb::Descriptor* find(std::string_view type) const {
    return pool_.FindMessageTypeByName(fullName(type));
  }

  std::unique_ptr<pb::Message> make(const pb::Descriptor& descriptor) const {
    return std::unique_ptr<pb::Message>(factory_.GetPrototype(&descriptor)->New());
  }

  std::vector<std::string> names(std::string_view end) const {
    std::vector<std::string> found;
    for (const pb::FileDescriptor* file : built_) {
      if (file->package() + "." != kPackage) continue;
      for (int i = 0; i < file->message_type_count(); ++i) {
        const std::string& name = file->message_type(i)->name();
        if (endsWith(name, end)) found.push_back(name);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  pb::DescriptorPool pool_;
  std::vector<const pb::FileDescriptor*> built_;
  mutable pb::DynamicMessageFactory factory_;  // locks itself
};

BlueyeCatalogue::BlueyeCatalogue() : impl_(std::make_unique<Impl>()) {}

BlueyeCatalogue::~BlueyeCatalogue() = default;

bool BlueyeCatalogue::knows(std::string_view type) const { return impl_->find(type) != nullptr; }

std::string BlueyeCatalogue::fullName(std::string_view type) {
  const bool bare = type.find('.') == std::string_view::npos;
  return bare ? std::string{kPackage} + std::string{type} : std::string{type};
}

std::vector<std::string> BlueyeCatalogue::names(std::string_view end) const {
  return impl_->names(end);
}

BlueyeCatalogue::Result BlueyeCatalogue::fromJson(std::string_view type,
                                                  const std::string& json) const {
  const pb::Descriptor* descriptor = impl_->find(type);
  if (descriptor == nullptr) return {false, "there is no message " + std::string{type}};
  const auto message = impl_->make(*descriptor);
  if (!json.empty()) {
    const auto status = pb::util::JsonStringToMessage(json, message.get());
    if (!status.ok())
      return {false, "the JSON is not a " + descriptor->name() + ": " + status.ToString()};
  }
  const std::string wrong = notFinite(*message);
  if (!wrong.empty()) return {false, wrong + "; a finite number is accepted"};
  return {true, message->SerializeAsString()};
}

BlueyeCatalogue::Result BlueyeCatalogue::toJson(std::string_view type,
                                                std::string_view bytes) const {
  const pb::Descriptor* descriptor = impl_->find(type);
  if (descriptor == nullptr) return {false, "there is no message " + std::string{type}};
  const auto message = impl_->make(*descriptor);
  if (!message->ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return {false, "the bytes are not a " + descriptor->name()};
  }
  pb::util::JsonPrintOptions options;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  std::string json;
  const auto status = pb::util::MessageToJsonString(*message, &json, options);
  if (!status.ok()) return {false, status.ToString()};
  return {true, json};
}

std::vector<std::pair<std::string, std::string>> BlueyeCatalogue::values(
    std::string_view type, std::string_view bytes) const {
  Values found;
  const pb::Descriptor* descriptor = impl_->find(type);
  if (descriptor == nullptr) return found;
  const auto message = impl_->make(*descriptor);
  if (!message->ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return found;
  collect(*message, "", found);
  return found;
}

}  // namespace frontseat_driver::protocol
