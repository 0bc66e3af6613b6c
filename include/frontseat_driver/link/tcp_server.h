#pragma once

#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace frontseat_driver::link {

/// Accepts any number of TCP clients. Everything happens on the thread that runs the io_context,
/// which must outlive the server.
class TcpServer {
 public:
  using ClientId = std::uint64_t;  ///< never used twice

  /// Every call of the server is allowed from inside these. No call follows close() or the end of
  /// the server.
  class Handler {
   public:
    virtual ~Handler() = default;
    /// `endpoint` is the numeric address and port of the client, "127.0.0.1:41234".
    virtual void onClientConnected(ClientId client, const std::string& endpoint) = 0;
    virtual void onClientBytes(ClientId client, std::string_view bytes) = 0;
    /// Comes once for each client, whoever ended the connection; never from inside a call.
    virtual void onClientDisconnected(ClientId client) = 0;
  };

  /// Binds to a numeric address and listens at once; port 0 lets the system choose. Throws
  /// boost::system::system_error naming address and port when that fails.
  TcpServer(boost::asio::io_context& io, const std::string& address, std::uint16_t port,
            Handler& handler);

  /// As close().
  ~TcpServer();
  TcpServer(const TcpServer&) = delete;
  TcpServer& operator=(const TcpServer&) = delete;

  std::uint16_t port() const;

  /// Queues bytes for one client; nothing happens if it is gone. A client that reads nothing is
  /// dropped at 1 MiB of backlog.
  void send(ClientId client, std::string_view bytes);

  /// Ends one client's connection in order: it reads what was queued, then the end. A client that
  /// has not closed its side within 250 ms is not waited for.
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
