#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "closed_loop.h"

namespace frontseat_driver::closed_loop {

inline constexpr std::string_view kZero = "$PYDIR,0,0*56";
inline constexpr auto kSandsharkSpacing = std::chrono::milliseconds{60};
inline constexpr auto kKingfisherSpacing = std::chrono::milliseconds{20};
inline constexpr auto kCommandTimeout = std::chrono::seconds{1};
inline constexpr auto kAckTimeout = std::chrono::seconds{3};
inline constexpr auto kVehiclesWatchdog = std::chrono::seconds{1};  // a Kingfisher's motors
inline constexpr auto kVehicleTakesOver =
    std::chrono::seconds{5};  // a Sandshark, SPI 0.1, section 7.3
inline constexpr auto kVehicleTick = std::chrono::milliseconds{10};

/// Without BPSTS between what a test looks at.
inline ros_layer::Parameters quiet(protocol::Dialect dialect) {
  ros_layer::Parameters parameters = parametersFor(dialect);
  parameters.session.status_rate_hz = 0.0;
  return parameters;
}

/// The failures of doc/safety.md that show without sockets and threads: driver and vehicle in
/// virtual time, with the limits that the document promises.
class Safety : public testing::Test {
 protected:
  template <class Config>
  void start(const ros_layer::Parameters& parameters, const Config& vehicle) {
    loop_ = std::make_unique<ClosedLoop>(parameters, vehicle);
    loop_->connect();
    awaitPermission();
    loop_->pass(std::chrono::seconds{1});
  }
  void startSandshark(const sim::SandsharkConfig& vehicle = quietSandshark()) {
    start(quiet(protocol::Dialect::Sandshark), vehicle);
  }
  void startKingfisher(const sim::KingfisherConfig& vehicle = quietKingfisher()) {
    start(quiet(protocol::Dialect::Kingfisher), vehicle);
  }

  void awaitPermission() {
    ASSERT_TRUE(loop_->passUntil([&] { return loop_->reason().empty(); }, std::chrono::seconds{10}))
        << loop_->reason();
  }

  /// As a vehicle does that is told to by its operator.
  void takeControlAndGiveItBack() {
    loop_->sandshark().setBackseatControl(false);
    loop_->pass(std::chrono::milliseconds{100});
    loop_->sandshark().setBackseatControl(true);
    awaitPermission();
  }

  std::vector<Sent> sentSince(Duration from) const { return loop_->sent("", from); }
  std::vector<Sent> behaviorsSince(Duration from) const { return loop_->sent("BPRMB", from); }

  /// The smallest time between two sentences.
  Duration leastSpacing(Duration from = Duration{0}) const {
    const auto sent = sentSince(from);
    Duration least = Duration::max();
    for (std::size_t i = 1; i < sent.size(); ++i) {
      least = std::min(least, sent[i].at - sent[i - 1].at);
    }
    return least;
  }

  bool motorsStand() const {
    const auto& thrust = loop_->kingfisher().thrust();
    return thrust.port == 0.0 && thrust.starboard == 0.0;
  }

  bool ascends() const {
    const auto state = loop_->sandshark().mission().state();
    return state == sim::Mission::State::Aborting || state == sim::Mission::State::Aborted;
  }

  /// The only answer to a request; a test fails if there is not exactly one.
  Asked::Answered answerTo(std::size_t request) const {
    const Asked& asked = loop_->asked()[request];
    EXPECT_THAT(asked.answers, testing::SizeIs(1));
    return asked.answers.empty() ? Asked::Answered{} : asked.answers.front();
  }
  Duration waitedFor(std::size_t request) const {
    return answerTo(request).at - loop_->asked()[request].at;
  }

  std::unique_ptr<ClosedLoop> loop_;
};

}  // namespace frontseat_driver::closed_loop
