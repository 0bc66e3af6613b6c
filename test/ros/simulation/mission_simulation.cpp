// Missions in virtual time, by the thousand: driver, simulated vehicle and the network between
// them, every choice from a seed, every promise of the driver looked at after every step.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "arguments.h"
#include "runs.h"

namespace {

using namespace frontseat_driver;
using namespace frontseat_driver::simulation;

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

int runOne(const Runs& runs, const Arguments& wanted) {
  const auto dialect = runs.dialect.value_or(dialectOf(runs.first));
  Mission mission{planFor(runs.first, dialect, runs.hours, runs.pace)};
  mission.verbose = wanted.verbose;
  const std::string broken = mission.run();
  std::printf("%s", describe(mission.totals()).c_str());
  if (broken.empty()) return EXIT_SUCCESS;
  tell({runs.first, dialect, runs.hours, runs.pace, broken}, !wanted.no_shrink);
  return EXIT_FAILURE;
}

int runAll(const Runs& runs, const Arguments& wanted) {
  const auto begun = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  Totals totals;
  double told_s = 0.0;
  const auto failure = makeRuns(runs, totals, [&](std::uint64_t made) {
    if (wanted.quiet || elapsed_s() < told_s + 10.0) return;
    told_s = elapsed_s();
    std::fprintf(stderr, "%llu of %llu runs, %.0f s\n", static_cast<unsigned long long>(made),
                 static_cast<unsigned long long>(runs.count), told_s);
  });
  if (!wanted.quiet) std::printf("%s", describe(totals).c_str());
  std::printf("%llu runs, %.1f virtual hours in %.1f s on %u threads, digest %016llx\n",
              static_cast<unsigned long long>(totals.runs), totals.virtual_s / 3600.0, elapsed_s(),
              runs.threads, static_cast<unsigned long long>(totals.digest));
  if (!failure) {
    std::printf("no promise was broken\n");
    return EXIT_SUCCESS;
  }
  tell(*failure, !wanted.no_shrink);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments wanted;
  std::string dialect;
  CLI::App app{
      "Runs virtual missions and ends with status 1 at the first broken promise. Of a single one, "
      "everything is told."};
  addOptions(app, wanted);
  app.add_option("--dialect", dialect, "odd seeds are sandsharks otherwise, even ones kingfishers")
      ->check(CLI::IsMember({"sandshark", "kingfisher"}));
  CLI11_PARSE(app, argc, argv);
  Runs runs{wanted.first, wanted.count, wanted.hours, wanted.pace, {}, wanted.threads};
  if (dialect == "sandshark") runs.dialect = protocol::Dialect::Sandshark;
  if (dialect == "kingfisher") runs.dialect = protocol::Dialect::Kingfisher;
  return runs.count == 1 ? runOne(runs, wanted) : runAll(runs, wanted);
}
