#include "replay.h"

#include "convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kQueue = 10000;
// A record that starts again goes back further than sentences of one connection ever do.
constexpr auto kRestart = 1s;

vehicle::Now recordedTime(const Sentence& sentence) {
  const bool stamped = !sentence.header.stamp.isZero();
  const vehicle::UtcTime at = toUtcTime(stamped ? sentence.header.stamp : ros::Time::now());
  return {vehicle::SteadyTime{at}, at, at};
}

}  // namespace

Replay::Replay(ros::NodeHandle node, session::Session& session, driver::Listener& listener)
    : session_(session),
      listener_(listener),
      subscriber_(node.subscribe(topics::kNmeaReplay, kQueue, &Replay::take, this,
                                 ros::TransportHints().tcpNoDelay())) {}

void Replay::post(const std::function<void(const vehicle::Now&, session::Output&)>& task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const vehicle::Now now = last_.value_or(vehicle::Now{});
  task(now, *this);
  session_.step(now, *this);
}

void Replay::take(const Sentence& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const vehicle::Now now = recordedTime(sentence);
  if (!last_) begin(now);
  if (now.stamp < last_->stamp - kRestart) {
    session_.disconnected(now, *this);
    listener_.onDisconnected(now, "the record starts again");
    begin(now);
  }
  tickUntil(now);
  last_ = now;
  session_.receive(now, sentence.sentence + "\r\n", *this);
  session_.step(now, *this);
}

void Replay::begin(const vehicle::Now& now) {
  last_ = now;
  next_tick_ = now.stamp + 1s;
  listener_.onConnected(now, topics::kNmeaReplay);
  session_.connected(now, *this);
}

void Replay::tickUntil(const vehicle::Now& now) {
  if (now.stamp < next_tick_) return;
  next_tick_ = now.stamp + 1s;
  listener_.onTick(now);
}

bool Replay::send(const vehicle::Now&, std::string_view) { return false; }

void Replay::heard(const vehicle::Now& now, std::string_view line) { listener_.onHeard(now, line); }

void Replay::event(const vehicle::Now& now, const vehicle::Event& event) {
  listener_.onEvent(now, event);
}

}  // namespace frontseat_driver::ros_layer
