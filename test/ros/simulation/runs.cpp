#include "runs.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <thread>

namespace frontseat_driver::simulation {

namespace {

constexpr int kMostShrinkingRuns = 400;

std::string line(const char* what, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%14.0f  %s\n", value, what);
  return text;
}

std::string brokenBy(const Plan& plan) { return Mission{plan}.run(); }

/// Runs of one thread after the other take the next seed.
class Pool {
 public:
  Pool(const Runs& runs, Totals& totals, const std::function<void(std::uint64_t)>& progress)
      : runs_(runs), totals_(totals), progress_(progress), next_(runs.first) {}

  std::optional<Failure> run() {
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < runs_.threads; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    return failure_;
  }

 private:
  void work() {
    for (std::uint64_t seed = next_++; seed < runs_.first + runs_.count && !failed_;
         seed = next_++) {
      const auto dialect = runs_.dialect.value_or(dialectOf(seed));
      Mission mission{planFor(seed, dialect, runs_.hours, runs_.pace)};
      const std::string broken = mission.run();
      const std::lock_guard<std::mutex> lock(mutex_);
      totals_.add(mission.totals());
      if (!broken.empty()) fail({seed, dialect, runs_.hours, runs_.pace, broken});
      if (progress_) progress_(totals_.runs);
    }
  }

  void fail(const Failure& failure) {
    failed_ = true;
    if (!failure_ || failure.seed < failure_->seed) failure_ = failure;
  }

  const Runs& runs_;
  Totals& totals_;
  const std::function<void(std::uint64_t)>& progress_;
  std::atomic<std::uint64_t> next_;
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::optional<Failure> failure_;
};

}  // namespace

std::optional<Failure> makeRuns(const Runs& runs, Totals& totals,
                                const std::function<void(std::uint64_t)>& progress) {
  return Pool{runs, totals, progress}.run();
}

Plan planOf(const Failure& failure) {
  return planFor(failure.seed, failure.dialect, failure.hours, failure.pace);
}

Plan shrunk(const Failure& failure) {
  Plan plan = planOf(failure);
  int runs = 0;
  for (std::size_t size = plan.actions.size(); size > 0 && runs < kMostShrinkingRuns; size /= 2) {
    for (std::size_t from = 0; from < plan.actions.size() && runs < kMostShrinkingRuns;) {
      Plan fewer = plan;
      const auto begin = fewer.actions.begin() + static_cast<std::ptrdiff_t>(from);
      const auto end =
          begin + static_cast<std::ptrdiff_t>(std::min(size, fewer.actions.size() - from));
      fewer.actions.erase(begin, end);
      ++runs;
      if (brokenBy(fewer).empty()) {
        from += size;
      } else {
        plan = fewer;
      }
    }
  }
  return plan;
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
