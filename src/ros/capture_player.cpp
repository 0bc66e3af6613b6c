#include "capture_player.h"

#include <ros/console.h>
#include <ros/init.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>

#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kQueue = 2 * CapturePlayer::kAhead;
constexpr auto kLook = 10ms;  // how soon the end of the program is noticed
constexpr auto kClockPeriod = 10ms;
constexpr auto kPatience = 5s;  // with a driver that tells nothing

}  // namespace

CapturePlayer::CapturePlayer(ros::NodeHandle node, double rate)
    : rate_(rate), lines_(node.advertise<Sentence>(topics::kNmeaReplay, kQueue)) {
  bool simulated = false;
  node.getParam("/use_sim_time", simulated);
  if (simulated) clock_ = node.advertise<rosgraph_msgs::Clock>("/clock", kQueue);
  echo_ = node.subscribe(topics::kNmeaReceived, kQueue, &CapturePlayer::taken, this,
                         ros::TransportHints().tcpNoDelay());
}

bool CapturePlayer::awaitListener() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (ros::ok() && lines_.getNumSubscribers() == 0) changed_.wait_for(lock, kLook);
  const auto give_up = Steady::now() + 1s;  // somebody else than a driver may listen
  while (ros::ok() && echo_.getNumPublishers() == 0 && Steady::now() < give_up) {
    changed_.wait_for(lock, kLook);
  }
  return ros::ok();
}

bool CapturePlayer::play(const Sentence& sentence) {
  if (!awaitDue(sentence.header.stamp) || !awaitRoom(kAhead)) return false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (echo_.getNumPublishers() > 0) waiting_.push_back(sentence);
  }
  lines_.publish(sentence);
  ++played_;
  return true;
}

void CapturePlayer::finish() { awaitRoom(1); }

// A line that the driver does not take for one, such as an oversized one, is not heard back.
void CapturePlayer::taken(const Sentence& sentence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Sentence& one) {
    return one.header.stamp == sentence.header.stamp && one.sentence == sentence.sentence;
  });
  if (found == waiting_.end()) return;
  waiting_.erase(waiting_.begin(), found + 1);
  changed_.notify_all();
}

bool CapturePlayer::awaitDue(const ros::Time& stamp) {
  if (!first_) {
    first_ = stamp;
    began_ = Steady::now();
  }
  std::unique_lock<std::mutex> lock(mutex_);
  while (ros::ok() && rate_ > 0.0) {
    const auto elapsed = Steady::now() - began_;
    const double played_s = std::chrono::duration<double>(elapsed).count() * rate_;
    const double due_s = (stamp - *first_).toSec();
    if (played_s >= due_s) break;
    tell(*first_ + ros::Duration(played_s));
    const auto left = std::chrono::duration<double>((due_s - played_s) / rate_);
    changed_.wait_for(lock, std::min<std::chrono::duration<double>>(left, kLook));
  }
  tell(stamp);
  return ros::ok();
}

bool CapturePlayer::awaitRoom(std::size_t most_waiting) {
  std::unique_lock<std::mutex> lock(mutex_);
  auto give_up = Steady::now() + kPatience;
  std::size_t before = waiting_.size();
  while (ros::ok() && waiting_.size() >= most_waiting && echo_.getNumPublishers() > 0) {
    changed_.wait_for(lock, kLook);
    if (waiting_.size() != before) give_up = Steady::now() + kPatience;
    before = waiting_.size();
    if (Steady::now() < give_up) continue;
    ROS_WARN("the driver has not taken %zu lines for %ld s; going on without it", before,
             static_cast<long>(kPatience.count()));
    waiting_.clear();
  }
  return ros::ok();
}

void CapturePlayer::tell(const ros::Time& time) {
  if (!clock_ || Steady::now() < clock_due_) return;
  clock_due_ = Steady::now() + kClockPeriod;
  rosgraph_msgs::Clock clock;
  clock.clock = time;
  clock_.publish(clock);
}

}  // namespace frontseat_driver::ros_layer
