#include "fault_note.h"

#include <algorithm>
#include <cstdio>

#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::decode {
namespace {

using nmea::Fault;

/// Finds the name of a field by its number.
class FieldName : public protocol::FieldVisitor {
 public:
  explicit FieldName(int number) : number_(number) {}

  std::string name() const { return std::string{name_}; }

  void time(const protocol::Field& field, const std::optional<nmea::TimeOfDay>&) override {
    take(field);
  }
  void date(const protocol::Field& field, const std::optional<nmea::Date>&) override {
    take(field);
  }
  void position(const protocol::Field& field, const std::optional<nmea::LatLon>&) override {
    take(field, 4);
  }
  void number(const protocol::Field& field, const std::optional<double>&) override { take(field); }
  void integer(const protocol::Field& field, const std::optional<std::int64_t>&) override {
    take(field);
  }
  void flag(const protocol::Field& field, const std::optional<bool>&) override { take(field); }
  void choice(const protocol::Field& field, const std::optional<std::size_t>&, Words) override {
    take(field);
  }
  void text(const protocol::Field& field, std::string_view) override { take(field); }

 private:
  void take(const protocol::Field& field, int fields = 1) {
    if (number_ >= field.number && number_ < field.number + fields) name_ = field.name;
  }

  int number_;
  std::string_view name_;
};

std::string nameOf(const protocol::Message& message, int number) {
  FieldName finder{number};
  protocol::describe(message, finder);
  std::string name = finder.name();
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Where a field begins; for one that is missing, where the fields end.
std::size_t columnOfField(std::string_view line, int field) {
  const std::size_t end = std::min(line.find('*'), line.size());
  std::size_t at = 0;
  for (; field > 0; --field) {
    at = line.find(',', at);
    if (at == std::string_view::npos || at >= end) return end + 1;
    ++at;
  }
  for (; at < end && line[at] == ' '; ++at) continue;
  return at + 1;
}

/// The first byte that is not allowed, or what follows the checksum, or the address.
std::size_t columnOfBadFrame(std::string_view line) {
  const auto allowed = [](char c) { return c >= 0x20; };  // beyond ASCII is negative
  const auto bad = std::find_if_not(line.begin(), line.end(), allowed);
  if (bad != line.end()) return static_cast<std::size_t>(bad - line.begin()) + 1;
  const std::size_t star = line.find('*');
  if (star == std::string_view::npos) return line.size() + 1;
  const std::string_view sum = line.substr(star + 1);
  const auto is_hex = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f');
  };
  const auto hex_end = std::find_if_not(sum.begin(), sum.end(), is_hex) - sum.begin();
  const std::size_t digits = std::min<std::size_t>(static_cast<std::size_t>(hex_end), 2);
  const bool blank_after = sum.find_first_not_of(' ', digits) == std::string_view::npos;
  return digits == 2 && blank_after ? 2 : star + digits + 2;
}

std::size_t columnOf(std::string_view line, const nmea::Failure& failure) {
  if (failure.field > 0) return columnOfField(line, failure.field);
  if (failure.fault == Fault::BadFrame) return columnOfBadFrame(line);
  return std::min(line.find('*') + 1, line.size()) + 1;
}

std::string reasonOf(std::string_view line, const nmea::Failure& failure) {
  std::string reason = nmea::toString(failure.fault);
  const std::size_t star = line.find('*');
  if (failure.fault != Fault::BadChecksum || star + 2 >= line.size()) return reason;
  char numbers[32];
  std::snprintf(numbers, sizeof numbers, ": %c%c sent, %02X computed", line[star + 1],
                line[star + 2], nmea::checksum(line.substr(1, star - 1)));
  return reason + numbers;
}

}  // namespace

std::optional<FaultNote> faultOf(const DecodedLine& line) {
  if (line.unknown() || (line.reading && line.reading->faults.count == 0)) return std::nullopt;
  const nmea::Failure failure = line.reading ? line.reading->faults.first : line.reading.failure();
  FaultNote note;
  note.reason = reasonOf(line.entry.line, failure);
  note.field = failure.field;
  note.column = columnOf(line.entry.line, failure);
  if (line.reading) {
    note.field_name = nameOf(line.reading->message, failure.field);
    note.more = line.reading->faults.count - 1;
  }
  return note;
}

}  // namespace frontseat_driver::decode
