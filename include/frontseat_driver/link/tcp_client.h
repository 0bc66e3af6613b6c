#pragma once

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace frontseat_driver::link {

/// A TCP connection that is kept: connects, reconnects with back-off, notices a silent peer.
///
///   start() -> resolving -> connecting -> connected -> backing off -> resolving ...
///                  `------------+---- failed -----------^        close() ends it from anywhere
///
/// Everything happens on the thread that runs the io_context, and every handler call comes from it.
/// No call waits, and neither does the destructor: a name look-up that hangs is left behind.
/// Delivers bytes, not lines. The io_context must outlive the client.
class TcpClient {
 public:
  struct Options {
    /// A name, an IPv4 or an IPv6 address, the latter with or without brackets and scope.
    std::string host = "localhost";
    std::uint16_t port = 29500;
    /// For the look-up and all addresses of the name together. An address gets an equal share of
    /// the time that is left, so that one that never answers does not hide the next one.
    std::chrono::milliseconds connect_timeout{2000};
    /// The wait before the next attempt doubles from `reconnect_min` to `reconnect_max`; chance
    /// takes off up to half of it, but it is never shorter than `reconnect_min`.
    std::chrono::milliseconds reconnect_min{500};
    std::chrono::milliseconds reconnect_max{10000};
    /// No byte for so long: the link is dead. The same limit holds for data that the vehicle does
    /// not acknowledge or does not take (TCP_USER_TIMEOUT).
    std::chrono::milliseconds silence_timeout{5000};
    std::uint64_t jitter_seed = 0;  ///< 0: from the system
  };

  /// Every call of the client is allowed from inside these. Reasons are for people, and begin with
  /// a small letter: "connection refused", "no byte for 5.0 s".
  class Handler {
   public:
    virtual ~Handler() = default;
    /// `endpoint` is the numeric address and port, "127.0.0.1:29500" or "[::1]:29500".
    virtual void onConnected(const std::string& endpoint) = 0;
    /// At least one byte and at most 64 KiB; the view holds during the call.
    virtual void onBytes(std::string_view bytes) = 0;
    /// The connection ended: closed by the vehicle, silent, broken, or closed by close().
    virtual void onDisconnected(const std::string& reason) = 0;
    /// An attempt failed before there was a connection; the next one comes after `retry_in`.
    virtual void onConnectFailed(const std::string& reason, std::chrono::milliseconds retry_in) = 0;
  };

  TcpClient(boost::asio::io_context& io, Options options, Handler& handler);

  /// As close(), but without a handler call.
  ~TcpClient();
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  /// Begins connecting; returns at once. Only the first call has an effect.
  void start();

  /// Ends the connection in order, after everything written has been handed to the kernel: the
  /// vehicle reads the last sentence, then the end. No handler call follows but onDisconnected,
  /// which comes from inside this call if there was a connection. Does not connect again.
  ///
  /// Returns at once. For up to 50 ms more, as long as the io_context runs, what the vehicle sends
  /// is read and thrown away until it closes its side too; run() has nothing left to do after that.
  /// A vehicle that takes longer and still sends gets a reset then, which may cost it what it has
  /// not read yet on some systems (not on Linux).
  ///
  /// Whenever a connection ends in another way, it is reset: commands that the kernel still holds
  /// must not reach a vehicle that comes back later.
  void close();

  /// Writes all of `bytes`, a few sentences at most, with one system call. False when there is no
  /// connection or the kernel would not take them whole: then nothing was queued, and a part that
  /// did go out ends the connection (half a sentence must not be followed by another). The handler
  /// is not called from inside.
  bool write(std::string_view bytes);

  /// The peer talks sense: the back-off starts again at reconnect_min after the next loss. Until
  /// this is called, a connection that is made and lost again counts as one more failure.
  void confirm();

  /// Whether bytes can be written.
  bool connected() const;

  /// Bytes written that the vehicle's host has not acknowledged: more than a sentence or two means
  /// that the link holds them back.
  std::size_t unacknowledgedBytes() const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::link
