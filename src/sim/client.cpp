#include "frontseat_driver/sim/client.h"

namespace frontseat_driver::sim {
namespace {

/// Split or not, no more than this waits.
constexpr std::size_t kMostWaiting = 4096;

}  // namespace

void Client::queue(std::string_view sentence) {
  if (ignored || random_.chance(faults_->drop)) return;
  const std::size_t start = queued_.size();
  queued_.append(sentence);
  if (!random_.chance(faults_->corrupt)) return;
  const std::size_t line_end = 2;
  const std::size_t at = start + random_.below(sentence.size() - line_end);
  // One bit of the lower six, so that the byte changes; above them a line end could appear.
  queued_[at] = static_cast<char>(queued_[at] ^ (1 << random_.below(5)));
}

std::string_view Client::outgoing() {
  leaving_ = queued_.size();
  if (faults_->split && leaving_ <= kMostWaiting) leaving_ = random_.below(leaving_ + 1);
  return std::string_view{queued_}.substr(0, leaving_);
}

void Client::sent() {
  queued_.erase(0, leaving_);
  leaving_ = 0;
}

void Client::lose() { queued_.clear(); }

}  // namespace frontseat_driver::sim
