#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mission.h"

namespace frontseat_driver::simulation {

/// A seed whose run broke a promise.
struct Failure {
  std::uint64_t seed = 0;
  protocol::Dialect dialect{};
  double hours = 1.0;
  double pace = 1.0;
  std::string broken;
};

/// Which runs to make.
struct Runs {
  std::uint64_t first = 1;
  std::uint64_t count = 1;
  double hours = 1.0;
  double pace = 1.0;                         ///< how often things happen, in parts of the usual
  std::optional<protocol::Dialect> dialect;  ///< empty: by seed
  unsigned threads = 1;
};

/// Makes all runs; ends early at the first failure, which is the one of the lowest seed known.
/// `progress` is called now and then with the number of runs made.
std::optional<Failure> makeRuns(const Runs& runs, Totals& totals,
                                const std::function<void(std::uint64_t)>& progress);

/// The plan of the run that failed.
Plan planOf(const Failure& failure);

/// The least of what happens in a failing run that still makes it fail, by taking out halves,
/// quarters and so on; and nothing after the failure.
Plan shrunk(const Failure& failure);

/// What happens in a plan, a line each.
std::string describe(const Plan& plan);

/// Table of what was looked at and what happened.
std::string describe(const Totals& totals);

}  // namespace frontseat_driver::simulation
