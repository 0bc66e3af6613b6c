// The compiled descriptors against the tables of the protocol, field by field and both ways.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "blueye/descriptors.h"
#include "blueye/telemetry.pb.h"

namespace {

namespace pb = google::protobuf;

const std::string kPackage = "blueye.protocol.";

const pb::DescriptorPool& pool() {
  static const auto* built = [] {
    auto* result = new pb::DescriptorPool;
    pb::FileDescriptorSet files;
    const std::string_view bytes = blueye::descriptorSet();
    if (!files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return result;
    for (const auto& file : files.file()) EXPECT_NE(result->BuildFile(file), nullptr);
    return result;
  }();
  return *built;
}

/// Every line of a table after its head, split at the commas.
std::vector<std::vector<std::string>> table(const std::string& name) {
  std::ifstream file{std::string{DATA_DIR} + "/" + name};
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    auto& row = rows.emplace_back();
    std::istringstream in{line};
    std::string cell;
    while (std::getline(in, cell, ',')) row.push_back(cell);
  }
  return rows;
}

/// As the table has it: without the package.
std::string withoutPackage(const std::string& full) {
  return full.compare(0, kPackage.size(), kPackage) == 0 ? full.substr(kPackage.size()) : full;
}

std::string typeOf(const pb::FieldDescriptor& field) {
  if (const auto* message = field.message_type()) return withoutPackage(message->full_name());
  if (const auto* values = field.enum_type()) return withoutPackage(values->full_name());
  return field.type_name();
}

std::string oneofOf(const pb::FieldDescriptor& field) {
  return field.containing_oneof() != nullptr ? field.containing_oneof()->name() : "";
}

/// "file,message,field,number,type,label,oneof" of every field, and of every message without one.
void collect(const pb::Descriptor& message, std::multiset<std::string>& rows) {
  std::string file = message.file()->name();
  file = file.substr(file.rfind('/') + 1);
  const std::string head =
      file.substr(0, file.find('.')) + "," + withoutPackage(message.full_name()) + ",";
  rows.insert(head);
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    rows.insert(head + field.name() + "," + std::to_string(field.number()) + "," + typeOf(field) +
                "," + (field.is_repeated() ? "repeated" : "") + "," + oneofOf(field));
  }
  for (int i = 0; i < message.nested_type_count(); ++i) collect(*message.nested_type(i), rows);
}

void collect(const pb::EnumDescriptor& values, const std::string& scope,
             std::multiset<std::string>& rows) {
  for (int i = 0; i < values.value_count(); ++i) {
    rows.insert(values.name() + "," + scope + "," + values.value(i)->name() + "," +
                std::to_string(values.value(i)->number()));
  }
}

void collectEnums(const pb::Descriptor& message, std::multiset<std::string>& rows) {
  for (int i = 0; i < message.enum_type_count(); ++i) {
    collect(*message.enum_type(i), withoutPackage(message.full_name()), rows);
  }
  for (int i = 0; i < message.nested_type_count(); ++i) {
    collectEnums(*message.nested_type(i), rows);
  }
}

const char* const kFiles[] = {"aquatroll",        "control", "message_formats",
                              "mission_planning", "req_rep", "telemetry"};

const pb::FileDescriptor* fileNamed(const std::string& name) {
  return pool().FindFileByName("blueye/" + name + ".proto");
}

TEST(Descriptors, HaveEveryFieldOfTheTableAndNoOther) {
  std::multiset<std::string> expected;
  std::set<std::string> messages;
  for (const auto& row : table("fields.csv")) {
    ASSERT_GE(row.size(), 7u);
    messages.insert(row[0] + "," + row[1] + ",");
    if (row[2].empty()) continue;
    expected.insert(row[0] + "," + row[1] + "," + row[2] + "," + row[3] + "," + row[4] + "," +
                    row[5] + "," + row[6]);
  }
  ASSERT_GT(expected.size(), 900u);
  expected.insert(messages.begin(), messages.end());
  std::multiset<std::string> compiled;
  for (const auto* name : kFiles) {
    const auto* file = fileNamed(name);
    ASSERT_NE(file, nullptr) << name;
    EXPECT_EQ(file->package(), "blueye.protocol");
    EXPECT_EQ(file->syntax(), pb::FileDescriptor::SYNTAX_PROTO3);
    for (int i = 0; i < file->message_type_count(); ++i) collect(*file->message_type(i), compiled);
  }
  for (const auto& row : expected) EXPECT_EQ(compiled.count(row), expected.count(row)) << row;
  for (const auto& row : compiled) EXPECT_EQ(expected.count(row), 1u) << row << " is no row";
}

TEST(Descriptors, HaveEveryEnumeratorOfTheTableAndNoOther) {
  std::multiset<std::string> expected;
  for (const auto& row : table("enums.csv")) {
    ASSERT_GE(row.size(), 4u);
    expected.insert(row[0] + "," + row[1] + "," + row[2] + "," + row[3]);
  }
  ASSERT_GT(expected.size(), 500u);
  std::multiset<std::string> compiled;
  for (const auto* name : kFiles) {
    const auto* file = fileNamed(name);
    ASSERT_NE(file, nullptr) << name;
    for (int i = 0; i < file->enum_type_count(); ++i) collect(*file->enum_type(i), name, compiled);
    for (int i = 0; i < file->message_type_count(); ++i) {
      collectEnums(*file->message_type(i), compiled);
    }
  }
  EXPECT_EQ(compiled, expected);
}

TEST(Descriptors, ReserveTheNumbersThatMustNeverComeBack) {
  const std::map<std::string, std::vector<int>> kReserved{
      {"AquaTrollParameterBlock", {4}},
      {"AquaTrollSensorMetadata", {4}},
      {"AquaTrollProbeMetadata", {19}},
      {"CanisterTemperature", {1, 2}},
      {"CanisterHumidity", {1, 2}},
      {"BatteryBQ40Z50", {3, 5}},
      {"BatteryBQ40Z50.BatteryStatus", {15, 16}},
      {"CameraParameters", {19}}};
  for (const auto& [name, numbers] : kReserved) {
    const auto* message = pool().FindMessageTypeByName(kPackage + name);
    ASSERT_NE(message, nullptr) << name;
    for (const int number : numbers) EXPECT_TRUE(message->IsReservedNumber(number)) << name;
  }
}

TEST(Descriptors, AreNotRegisteredForTheWholeProcess) {
  blueye::protocol::AttitudeTel message;  // keeps its file linked
  EXPECT_EQ(message.GetTypeName(), "blueye.protocol.AttitudeTel");
  const auto& everybody = *pb::DescriptorPool::generated_pool();
  EXPECT_EQ(everybody.FindFileByName("blueye/telemetry.proto"), nullptr);
  EXPECT_EQ(everybody.FindMessageTypeByName("blueye.protocol.AttitudeTel"), nullptr);
}

}  // namespace
