#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/battery_watch.h"
#include "diagnosis/clock_watch.h"
#include "diagnosis/health.h"
#include "frontseat_driver/session/nmea_session.h"
#include "message_builder.h"
#include "parameters.h"

namespace frontseat_driver::ros_layer {

/// Watches a session and what comes of it, and tells once a second how all is. Knows no ROS node,
/// so that it runs in virtual time too.
class HealthMonitor {
 public:
  /// The session must outlive this.
  HealthMonitor(const Parameters& parameters, const session::NmeaSession& session);

  void connected(const vehicle::Now& now, const std::string& endpoint);
  void disconnected(const vehicle::Now& now, const std::string& reason);
  void connectFailed(const std::string& reason);
  void heard(const vehicle::Now& now, std::string_view line);
  void event(const vehicle::Now& now, const vehicle::Event& event);

  /// The health at `now`, once a second. `held_back` is by how much stamps would have gone back
  /// since the last call.
  Health take(const vehicle::Now& now, const MessageBuilder& builder,
              std::chrono::nanoseconds held_back);

  /// As connected, or host and port as configured.
  const std::string& endpoint() const { return endpoint_; }

 private:
  /// How long a refusal counts: commands are to come at 2 Hz or more.
  static constexpr std::chrono::seconds kRecent{3};
  /// How long the end of a connection counts.
  static constexpr std::chrono::seconds kLately{60};

  LinkHealth link(const vehicle::Now& now);
  bool otherDialectOnly() const;
  std::string recentWords(const std::optional<session::CommandRefusal>& refusal,
                          const vehicle::Now& now) const;
  std::chrono::seconds leapSeconds() const;
  session::NmeaCounters recentCounters();

  const Parameters parameters_;
  const std::string configured_endpoint_;
  const session::NmeaSession& session_;
  std::string endpoint_;
  bool connected_ = false;
  bool failed_ = false;                ///< and nothing was heard since
  bool other_dialect_before_ = false;  ///< on the last connection
  std::string last_failure_;
  std::deque<vehicle::SteadyTime> losses_;  ///< in kLately; the back-off keeps them few
  vehicle::SteadyTime connected_at_{};
  session::NmeaCounters at_connect_;
  std::array<session::NmeaCounters, SentenceRates::kWindow> at_ticks_;
  std::size_t tick_ = 0;
  SentenceRates rates_;
  std::vector<SentenceRates::Rate> latest_rates_;
  ClockWatch clock_;
  BatteryWatch batteries_;
};

}  // namespace frontseat_driver::ros_layer
