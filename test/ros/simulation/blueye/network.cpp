#include "network.h"

#include <algorithm>
#include <utility>

namespace frontseat_driver::blueye_simulation {

using namespace std::chrono_literals;

namespace {

constexpr Duration kNever = Duration::max();
constexpr Duration kRoundTrip = 2ms;
constexpr const char* kOther = "other";

}  // namespace

Network::Network(Clock clock, sim::BlueyeDrone& drone, Watcher& watcher, std::uint64_t seed)
    : clock_(std::move(clock)),
      drone_(drone),
      watcher_(watcher),
      random_(seed, 5),
      attempt_at_(kNever),
      fails_at_(kNever),
      reply_due_(kNever) {}

Duration Network::elapsed() const { return clock_().steady.time_since_epoch(); }

void Network::serve(session::BlueyeSession* session) {
  drop();
  session_ = session;
  attempt_at_ = session_ == nullptr ? kNever : elapsed();
}

void Network::drop() {
  connected_ = false;
  attempt_at_ = fails_at_ = reply_due_ = kNever;
  ++socket_;
  // Control that has left is not called back; what the driver did not read is gone.
  to_telemetry.passing.clear();
  to_reply.passing.clear();
  to_request.passing.clear();
}

void Network::lose(const std::string&) {
  const bool was_connected = std::exchange(connected_, false);
  drop();
  if (session_ != nullptr) attempt_at_ = elapsed() + options_.reconnect_min;
  if (!was_connected) return;
  session_->disconnected(clock_(), *this);
  watcher_.disconnected();
}

void Network::attempt() {
  attempt_at_ = kNever;
  if (!listens || !drone_.online() || !delivers) {
    ++failures;
    fails_at_ = elapsed() + options_.connect_timeout;
    return;
  }
  ++connects;
  connected_ = true;
  last_heard_ = elapsed() + kRoundTrip;
  watcher_.connected();
  session_->connected(clock_(), *this);
}

Duration Network::next() const {
  Duration next = std::min({attempt_at_, fails_at_, reply_due_});
  if (connected_) next = std::min(next, last_heard_ + options_.silence_timeout);
  for (const Channel* channel : {&to_telemetry, &to_reply, &to_control, &to_request}) {
    if (!channel->passing.empty()) next = std::min(next, channel->passing.front().at);
  }
  return next;
}

void Network::act() {
  while (deliverOne()) {
  }
  checkTime();
}

/// What has come first goes first, whichever channel it is on.
bool Network::deliverOne() {
  Channel* first = nullptr;
  for (Channel* channel : {&to_control, &to_request, &to_reply, &to_telemetry}) {
    if (channel->passing.empty() || channel->passing.front().at > elapsed()) continue;
    if (first == nullptr || channel->passing.front().at < first->passing.front().at) {
      first = channel;
    }
  }
  if (first == nullptr) return false;
  deliver(*first);
  return true;
}

void Network::deliver(Channel& channel) {
  const Channel::Passing one = std::move(channel.passing.front());
  channel.passing.pop_front();
  if (!delivers) return;
  ++delivered;
  if (&channel == &to_control) return drone_.control(one.word.type, one.word.payload);
  if (&channel == &to_request) {
    // The drone changes now, whenever its answer comes.
    const std::string peer = std::to_string(++order_) + ":" + std::to_string(one.socket);
    return drone_.request(peer, one.word.type, one.word.payload);
  }
  if (!connected_) return;
  last_heard_ = elapsed();
  if (&channel == &to_telemetry) {
    watcher_.telemetry(one.word);
    return session_->telemetry(clock_(), one.word.type, one.word.payload, *this);
  }
  if (one.socket != socket_) return;  // late
  reply_due_ = kNever;
  watcher_.reply(one.word);
  session_->reply(clock_(), one.word.type, one.word.payload, *this);
}

void Network::checkTime() {
  if (elapsed() >= reply_due_) {
    reply_due_ = kNever;
    ++socket_;
    watcher_.noReply();
    session_->noReply(clock_(), "no reply in time", *this);
  }
  if (connected_ && elapsed() >= last_heard_ + options_.silence_timeout) lose("silence");
  if (elapsed() >= fails_at_) {
    fails_at_ = kNever;
    attempt_at_ = elapsed() + options_.reconnect_min;
  }
  if (elapsed() >= attempt_at_) attempt();
}

void Network::send(Channel& channel, Word word) {
  const Duration on_the_way =
      delay + channel.slower_by + fromSeconds(inSeconds(jitter) * random_.uniform());
  const Duration at = std::max(elapsed() + on_the_way, channel.stalled_until);
  channel.last_arrival = std::max(channel.last_arrival, at);
  channel.passing.push_back({channel.last_arrival, socket_, std::move(word)});
}

bool Network::publish(const vehicle::Now&, std::string_view type, std::string_view payload) {
  if (!connected_ || !takes) {
    watcher_.linkRefused();
    return false;
  }
  watcher_.control(type, payload);
  send(to_control, {0, std::string{type}, std::string{payload}});
  return true;
}

bool Network::request(const vehicle::Now&, std::string_view type, std::string_view payload,
                      std::chrono::milliseconds timeout) {
  if (!connected_ || reply_due_ != kNever) return false;
  reply_due_ = elapsed() + timeout;
  watcher_.request(type, timeout);
  send(to_request, {0, std::string{type}, std::string{payload}});
  return true;
}

void Network::publish(const std::string& name, std::string data) {
  ++order_;
  if (connected_) send(to_telemetry, {order_, name, std::move(data)});
}

void Network::reply(const std::string& peer, const std::string& name, std::string data) {
  if (peer == kOther) {
    other_reply = std::move(data);
    return;
  }
  const std::size_t colon = peer.find(':');
  const std::uint64_t socket = std::stoull(peer.substr(colon + 1));
  if (!connected_ || socket != socket_) return;
  send(to_reply, {std::stoull(peer.substr(0, colon)), name, std::move(data)});
}

void Network::askAsOther(std::string_view type, const std::string& payload) {
  ++order_;
  other_reply.clear();
  drone_.request(kOther, type, payload);
  drone_.step(drone_.now(), *this);
}

}  // namespace frontseat_driver::blueye_simulation
