#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace frontseat_driver::link {

/// A TCP connection that is kept: connects, reconnects with back-off, notices a silent peer.
///
/// Everything happens on the thread that runs the io_context, and every handler call comes from it.
/// No call waits, and neither does the destructor: a name look-up that hangs is left behind.
/// Delivers bytes, not lines.
class TcpClient {
 public:
  struct Options {
    std::string host = "localhost";  ///< a name, an IPv4 or an IPv6 address
    std::uint16_t port = 29500;
    std::chrono::milliseconds connect_timeout{2000};  ///< for all addresses of the name together
    std::chrono::milliseconds reconnect_min{500};
    std::chrono::milliseconds reconnect_max{10000};
    std::chrono::milliseconds silence_timeout{5000};  ///< no byte for so long: the link is dead
    std::uint64_t jitter_seed = 0;  ///< 0: from the system
  };

  class Handler {
   public:
    virtual ~Handler() = default;
    /// `endpoint` is the numeric address and port, "127.0.0.1:29500" or "[::1]:29500".
    virtual void onConnected(const std::string& endpoint) = 0;
    virtual void onBytes(std::string_view bytes) = 0;
    /// The connection ended: closed by the vehicle, silent, broken, or closed by close().
    virtual void onDisconnected(const std::string& reason) = 0;
    /// An attempt failed before there was a connection; the next one comes after `retry_in`.
    virtual void onConnectFailed(const std::string& reason, std::chrono::milliseconds retry_in) = 0;
  };

  TcpClient(boost::asio::io_context& io, Options options, Handler& handler);
  ~TcpClient();
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  /// Begins connecting; returns at once.
  void start();

  /// Ends the connection in order, after everything written has been handed to the kernel: the
  /// vehicle reads the last sentence, then the end. No handler call follows but onDisconnected,
  /// which comes from inside this call if there was a connection. Does not connect again.
  void close();

  /// Writes all of `bytes` with one system call. False when there is no connection or the kernel
  /// would not take them whole: then nothing was queued, and a part that did go out ends the
  /// connection (half a sentence must not be followed by another).
  bool write(std::string_view bytes);

  /// The peer talks sense: the back-off starts again at reconnect_min after the next loss. Until
  /// this is called, a connection that is made and lost again counts as one more failure.
  void confirm();

  bool connected() const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::link
