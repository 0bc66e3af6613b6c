#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <thread>

namespace frontseat_driver::simulation {

/// Which runs a program makes, and what it tells of them.
struct Arguments {
  std::uint64_t first = 1;
  std::uint64_t count = 1;
  double hours = 1.0;
  double pace = 1.0;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool verbose = false;
  bool quiet = false;
  bool no_shrink = false;
};

/// The options that all missions have. `arguments` holds what is usual, and must outlive the app.
inline void addOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--seeds", arguments.count, "how many runs to make")->check(CLI::PositiveNumber);
  app.add_option("--first,--seed", arguments.first, "seed of the first run, or of the only one");
  app.add_option("--hours", arguments.hours, "virtual hours of each run")
      ->check(CLI::PositiveNumber);
  app.add_option("--pace", arguments.pace, "more happens in an hour")->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.threads, "runs at a time")->check(CLI::Range(1, 1024));
  app.add_flag("--verbose", arguments.verbose, "prints everything that is said and happens");
  app.add_flag("--quiet", arguments.quiet, "prints no table");
  app.add_flag("--no-shrink", arguments.no_shrink,
               "a failure as it came, not shrunk to the least that causes it");
}

}  // namespace frontseat_driver::simulation
