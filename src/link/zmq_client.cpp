#include "frontseat_driver/link/zmq_client.h"

#include <sys/eventfd.h>
#include <unistd.h>
#include <zmq.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <zmq.hpp>

namespace frontseat_driver::link {

namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;
using Time = ZmqClient::Clock::time_point;

// A second of the busiest telemetry: more means that this process has stopped reading.
constexpr int kReceiveQueue = 2000;
// A drone that takes nothing must not find a queue of commands when it takes again.
constexpr int kSendQueue = 16;
constexpr int kSendBuffer = 2048;  // of the kernel, for the same reason
// No sonar image comes near it; a peer that announces more is none.
constexpr std::int64_t kMostBytes = 64 << 20;
constexpr int kLastWords_ms = 50;
// So that a flood of telemetry holds up neither time-outs nor commands.
constexpr int kMostAtOnce = 64;

enum Channel : std::size_t { kTelemetry, kRequest, kControl, kChannels };
constexpr std::array<int, kChannels> kSocketTypes{ZMQ_SUB, ZMQ_REQ, ZMQ_PUB};

template <class Value>
void setOption(zmq::socket_t& socket, int option, const Value& value) {
  if (zmq_setsockopt(static_cast<void*>(socket), option, &value, sizeof value) != 0) {
    throw zmq::error_t();
  }
}

/// One frame. Both ends of the years of cppzmq's receiving functions are avoided this way.
class Frame {
 public:
  Frame() { zmq_msg_init(&message_); }
  ~Frame() { zmq_msg_close(&message_); }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  /// False if there is none now.
  bool receive(zmq::socket_t& socket) {
    return zmq_msg_recv(&message_, static_cast<void*>(socket), ZMQ_DONTWAIT) >= 0;
  }
  bool more() const { return zmq_msg_more(&message_) != 0; }
  std::string_view bytes() {
    return {static_cast<const char*>(zmq_msg_data(&message_)), zmq_msg_size(&message_)};
  }

 private:
  zmq_msg_t message_;
};

enum class Received { Nothing, Message, Malformed };

/// One message of two frames; all frames of another are read and thrown away.
Received receive(zmq::socket_t& socket, Frame& type, Frame& payload) {
  if (!type.receive(socket)) return Received::Nothing;
  if (!type.more()) return Received::Malformed;
  payload.receive(socket);
  if (!payload.more()) return Received::Message;
  Frame rest;
  while (rest.receive(socket) && rest.more()) {
  }
  return Received::Malformed;
}

bool send(zmq::socket_t& socket, std::string_view type, std::string_view payload) {
  void* const raw = static_cast<void*>(socket);
  if (zmq_send(raw, type.data(), type.size(), ZMQ_DONTWAIT | ZMQ_SNDMORE) < 0) return false;
  return zmq_send(raw, payload.data(), payload.size(), ZMQ_DONTWAIT) >= 0;
}

std::string inSeconds(milliseconds duration) {
  const auto tenths = (duration.count() + 50) / 100;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " s";
}

/// For poll: rounded up, so that it is time when it returns.
long untilThen_ms(Time then) {
  const Time now = ZmqClient::Clock::now();
  if (then <= now) return 0;
  const auto left = std::chrono::ceil<milliseconds>(then - now);
  return static_cast<long>(std::min<std::int64_t>(left.count(), 60'000));
}

/// Ends a poll from another thread.
class Wake {
 public:
  Wake() : file_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (file_ < 0) throw std::runtime_error(std::string{"eventfd: "} + std::strerror(errno));
  }
  ~Wake() { ::close(file_); }
  Wake(const Wake&) = delete;
  Wake& operator=(const Wake&) = delete;

  int file() const { return file_; }
  void set() {
    const std::uint64_t once = 1;
    [[maybe_unused]] const auto written = write(file_, &once, sizeof once);
  }
  void clear() {
    std::uint64_t calls = 0;
    [[maybe_unused]] const auto size = read(file_, &calls, sizeof calls);
  }

 private:
  const int file_;
};

zmq::context_t newContext() {
  try {
    return zmq::context_t{1};
  } catch (const zmq::error_t& error) {
    throw std::runtime_error(std::string{"ZeroMQ: "} + error.what());
  }
}

/// A socket, and the one that tells whether it is connected.
struct Connection {
  Connection() = default;
  // Telling an event to a monitor that is gone would block ZeroMQ's own thread for good.
  ~Connection() { stopWatching(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void stopWatching() {
    if (static_cast<void*>(socket) != nullptr) {
      zmq_socket_monitor(static_cast<void*>(socket), nullptr, 0);
    }
    monitor.close();
  }

  zmq::socket_t socket;
  zmq::socket_t monitor;
  bool up = false;
};

}  // namespace

class ZmqClient::Impl {
 public:
  Impl(Options options, Handler& handler) : options_(std::move(options)), handler_(handler) {}

  ~Impl() { drop(0); }

  void start() { open(Clock::now()); }

  void run(Time deadline) {
    wait(std::min(deadline, nextDeadline()));
    for (std::size_t i = 0; i < kChannels && isOpen(); ++i) readMonitor(static_cast<Channel>(i));
    if (isOpen()) readReply();
    for (int i = 0; i < kMostAtOnce && isOpen() && readTelemetry(); ++i) {
    }
    checkTime(Clock::now());
  }

  void wake() { wake_.set(); }

  bool publish(std::string_view type, std::string_view payload) {
    return connected_ && send((*connections_)[kControl].socket, type, payload);
  }

  bool request(std::string_view type, std::string_view payload, milliseconds timeout) {
    if (!connected_ || reply_due_ != Time::max()) return false;
    if (!send((*connections_)[kRequest].socket, type, payload)) return false;
    reply_due_ = Clock::now() + timeout;
    request_timeout_ = timeout;
    return true;
  }

  void reconnect(const std::string& reason) {
    if (!isOpen()) return;
    lose(reason);
  }

  void close() {
    closed_ = true;
    const bool was_connected = connected_;
    drop(kLastWords_ms);
    if (was_connected) handler_.onDisconnected("closed");
  }

  bool connected() const { return connected_; }

 private:
  bool isOpen() const { return connections_ != nullptr; }

  std::string endpoint(Channel channel) const {
    const std::array<std::uint16_t, kChannels> ports{options_.telemetry_port, options_.request_port,
                                                     options_.control_port};
    const bool bare_ipv6 =
        options_.host.find(':') != std::string::npos && options_.host.front() != '[';
    const std::string host = bare_ipv6 ? "[" + options_.host + "]" : options_.host;
    return host + ":" + std::to_string(ports[channel]);
  }

  void open(Time now) {
    if (closed_) return;
    reopen_at_ = Time::max();
    connect_due_ = now + options_.connect_timeout;
    connections_ = std::make_unique<std::array<Connection, kChannels>>();
    std::string failure;
    for (std::size_t i = 0; i < kChannels && failure.empty(); ++i) {
      failure = tryToConnect(static_cast<Channel>(i));
    }
    if (failure.empty()) return;
    lose("");
    handler_.onConnectFailed(failure);
  }

  /// What went wrong; empty if nothing did: a host that is none, or no files left, is no reason
  /// to give up for good.
  std::string tryToConnect(Channel channel) {
    try {
      connect(channel);
      return {};
    } catch (const zmq::error_t& error) {
      return "cannot open a connection to " + endpoint(channel) + ": " + error.what();
    }
  }

  void connect(Channel channel) {
    Connection& connection = (*connections_)[channel];
    connection.up = false;
    connection.stopWatching();
    connection.socket = zmq::socket_t(context_, kSocketTypes[channel]);
    zmq::socket_t& socket = connection.socket;
    setOption(socket, ZMQ_LINGER, 0);
    // Control that waits dies with the connection; a request waits for it as long as for its reply.
    setOption(socket, ZMQ_IMMEDIATE, channel == kRequest ? 0 : 1);
    setOption(socket, ZMQ_IPV6, options_.host.find(':') != std::string::npos ? 1 : 0);
    setOption(socket, ZMQ_RCVHWM, kReceiveQueue);
    setOption(socket, ZMQ_SNDHWM, kSendQueue);
    setOption(socket, ZMQ_MAXMSGSIZE, kMostBytes);
    // A peer that accepts and then says nothing would be waited for half a minute.
    setOption(socket, ZMQ_HANDSHAKE_IVL, static_cast<int>(options_.connect_timeout.count()));
    setOption(socket, ZMQ_RECONNECT_IVL, static_cast<int>(options_.reconnect_min.count()));
    setOption(socket, ZMQ_RECONNECT_IVL_MAX, static_cast<int>(options_.reconnect_max.count()));
    setOption(socket, ZMQ_TCP_MAXRT, static_cast<int>(options_.silence_timeout.count()));
    if (channel == kTelemetry) {
      zmq_setsockopt(static_cast<void*>(socket), ZMQ_SUBSCRIBE, "", 0);
    } else if (channel == kControl) {
      setOption(socket, ZMQ_XPUB_NODROP, 1);  // else a full queue would look like success
      setOption(socket, ZMQ_SNDBUF, kSendBuffer);
    }
    watch(connection);
    socket.connect(("tcp://" + endpoint(channel)).c_str());
  }

  void watch(Connection& connection) {
    const std::string address = "inproc://monitor-" + std::to_string(next_monitor_++);
    if (zmq_socket_monitor(static_cast<void*>(connection.socket), address.c_str(),
                           ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED) != 0) {
      throw zmq::error_t();
    }
    connection.monitor = zmq::socket_t(context_, ZMQ_PAIR);
    setOption(connection.monitor, ZMQ_LINGER, 0);
    connection.monitor.connect(address.c_str());
  }

  void drop(int linger_ms) {
    for (const Channel channel : {kRequest, kControl}) {
      // Nothing to set where the socket could not be opened.
      if (!connections_ || static_cast<void*>((*connections_)[channel].socket) == nullptr) continue;
      setOption((*connections_)[channel].socket, ZMQ_LINGER, linger_ms);
    }
    connections_.reset();
    connected_ = false;
    reply_due_ = connect_due_ = silent_at_ = reopen_at_ = Time::max();
  }

  void lose(const std::string& reason) {
    const bool was_connected = connected_;
    drop(0);
    if (!closed_) reopen_at_ = Clock::now() + options_.reconnect_min;
    if (was_connected) handler_.onDisconnected(reason);
  }

  // Everything that can happen.

  void wait(Time deadline) {
    std::array<zmq_pollitem_t, 1 + kChannels + 2> items{};
    std::size_t count = 0;
    items[count++] = {nullptr, wake_.file(), ZMQ_POLLIN, 0};
    if (isOpen()) {
      for (Connection& connection : *connections_) {
        // cppcheck-suppress containerOutOfBounds // it takes kChannels for 0
        items[count++] = {static_cast<void*>(connection.monitor), 0, ZMQ_POLLIN, 0};
      }
      for (const Channel channel : {kTelemetry, kRequest}) {
        items[count++] = {static_cast<void*>((*connections_)[channel].socket), 0, ZMQ_POLLIN, 0};
      }
    }
    zmq_poll(items.data(), static_cast<int>(count), untilThen_ms(deadline));
    if ((items[0].revents & ZMQ_POLLIN) != 0) wake_.clear();
  }

  void readMonitor(Channel channel) {
    Connection& connection = (*connections_)[channel];
    Frame event;
    Frame address;
    while (receive(connection.monitor, event, address) == Received::Message) {
      std::uint16_t number = 0;
      if (event.bytes().size() < sizeof number) continue;
      std::memcpy(&number, event.bytes().data(), sizeof number);
      if (number == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
        connection.up = true;
      } else if (connection.up) {
        return lose("the drone closed the connection");
      }
    }
    noteConnected();
  }

  void noteConnected() {
    if (connected_) return;
    for (const Connection& connection : *connections_) {
      if (!connection.up) return;
    }
    connected_ = true;
    connect_due_ = Time::max();
    heard();
    handler_.onConnected(endpoint(kTelemetry));
  }

  void heard() { silent_at_ = Clock::now() + options_.silence_timeout; }

  bool readTelemetry() {
    Frame type;
    Frame payload;
    const Received received = receive((*connections_)[kTelemetry].socket, type, payload);
    if (received == Received::Nothing) return false;
    heard();
    if (!connected_) return true;  // the other connections are still on their way
    if (received == Received::Malformed) {
      handler_.onMalformed();
    } else {
      handler_.onTelemetry(type.bytes(), payload.bytes());
    }
    return true;
  }

  void readReply() {
    Frame type;
    Frame payload;
    const Received received = receive((*connections_)[kRequest].socket, type, payload);
    if (received == Received::Nothing) return;
    heard();
    reply_due_ = Time::max();
    if (received == Received::Malformed) {
      handler_.onNoReply("the reply had not two frames");
    } else {
      handler_.onReply(type.bytes(), payload.bytes());
    }
  }

  // A REQ socket without its reply cannot send again, and a late reply must not be the next one's.
  std::string replaceRequestSocket() {
    reply_due_ = Time::max();
    std::string failure = tryToConnect(kRequest);
    (*connections_)[kRequest].up = true;  // as good as the last one; a failure shows as silence
    return failure;
  }

  Time nextDeadline() const { return std::min({reply_due_, connect_due_, silent_at_, reopen_at_}); }

  void checkTime(Time now) {
    if (now >= reply_due_) {
      const std::string failure = replaceRequestSocket();
      handler_.onNoReply("no reply within " + inSeconds(request_timeout_));
      if (!failure.empty()) lose(failure);
    }
    if (now >= silent_at_) lose("nothing heard for " + inSeconds(options_.silence_timeout));
    if (now >= connect_due_) {
      const std::string where = endpoint(missing());
      lose("");
      handler_.onConnectFailed("no answer at " + where + " within " +
                               inSeconds(options_.connect_timeout));
    }
    if (now >= reopen_at_) open(now);
  }

  /// The first that is not up; called while one is not.
  Channel missing() const {
    std::size_t i = 0;
    while (i + 1 < kChannels && (*connections_)[i].up) ++i;
    return static_cast<Channel>(i);
  }

  const Options options_;
  Handler& handler_;
  Wake wake_;
  zmq::context_t context_ = newContext();
  std::unique_ptr<std::array<Connection, kChannels>> connections_;
  std::uint64_t next_monitor_ = 0;
  bool connected_ = false;
  bool closed_ = false;
  milliseconds request_timeout_{};
  // Time::max(): nothing of the kind is expected.
  Time reply_due_ = Time::max();
  Time connect_due_ = Time::max();
  Time silent_at_ = Time::max();
  Time reopen_at_ = Time::max();
};

ZmqClient::ZmqClient(Options options, Handler& handler)
    : impl_(std::make_unique<Impl>(std::move(options), handler)) {}

ZmqClient::~ZmqClient() = default;

void ZmqClient::start() { impl_->start(); }

void ZmqClient::run(Clock::time_point deadline) { impl_->run(deadline); }

void ZmqClient::wake() { impl_->wake(); }

bool ZmqClient::publish(std::string_view type, std::string_view payload) {
  return impl_->publish(type, payload);
}

bool ZmqClient::request(std::string_view type, std::string_view payload,
                        std::chrono::milliseconds timeout) {
  return impl_->request(type, payload, timeout);
}

void ZmqClient::reconnect(const std::string& reason) { impl_->reconnect(reason); }

void ZmqClient::close() { impl_->close(); }

bool ZmqClient::connected() const { return impl_->connected(); }

}  // namespace frontseat_driver::link
