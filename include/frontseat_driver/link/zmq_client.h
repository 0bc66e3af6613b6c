#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace frontseat_driver::link {

/// The three ZeroMQ connections to a Blueye drone, kept together: telemetry (SUB), requests (REQ)
/// and control (PUB). Connected means all three; when one is lost, or nothing is heard for
/// silence_timeout, all are closed and opened afresh, so that nothing old is ever delivered.
///
/// Every message has two frames, the name of its type and its bytes; neither is looked into here.
/// One thread calls everything but wake(). The only other thread is ZeroMQ's own, which moves
/// bytes.
class ZmqClient {
 public:
  using Clock = std::chrono::steady_clock;

  struct Options {
    /// An IPv4 or IPv6 address or a name. A name server that hangs holds up close().
    std::string host = "192.168.1.101";
    std::uint16_t telemetry_port = 5555;
    std::uint16_t request_port = 5556;
    std::uint16_t control_port = 5557;
    /// After so long without all three connections a failure is reported, and they are tried
    /// afresh.
    std::chrono::milliseconds connect_timeout{2000};
    /// Between attempts; doubles from `reconnect_min` to `reconnect_max`. After a loss nothing is
    /// opened again for `reconnect_min`.
    std::chrono::milliseconds reconnect_min{500};
    std::chrono::milliseconds reconnect_max{10000};
    /// Neither telemetry nor a reply for so long: the link is dead. The drone publishes its clock
    /// every second.
    std::chrono::milliseconds silence_timeout{5000};
  };

  /// Every call of the client but run() is allowed from inside these. Views hold during the call.
  /// Reasons are for people and begin with a small letter.
  class Handler {
   public:
    virtual ~Handler() = default;
    /// `endpoint` as "192.168.1.101:5555".
    virtual void onConnected(const std::string& endpoint) = 0;
    virtual void onTelemetry(std::string_view type, std::string_view payload) = 0;
    virtual void onReply(std::string_view type, std::string_view payload) = 0;
    /// The request under way will get no reply: too late, or not two frames.
    virtual void onNoReply(const std::string& reason) = 0;
    /// A telemetry message that has not two frames.
    virtual void onMalformed() = 0;
    virtual void onDisconnected(const std::string& reason) = 0;
    virtual void onConnectFailed(const std::string& reason) = 0;
  };

  /// Throws std::runtime_error when the system has no sockets left.
  ZmqClient(Options options, Handler& handler);

  /// As close() without last words, and without a handler call.
  ~ZmqClient();
  ZmqClient(const ZmqClient&) = delete;
  ZmqClient& operator=(const ZmqClient&) = delete;

  /// Begins connecting; returns at once.
  void start();

  /// Waits for `deadline`, for something to happen or for wake(), and tells the handler what
  /// happened. Returns soon even when messages keep coming.
  void run(Clock::time_point deadline);

  /// Ends the wait of run(), or of its next call. From any thread.
  void wake();

  /// Hands a control message to ZeroMQ; false without a connection, or when the drone takes
  /// nothing: then it is gone, since it would be late.
  bool publish(std::string_view type, std::string_view payload);

  /// Sends a request; the handler hears of its reply, or within `timeout` that there is none. False
  /// without a connection or while another request is under way.
  bool request(std::string_view type, std::string_view payload, std::chrono::milliseconds timeout);

  /// The drone was rebooted, or anything else after which these connections mean nothing: as if the
  /// link had been lost. The handler is told.
  void reconnect(const std::string& reason);

  /// Closes everything and connects no more; what was published or asked before gets up to 50 ms
  /// to leave.
  void close();

  bool connected() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace frontseat_driver::link
