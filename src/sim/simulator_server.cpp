#include "frontseat_driver/sim/simulator_server.h"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "frontseat_driver/link/tcp_server.h"

namespace frontseat_driver::sim {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr int kTicksAtOnce = 50;
constexpr std::chrono::milliseconds kShortestWait{1};
/// Further behind than this, in real time, the vehicle's time slips instead of catching up.
constexpr std::chrono::milliseconds kMostBehind{500};

}  // namespace

class SimulatorServer::Impl : public link::TcpServer::Handler, public Frontseat::Sink {
 public:
  Impl(std::unique_ptr<Frontseat> frontseat, const ServerConfig& config, OnTruth on_truth)
      : frontseat_(std::move(frontseat)),
        on_truth_(std::move(on_truth)),
        speed_(config.speed),
        server_(io_, config.bind, config.port, *this),
        port_(server_.port()),
        timer_(io_),
        reached_(frontseat_->now()) {}

  ~Impl() override { stop(); }

  void start() {
    if (thread_.joinable()) return;
    anchor(Steady::now());
    boost::asio::post(io_, [this] { live(); });
    thread_ = std::thread{[this] { io_.run(); }};
  }

  void stop() {
    if (!thread_.joinable()) return;
    boost::asio::post(io_, [this] {
      stopped_ = true;
      timer_.cancel();
      server_.close();
    });
    thread_.join();
  }

  std::uint16_t port() const { return port_; }

  void post(std::function<void(Frontseat&)> action) {
    boost::asio::post(io_, [this, action = std::move(action)] {
      if (!stopped_) action(*frontseat_);
    });
  }

  void onClientConnected(ClientId client, const std::string&) override {
    frontseat_->clientConnected(client, reached_);
    frontseat_->step(reached_, *this);
  }

  void onClientBytes(ClientId client, std::string_view bytes) override {
    const UtcTime now = std::max(reached_, std::min(vehicleTime(), reached_ + frontseat_->tick()));
    frontseat_->clientBytes(client, bytes, now);
    frontseat_->step(reached_, *this);
  }

  void onClientDisconnected(ClientId client) override { frontseat_->clientDisconnected(client); }

  void send(ClientId client, std::string_view bytes) override { server_.send(client, bytes); }
  void disconnect(ClientId client) override { server_.disconnect(client); }
  void navigation(const Truth& truth) override {
    if (on_truth_) on_truth_(truth);
  }

 private:
  void live() {
    if (stopped_) return;
    const UtcTime target = vehicleTime();
    reached_ = std::max(reached_, std::min(target, reached_ + kTicksAtOnce * frontseat_->tick()));
    frontseat_->step(reached_, *this);
    const double behind_s =
        std::chrono::duration<double>(vehicleTime() - reached_).count() / speed_;
    if (behind_s > std::chrono::duration<double>(kMostBehind).count()) anchor(Steady::now());
    const auto tick = std::chrono::duration_cast<nanoseconds>(frontseat_->tick() / speed_);
    timer_.expires_after(reached_ < target ? nanoseconds{0}
                                           : std::max<nanoseconds>(kShortestWait, tick));
    timer_.async_wait([this](const boost::system::error_code& error) {
      if (!error) live();
    });
  }

  void anchor(Steady::time_point now) {
    anchor_ = now;
    anchor_time_ = reached_;
  }

  UtcTime vehicleTime() const {
    const auto elapsed = std::chrono::duration<double, std::nano>(Steady::now() - anchor_) * speed_;
    return anchor_time_ + std::chrono::duration_cast<UtcTime>(elapsed);
  }

  boost::asio::io_context io_;
  std::unique_ptr<Frontseat> frontseat_;
  OnTruth on_truth_;
  double speed_;
  link::TcpServer server_;
  std::uint16_t port_;
  boost::asio::steady_timer timer_;
  UtcTime reached_;  ///< the vehicle has lived up to here
  Steady::time_point anchor_;
  UtcTime anchor_time_{};
  bool stopped_ = false;
  std::thread thread_;
};

SimulatorServer::SimulatorServer(std::unique_ptr<Frontseat> frontseat, const ServerConfig& config,
                                 OnTruth on_truth)
    : impl_(std::make_unique<Impl>(std::move(frontseat), config, std::move(on_truth))) {}

SimulatorServer::~SimulatorServer() = default;

void SimulatorServer::start() { impl_->start(); }

void SimulatorServer::stop() { impl_->stop(); }

std::uint16_t SimulatorServer::port() const { return impl_->port(); }

void SimulatorServer::post(std::function<void(Frontseat&)> action) {
  impl_->post(std::move(action));
}

}  // namespace frontseat_driver::sim
