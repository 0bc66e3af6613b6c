#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <string>
#include <thread>

namespace frontseat_driver::sim {

/// What clients ask the drone's web server for before anything else, `GET /diagnostics/drone_info`,
/// and the lists of its logs, `/logs` and `/logcsv`, which are empty.
class BlueyeHttpServer {
 public:
  /// Listens and serves on a thread of its own; throws boost::system::system_error.
  BlueyeHttpServer(const std::string& bind, std::uint16_t port, std::string drone_info);
  ~BlueyeHttpServer();
  BlueyeHttpServer(const BlueyeHttpServer&) = delete;
  BlueyeHttpServer& operator=(const BlueyeHttpServer&) = delete;

  std::uint16_t port() const { return port_; }
  /// While false, connections are closed as they come.
  void setOnline(bool online) { online_ = online; }

 private:
  void accept();

  const std::string drone_info_;
  std::atomic<bool> online_{true};
  boost::asio::io_context io_{1};
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  std::uint16_t port_;
  std::thread thread_;
};

}  // namespace frontseat_driver::sim
