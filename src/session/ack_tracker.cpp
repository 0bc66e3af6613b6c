#include "frontseat_driver/session/ack_tracker.h"

#include <algorithm>

namespace frontseat_driver::session {

namespace {

using vehicle::Acknowledgement;

// Times go out with milliseconds; a frontseat may send them back with more or fewer decimals.
bool sameTime(const std::optional<vehicle::TimeOfDay>& a,
              const std::optional<vehicle::TimeOfDay>& b) {
  if (!a || !b) return !a && !b;
  return std::chrono::abs(*a - *b) < std::chrono::milliseconds{1};
}

// What only order can tell must not stand in the way of a request that somebody waits for: an
// acknowledgement comes within two seconds (SPI 0.1, section 4.4) or not at all.
bool isGivenUp(const AckTracker::Sent& sentence, AckTracker::SteadyTime now) {
  const bool waited_for = sentence.request != AckTracker::kNoRequest;
  return !sentence.time && !waited_for && now - sentence.at > std::chrono::seconds{2};
}

}  // namespace

void AckTracker::sent(const Sent& sentence) {
  if (outstanding_.size() == kMost) {
    const auto unwaited = std::find_if(outstanding_.begin(), outstanding_.end(),
                                       [](const Sent& sent) { return sent.request == kNoRequest; });
    outstanding_.erase(unwaited == outstanding_.end() ? outstanding_.begin() : unwaited);
  }
  outstanding_.push_back(sentence);
}

void AckTracker::forget(RequestId request) {
  outstanding_.erase(std::remove_if(outstanding_.begin(), outstanding_.end(),
                                    [&](const Sent& sent) { return sent.request == request; }),
                     outstanding_.end());
}

std::optional<AckTracker::Sent> AckTracker::match(const Acknowledgement& ack, SteadyTime now) {
  while (!outstanding_.empty() && now - outstanding_.front().at > forgotten_) {
    outstanding_.pop_front();
  }
  const auto found =
      std::find_if(outstanding_.begin(), outstanding_.end(), [&](const Sent& sentence) {
        return sentence.formatter == ack.command && sameTime(sentence.time, ack.command_time) &&
               !isGivenUp(sentence, now);
      });
  if (found == outstanding_.end()) return std::nullopt;
  const Sent sentence = *found;
  if (ack.status != Acknowledgement::Status::Pending) outstanding_.erase(found);
  return sentence;
}

}  // namespace frontseat_driver::session
