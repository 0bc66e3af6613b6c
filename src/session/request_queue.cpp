#include "frontseat_driver/session/request_queue.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace frontseat_driver::session {

namespace {

using vehicle::Acknowledgement;

// Fits two repetitions and an answer to the last into the time a caller waits.
constexpr int kSendsPerTimeout = 3;

bool isAbort(const Request& request) { return std::holds_alternative<AbortRequest>(request); }

// Sent twice, these end where sent once they would; a behavior would start its five seconds again.
bool isIdempotent(const Request& request) {
  return isAbort(request) || std::holds_alternative<LogSwitch>(request);
}

std::string inSeconds(std::chrono::nanoseconds duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", std::chrono::duration<double>(duration).count());
  return text;
}

}  // namespace

std::string finalWords(const Acknowledgement& ack) {
  const std::string message{ack.message};
  const std::string why = message.empty() ? "" : ": " + message;
  switch (ack.status) {
    case Acknowledgement::Status::Done:
      return message.empty() ? "done" : message;
    case Acknowledgement::Status::Failed:
      return "the vehicle could not do it (acknowledgement 1)" + why;
    default:
      return "the vehicle calls it invalid (acknowledgement 0)" + why;
  }
}

void RequestQueue::add(Request request, std::string note, Respond respond, SteadyTime now) {
  Open open;
  open.id = ++last_id_;
  open.request = std::move(request);
  open.respond = std::move(respond);
  open.note = std::move(note);
  open.deadline = now + ack_timeout_;
  open.due = now;
  open_.push_back(std::move(open));
}

const RequestQueue::Open* RequestQueue::due(SteadyTime now, bool abort) const {
  const auto found = std::find_if(open_.begin(), open_.end(), [&](const Open& open) {
    return isAbort(open.request) == abort && now >= open.due;
  });
  return found == open_.end() ? nullptr : &*found;
}

RequestQueue::Requests::iterator RequestQueue::find(Id id) {
  return std::find_if(open_.begin(), open_.end(), [&](const Open& open) { return open.id == id; });
}

void RequestQueue::sent(Id id, SteadyTime now, bool acknowledged) {
  const auto open = find(id);
  if (open == open_.end()) return;
  open->sent = true;
  const bool again = acknowledged && isIdempotent(open->request);
  open->due = again ? now + ack_timeout_ / kSendsPerTimeout : SteadyTime::max();
  if (std::holds_alternative<RawSentence>(open->request)) {
    answer(open, true, "sent");
  } else if (!acknowledged) {
    answer(open, true, "sent; the vehicle is not asked to acknowledge it");
  }
}

void RequestQueue::take(Id id, const Acknowledgement& ack) {
  const auto open = find(id);
  if (open == open_.end()) return;
  if (ack.status == Acknowledgement::Status::Pending) {
    open->pending = true;
    open->due = SteadyTime::max();
    return;
  }
  answer(open, ack.status == Acknowledgement::Status::Done, finalWords(ack));
}

std::vector<RequestQueue::Id> RequestQueue::expire(SteadyTime now) {
  std::vector<Id> expired;
  for (auto open = open_.begin(); open != open_.end();) {
    const auto current = open++;
    if (now < current->deadline) continue;
    const std::string limit = inSeconds(ack_timeout_);
    const char* what = !current->sent     ? "it could not be sent within "
                       : current->pending ? "the vehicle is still working on it after "
                                          : "sent, but the vehicle did not acknowledge it within ";
    expired.push_back(current->id);
    answer(current, false, what + limit);
  }
  return expired;
}

void RequestQueue::failAll(const std::string& reason) {
  while (!open_.empty()) answer(open_.begin(), false, reason);
}

template <class... Kinds>
void RequestQueue::failUnsent(const std::string& reason) {
  for (auto open = open_.begin(); open != open_.end();) {
    const auto current = open++;
    const bool is_one = (std::holds_alternative<Kinds>(current->request) || ...);
    if (is_one && !current->sent) answer(current, false, reason);
  }
}

void RequestQueue::failUnsentBehaviors(const std::string& reason) {
  failUnsent<vehicle::BehaviorCommand>(reason);
}

void RequestQueue::failUnsentCommands(const std::string& reason) {
  failUnsent<vehicle::BehaviorCommand, RawSentence>(reason);
}

void RequestQueue::answer(Requests::iterator open, bool success, const std::string& message) {
  const Respond respond = std::move(open->respond);
  const std::string text = open->note.empty() ? message : message + "; " + open->note;
  open_.erase(open);
  respond({success, text});
}

RequestQueue::SteadyTime RequestQueue::nextDue() const {
  SteadyTime next = SteadyTime::max();
  for (const Open& open : open_) next = std::min(next, open.due);
  return next;
}

RequestQueue::SteadyTime RequestQueue::nextDeadline() const {
  SteadyTime next = SteadyTime::max();
  for (const Open& open : open_) next = std::min(next, open.deadline);
  return next;
}

}  // namespace frontseat_driver::session
