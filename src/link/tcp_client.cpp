#include "frontseat_driver/link/tcp_client.h"

#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "back_off.h"
#include "endpoint.h"
#include "name_lookup.h"
#include "orderly_close.h"

namespace frontseat_driver::link {

using boost::asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

namespace {

/// At most in one go, so that a vehicle that floods leaves time for timers and posted tasks: an
/// abort waits for some 200 sentences.
constexpr std::size_t kReadSize = 16384;
/// From a connection that is about to be ended; the vehicle may flood.
constexpr int kLastReads = 4;
/// Commands that the vehicle does not take must not pile up in the kernel: some dozen sentences.
constexpr int kSendBuffer = 16384;
constexpr milliseconds kCloseLimit{50};

/// For the options of TCP that Asio does not know. One that cannot be set does not matter.
void setTcpOption(tcp::socket& socket, int name, int value) {
  setsockopt(socket.native_handle(), IPPROTO_TCP, name, &value, sizeof value);
}

std::string seconds(milliseconds duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%lld.%lld s", static_cast<long long>(duration.count() / 1000),
                static_cast<long long>(duration.count() % 1000 / 100));
  return text;
}

}  // namespace

class TcpClient::Impl : public std::enable_shared_from_this<Impl> {
 public:
  Impl(boost::asio::io_context& io, Options options, Handler& handler)
      : io_(io),
        options_(std::move(options)),
        handler_(handler),
        back_off_(options_.reconnect_min, options_.reconnect_max, options_.jitter_seed),
        socket_(io),
        timer_(io) {}

  void start() {
    if (state_ != State::Idle) return;
    enter(State::BackingOff);
    timeOutAt(Clock::now(), &Impl::attempt);
  }

  /// True if that ended a connection.
  bool close() {
    const bool had_connection = state_ == State::Connected;
    enter(State::Closed);
    timer_.cancel();
    lookup_.reset();
    if (had_connection && broken_.empty()) {
      closeInOrder(std::move(socket_), {}, kCloseLimit);
    } else {
      closeWithReset(socket_);
    }
    return had_connection;
  }

  void tellClosed() { handler_.onDisconnected("closed by the backseat"); }

  bool write(std::string_view bytes) {
    if (!connected()) return false;
    sent_ = true;
    error_code error;
    const std::size_t written =
        socket_.write_some(boost::asio::buffer(bytes.data(), bytes.size()), error);
    if (written == bytes.size()) return true;
    const bool refused_whole = written == 0 && error == boost::asio::error::would_block;
    if (!refused_whole) breakLater(error ? toText(error) : "a sentence could be sent only in part");
    return false;
  }

  void confirm() { back_off_.restart(); }

  std::size_t unacknowledgedBytes() {
    int bytes = 0;
    const bool known = connected() && ioctl(socket_.native_handle(), SIOCOUTQ, &bytes) == 0;
    return known && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
  }

  bool connected() const { return state_ == State::Connected && broken_.empty(); }

 private:
  enum class State { Idle, Resolving, Connecting, Connected, BackingOff, Closed };
  using Step = void (Impl::*)(const error_code&);

  /// Everything that was begun in the state before is void from here on.
  void enter(State state) {
    state_ = state;
    ++epoch_;
  }

  /// A completion handler that does nothing once the state that it was made in has been left.
  template <class... Result>
  auto then(void (Impl::*step)(const error_code&, Result...)) {
    return [self = shared_from_this(), epoch = epoch_, step](const error_code& error,
                                                             Result... result) {
      if (epoch == self->epoch_) ((*self).*step)(error, result...);
    };
  }

  void timeOutAt(Clock::time_point when, Step step) {
    timer_.expires_at(when);
    timer_.async_wait(then(step));
  }

  void attempt(const error_code&) {
    enter(State::Resolving);
    attempt_ends_ = Clock::now() + options_.connect_timeout;
    if (const auto endpoint = numericEndpoint(options_.host, options_.port)) {
      return connectTo({*endpoint});
    }
    if (!late_result_.empty()) return connectTo(std::exchange(late_result_, {}));
    timeOutAt(attempt_ends_, &Impl::noAnswer);
    // One that the attempt before has left unfinished serves this one.
    if (!lookup_) beginLookup();
  }

  void beginLookup() {
    lookup_ = std::make_unique<NameLookup>(io_, options_.host, options_.port,
                                           [this](auto result) { lookedUp(std::move(result)); });
  }

  void lookedUp(NameLookup::Result result) {
    lookup_.reset();
    if (state_ != State::Resolving) {
      late_result_ = std::move(result.endpoints);
    } else if (result.endpoints.empty()) {
      fail(result.failure);
    } else {
      connectTo(std::move(result.endpoints));
    }
  }

  void connectTo(std::vector<tcp::endpoint> endpoints) {
    endpoints_ = std::move(endpoints);
    next_endpoint_ = 0;
    connectNext();
  }

  void connectNext() {
    if (next_endpoint_ == endpoints_.size()) return fail(std::exchange(failure_, {}));
    enter(State::Connecting);
    const auto share = (attempt_ends_ - Clock::now()) /
                       static_cast<Clock::rep>(endpoints_.size() - next_endpoint_);
    const tcp::endpoint& endpoint = endpoints_[next_endpoint_++];
    error_code error;
    socket_.close(error);
    socket_.open(endpoint.protocol(), error);
    if (error) return tryNext(toText(error));
    setOptions();
    timeOutAt(Clock::now() + share, &Impl::noConnection);
    socket_.async_connect(endpoint, then(&Impl::connectDone));
  }

  void tryNext(std::string failure) {
    failure_ = std::move(failure);
    connectNext();
  }

  void setOptions() {
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.set_option(tcp::socket::keep_alive(true), ignored);
    socket_.set_option(tcp::socket::send_buffer_size(kSendBuffer), ignored);
  }

  std::string noAnswerText() const {
    return "no answer from host " + options_.host + " within " + seconds(options_.connect_timeout);
  }

  void noAnswer(const error_code&) {
    fail("host name '" + options_.host + "' could not be looked up within " +
         seconds(options_.connect_timeout));
  }

  void noConnection(const error_code&) { tryNext(noAnswerText()); }

  void connectDone(const error_code& error) {
    if (error == boost::asio::error::timed_out) return tryNext(noAnswerText());
    if (error) return tryNext(toText(error));
    error_code local_error;
    error_code remote_error;
    const tcp::endpoint remote = socket_.remote_endpoint(remote_error);
    // A port of this host that nobody listens on may be given to the connecting socket itself, and
    // TCP then connects it to itself.
    const bool to_itself = socket_.local_endpoint(local_error) == remote;
    if (local_error || remote_error || to_itself) return tryNext("connection refused");
    connectedTo(remote);
  }

  void connectedTo(const tcp::endpoint& endpoint) {
    enter(State::Connected);
    broken_.clear();
    failure_.clear();
    error_code ignored;
    socket_.non_blocking(true, ignored);
    const auto silence_ms = static_cast<int>(options_.silence_timeout.count());
    setTcpOption(socket_, TCP_USER_TIMEOUT, silence_ms);
    sent_ = true;
    last_byte_ = Clock::now();
    timeOutAt(last_byte_ + options_.silence_timeout, &Impl::checkSilence);
    waitForBytes();
    handler_.onConnected(toText(endpoint));
  }

  void waitForBytes() {
    // Without it, a vehicle with Nagle's algorithm on that sends a bundle in two writes waits 40 ms
    // for our acknowledgement when we send in between. The kernel forgets it when we send.
    if (std::exchange(sent_, false)) setTcpOption(socket_, TCP_QUICKACK, 1);
    // Not async_wait(), which goes through epoll_ctl() and one more epoll_wait().
    socket_.async_receive(boost::asio::buffer(buffer_), then(&Impl::received));
  }

  void received(const error_code& error, std::size_t size) {
    if (error) return lose(toText(error));
    if (handOn(size) && broken_.empty()) waitForBytes();
  }

  /// False if the connection was lost or closed on the way.
  bool handOn(std::size_t size) {
    const auto epoch = epoch_;
    last_byte_ = Clock::now();
    handler_.onBytes({buffer_.data(), size});
    return epoch == epoch_;
  }

  /// The timer is not moved at every read; it moves on when it expires.
  void checkSilence(const error_code&) {
    error_code ignored;
    // Bytes may have waited while this process did not run; they are read next.
    if (socket_.available(ignored) > 0) last_byte_ = Clock::now();
    const auto silent_at = last_byte_ + options_.silence_timeout;
    if (Clock::now() >= silent_at) return lose("no byte for " + seconds(options_.silence_timeout));
    timeOutAt(silent_at, &Impl::checkSilence);
  }

  /// Ends the connection, but not from inside the caller's call.
  void breakLater(std::string reason) {
    broken_ = std::move(reason);
    boost::asio::post(io_, [step = then(&Impl::endBroken)] { step(error_code{}); });
  }

  /// The vehicle's last words may have come before the end.
  void endBroken(const error_code&) {
    for (int i = 0; i < kLastReads; ++i) {
      error_code error;
      const std::size_t size = socket_.read_some(boost::asio::buffer(buffer_), error);
      if (error == boost::asio::error::would_block) break;
      if (error) return lose(toText(error));
      if (!handOn(size)) return;
    }
    lose(broken_);
  }

  void lose(const std::string& reason) {
    retryIn(back_off_.next());
    handler_.onDisconnected(reason);
  }

  void fail(const std::string& reason) {
    const milliseconds delay = back_off_.next();
    retryIn(delay);
    handler_.onConnectFailed(reason, delay);
  }

  void retryIn(milliseconds delay) {
    enter(State::BackingOff);
    closeWithReset(socket_);
    timeOutAt(Clock::now() + delay, &Impl::attempt);
  }

  boost::asio::io_context& io_;
  const Options options_;
  Handler& handler_;
  BackOff back_off_;
  State state_ = State::Idle;
  std::uint64_t epoch_ = 0;
  tcp::socket socket_;
  boost::asio::steady_timer timer_;
  std::unique_ptr<NameLookup> lookup_;
  std::vector<tcp::endpoint> late_result_;  ///< came after its attempt had timed out
  std::vector<tcp::endpoint> endpoints_;
  std::size_t next_endpoint_ = 0;
  std::string failure_;  ///< of the endpoint tried last
  Clock::time_point attempt_ends_;
  Clock::time_point last_byte_;
  std::string broken_;  ///< why the connection is about to be ended; empty if it is not
  bool sent_ = false;   ///< since the last wait for bytes
  std::array<char, kReadSize> buffer_;
};

TcpClient::TcpClient(boost::asio::io_context& io, Options options, Handler& handler)
    : impl_(std::make_shared<Impl>(io, std::move(options), handler)) {}

TcpClient::~TcpClient() { impl_->close(); }

void TcpClient::start() { impl_->start(); }

void TcpClient::close() {
  const auto impl = impl_;  // the handler may destroy this client
  if (impl->close()) impl->tellClosed();
}

bool TcpClient::write(std::string_view bytes) { return impl_->write(bytes); }

void TcpClient::confirm() { impl_->confirm(); }

bool TcpClient::connected() const { return impl_->connected(); }

std::size_t TcpClient::unacknowledgedBytes() const { return impl_->unacknowledgedBytes(); }

}  // namespace frontseat_driver::link
