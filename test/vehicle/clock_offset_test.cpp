#include "frontseat_driver/vehicle/clock_offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::vehicle {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// 2026-05-10 22:00:00 UTC: two hours before midnight.
constexpr UtcTime kStart = std::chrono::seconds{1778450400};

double milliseconds(nanoseconds duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

/// How long a sentence takes.
enum class Link {
  Lognormal,    ///< median 5 ms, 1 % above 200 ms
  Uniform,      ///< 0 to 200 ms
  Exponential,  ///< mean 80 ms
  Constant,     ///< 5 ms
};

/// A vehicle whose clock is off and drifts, behind a network that delays in order.
class Vehicle {
 public:
  explicit Vehicle(std::uint64_t seed) : random_(seed) {}

  struct Sample {
    UtcTime truth;                   ///< when it was sent, on the host's clock
    UtcTime arrival;                 ///< on the host's clock
    ClockOffset::TimeOfDay sent_at;  ///< on the vehicle's clock
  };

  Sample next(nanoseconds period) {
    now_ += period;
    const UtcTime vehicle = now_ + clock_error + scaledDrift();
    last_arrival_ = std::max(last_arrival_, now_ + delay());
    // Sentences carry whole milliseconds.
    const auto written = std::chrono::duration_cast<std::chrono::milliseconds>(timeOfDay(vehicle));
    return {now_, last_arrival_, written};
  }

  UtcTime now() const { return now_; }

  nanoseconds clock_error = 5h + 18s;
  double drift_ppm = 50.0;
  Link link = Link::Lognormal;

 private:
  nanoseconds scaledDrift() const {
    const auto elapsed = static_cast<double>((now_ - kStart).count());
    return nanoseconds{std::llround(elapsed * drift_ppm * 1e-6)};
  }

  nanoseconds delay() { return nanoseconds{std::llround(delay_s() * 1e9)}; }

  double delay_s() {
    constexpr double kSigma = 1.5857;  // ln(200 / 5) / 2.3263
    switch (link) {
      case Link::Lognormal:
        return 0.005 * std::exp(kSigma * normal_(random_));
      case Link::Uniform:
        return uniform_(random_);
      case Link::Exponential:
        return exponential_(random_);
      case Link::Constant:
        return 0.005;
    }
    return 0.0;
  }

  UtcTime now_ = kStart;
  UtcTime last_arrival_{};
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{0.0, 0.2};
  std::exponential_distribution<double> exponential_{1.0 / 0.08};
};

struct Row {
  const char* name;
  std::uint64_t seed;
  nanoseconds clock_error;
  double drift_ppm;
};

class Delayed : public testing::TestWithParam<Row> {};

TEST_P(Delayed, StampsAreWithinTwoMilliseconds) {
  Vehicle vehicle{GetParam().seed};
  vehicle.clock_error = GetParam().clock_error;
  vehicle.drift_ppm = GetParam().drift_ppm;
  ClockOffset estimate;
  std::vector<double> errors_ms;
  UtcTime last{};
  while (vehicle.now() < kStart + 10min) {
    const Vehicle::Sample sample = vehicle.next(50ms);
    estimate.take(sample.sent_at, sample.arrival);
    const UtcTime stamp = *estimate.toHost(sample.sent_at, sample.arrival);
    EXPECT_GE(stamp, last);
    last = stamp;
    if (sample.truth > kStart + 10s) {
      errors_ms.push_back(std::abs(milliseconds(stamp - sample.truth)));
    }
  }
  std::sort(errors_ms.begin(), errors_ms.end());
  EXPECT_LT(errors_ms[errors_ms.size() * 95 / 100], 2.0);
  EXPECT_LT(errors_ms.back(), 20.0);
  RecordProperty("p95_us", static_cast<int>(errors_ms[errors_ms.size() * 95 / 100] * 1e3));
  RecordProperty("max_us", static_cast<int>(errors_ms.back() * 1e3));
  EXPECT_NEAR(estimate.state().drift_ppm, -GetParam().drift_ppm, 40.0);
  EXPECT_EQ(estimate.state().steps, 0u);
}

const Row kRows[] = {
    {"five_hours_ahead_50_ppm", 1, 5h + 18s, 50.0},
    {"five_hours_ahead_minus_50_ppm", 2, 5h + 18s, -50.0},
    {"half_a_day_behind", 3, -11h - 59min, 50.0},
    {"gps_time", 4, 18s, 0.0},
    {"no_error", 5, 0s, 20.0},
    {"six", 6, 5h + 18s, 50.0},
    {"seven", 7, 5h + 18s, 50.0},
    {"eight", 8, 5h + 18s, -50.0},
};

INSTANTIATE_TEST_SUITE_P(Table, Delayed, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(ClockOffset, NothingBeforeTheFirstSample) { EXPECT_FALSE(ClockOffset{}.toHost(12h, kStart)); }

TEST(ClockOffset, IsUsefulAfterOneSecond) {
  Vehicle vehicle{11};
  ClockOffset estimate;
  Vehicle::Sample sample{};
  while (vehicle.now() < kStart + 1s) {
    sample = vehicle.next(50ms);
    estimate.take(sample.sent_at, sample.arrival);
  }
  const UtcTime stamp = *estimate.toHost(sample.sent_at, sample.arrival);
  EXPECT_LT(std::abs(milliseconds(stamp - sample.truth)), 5.0);
}

class Stepped : public testing::TestWithParam<std::chrono::seconds> {};

TEST_P(Stepped, AClockStepIsAbsorbedWithinTwoSeconds) {
  Vehicle vehicle{21};
  ClockOffset estimate;
  const auto run = [&](nanoseconds duration) {
    double worst_ms = 0.0;
    const UtcTime end = vehicle.now() + duration;
    while (vehicle.now() < end) {
      const Vehicle::Sample sample = vehicle.next(50ms);
      estimate.take(sample.sent_at, sample.arrival);
      const UtcTime stamp = *estimate.toHost(sample.sent_at, sample.arrival);
      worst_ms = std::max(worst_ms, std::abs(milliseconds(stamp - sample.truth)));
    }
    return worst_ms;
  };
  run(60s);
  vehicle.clock_error += GetParam();
  run(2s);
  EXPECT_LT(run(60s), 20.0);
  EXPECT_EQ(estimate.state().steps, 1u);
}

INSTANTIATE_TEST_SUITE_P(Table, Stepped,
                         testing::Values(3s, -3s, 1s, -1s, 3600s, -3600s, 40000s, -40000s));

struct Jittery {
  const char* name;
  Link link;
  double tolerance_ms;  ///< what a fresh estimate of this link may be off by
};

class SteppedLink : public testing::TestWithParam<std::tuple<Jittery, std::chrono::milliseconds>> {
};

TEST_P(SteppedLink, AStepIsAbsorbedWithinSeconds) {
  const auto& [link, step] = GetParam();
  const bool small = std::chrono::abs(step) < ClockOffset::kStep;
  int missed = 0;
  for (std::uint64_t seed = 41; seed < 51; ++seed) {
    Vehicle vehicle{seed};
    vehicle.link = link.link;
    ClockOffset estimate;
    const auto run = [&](nanoseconds duration) {
      double worst_ms = 0.0;
      const UtcTime end = vehicle.now() + duration;
      while (vehicle.now() < end) {
        const Vehicle::Sample sample = vehicle.next(50ms);
        estimate.take(sample.sent_at, sample.arrival);
        const UtcTime stamp = *estimate.toHost(sample.sent_at, sample.arrival);
        worst_ms = std::max(worst_ms, std::abs(milliseconds(stamp - sample.truth)));
      }
      return worst_ms;
    };
    run(60s);
    const std::uint64_t steps = estimate.state().steps;
    EXPECT_LT(run(60s), link.tolerance_ms) << "seed " << seed;
    EXPECT_EQ(estimate.state().steps, steps) << "seed " << seed;
    vehicle.clock_error += step;
    run(small ? 6s : 4s);
    missed += run(54s) < link.tolerance_ms ? 0 : 1;
  }
  // A link that was as late lately may hide a small step.
  EXPECT_LE(missed, small ? 3 : 0);
}

const Jittery kLinks[] = {{"lognormal", Link::Lognormal, 20.0},
                          {"uniform", Link::Uniform, 90.0},
                          {"exponential", Link::Exponential, 90.0},
                          {"constant", Link::Constant, 7.0}};

INSTANTIATE_TEST_SUITE_P(Table, SteppedLink,
                         testing::Combine(testing::ValuesIn(kLinks),
                                          testing::Values(100ms, -100ms, 200ms, -200ms, 500ms,
                                                          -500ms, 3000ms, -3000ms, 3600000ms,
                                                          -3600000ms)),
                         [](const auto& row) {
                           const auto step = std::get<1>(row.param).count();
                           return std::string{std::get<0>(row.param).name} +
                                  (step < 0 ? "_back_" : "_forth_") +
                                  std::to_string(std::abs(step)) + "_ms";
                         });

TEST(ClockOffset, ABurstAfterAStallIsNoStep) {
  ClockOffset estimate;
  UtcTime sent = kStart;
  for (int i = 0; i < 100; ++i, sent += 100ms) estimate.take(timeOfDay(sent), sent + 1ms);
  const UtcTime stall_ends = sent + 4s;
  for (; sent < stall_ends; sent += 100ms) {
    estimate.take(timeOfDay(sent), stall_ends);
    EXPECT_EQ(*estimate.toHost(timeOfDay(sent), stall_ends), sent + 1ms);
  }
  EXPECT_EQ(estimate.state().steps, 0u);
}

class Stalled : public testing::TestWithParam<std::chrono::milliseconds> {};

TEST_P(Stalled, StallsInARowAreNoStep) {
  const std::chrono::milliseconds period = GetParam();
  ClockOffset estimate;
  UtcTime sent = kStart;
  for (; sent < kStart + 30s; sent += period) estimate.take(timeOfDay(sent), sent + 1ms);
  for (int stall = 0; stall < 5; ++stall) {
    const UtcTime ends = sent + 1500ms;
    // Each holds back all but the last 40 ms, which the next one delays.
    for (; sent < ends - 40ms; sent += period) {
      estimate.take(timeOfDay(sent), ends);
      EXPECT_EQ(*estimate.toHost(timeOfDay(sent), ends), sent + 1ms);
    }
  }
  EXPECT_EQ(estimate.state().steps, 0u);
}

INSTANTIATE_TEST_SUITE_P(Rates, Stalled, testing::Values(10ms, 50ms, 100ms, 500ms));

TEST(ClockOffset, TheHostsOwnStepIsFollowed) {
  ClockOffset estimate;
  UtcTime sent = kStart;
  for (int i = 0; i < 100; ++i, sent += 100ms) estimate.take(timeOfDay(sent), sent + 1ms);
  for (const nanoseconds host_step : {nanoseconds{2h}, nanoseconds{-2h}}) {
    for (int i = 0; i < 30; ++i, sent += 100ms) {
      estimate.take(timeOfDay(sent), sent + host_step + 1ms);
    }
    EXPECT_EQ(*estimate.toHost(timeOfDay(sent), sent + host_step), sent + host_step + 1ms);
  }
}

TEST(ClockOffset, StampsNeverGoBackIn24HoursAcrossMidnight) {
  Vehicle vehicle{31};
  ClockOffset estimate;
  UtcTime last{};
  std::size_t back = 0;
  while (vehicle.now() < kStart + 24h) {
    const Vehicle::Sample sample = vehicle.next(100ms);
    estimate.take(sample.sent_at, sample.arrival);
    const UtcTime stamp = *estimate.toHost(sample.sent_at, sample.arrival);
    back += stamp < last ? 1 : 0;
    last = stamp;
  }
  EXPECT_EQ(back, 0u);
  EXPECT_EQ(estimate.state().steps, 0u);
}

/// A link that always takes as long, and a vehicle whose clock is exactly what is set here: what
/// the limits of the estimate are can be seen one by one.
struct Exact {
  ClockOffset estimate;
  UtcTime now = kStart;
  nanoseconds late{};  ///< of the next samples, against the first ones
  double drift_ppm = 0.0;

  void take() {
    const auto elapsed_ns = static_cast<double>((now - kStart).count());
    const nanoseconds drifted{std::llround(elapsed_ns * drift_ppm * 1e-6)};
    estimate.take(timeOfDay(now - late + drifted), now);
  }
  void run(nanoseconds time, nanoseconds period = 50ms) {
    for (const UtcTime end = now + time; now < end; take()) now += period;
  }
  std::uint64_t steps() const { return estimate.state().steps; }
  /// How late the estimate takes the first samples to be.
  nanoseconds learned() const { return *estimate.toHost(timeOfDay(now), now) - now; }
};

struct LateStep {
  const char* name;
  std::chrono::milliseconds step;
  std::chrono::milliseconds not_before;
  std::chrono::milliseconds not_after;
};

class LateSteps : public testing::TestWithParam<LateStep> {};

TEST_P(LateSteps, AreBelievedWhenTheirTimeHasCome) {
  Exact exact;
  exact.run(60s);
  exact.late = GetParam().step;
  exact.run(GetParam().not_before, 80ms);
  EXPECT_EQ(exact.steps(), 0u);
  EXPECT_EQ(exact.learned(), 0ms);
  exact.run(GetParam().not_after - GetParam().not_before, 80ms);
  EXPECT_EQ(exact.steps(), 1u);
  EXPECT_EQ(exact.learned(), GetParam().step);
}

const LateStep kLateSteps[] = {{"big", 3000ms, 800ms, 1300ms},
                               {"just_big", 260ms, 800ms, 1300ms},
                               {"small", 240ms, 1700ms, 2500ms},
                               {"smallest", 30ms, 1700ms, 2500ms}};

INSTANTIATE_TEST_SUITE_P(Table, LateSteps, testing::ValuesIn(kLateSteps),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(ClockOffset, WhatIsLateByLittleIsNoStep) {
  Exact exact;
  exact.run(30s);
  exact.late = 15ms;
  exact.run(20s);
  EXPECT_EQ(exact.steps(), 0u);
  EXPECT_EQ(exact.learned(), 0ms);
}

TEST(ClockOffset, EarlySamplesAreAStepByHowLongTheLinkIsKnown) {
  struct Early {
    std::chrono::seconds known;
    std::chrono::milliseconds early;
    std::uint64_t steps;
  };
  for (const Early& row : {Early{5s, 200ms, 0}, Early{5s, 300ms, 1}, Early{8s, 30ms, 0},
                           Early{15s, 15ms, 0}, Early{15s, 30ms, 1}}) {
    Exact exact;
    exact.run(row.known);
    exact.late = -row.early;
    exact.run(50ms);
    EXPECT_EQ(exact.steps(), row.steps) << row.known.count() << " s " << row.early.count() << " ms";
    EXPECT_EQ(exact.learned(), -row.early);
  }
}

/// Whether samples that are late by three seconds, each second one by `apart` more, are a step.
bool isStep(nanoseconds apart) {
  Exact exact;
  exact.run(30s);
  for (int i = 0; i < 100; ++i) {
    exact.late = 3s + (i % 2 == 0 ? 0ns : apart);
    exact.run(50ms);
  }
  return exact.steps() > 0;
}

TEST(ClockOffset, AStepShowsAsSamplesThatLieTogether) {
  EXPECT_TRUE(isStep(40ms));
  EXPECT_FALSE(isStep(80ms));
}

TEST(ClockOffset, TheEarliestSampleCountsForAMinute) {
  Exact exact;
  exact.run(50ms);
  exact.late = 100ms;
  exact.run(55s);
  EXPECT_LE(exact.learned(), 28ms);  // which may be the most drift
  exact.run(10s);
  EXPECT_EQ(exact.learned(), 100ms);
}

TEST(ClockOffset, BeginsAnewAfterAMinuteWithoutSamples) {
  for (const auto& [gap, learned] : {std::pair{50s, 0ms}, std::pair{70s, 15ms}}) {
    Exact exact;
    exact.run(5s);
    exact.now += gap;
    exact.late = 15ms;
    exact.run(50ms);
    EXPECT_EQ(exact.learned(), learned) << gap.count() << " s";
    EXPECT_EQ(exact.steps(), 0u);
  }
}

TEST(ClockOffset, LearnsTheDriftInTenSecondsAndKnowsItsLimit) {
  struct Drifting {
    double vehicle_ppm;
    double learned_ppm;
  };
  for (const Drifting& row : {Drifting{400.0, -400.0}, Drifting{-400.0, 400.0},
                              Drifting{600.0, -500.0}, Drifting{-600.0, 500.0}}) {
    Exact exact;
    exact.drift_ppm = row.vehicle_ppm;
    exact.run(8s);
    EXPECT_EQ(exact.estimate.state().drift_ppm, 0.0);
    exact.run(5s);
    EXPECT_NEAR(exact.estimate.state().drift_ppm, row.learned_ppm, 1.0);
  }
}

TEST(ClockOffset, TellsTheMeanDelayBeyondTheLeast) {
  Exact exact;
  exact.run(10s);
  EXPECT_EQ(exact.estimate.state().jitter, 0ns);
  for (int i = 0; i < 64; ++i) {  // of 5 ms in the mean; 1 - 1 / e of it is learned
    exact.late = i % 2 == 0 ? 10ms : 0ms;
    exact.run(50ms);
  }
  EXPECT_NEAR(milliseconds(exact.estimate.state().jitter), 3.16, 0.1);
}

TEST(ClockOffset, AClockThatStandsStillGivesItsOwnTime) {
  ClockOffset estimate;
  for (ClockOffset::TimeOfDay sent = 1h; sent < 2h; sent += 1min) {
    estimate.take(sent, 0s);
    EXPECT_LE(*estimate.toHost(sent, 0s), 60s);
  }
}

}  // namespace
}  // namespace frontseat_driver::vehicle
