#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "closed_loop.h"
#include "convert.h"
#include "frontseat_driver/sim/random.h"
#include "frontseat_driver/vehicle/date_resolution.h"
#include "recording.h"

// What stands in header.stamp against the instant of the measurement, from the vehicle's clock
// through a network that delays to what is published.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;

// 2026-05-10 22:00:00 UTC: two hours before midnight.
constexpr vehicle::UtcTime kStart = std::chrono::seconds{1778450400};
constexpr double kFiveHours18_s = 5.0 * 3600.0 + 18.0;

ros::Time stampOf(const VehicleMessage& message) {
  return std::visit([](const auto& any) { return any.header.stamp; }, message);
}

/// Lognormal: median 5 ms, 1 % above 200 ms.
Duration delay(sim::Random& random) {
  constexpr double kSigma = 1.5857;  // ln(200 / 5) / 2.3263
  return Duration{std::llround(5e6 * std::exp(kSigma * random.normal()))};
}

class Voyage {
 public:
  Voyage(Dialect dialect, double clock_offset_s, double drift_ppm, std::uint64_t seed,
         double rate_hz = 10.0)
      : parameters_(parametersWith(dialect)),
        loop_(loopFor(dialect, parameters_, clock_offset_s, drift_ppm, seed, rate_hz)),
        messages_(parameters_),
        random_(seed) {
    // As it will stand in the sentence: a Kingfisher's clock shows GPS time.
    const auto ahead = dialect == Dialect::Kingfisher ? 18s : 0s;
    loop_.watch.truth = [this, ahead](const sim::Truth& truth) {
      measured_[vehicle::timeOfDay(truth.stamp + ahead)] = loop_.now().stamp;
    };
    loop_.watch.event = [this](const vehicle::Now& now, const vehicle::Event& event) {
      const auto* navigation = std::get_if<vehicle::Navigation>(&event);
      if (navigation != nullptr) truth_ = measured_.at(*navigation->measured_at);
      messages_.take(now, event, outlet_);
    };
    loop_.link.edit = [this](std::string_view bytes) {
      loop_.link.delay = delay(random_);
      return std::string{bytes};
    };
    outlet_.watch = [this](VehicleTopic topic, const VehicleMessage& message) {
      const ros::Time stamp = stampOf(message);
      went_back_ += stamp < last_[topic] ? 1 : 0;
      last_[topic] = stamp;
      if (topic != VehicleTopic::Odom && topic != VehicleTopic::NavFix) return;
      errors_ms_.push_back(
          std::chrono::duration<double, std::milli>(ros_layer::toUtcTime(stamp) - truth_).count());
    };
    loop_.connect();
  }

  void pass(Duration duration) {
    // In pieces, so that messages need not be kept.
    for (const Duration end = loop_.elapsed() + duration; loop_.elapsed() < end;) {
      loop_.pass(std::min<Duration>(10s, end - loop_.elapsed()));
      published_ += outlet_.published.size();
      outlet_.published.clear();
    }
  }

  ClosedLoop& loop() { return loop_; }

  /// Of what was stamped since the last call, in order of size.
  std::vector<double> takeErrors_ms() {
    std::vector<double> errors = std::exchange(errors_ms_, {});
    for (double& error : errors) error = std::abs(error);
    std::sort(errors.begin(), errors.end());
    return errors;
  }

  std::size_t wentBack() const { return went_back_; }
  std::size_t published() const { return published_; }
  vehicle::ClockOffset::State clock() { return messages_.builder().clock(); }

 private:
  static ros_layer::Parameters parametersWith(Dialect dialect) {
    ros_layer::Parameters parameters = parametersFor(dialect);
    parameters.stamp = ros_layer::StampMode::Synced;
    return parameters;
  }

  static ClosedLoop loopFor(Dialect dialect, const ros_layer::Parameters& parameters,
                            double clock_offset_s, double drift_ppm, std::uint64_t seed,
                            double rate_hz) {
    const auto prepared = [&](auto config) {
      config.start_time = kStart;
      config.seed = seed;
      config.clock_offset_s = clock_offset_s;
      config.clock_drift_ppm = drift_ppm;
      config.rates = {{"NVG", rate_hz}, {"NVR", rate_hz}};
      return config;
    };
    if (dialect == Dialect::Sandshark) return {parameters, prepared(sim::SandsharkConfig{})};
    return {parameters, prepared(sim::KingfisherConfig{})};
  }

  ros_layer::Parameters parameters_;
  ClosedLoop loop_;
  ros_layer::VehicleMessages messages_;
  Outlet outlet_;
  sim::Random random_;
  std::map<vehicle::TimeOfDay, vehicle::UtcTime> measured_;  ///< on the host's clock
  vehicle::UtcTime truth_{};
  std::map<VehicleTopic, ros::Time> last_;
  std::vector<double> errors_ms_;
  std::size_t went_back_ = 0;
  std::size_t published_ = 0;
};

struct Row {
  const char* name;
  Dialect dialect;
  double clock_offset_s;
  double drift_ppm;
  std::uint64_t seed;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

const Row kRows[] = {
    {"sandshark", Dialect::Sandshark, kFiveHours18_s, 50.0, 1},
    {"kingfisher", Dialect::Kingfisher, kFiveHours18_s, 50.0, 2},
    {"sandshark_slow_clock", Dialect::Sandshark, -kFiveHours18_s, -50.0, 3},
    {"kingfisher_slow_clock", Dialect::Kingfisher, -kFiveHours18_s, -50.0, 4},
    {"sandshark_right_clock", Dialect::Sandshark, 0.0, 0.0, 5},
    {"kingfisher_other_seed", Dialect::Kingfisher, kFiveHours18_s, 50.0, 6},
};

class PublishedStamps : public testing::TestWithParam<Row> {
 protected:
  static Voyage voyage() {
    const Row& row = GetParam();
    return {row.dialect, row.clock_offset_s, row.drift_ppm, row.seed};
  }
};

void expectGood(const std::vector<double>& errors_ms) {
  ASSERT_FALSE(errors_ms.empty());
  EXPECT_LT(errors_ms[errors_ms.size() * 95 / 100], 2.0);
  EXPECT_LT(errors_ms.back(), 20.0);
}

TEST_P(PublishedStamps, AreTheTimeOfMeasurement) {
  Voyage voyage = this->voyage();
  voyage.pass(10s);
  voyage.takeErrors_ms();
  voyage.pass(10min);
  const auto errors_ms = voyage.takeErrors_ms();
  EXPECT_GT(errors_ms.size(), 11000u);  // odom and nav/fix at 10 Hz
  expectGood(errors_ms);
  EXPECT_EQ(voyage.wentBack(), 0u);
  EXPECT_EQ(voyage.clock().steps, 0u);
  RecordProperty("p95_us", static_cast<int>(errors_ms[errors_ms.size() * 95 / 100] * 1e3));
  RecordProperty("max_us", static_cast<int>(errors_ms.back() * 1e3));
}

TEST_P(PublishedStamps, AbsorbAStepOfTheVehiclesClockWithinTwoSeconds) {
  for (const Duration step : {3s, -3s}) {
    Voyage voyage = this->voyage();
    voyage.pass(1min);
    voyage.loop().frontseat().stepClock(step);
    voyage.pass(2s);
    voyage.takeErrors_ms();
    voyage.pass(10min);
    expectGood(voyage.takeErrors_ms());
    EXPECT_EQ(voyage.wentBack(), 0u);
    EXPECT_EQ(voyage.clock().steps, 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, PublishedStamps, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(PublishedStampsOfADay, NeverGoBackAcrossMidnight) {
  Voyage voyage{Dialect::Sandshark, kFiveHours18_s, 50.0, 7, 1.0};
  voyage.pass(24h);
  EXPECT_EQ(voyage.wentBack(), 0u);
  EXPECT_EQ(voyage.clock().steps, 0u);
  EXPECT_GT(voyage.published(), 24u * 3600u * 4u);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
