#include "record_player.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;

// A record that starts again goes back further than what a network puts out of order.
constexpr auto kRestart = 1s;
constexpr auto kTick = 1s;

vehicle::Now recordedTime(vehicle::UtcTime stamp) {
  return {vehicle::SteadyTime{stamp}, stamp, stamp};
}

/// Which run of a driver a connection belongs to: `connection_1@1778450400.123` to the one that
/// began then. Empty in older records and in names that others gave.
std::string_view driverOf(std::string_view connection) {
  constexpr std::string_view kOurs = "connection_";
  const std::size_t at = connection.find('@');
  if (connection.substr(0, kOurs.size()) != kOurs || at == connection.npos) return {};
  return connection.substr(at + 1);
}

}  // namespace

RecordPlayer::RecordPlayer(session::Session& session, driver::Listener& listener,
                           std::function<void(Restart)> on_restart)
    : session_(session), listener_(listener), on_restart_(std::move(on_restart)) {}

void RecordPlayer::play(const RecordedLine& recorded) {
  vehicle::Now now = recordedTime(recorded.stamp);
  if (!last_) {
    begin(now, recorded);
  } else if (driverOf(recorded.connection) != driverOf(connection_)) {
    beginAnew(now, recorded, Restart::Driver);
  } else if (now.stamp < last_->stamp - kRestart) {
    beginAnew(now, recorded, Restart::Record);
  } else if (recorded.connection != connection_) {
    now = recordedTime(std::max(now.stamp, last_->stamp));
    end(now, "the recorded connection ended");
    begin(now, recorded);
  }
  now = recordedTime(std::max(now.stamp, last_->stamp));
  tickUntil(now);
  last_ = now;
  line_.assign(recorded.line).append("\r\n");
  session_.receive(now, line_, *this);
  session_.step(now, *this);
}

void RecordPlayer::post(const std::function<void(const vehicle::Now&, session::Output&)>& task) {
  const vehicle::Now now = last_.value_or(vehicle::Now{});
  task(now, *this);
  session_.step(now, *this);
}

void RecordPlayer::begin(const vehicle::Now& now, const RecordedLine& recorded) {
  last_ = now;
  connection_ = recorded.connection;
  next_tick_ = now.stamp + kTick;
  listener_.onConnected(now, topics::kNmeaReplay);
  session_.connected(now, *this);
}

void RecordPlayer::beginAnew(const vehicle::Now& now, const RecordedLine& recorded, Restart what) {
  end(*last_,
      what == Restart::Driver ? "the recorded driver was restarted" : "the record starts again");
  on_restart_(what);
  begin(now, recorded);
}

void RecordPlayer::end(const vehicle::Now& now, const char* reason) {
  session_.disconnected(now, *this);
  listener_.onDisconnected(now, reason);
}

void RecordPlayer::tickUntil(const vehicle::Now& now) {
  if (now.stamp < next_tick_) return;
  next_tick_ = now.stamp + kTick;
  listener_.onTick(now);
}

bool RecordPlayer::send(const vehicle::Now&, std::string_view) { return false; }

void RecordPlayer::heard(const vehicle::Now& now, std::string_view line) {
  listener_.onHeard(now, line);
}

void RecordPlayer::event(const vehicle::Now& now, const vehicle::Event& event) {
  listener_.onEvent(now, event);
}

}  // namespace frontseat_driver::ros_layer
