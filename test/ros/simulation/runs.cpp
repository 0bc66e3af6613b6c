#include "runs.h"

#include <cstdio>
#include <mutex>

#include "seeds.h"

namespace frontseat_driver::simulation {

namespace {

std::string line(const char* what, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%14.0f  %s\n", value, what);
  return text;
}

std::string brokenBy(const Plan& plan) { return Mission{plan}.run(); }

}  // namespace

std::optional<Failure> makeRuns(const Runs& runs, Totals& totals,
                                const std::function<void(std::uint64_t)>& progress) {
  std::mutex mutex;
  const auto dialect_for = [&](std::uint64_t seed) {
    return runs.dialect.value_or(dialectOf(seed));
  };
  const auto broken = firstBroken(runs.first, runs.count, runs.threads, [&](std::uint64_t seed) {
    Mission mission{planFor(seed, dialect_for(seed), runs.hours, runs.pace)};
    std::string found = mission.run();
    const std::lock_guard<std::mutex> lock(mutex);
    totals.add(mission.totals());
    if (progress) progress(totals.runs);
    return found;
  });
  if (!broken) return std::nullopt;
  return Failure{broken->seed, dialect_for(broken->seed), runs.hours, runs.pace, broken->broken};
}

Plan planOf(const Failure& failure) {
  return planFor(failure.seed, failure.dialect, failure.hours, failure.pace);
}

Plan shrunk(const Failure& failure) {
  return leastThat<Plan>(planOf(failure), [](const Plan& plan) { return !brokenBy(plan).empty(); });
}

std::string describe(const Plan& plan) {
  std::string text;
  for (const Action& action : plan.actions) {
    char row[128];
    std::snprintf(row, sizeof row, "%12.3f s  %-26s for %.3f s\n",
                  std::chrono::duration<double>(action.at).count(),
                  std::string{nameOf(action.kind)}.c_str(),
                  std::chrono::duration<double>(action.lasts).count());
    text += row;
  }
  return text;
}

std::string describe(const Totals& totals) {
  const auto number = [](std::uint64_t value) { return static_cast<double>(value); };
  std::string text = line("runs", number(totals.runs));
  text += line("virtual hours", totals.virtual_s / 3600.0);
  text += line("sentences heard", number(totals.driver.sentences_heard));
  text += line("sentences sent", number(totals.driver.sentences_sent));
  text += line("of these, commands", number(totals.driver.commands_sent));
  text += line("of these, zero thrusts that ended commanding", number(totals.driver.zeros));
  text += line("of these, aborts", number(totals.driver.aborts));
  text += line("commands taken", number(totals.driver.commands_taken));
  text += line("commands refused", number(totals.driver.commands_refused));
  text += line("service calls", number(totals.driver.requests));
  text += line("of these, answered by the vehicle", number(totals.driver.acknowledged));
  text += line("connections", number(totals.connects));
  text += line("failed attempts to connect", number(totals.failed_attempts));
  text += line("positions held against the truth", number(totals.truth.positions));
  text += line("velocities held against the truth", number(totals.truth.velocities));
  text += line("stamps held against the truth", number(totals.truth.stamps));
  text += "what happened, and how often:\n";
  for (std::size_t i = 0; i < kKinds; ++i) {
    text += line(std::string{nameOf(static_cast<Kind>(i))}.c_str(), number(totals.happened[i]));
  }
  return text;
}

}  // namespace frontseat_driver::simulation
