#include "network.h"

#include <algorithm>

namespace frontseat_driver::simulation {

using namespace std::chrono_literals;

namespace {

constexpr Duration kNever = Duration::max();
constexpr Duration kRoundTrip = 1ms;

}  // namespace

Network::Network(closed_loop::ClosedLoop& loop, closed_loop::Supervised& supervised,
                 const link::TcpClient::Options& options)
    : loop_(loop),
      supervised_(supervised),
      options_(options),
      back_off_(options.reconnect_min, options.reconnect_max, options.jitter_seed),
      breaks_at_(kNever) {
  loop_.watch.lost = [this] { lost(); };
  loop_.watch.confirmed = [this] { back_off_.restart(); };
  loop_.watch.arrives = [this, before = loop_.watch.arrives](std::string_view bytes) {
    last_byte_ = loop_.elapsed();
    before(bytes);
  };
}

void Network::breakSoon() { resetAt(loop_.elapsed()); }

void Network::resetAt(Duration at) { breaks_at_ = std::min(breaks_at_, at); }

Duration Network::next() const {
  if (state_ == State::Off) return kNever;
  if (state_ != State::Connected) return due_;
  return std::min(breaks_at_, last_byte_ + options_.silence_timeout);
}

void Network::act() {
  if (loop_.elapsed() < next()) return;
  switch (state_) {
    case State::BackingOff:
      return attempt();
    case State::Connecting:
      ++failures_;
      return retry();
    case State::Connected:
      return supervised_.disconnect();
    case State::Off:
      return;
  }
}

void Network::attempt() {
  if (host_ == Host::Listens) {
    ++connects_;
    state_ = State::Connected;
    breaks_at_ = kNever;
    last_byte_ = loop_.elapsed();
    loop_.link.delivers = true;
    return supervised_.connect();
  }
  state_ = State::Connecting;
  due_ = loop_.elapsed() +
         (host_ == Host::Refuses ? Duration{kRoundTrip} : Duration{options_.connect_timeout});
}

void Network::retry() {
  state_ = State::BackingOff;
  due_ = loop_.elapsed() + back_off_.next();
}

void Network::lost() {
  if (state_ == State::Connected) retry();
}

void Network::setRunning(bool running) {
  state_ = running ? State::BackingOff : State::Off;
  due_ = loop_.elapsed();
  if (running) back_off_.restart();
}

}  // namespace frontseat_driver::simulation
