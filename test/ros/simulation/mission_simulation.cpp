// Missions in virtual time, by the thousand: driver, simulated vehicle and the network between
// them, every choice from a seed, every promise of the driver looked at after every step.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>

#include "runs.h"

namespace {

using namespace frontseat_driver;
using namespace frontseat_driver::simulation;

constexpr const char* kUsage =
    "usage: mission_simulation [--seeds=N] [--first=N] [--hours=H] [--threads=N]\n"
    "                          [--dialect=sandshark|kingfisher] [--pace=P] [--quiet] "
    "[--no-shrink]\n"
    "       mission_simulation --seed=N [--dialect=...] [--hours=H] [--verbose] [--no-shrink]\n"
    "Runs virtual missions and ends with status 1 at the first broken promise. With --seed, the\n"
    "one run; --verbose prints everything that is said and happens; --pace has more happen in an\n"
    "hour. A failure is shrunk to the least that causes it. Without --dialect, odd seeds\n"
    "are sandsharks and even ones kingfishers.\n";

struct Options {
  Runs runs;
  bool one = false;
  bool verbose = false;
  bool quiet = false;
  bool shrinks = true;
};

bool take(Options& options, std::string_view argument) {
  const std::size_t equals = argument.find('=');
  const std::string_view name = argument.substr(0, equals);
  const std::string value{equals == std::string_view::npos ? "" : argument.substr(equals + 1)};
  const auto number = [&] { return std::strtoull(value.c_str(), nullptr, 10); };
  if (name == "--seed") {
    options.one = true;
    options.runs.first = number();
  } else if (name == "--seeds") {
    options.runs.count = number();
  } else if (name == "--first") {
    options.runs.first = number();
  } else if (name == "--hours") {
    options.runs.hours = std::strtod(value.c_str(), nullptr);
  } else if (name == "--pace") {
    options.runs.pace = std::strtod(value.c_str(), nullptr);
  } else if (name == "--threads") {
    options.runs.threads = static_cast<unsigned>(std::max<unsigned long long>(1, number()));
  } else if (name == "--dialect" && (value == "sandshark" || value == "kingfisher")) {
    options.runs.dialect =
        value == "sandshark" ? protocol::Dialect::Sandshark : protocol::Dialect::Kingfisher;
  } else if (name == "--verbose") {
    options.verbose = true;
  } else if (name == "--quiet") {
    options.quiet = true;
  } else if (name == "--no-shrink") {
    options.shrinks = false;
  } else {
    return false;
  }
  return options.runs.hours > 0.0 && options.runs.count > 0;
}

void tell(const Failure& failure, bool shrinks) {
  constexpr std::size_t kTrace = 60;
  const Plan plan = shrinks ? shrunk(failure) : planOf(failure);
  Mission mission{plan};
  mission.trace_lines = kTrace;
  const std::string broken = mission.run();
  std::printf("BROKEN with seed %llu: %s\n", static_cast<unsigned long long>(failure.seed),
              failure.broken.c_str());
  if (shrinks) std::printf("the least that breaks it (%s):\n", broken.c_str());
  std::printf("%s", describe(plan).c_str());
  std::printf("the last %zu events:\n", mission.trace().size());
  for (const std::string& line : mission.trace()) std::printf("%s\n", line.c_str());
  std::printf("again: mission_simulation --seed=%llu --dialect=%s --hours=%g --pace=%g --verbose\n",
              static_cast<unsigned long long>(failure.seed), protocol::toString(failure.dialect),
              failure.hours, failure.pace);
}

int runOne(const Options& options) {
  const auto dialect = options.runs.dialect.value_or(dialectOf(options.runs.first));
  Mission mission{planFor(options.runs.first, dialect, options.runs.hours, options.runs.pace)};
  mission.verbose = options.verbose;
  const std::string broken = mission.run();
  std::printf("%s", describe(mission.totals()).c_str());
  if (broken.empty()) return EXIT_SUCCESS;
  tell({options.runs.first, dialect, options.runs.hours, options.runs.pace, broken},
       options.shrinks);
  return EXIT_FAILURE;
}

int runAll(const Options& options) {
  const auto begun = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  Totals totals;
  double told_s = 0.0;
  const auto failure = makeRuns(options.runs, totals, [&](std::uint64_t made) {
    if (options.quiet || elapsed_s() < told_s + 10.0) return;
    told_s = elapsed_s();
    std::fprintf(stderr, "%llu of %llu runs, %.0f s\n", static_cast<unsigned long long>(made),
                 static_cast<unsigned long long>(options.runs.count), told_s);
  });
  if (!options.quiet) std::printf("%s", describe(totals).c_str());
  std::printf("%llu runs, %.1f virtual hours in %.1f s on %u threads, digest %016llx\n",
              static_cast<unsigned long long>(totals.runs), totals.virtual_s / 3600.0, elapsed_s(),
              options.runs.threads, static_cast<unsigned long long>(totals.digest));
  if (!failure) {
    std::printf("no promise was broken\n");
    return EXIT_SUCCESS;
  }
  tell(*failure, options.shrinks);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.runs.threads = std::max(1U, std::thread::hardware_concurrency());
  for (int i = 1; i < argc; ++i) {
    if (take(options, argv[i])) continue;
    std::fprintf(stderr, "argument '%s' is not accepted\n%s", argv[i], kUsage);
    return 2;
  }
  return options.one ? runOne(options) : runAll(options);
}
