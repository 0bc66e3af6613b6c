#include "csv_output.h"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "fault_note.h"
#include "field_text.h"

namespace frontseat_driver::decode {
namespace {

void appendCell(std::string& out, std::string_view text) {
  if (text.find_first_of("\",\\") == std::string_view::npos) return appendVisible(out, text);
  out += '"';
  for (const char c : visible(text)) out += c == '"' ? std::string(2, c) : std::string(1, c);
  out += '"';
}

/// ",heading_deg" for each field.
class Header : public protocol::FieldVisitor {
 public:
  explicit Header(std::string& out) : out_(out) {}

  void time(const protocol::Field& field, const std::optional<nmea::TimeOfDay>&) override {
    cell(field.name, "_s");
  }
  void date(const protocol::Field& field, const std::optional<nmea::Date>&) override {
    cell(field.name);
  }
  void position(const protocol::Field&, const std::optional<nmea::LatLon>&) override {
    cell("latitude", "_deg");
    cell("longitude", "_deg");
  }
  void number(const protocol::Field& field, const std::optional<double>&) override {
    cell(field.name, field.unit.suffix);
  }
  void integer(const protocol::Field& field, const std::optional<std::int64_t>&) override {
    cell(field.name);
  }
  void flag(const protocol::Field& field, const std::optional<bool>&) override { cell(field.name); }
  void choice(const protocol::Field& field, const std::optional<std::size_t>&, Words) override {
    cell(field.name);
  }
  void text(const protocol::Field& field, std::string_view) override { cell(field.name); }

 private:
  void cell(std::string_view name, std::string_view suffix = {}) {
    out_ += ',';
    out_ += name;
    out_ += suffix;
  }

  std::string& out_;
};

/// ",90" for each field.
class Cells : public protocol::FieldVisitor {
 public:
  explicit Cells(std::string& out) : out_(out) {}

  void time(const protocol::Field&, const std::optional<nmea::TimeOfDay>& value) override {
    out_ += ',';
    if (value) appendSeconds(out_, *value);
  }
  void date(const protocol::Field&, const std::optional<nmea::Date>& value) override {
    out_ += ',';
    if (value) appendDate(out_, *value);
  }
  void position(const protocol::Field&, const std::optional<nmea::LatLon>& value) override {
    constexpr int kDecimals = 9;
    out_ += ',';
    if (value) appendFixed(out_, value->latitude_deg, kDecimals);
    out_ += ',';
    if (value) appendFixed(out_, value->longitude_deg, kDecimals);
  }
  void number(const protocol::Field&, const std::optional<double>& value) override {
    out_ += ',';
    if (value) appendNumber(out_, *value);
  }
  void integer(const protocol::Field&, const std::optional<std::int64_t>& value) override {
    out_ += ',';
    if (value) appendInteger(out_, *value);
  }
  void flag(const protocol::Field&, const std::optional<bool>& value) override {
    out_ += ',';
    if (value) out_ += *value ? '1' : '0';
  }
  void choice(const protocol::Field&, const std::optional<std::size_t>& value,
              Words words) override {
    out_ += ',';
    if (value) out_ += words.begin()[*value];
  }
  void text(const protocol::Field&, std::string_view value) override {
    out_ += ',';
    appendCell(out_, value);
  }

 private:
  std::string& out_;
};

constexpr char kUnknown[] = "unknown";
constexpr char kBad[] = "bad";

/// What a table is called: sentences that differ by their talker alone have one together.
std::string_view tableName(const DecodedLine& line) {
  if (line.unknown()) return kUnknown;
  return line.reading ? line.address.substr(2) : kBad;
}

void appendHeader(std::string& out, const DecodedLine& line) {
  out += "time_s,sentence";
  if (line.reading) {
    Header header{out};
    protocol::describe(line.reading->message, header);
  }
  out += line.reading ? ",fault" : ",fault,line";
}

std::string faultText(const FaultNote& note) {
  const std::string place = note.field > 0 ? "field " + std::to_string(note.field) + ": " : "";
  return place + note.reason + " (column " + std::to_string(note.column) + ")";
}

}  // namespace

struct CsvOutput::Table {
  Table(std::FILE* stream, const std::string& name, bool own) : sink(stream, name), file(stream) {
    owned = own;
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table() {
    if (owned) std::fclose(file);
  }

  TextSink sink;
  std::FILE* file;
  bool owned = false;
};

CsvOutput::CsvOutput(const std::string& folder) : folder_(folder) {
  constexpr mode_t kAll = 0777;  // less what the umask takes off
  if (mkdir(folder.c_str(), kAll) == 0 || errno == EEXIST) return;
  throw std::system_error(errno, std::generic_category(), folder);
}

CsvOutput::CsvOutput(std::FILE* stream) : stream_(stream) {}

CsvOutput::~CsvOutput() = default;

std::unique_ptr<CsvOutput::Table> CsvOutput::open(const std::string& name) const {
  if (stream_ != nullptr) return std::make_unique<Table>(stream_, "standard output", false);
  const std::string path = folder_ + "/" + name + ".csv";
  std::FILE* const file = std::fopen(path.c_str(), "we");
  if (file == nullptr) throw std::system_error(errno, std::generic_category(), path);
  return std::make_unique<Table>(file, path, true);
}

CsvOutput::Table& CsvOutput::tableFor(const DecodedLine& line) {
  const std::string_view name = tableName(line);
  if (const auto found = tables_.find(name); found != tables_.end()) return *found->second;
  const auto opened = tables_.emplace(name, open(std::string{name})).first;
  appendHeader(opened->second->sink.text(), line);
  opened->second->sink.endLine();
  return *opened->second;
}

void CsvOutput::write(const DecodedLine& line) {
  if (stream_ != nullptr && !line.reading) return;
  Table& table = tableFor(line);
  std::string& out = table.sink.text();
  if (line.entry.time) appendSeconds(out, *line.entry.time);
  out += ',';
  appendCell(out, line.address);
  if (line.reading) {
    Cells cells{out};
    protocol::describe(line.reading->message, cells);
  }
  out += ',';
  if (const auto note = faultOf(line)) appendCell(out, faultText(*note));
  if (!line.reading) {
    out += ',';
    appendCell(out, line.entry.line);
  }
  table.sink.endLine();
}

void CsvOutput::flush() {
  for (auto& table : tables_) table.second->sink.flush();
}

}  // namespace frontseat_driver::decode
