#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/link/tcp_server.h"

/// What the tests need of the loopback interface.
namespace frontseat_driver::link::testing {

using std::chrono::milliseconds;

/// Longer than anything takes; only a test that fails waits for it.
constexpr milliseconds kPatience{10000};

/// Runs the io_context until `condition` holds; false if it does not within kPatience.
bool runUntil(boost::asio::io_context& io, const std::function<bool()>& condition);

/// Waits for what another thread does.
bool waitUntil(const std::function<bool()>& condition);

std::size_t openFileDescriptors();
std::size_t threads();
bool hasIpv6();

/// A socket that closes itself.
class Socket {
 public:
  explicit Socket(int fd = -1) : fd_(fd) {}
  Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Socket();
  int fd() const { return fd_; }

  /// Ends the connection with a reset.
  void reset();

 private:
  int fd_;
};

/// A port of 127.0.0.1 that is kept for this test: nothing listens on it until somebody binds
/// there.
class ReservedPort {
 public:
  ReservedPort();
  std::uint16_t port() const { return port_; }

 private:
  Socket socket_;
  std::uint16_t port_ = 0;
};

/// A vehicle made of plain system calls, so that it can misbehave.
class RawVehicle {
 public:
  /// `receive_buffer` of 0 leaves it to the system.
  explicit RawVehicle(int receive_buffer = 0);
  std::uint16_t port() const { return port_; }

  /// Waits for a connection.
  Socket accept() const;

  /// Whether a connection waits to be accepted.
  bool called() const;

 private:
  Socket listener_;
  std::uint16_t port_ = 0;
};

/// A port whose queue of connections is full: a further one gets no answer.
class FullVehicle {
 public:
  explicit FullVehicle(const char* address = "127.0.0.1", std::uint16_t port = 0);
  std::uint16_t port() const { return port_; }

 private:
  Socket listener_;
  std::vector<Socket> waiting_;
  std::uint16_t port_ = 0;
};

/// All that can be read until the connection ends, and how it ended: 0 in order, or errno.
struct Received {
  std::string bytes;
  int error = 0;
};
Received readToEnd(const Socket& socket);

/// Keeps what a client reports.
struct ClientLog : TcpClient::Handler {
  void onConnected(const std::string& endpoint) override;
  void onBytes(std::string_view bytes) override;
  void onDisconnected(const std::string& reason) override;
  void onConnectFailed(const std::string& reason, milliseconds retry_in) override;

  std::vector<std::string> endpoints;
  std::string received;
  std::vector<std::string> losses;
  std::vector<std::string> failures;
  std::vector<milliseconds> retries;
  std::function<void()> on_connected = [] {};
  std::function<void()> on_bytes = [] {};
  std::function<void()> on_disconnected = [] {};
  std::function<void()> on_failed = [] {};
};

/// Keeps what a server reports.
struct ServerLog : TcpServer::Handler {
  void onClientConnected(TcpServer::ClientId client, const std::string& endpoint) override;
  void onClientBytes(TcpServer::ClientId client, std::string_view bytes) override;
  void onClientDisconnected(TcpServer::ClientId client) override;

  std::vector<TcpServer::ClientId> connected;
  std::vector<TcpServer::ClientId> disconnected;
  std::string received;
  std::function<void()> on_connected = [] {};
  std::function<void()> on_bytes = [] {};
};

/// Options that make a test quick.
TcpClient::Options quickOptions(const std::string& host, std::uint16_t port);

}  // namespace frontseat_driver::link::testing
