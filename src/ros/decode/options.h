#pragma once

#include <optional>
#include <string>
#include <vector>

#include "selection.h"

namespace frontseat_driver::decode {

enum class Format { Lines, Csv, Json };

/// What the command line of `nmea_decode` says.
struct Options {
  std::string input = "-";
  Format format = Format::Lines;
  std::string folder;   ///< for CSV; empty: standard output
  std::string plot;     ///< picture to make; empty: none
  std::string vehicle;  ///< namespace in a bag
  unsigned baud = 115200;
  int port = 29500;  ///< in a packet capture
  bool summary_only = false;
  bool quiet = false;
  Selection::Config selection;

  /// The program is to end at once with this exit code; what there is to say has been printed.
  std::optional<int> exit_code;
};

constexpr int kExitUnreadable = 1;
constexpr int kExitUsage = 2;

Options parseOptions(const std::vector<std::string>& arguments);

}  // namespace frontseat_driver::decode
