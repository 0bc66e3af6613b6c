#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>

#include "csv_output.h"
#include "field_text.h"
#include "frontseat_driver/capture/byte_source.h"
#include "json_output.h"
#include "line_output.h"
#include "options.h"
#include "plot.h"
#include "progress.h"
#include "record.h"
#include "summary.h"

namespace frontseat_driver::decode {
namespace {

std::unique_ptr<Output> makeOutput(const Options& options) {
  if (options.summary_only) return nullptr;
  if (options.format == Format::Json) return std::make_unique<JsonOutput>(stdout);
  if (options.format == Format::Lines) return std::make_unique<LineOutput>(stdout);
  if (options.folder.empty()) return std::make_unique<CsvOutput>(stdout);
  return std::make_unique<CsvOutput>(options.folder);
}

/// The first Ctrl-C ends the input, so that the summary comes; the second ends the program.
void endInputOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { capture::FileSource::endReading(); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

vehicle::UtcTime utcNow() {
  return std::chrono::duration_cast<vehicle::UtcTime>(
      std::chrono::system_clock::now().time_since_epoch());
}

bool showsProgress(const Options& options) {
  const bool elsewhere =
      options.summary_only || !options.folder.empty() || isatty(STDOUT_FILENO) == 0;
  return !options.quiet && elsewhere;
}

void decodeAll(const Options& options, Record& record, Output* output, Summary& summary) {
  constexpr std::uint64_t kBetweenLooks = 4096;
  Progress progress{record.size, showsProgress(options)};
  LineDecoder decoder;
  Selection selection{options.selection};
  std::uint64_t lines = 0;
  while (true) {
    if (output != nullptr && !record.reader->ready()) output->flush();
    std::optional<capture::Entry> entry = record.reader->next();
    if (!entry) break;
    if (record.live && !entry->time) entry->time = utcNow();
    const DecodedLine line = decoder.decode(*entry);
    if (++lines % kBetweenLooks == 0) progress.show(record.reader->counters().bytes);
    if (!selection.accepts(line)) continue;
    summary.add(line);
    if (output != nullptr) output->write(line);
  }
  if (output != nullptr) output->flush();
}

void run(const Options& options) {
  Record record = openRecord(options);
  const std::unique_ptr<Output> output = makeOutput(options);
  Summary summary;
  decodeAll(options, record, output.get(), summary);
  if (options.quiet && !options.summary_only) return;
  TextSink sink{options.summary_only ? stdout : stderr, "summary"};
  sink.text() = summary.text(record.reader->counters());
  sink.flush();
}

}  // namespace
}  // namespace frontseat_driver::decode

int main(int argc, char** argv) {
  using namespace frontseat_driver::decode;
  const Options options = parseOptions({argv + 1, argv + argc});
  if (options.exit_code) return *options.exit_code;
  endInputOnInterrupt();
  try {
    if (!options.plot.empty()) runPlot(options);
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nmea_decode: %s\n", visible(error.what()).c_str());
    return kExitUnreadable;
  }
  return 0;
}
