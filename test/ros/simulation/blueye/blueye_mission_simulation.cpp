// Missions of a Blueye in virtual time, by the thousand: session, simulated drone, its other
// clients and the network, every choice from a seed, every promise looked at after every step.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>

#include "arguments.h"
#include "mission.h"
#include "seeds.h"

namespace {

using namespace frontseat_driver::blueye_simulation;
using frontseat_driver::simulation::Arguments;
using frontseat_driver::simulation::firstBroken;
using frontseat_driver::simulation::leastThat;

void tell(const Arguments& options, std::uint64_t seed, const std::string& first_broken) {
  Plan plan = planFor(seed, options.hours, options.pace);
  if (!options.no_shrink) {
    plan = leastThat<Plan>(plan, [](const Plan& fewer) { return !Mission{fewer}.run().empty(); });
  }
  Mission mission{plan};
  mission.trace_lines = 60;
  const std::string broken = mission.run();
  std::printf("BROKEN with seed %llu: %s\n", static_cast<unsigned long long>(seed),
              first_broken.c_str());
  if (!options.no_shrink) std::printf("the least that breaks it (%s):\n", broken.c_str());
  std::printf("%slast events:\n", describe(plan).c_str());
  for (const std::string& line : mission.trace()) std::printf("%s\n", line.c_str());
  std::printf("again: blueye_mission_simulation --seed=%llu --hours=%g --pace=%g --verbose\n",
              static_cast<unsigned long long>(seed), options.hours, options.pace);
}

void tell(const Totals& totals) {
  const auto line = [](const char* what, double value) {
    std::printf("%14.0f  %s\n", value, what);
  };
  const auto number = [](std::uint64_t value) { return static_cast<double>(value); };
  const Seen& seen = totals.seen;
  line("runs", number(totals.runs));
  line("virtual hours", totals.virtual_s / 3600.0);
  line("messages delivered", number(totals.delivered));
  line("control messages sent", number(seen.controls));
  line("of these, commands", number(seen.motions));
  line("of these, zeros", number(seen.zeros));
  line("of these, watchdogs", number(seen.watchdogs));
  line("commands taken", number(seen.taken));
  line("commands refused", number(seen.refused));
  line("calls", number(seen.calls));
  line("of these, with success", number(seen.succeeded));
  line("requests sent", number(seen.requests));
  line("times that control was gained", number(seen.gains));
  line("times that it was lost", number(seen.losses));
  line("connections", number(totals.connects));
  line("failed attempts to connect", number(totals.failed_attempts));
  std::printf("what happened, and how often:\n");
  for (std::size_t i = 0; i < kKinds; ++i) {
    line(std::string{nameOf(static_cast<Kind>(i))}.c_str(), number(totals.happened[i]));
  }
}

int run(const Arguments& options) {
  const auto begun = std::chrono::steady_clock::now();
  std::mutex mutex;
  Totals totals;
  const auto broken = firstBroken(options.first, options.count, options.threads, [&](auto seed) {
    Mission mission{planFor(seed, options.hours, options.pace)};
    mission.verbose = options.verbose;
    std::string found = mission.run();
    const std::lock_guard<std::mutex> lock(mutex);
    totals.add(mission.totals());
    return found;
  });
  if (!options.quiet) tell(totals);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
  std::printf("%llu runs of a Blueye, %.1f virtual hours in %.1f s on %u threads, digest %016llx\n",
              static_cast<unsigned long long>(totals.runs), totals.virtual_s / 3600.0,
              taken.count(), options.threads, static_cast<unsigned long long>(totals.digest));
  if (!broken) {
    std::printf("no promise was broken\n");
    return EXIT_SUCCESS;
  }
  tell(options, broken->seed, broken->broken);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments options;
  options.hours = 0.03;
  options.pace = 5.0;
  CLI::App app{
      "Runs virtual missions of a Blueye and ends with status 1 at the first broken promise. "
      "Usual are 0.03 hours at pace 5."};
  frontseat_driver::simulation::addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  return run(options);
}
