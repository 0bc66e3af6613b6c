#include "json_output.h"

#include "fault_note.h"
#include "field_text.h"

namespace frontseat_driver::decode {
namespace {

void appendString(std::string& out, std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte >= 0x20 && byte < 0x7F) {
      out += c;
    } else {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 0xF];
    }
  }
  out += '"';
}

/// "heading_deg":90 for each field.
class Fields : public protocol::FieldVisitor {
 public:
  explicit Fields(std::string& out) : out_(out) {}

  void time(const protocol::Field& field, const std::optional<nmea::TimeOfDay>& value) override {
    if (begin(field.name, "_s", value.has_value())) appendSeconds(out_, *value);
  }
  void date(const protocol::Field& field, const std::optional<nmea::Date>& value) override {
    if (!begin(field.name, "", value.has_value())) return;
    out_ += '"';
    appendDate(out_, *value);
    out_ += '"';
  }
  void position(const protocol::Field&, const std::optional<nmea::LatLon>& value) override {
    constexpr int kDecimals = 9;
    if (begin("latitude", "_deg", value.has_value())) {
      appendFixed(out_, value->latitude_deg, kDecimals);
    }
    if (begin("longitude", "_deg", value.has_value())) {
      appendFixed(out_, value->longitude_deg, kDecimals);
    }
  }
  void number(const protocol::Field& field, const std::optional<double>& value) override {
    if (begin(field.name, field.unit.suffix, value.has_value())) appendNumber(out_, *value);
  }
  void integer(const protocol::Field& field, const std::optional<std::int64_t>& value) override {
    if (begin(field.name, "", value.has_value())) appendInteger(out_, *value);
  }
  void flag(const protocol::Field& field, const std::optional<bool>& value) override {
    if (begin(field.name, "", value.has_value())) out_ += *value ? "true" : "false";
  }
  void choice(const protocol::Field& field, const std::optional<std::size_t>& value,
              Words words) override {
    if (begin(field.name, "", value.has_value())) appendString(out_, words.begin()[*value]);
  }
  void text(const protocol::Field& field, std::string_view value) override {
    if (begin(field.name, "", !value.empty())) appendString(out_, value);
  }

 private:
  bool begin(std::string_view name, std::string_view suffix, bool has_value) {
    out_ += first_ ? "\"" : ",\"";
    first_ = false;
    out_ += name;
    out_ += suffix;
    out_ += has_value ? "\":" : "\":null";
    return has_value;
  }

  std::string& out_;
  bool first_ = true;
};

void appendFault(std::string& out, const FaultNote& note) {
  out += ",\"fault\":{\"reason\":";
  appendString(out, note.reason);
  if (note.field > 0) {
    out += ",\"field\":";
    appendInteger(out, note.field);
    out += ",\"name\":";
    appendString(out, note.field_name);
  }
  out += ",\"column\":";
  appendInteger(out, static_cast<std::int64_t>(note.column));
  out += ",\"more\":";
  appendInteger(out, note.more);
  out += '}';
}

}  // namespace

void JsonOutput::write(const DecodedLine& line) {
  std::string& out = sink_.text();
  out += '{';
  if (line.entry.time) {
    out += "\"time_s\":";
    appendSeconds(out, *line.entry.time);
    out += ',';
  }
  out += line.direction == capture::Direction::ToVehicle ? "\"direction\":\"tx\""
                                                         : "\"direction\":\"rx\"";
  out += ",\"sentence\":";
  appendString(out, line.address);
  if (line.reading) {
    out += ",\"fields\":{";
    Fields fields{out};
    protocol::describe(line.reading->message, fields);
    out += '}';
  }
  const auto note = faultOf(line);
  if (note) appendFault(out, *note);
  if (note || line.unknown()) {
    out += ",\"line\":";
    appendString(out, line.entry.line);
  }
  out += '}';
  sink_.endLine();
}

}  // namespace frontseat_driver::decode
