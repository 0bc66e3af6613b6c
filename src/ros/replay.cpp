#include "replay.h"

#include <utility>

#include "convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

// A bag can be read faster than it is decoded.
constexpr std::uint32_t kUnlimited = 0;

}  // namespace

Replay::Replay(session::Session& session, driver::Listener& listener,
               std::function<void(Restart)> on_restart)
    : player_(session, listener, std::move(on_restart)) {}

void Replay::start(ros::NodeHandle node) {
  subscriber_ = node.subscribe(topics::kNmeaReplay, kUnlimited, &Replay::take, this,
                               ros::TransportHints().tcpNoDelay());
}

void Replay::post(const std::function<void(const vehicle::Now&, session::Output&)>& task) {
  const std::lock_guard<std::mutex> lock(mutex_);
  player_.post(task);
}

void Replay::take(const Sentence& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto& header = sentence.header;
  // Only what was never stamped, as by hand, is taken for now.
  const ros::Time stamp = header.stamp.isZero() ? ros::Time::now() : header.stamp;
  player_.play({toUtcTime(stamp), header.frame_id, sentence.sentence});
}

}  // namespace frontseat_driver::ros_layer
