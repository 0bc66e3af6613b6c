#pragma once

#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace frontseat_driver::link {

/// Accepts any number of TCP clients. Everything happens on the thread that runs the io_context.
class TcpServer {
 public:
  using ClientId = std::uint64_t;  ///< never used twice

  class Handler {
   public:
    virtual ~Handler() = default;
    virtual void onClientConnected(ClientId client, const std::string& endpoint) = 0;
    virtual void onClientBytes(ClientId client, std::string_view bytes) = 0;
    virtual void onClientDisconnected(ClientId client) = 0;
  };

  /// Binds and listens at once; port 0 lets the system choose. Throws std::system_error (or
  /// boost::system::system_error) naming address and port when that fails.
  TcpServer(boost::asio::io_context& io, const std::string& address, std::uint16_t port,
            Handler& handler);
  ~TcpServer();
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  std::uint16_t port() const;

  /// Queues bytes for one client. A client that reads nothing is dropped at 1 MiB of backlog.
  void send(ClientId client, std::string_view bytes);

  /// Ends one client's connection in order.
  void disconnect(ClientId client);

  /// Ends one client's connection with a reset, as a vehicle that loses power does not even do.
  void reset(ClientId client);

  /// Ends all connections in order and stops listening.
  void close();

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::link
