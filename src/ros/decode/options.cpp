#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>

#include "field_text.h"

namespace frontseat_driver::decode {
namespace {

constexpr char kAbout[] =
    "Shows what is in a record of a vehicle's NMEA conversation.\n\n"
    "  nmea_decode mission.bag              every sentence with the names and units of its fields\n"
    "  nmea_decode --summary log.txt        only counts, rates, gaps and faults\n"
    "  nmea_decode --only NVG,NVR --from 60 --to 120 log.txt\n"
    "  nmea_decode --format csv --output tables mission.pcap\n"
    "  nmea_decode --format json --only ACK mission.bag | jq .fields.status\n"
    "  nmea_decode /dev/ttyUSB0 --baud 9600\n"
    "  nc 192.168.1.2 29500 | nmea_decode\n";

constexpr char kExits[] =
    "Exit codes: 0 done (whatever is in the record), 1 the input cannot be read or the output not\n"
    "written, 2 wrong options.";

std::vector<std::string> namesOf(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  std::vector<std::string> names;
  std::istringstream in{text};
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

std::string nameFault(const std::string& name) {
  const auto allowed = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const bool valid =
      name.size() >= 3 && name.size() <= 8 && std::all_of(name.begin(), name.end(), allowed);
  return valid ? "" : "'" + visible(name) + "' names no sentence; such as NVG or BFNVG does";
}

std::string namesFault(const std::string& text) {
  const std::vector<std::string> names = namesOf(text);
  for (const std::string& name : names) {
    if (std::string fault = nameFault(name); !fault.empty()) return fault;
  }
  return names.empty() ? nameFault(text) : "";
}

std::string momentFault(const std::string& text) {
  if (toMoment(text)) return {};
  return "'" + visible(text) +
         "' is no time; such as 2014-11-19T14:30:00Z, 1416407400 or 90 (seconds after the start) "
         "is";
}

/// What has to be translated.
struct Words {
  std::string format = "lines";
  std::string only, except, dialect, from, to;
};

void addInput(CLI::App& app, Options& options) {
  app.add_option(
         "input", options.input,
         "text log, bag, pcap or pcapng file, serial device, or - for standard input. Lines "
         "of a text log may begin with a time (UNIX or ISO 8601) and > or <")
      ->type_name("FILE");
  app.add_option("--baud", options.baud, "rate of a serial device (115200)")->type_name("N");
  app.add_option("--port", options.port, "TCP port of the vehicle in a packet capture (29500)")
      ->type_name("N")
      ->check(CLI::Range(1, 65535));
  app.add_option("--vehicle", options.vehicle,
                 "namespace of the vehicle, where a bag holds several, such as /alpha")
      ->type_name("NAME");
}

void addOutput(CLI::App& app, Options& options, Words& words) {
  app.add_option("--format", words.format,
                 "lines: to read (the default); csv: a table for each kind of sentence; json: an "
                 "object on each line")
      ->check(CLI::IsMember({"lines", "csv", "json"}))
      ->type_name("lines|csv|json");
  app.add_option("--output", options.folder,
                 "folder for the tables of --format csv; without it one kind of sentence, named "
                 "with --only, goes to standard output")
      ->type_name("DIR");
  app.add_flag("--summary", options.summary_only, "only the summary, on standard output");
  app.add_flag("--quiet", options.quiet, "no summary and no progress bar");
  app.add_option(
         "--plot", options.plot,
         "draw the whole record into this picture (png, svg or html), by the program nmea_plot; "
         "--vehicle and --quiet go with it")
      ->type_name("FILE");
}

void addSelection(CLI::App& app, Words& words) {
  app.add_option("--only", words.only, "these sentences only: NVG,BFACK,...")
      ->check(namesFault)
      ->type_name("NAMES");
  app.add_option("--except", words.except, "all but these sentences")
      ->check(namesFault)
      ->type_name("NAMES");
  app.add_option(
         "--from", words.from,
         "from this time on: 2014-11-19T14:30:00Z, UNIX seconds, or seconds after the start")
      ->check(momentFault)
      ->type_name("TIME");
  app.add_option("--to", words.to, "before this time")->check(momentFault)->type_name("TIME");
  app.add_option("--dialect", words.dialect, "leave out the sentences of the other kind of vehicle")
      ->check(CLI::IsMember({"sandshark", "kingfisher"}))
      ->type_name("sandshark|kingfisher");
}

void translate(const Words& words, Options& options) {
  if (words.format == "csv") options.format = Format::Csv;
  if (words.format == "json") options.format = Format::Json;
  Selection::Config& selection = options.selection;
  if (words.dialect == "sandshark") selection.dialect = protocol::Dialect::Sandshark;
  if (words.dialect == "kingfisher") selection.dialect = protocol::Dialect::Kingfisher;
  selection.only = namesOf(words.only);
  selection.except = namesOf(words.except);
  if (!words.from.empty()) selection.from = toMoment(words.from);
  if (!words.to.empty()) selection.to = toMoment(words.to);
}

// nmea_plot draws a whole record, a bag by its messages: what selects or presents sentences is
// nothing to it.
constexpr const char* kNotWithPlot[] = {"--from", "--to",   "--only",   "--except", "--dialect",
                                        "--port", "--baud", "--format", "--output", "--summary"};

std::string plotFault(const CLI::App& app) {
  if (app.count("--plot") == 0) return {};
  for (const char* name : kNotWithPlot) {
    if (app.count(name) == 0) continue;
    return name + std::string{" does not go with --plot, which draws the whole record"};
  }
  return {};
}

/// What cannot go together, in one line; empty if all is well.
std::string contradiction(const Options& options) {
  if (!options.folder.empty() && options.format != Format::Csv) {
    return "--output goes with --format csv alone";
  }
  const bool one_table = options.selection.only.size() == 1;
  const bool to_stdout = options.format == Format::Csv && options.folder.empty();
  if (to_stdout && !one_table && !options.summary_only) {
    return "--format csv makes a table for each kind of sentence: say --output DIR, or choose one "
           "with --only";
  }
  return {};
}

Options ended(int exit_code) {
  Options options;
  options.exit_code = exit_code;
  return options;
}

Options usage(const std::string& line) {
  std::cerr << "nmea_decode: " << line << " (see --help)" << std::endl;
  return ended(kExitUsage);
}

}  // namespace

Options parseOptions(const std::vector<std::string>& arguments) {
  Options options;
  Words words;
  CLI::App app{kAbout, "nmea_decode"};
  app.footer(kExits);
  addInput(app, options);
  addOutput(app, options, words);
  addSelection(app, words);
  std::vector<std::string> last_first{arguments.rbegin(), arguments.rend()};  // as CLI11 wants them
  try {
    app.parse(last_first);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return ended(app.exit(error));  // --help
    return usage(visible(error.what()));
  }
  translate(words, options);
  if (const std::string wrong = plotFault(app); !wrong.empty()) return usage(wrong);
  if (const std::string wrong = contradiction(options); !wrong.empty()) return usage(wrong);
  return options;
}

}  // namespace frontseat_driver::decode
