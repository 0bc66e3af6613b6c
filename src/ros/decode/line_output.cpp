#include "line_output.h"

#include "fault_note.h"
#include "field_text.h"

namespace frontseat_driver::decode {
namespace {

/// ", heading 90 deg" for each field; "-" for a blank one.
class Fields : public protocol::FieldVisitor {
 public:
  explicit Fields(std::string& out) : out_(out) {}

  void time(const protocol::Field& field, const std::optional<nmea::TimeOfDay>& value) override {
    if (begin(field, value.has_value())) appendClock(out_, *value);
  }
  void date(const protocol::Field& field, const std::optional<nmea::Date>& value) override {
    if (begin(field, value.has_value())) appendDate(out_, *value);
  }
  void position(const protocol::Field& field, const std::optional<nmea::LatLon>& value) override {
    if (!begin(field, value.has_value())) return;
    degrees(value->latitude_deg, " N ", " S ");
    degrees(value->longitude_deg, " E", " W");
  }
  void number(const protocol::Field& field, const std::optional<double>& value) override {
    if (!begin(field, value.has_value())) return;
    appendNumber(out_, *value);
    if (field.unit.symbol.empty()) return;
    out_ += ' ';
    out_ += field.unit.symbol;
  }
  void integer(const protocol::Field& field, const std::optional<std::int64_t>& value) override {
    if (begin(field, value.has_value())) appendInteger(out_, *value);
  }
  void flag(const protocol::Field& field, const std::optional<bool>& value) override {
    if (begin(field, value.has_value())) out_ += *value ? "yes" : "no";
  }
  void choice(const protocol::Field& field, const std::optional<std::size_t>& value,
              Words words) override {
    if (begin(field, value.has_value())) out_ += words.begin()[*value];
  }
  void text(const protocol::Field& field, std::string_view value) override {
    if (!begin(field, !value.empty())) return;
    out_ += '"';
    appendVisible(out_, value);
    out_ += '"';
  }

 private:
  bool begin(const protocol::Field& field, bool has_value) {
    out_ += first_ ? ": " : ", ";
    first_ = false;
    for (const char c : field.name) out_ += c == '_' ? ' ' : c;
    out_ += has_value ? " " : " -";
    return has_value;
  }

  void degrees(double value, std::string_view positive, std::string_view negative) {
    constexpr int kDecimals = 7;  // a centimetre
    appendFixed(out_, value < 0.0 ? -value : value, kDecimals);
    out_ += value < 0.0 ? negative : positive;
  }

  std::string& out_;
  bool first_ = true;
};

void appendSentence(std::string& out, const DecodedLine& line) {
  out += line.address;
  out += ' ';
  out += protocol::titleOf(line.reading->message);
  Fields fields{out};
  protocol::describe(line.reading->message, fields);
}

/// The line, and below it a mark at the column.
void appendMarked(std::string& out, std::string_view line, std::size_t column) {
  constexpr std::string_view kIndent = "\n    ";
  out += kIndent;
  appendVisible(out, line);
  out += kIndent;
  out.append(visible(line.substr(0, column - 1)).size(), ' ');
  out += '^';
}

void appendFault(std::string& out, const FaultNote& note) {
  if (note.field > 0) {
    out += "field ";
    appendInteger(out, note.field);
    if (!note.field_name.empty()) out += " (" + note.field_name + ")";
    out += ": ";
  }
  appendVisible(out, note.reason);
  out += ", column ";
  appendInteger(out, static_cast<std::int64_t>(note.column));
  if (note.more == 0) return;
  out += "; bad fields besides it: ";
  appendInteger(out, note.more);
}

}  // namespace

void LineOutput::write(const DecodedLine& line) {
  std::string& out = sink_.text();
  if (line.entry.time) {
    appendUtc(out, *line.entry.time);
    out += ' ';
  }
  out += line.direction == capture::Direction::ToVehicle ? "> " : "< ";
  if (line.unknown()) {
    appendVisible(out, line.address);
    out += " unknown sentence: ";
    appendVisible(out, line.entry.line);
  }
  if (line.reading) appendSentence(out, line);
  if (const auto note = faultOf(line)) {
    out += line.reading ? "\n    " : "bad line: ";
    appendFault(out, *note);
    appendMarked(out, line.entry.line, note->column);
  }
  sink_.endLine();
}

}  // namespace frontseat_driver::decode
