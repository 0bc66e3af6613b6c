#include "frontseat_driver/session/blueye_requests.h"

#include <utility>

namespace frontseat_driver::session {

namespace {

// How soon a request is tried again that the link did not take: a connection is being made.
constexpr std::chrono::milliseconds kRetry{20};

constexpr const char* kExpired = "it was not sent: those before it took the drone too long";

}  // namespace

void BlueyeRequests::add(const vehicle::Now& now, std::string type, std::string payload,
                         std::chrono::milliseconds timeout, Respond respond, BlueyeOutput& out,
                         vehicle::SteadyTime expires) {
  const auto as_it_is = [payload = std::move(payload)](const vehicle::Now&) { return payload; };
  add(now, std::move(type), Payload{as_it_is}, timeout, std::move(respond), out, expires);
}

void BlueyeRequests::add(const vehicle::Now& now, std::string type, Payload payload,
                         std::chrono::milliseconds timeout, Respond respond, BlueyeOutput& out,
                         vehicle::SteadyTime expires) {
  if (waiting_.size() >= kMost) {
    return respond(now, {false, {}, {}, "too many requests are waiting for the drone"}, out);
  }
  waiting_.push_back({std::move(type), std::move(payload), timeout, std::move(respond), expires});
}

void BlueyeRequests::reply(const vehicle::Now& now, std::string_view type, std::string_view payload,
                           BlueyeOutput& out) {
  if (under_way_) answer(now, {true, type, payload, {}}, out);
}

void BlueyeRequests::noReply(const vehicle::Now& now, const std::string& reason,
                             BlueyeOutput& out) {
  if (under_way_) answer(now, {false, {}, {}, reason}, out);
}

void BlueyeRequests::answer(const vehicle::Now& now, const BlueyeReply& reply, BlueyeOutput& out) {
  const Respond respond = std::move(waiting_.front().respond);
  waiting_.pop_front();
  under_way_ = false;
  respond(now, reply, out);
}

void BlueyeRequests::step(const vehicle::Now& now, BlueyeOutput& out) {
  if (under_way_) return;
  while (!waiting_.empty() && now.steady >= waiting_.front().expires) {
    answer(now, {false, {}, {}, kExpired}, out);
  }
  if (waiting_.empty() || now.steady < retry_at_) return;
  const Waiting& first = waiting_.front();
  under_way_ = out.request(now, first.type, first.payload(now), first.timeout);
  if (!under_way_) retry_at_ = now.steady + kRetry;
}

vehicle::SteadyTime BlueyeRequests::nextStep() const {
  return under_way_ || waiting_.empty() ? vehicle::SteadyTime::max() : retry_at_;
}

void BlueyeRequests::failAll(const vehicle::Now& now, const std::string& reason, BlueyeOutput& out,
                             std::string_view but) {
  std::deque<Waiting> all = std::exchange(waiting_, {});
  if (under_way_ && all.front().type == but) {
    waiting_.push_back(std::move(all.front()));
    all.pop_front();
  } else {
    under_way_ = false;
  }
  for (; !all.empty(); all.pop_front()) {
    all.front().respond(now, {false, {}, {}, reason}, out);
  }
}

}  // namespace frontseat_driver::session
