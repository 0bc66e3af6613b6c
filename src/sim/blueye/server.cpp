#include "frontseat_driver/sim/blueye/server.h"

#include <zmq.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>
#include <zmq.hpp>

#include "http_server.h"

namespace frontseat_driver::sim {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr int kTicksAtOnce = 50;
/// Further behind than this, in real time, the drone's time slips instead of catching up.
constexpr std::chrono::milliseconds kMostBehind{500};
/// A peer that sends more in one frame is cut off.
constexpr std::int64_t kMostBytes = 4 << 20;
constexpr int kMostAtOnce = 256;
constexpr std::chrono::milliseconds kRebindPause{50};

/// The frames of one message.
using Frames = std::vector<std::string>;

/// A bound socket of the drone. Only functions that all years of ZeroMQ have.
class Socket {
 public:
  Socket(zmq::context_t& context, int type, const std::string& bind, std::uint16_t port)
      : socket_(context, type) {
    set<int>(ZMQ_LINGER, 0);
    set<std::int64_t>(ZMQ_MAXMSGSIZE, kMostBytes);
    const bool ipv6 = bind.find(':') != std::string::npos;
    set<int>(ZMQ_IPV6, ipv6 ? 1 : 0);
    if (type == ZMQ_SUB) zmq_setsockopt(raw(), ZMQ_SUBSCRIBE, "", 0);
    const std::string endpoint = "tcp://" + (ipv6 ? "[" + bind + "]" : bind) + ":" +
                                 (port == 0 ? std::string{"*"} : std::to_string(port));
    if (zmq_bind(raw(), endpoint.c_str()) != 0) {
      throw std::runtime_error{"cannot listen on " + endpoint + ": " + zmq_strerror(zmq_errno())};
    }
    std::array<char, 256> bound{};
    std::size_t size = bound.size();
    zmq_getsockopt(raw(), ZMQ_LAST_ENDPOINT, bound.data(), &size);
    const std::string name{bound.data()};
    port_ = static_cast<std::uint16_t>(std::stoi(name.substr(name.rfind(':') + 1)));
  }

  std::uint16_t port() const { return port_; }
  void* raw() { return static_cast<void*>(socket_); }

  /// The next message, if one is here.
  std::optional<Frames> receive() {
    Frames frames;
    for (;;) {
      zmq_msg_t part;
      zmq_msg_init(&part);
      if (zmq_msg_recv(&part, raw(), ZMQ_DONTWAIT) < 0) {
        zmq_msg_close(&part);
        return std::nullopt;
      }
      frames.emplace_back(static_cast<const char*>(zmq_msg_data(&part)), zmq_msg_size(&part));
      const bool more = zmq_msg_more(&part) != 0;
      zmq_msg_close(&part);
      if (!more) return frames;
    }
  }

  /// Sends or, if the peer is gone or takes nothing, forgets.
  void send(std::initializer_list<std::string_view> frames) {
    std::size_t left = frames.size();
    for (const std::string_view frame : frames) {
      const int more = --left > 0 ? ZMQ_SNDMORE : 0;
      if (zmq_send(raw(), frame.data(), frame.size(), ZMQ_DONTWAIT | more) < 0) return;
    }
  }

 private:
  template <class Value>
  void set(int option, Value value) {
    zmq_setsockopt(raw(), option, &value, sizeof value);
  }

  zmq::socket_t socket_;
  std::uint16_t port_ = 0;
};

/// All three. The one for requests is a ROUTER, which on the wire is a REP that may forget a reply.
struct Sockets {
  Sockets(zmq::context_t& context, const BlueyeServerConfig& config)
      : telemetry(context, ZMQ_PUB, config.bind, config.telemetry_port),
        requests(context, ZMQ_ROUTER, config.bind, config.request_port),
        controls(context, ZMQ_SUB, config.bind, config.control_port) {}

  Socket telemetry;
  Socket requests;
  Socket controls;
};

}  // namespace

class BlueyeServer::Impl : public BlueyeDrone::Sink {
 public:
  Impl(const BlueyeConfig& drone, const BlueyeServerConfig& config, OnTruth on_truth)
      : config_(config),
        drone_(drone),
        on_truth_(std::move(on_truth)),
        sockets_(std::in_place, *context_, config_),
        reached_(drone_.now()) {
    // After a reboot the same ports must be found again.
    config_.telemetry_port = sockets_->telemetry.port();
    config_.request_port = sockets_->requests.port();
    config_.control_port = sockets_->controls.port();
    if (!config_.http) return;
    try {
      http_.emplace(config_.bind, config_.http_port, BlueyeDrone::droneInfo(drone));
    } catch (const std::exception& error) {
      http_problem_ = "cannot serve HTTP on " + config_.bind + ":" +
                      std::to_string(config_.http_port) + ": " + error.what();
      if (!config_.http_optional) throw std::runtime_error{http_problem_};
    }
  }

  ~Impl() override { stop(); }

  void start() {
    if (thread_.joinable()) return;
    thread_ = std::thread{[this] { live(); }};
  }

  void stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    thread_.join();
    sockets_.reset();
    context_.reset();  // waits until the ports are free
    http_.reset();
  }

  const BlueyeServerConfig& config() const { return config_; }
  std::uint16_t httpPort() const { return http_ ? http_->port() : std::uint16_t{0}; }
  const std::string& httpProblem() const { return http_problem_; }
  std::uint64_t malformed() const { return malformed_; }

  void post(std::function<void(BlueyeDrone&)> action) {
    const std::lock_guard<std::mutex> lock{mutex_};
    actions_.push_back(std::move(action));
  }

  void publish(const std::string& name, std::string data) override {
    if (sockets_) sockets_->telemetry.send({name, data});
  }
  void reply(const std::string& peer, const std::string& name, std::string data) override {
    if (sockets_) sockets_->requests.send({peer, "", name, data});
  }
  void truth(const Truth& truth) override {
    if (on_truth_) on_truth_(truth);
  }

 private:
  void live() {
    anchor();
    while (!stopping_) {
      act();
      advance();
      followPower();
      if (sockets_) serve();
      rest();
    }
  }

  void act() {
    std::deque<std::function<void(BlueyeDrone&)>> actions;
    {
      const std::lock_guard<std::mutex> lock{mutex_};
      actions.swap(actions_);
    }
    for (const auto& action : actions) action(drone_);
  }

  void advance() {
    const UtcTime target = droneTime();
    reached_ = std::max(reached_, std::min(target, reached_ + kTicksAtOnce * BlueyeDrone::kTick));
    drone_.step(reached_, *this);
    const auto behind = std::chrono::duration<double>(droneTime() - reached_) / config_.speed;
    if (behind > kMostBehind) anchor();
  }

  /// A drone that reboots is not there at all, and then is on the same ports again.
  void followPower() {
    if (http_) http_->setOnline(drone_.online());
    if (!drone_.online()) {
      sockets_.reset();
      return;
    }
    if (sockets_ || Steady::now() < next_bind_) return;
    try {
      sockets_.emplace(*context_, config_);
    } catch (const std::exception&) {
      // The old sockets are still being closed, or no file can be opened.
      next_bind_ = Steady::now() + kRebindPause;
    }
  }

  void serve() {
    for (int i = 0; i < kMostAtOnce; ++i) {
      const auto frames = sockets_->controls.receive();
      if (!frames) break;
      if (frames->size() == 2) {
        drone_.control((*frames)[0], (*frames)[1]);
      } else {
        ++malformed_;
      }
    }
    for (int i = 0; i < kMostAtOnce; ++i) {
      const auto frames = sockets_->requests.receive();
      if (!frames) break;
      takeRequest(*frames);
    }
    drone_.step(reached_, *this);  // hands on the answers
  }

  /// Peer, an empty frame, name, message. Whoever asks in another way is told nothing useful, but
  /// told: a REQ socket without an answer is stuck.
  void takeRequest(const Frames& frames) {
    if (frames.size() < 2 || !frames[1].empty()) {
      ++malformed_;
      return;
    }
    if (frames.size() == 4) {
      drone_.request(frames[0], frames[2], frames[3]);
      return;
    }
    ++malformed_;
    drone_.request(frames[0], "", "");
  }

  void rest() {
    const auto tick = std::chrono::duration<double>(BlueyeDrone::kTick) / config_.speed;
    const long wait_ms = std::clamp<long>(
        std::chrono::duration_cast<std::chrono::milliseconds>(tick).count(), 1, 10);
    if (droneTime() - reached_ > BlueyeDrone::kTick) return;
    if (!sockets_) {
      zmq_poll(nullptr, 0, wait_ms);
      return;
    }
    zmq_pollitem_t items[] = {{sockets_->controls.raw(), 0, ZMQ_POLLIN, 0},
                              {sockets_->requests.raw(), 0, ZMQ_POLLIN, 0}};
    zmq_poll(items, 2, wait_ms);
  }

  void anchor() {
    anchor_ = Steady::now();
    anchor_time_ = reached_;
  }

  UtcTime droneTime() const {
    const auto elapsed =
        std::chrono::duration<double, std::nano>(Steady::now() - anchor_) * config_.speed;
    return anchor_time_ + std::chrono::duration_cast<UtcTime>(elapsed);
  }

  BlueyeServerConfig config_;
  BlueyeDrone drone_;
  OnTruth on_truth_;
  std::optional<zmq::context_t> context_{std::in_place, 1};
  std::optional<Sockets> sockets_;
  std::optional<BlueyeHttpServer> http_;
  std::string http_problem_;
  UtcTime reached_;  ///< the drone has lived up to here
  Steady::time_point anchor_;
  UtcTime anchor_time_{};
  Steady::time_point next_bind_;
  std::atomic<std::uint64_t> malformed_{0};
  std::atomic<bool> stopping_{false};
  std::mutex mutex_;
  std::deque<std::function<void(BlueyeDrone&)>> actions_;
  std::thread thread_;
};

BlueyeServer::BlueyeServer(const BlueyeConfig& drone, const BlueyeServerConfig& config,
                           OnTruth on_truth)
    : impl_(std::make_unique<Impl>(drone, config, std::move(on_truth))) {}

BlueyeServer::~BlueyeServer() = default;

void BlueyeServer::start() { impl_->start(); }
void BlueyeServer::stop() { impl_->stop(); }
std::uint16_t BlueyeServer::telemetryPort() const { return impl_->config().telemetry_port; }
std::uint16_t BlueyeServer::requestPort() const { return impl_->config().request_port; }
std::uint16_t BlueyeServer::controlPort() const { return impl_->config().control_port; }
std::uint16_t BlueyeServer::httpPort() const { return impl_->httpPort(); }
std::string BlueyeServer::httpProblem() const { return impl_->httpProblem(); }
std::uint64_t BlueyeServer::malformed() const { return impl_->malformed(); }

void BlueyeServer::post(std::function<void(BlueyeDrone&)> action) {
  impl_->post(std::move(action));
}

}  // namespace frontseat_driver::sim
