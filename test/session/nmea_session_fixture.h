#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "frontseat_driver/session/nmea_session.h"
#include "recorder.h"

namespace frontseat_driver::session {

// 2015-09-03 12:00:00 UTC.
inline constexpr vehicle::UtcTime kStart = std::chrono::seconds{1441281600};
inline constexpr std::chrono::nanoseconds kSteadyStart = std::chrono::hours{1};

inline std::string line(const std::string& body) {
  char sum[3];
  std::snprintf(sum, sizeof sum, "%02X", nmea::checksum(body));
  return "$" + body + "*" + sum + "\r\n";
}

inline NmeaOptions quiet() {
  NmeaOptions options;
  options.status_rate_hz = 0.0;  // no BPSTS between what the test looks at
  return options;
}

inline NmeaOptions withDialect(protocol::Dialect dialect) {
  NmeaOptions options = quiet();
  options.dialect = dialect;
  return options;
}

/// A session in virtual time, with the vehicle's side at hand.
class NmeaSessionTest : public testing::Test {
 protected:
  Now now() const {
    const vehicle::UtcTime utc = kStart + (elapsed_ - kSteadyStart);
    return {SteadyTime{elapsed_}, utc, utc};
  }

  void start(NmeaOptions options) {
    session_ = std::make_unique<NmeaSession>(std::move(options));
    session_->step(now(), out_);
    connect();
  }

  void connect() {
    session_->connected(now(), out_);
    session_->step(now(), out_);
  }

  void disconnect() {
    session_->disconnected(now(), out_);
    session_->step(now(), out_);
  }

  void hear(const std::string& body) { receive(line(body)); }

  void receive(const std::string& bytes) {
    session_->receive(now(), bytes, out_);
    session_->step(now(), out_);
  }

  /// Lets time pass, stepping when the session asks for it.
  void pass(std::chrono::nanoseconds duration) {
    const auto end = elapsed_ + duration;
    while (session_->nextStep() <= SteadyTime{end}) {
      elapsed_ =
          std::max(elapsed_, std::chrono::nanoseconds{session_->nextStep().time_since_epoch()});
      session_->step(now(), out_);
    }
    elapsed_ = end;
  }

  std::chrono::nanoseconds elapsed_ = kSteadyStart;
  std::unique_ptr<NmeaSession> session_;
  Recorder out_;
};

}  // namespace frontseat_driver::session
