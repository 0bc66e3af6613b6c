#include "frontseat_driver/link/tcp_server.h"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/system/system_error.hpp>
#include <chrono>
#include <functional>
#include <unordered_map>
#include <utility>

#include "endpoint.h"
#include "orderly_close.h"

namespace frontseat_driver::link {

using boost::asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::size_t kReadSize = 16384;
constexpr std::size_t kMaxBacklog = std::size_t{1} << 20;
/// What a client does not read waits in the backlog, which has a limit, and not in the kernel.
constexpr int kSendBuffer = 65536;
constexpr std::chrono::milliseconds kCloseLimit{250};
/// After an accept that failed, mostly because there was no file descriptor left.
constexpr std::chrono::milliseconds kAcceptAgain{100};

/// One connection; calls `lost` once when it has ended by itself.
class Peer : public std::enable_shared_from_this<Peer> {
 public:
  using Bytes = std::function<void(std::string_view)>;
  using Lost = std::function<void()>;

  Peer(tcp::socket socket, Bytes bytes, Lost lost)
      : socket_(std::move(socket)), bytes_(std::move(bytes)), lost_(std::move(lost)) {}

  void begin() {
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.set_option(tcp::socket::send_buffer_size(kSendBuffer), ignored);
    socket_.non_blocking(true, ignored);
    read();
  }

  void send(std::string_view bytes) {
    if (unsent_.size() + bytes.size() > kMaxBacklog) return lose();
    const bool writing = !unsent_.empty();
    unsent_.append(bytes);
    if (!writing) write();
  }

  void disconnect() {
    forget();
    closeInOrder(std::move(socket_), std::move(unsent_), kCloseLimit);
  }

  void reset() {
    forget();
    closeWithReset(socket_);
  }

 private:
  void read() {
    socket_.async_read_some(boost::asio::buffer(buffer_),
                            [self = shared_from_this()](const error_code& error, std::size_t size) {
                              if (!self->bytes_) return;
                              if (error) return self->lose();
                              const Bytes bytes = self->bytes_;  // the call may end this connection
                              bytes({self->buffer_.data(), size});
                              if (self->bytes_) self->read();
                            });
  }

  void write() {
    error_code error;
    while (!unsent_.empty() && !error) {
      unsent_.erase(0, socket_.write_some(boost::asio::buffer(unsent_), error));
    }
    if (!error) return;
    if (error != boost::asio::error::would_block) return lose();
    socket_.async_wait(tcp::socket::wait_write,
                       [self = shared_from_this()](const error_code& failed) {
                         if (!failed && self->bytes_) self->write();
                       });
  }

  void lose() {
    const Lost lost = lost_;
    reset();
    lost();
  }

  void forget() {
    bytes_ = nullptr;
    lost_ = nullptr;
  }

  tcp::socket socket_;
  Bytes bytes_;
  Lost lost_;
  std::string unsent_;
  std::array<char, kReadSize> buffer_;
};

}  // namespace

class TcpServer::Impl : public std::enable_shared_from_this<Impl> {
 public:
  Impl(boost::asio::io_context& io, const std::string& address, std::uint16_t port,
       Handler& handler)
      : io_(io), handler_(handler), acceptor_(io), accept_again_(io) {
    listen(address, port);
  }

  void accept() {
    acceptor_.async_accept(
        [self = shared_from_this()](const error_code& error, tcp::socket socket) {
          if (self->closed_) return;
          if (error) return self->acceptLater();
          self->add(std::move(socket));
          if (!self->closed_) self->accept();
        });
  }

  std::uint16_t port() const { return port_; }

  void send(ClientId client, std::string_view bytes) {
    if (const auto peer = find(client)) peer->send(bytes);
  }

  void disconnect(ClientId client) {
    const auto peer = find(client);
    if (!peer) return;
    peer->disconnect();
    gone(client);
  }

  void reset(ClientId client) {
    const auto peer = find(client);
    if (!peer) return;
    peer->reset();
    gone(client);
  }

  void close() {
    closed_ = true;
    error_code ignored;
    acceptor_.close(ignored);
    accept_again_.cancel();
    for (const auto& [client, peer] : std::exchange(peers_, {})) peer->disconnect();
  }

 private:
  void listen(const std::string& address, std::uint16_t port) {
    const auto check = [&](const error_code& error) {
      if (!error) return;
      throw boost::system::system_error(
          error, "cannot listen on " + address + " port " + std::to_string(port));
    };
    error_code error;
    const auto endpoint = numericEndpoint(address, port);
    check(endpoint ? error_code{} : make_error_code(boost::asio::error::invalid_argument));
    acceptor_.open(endpoint->protocol(), error);
    check(error);
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    acceptor_.bind(*endpoint, error);
    check(error);
    acceptor_.listen(tcp::acceptor::max_listen_connections, error);
    check(error);
    port_ = acceptor_.local_endpoint(error).port();
  }

  void acceptLater() {
    accept_again_.expires_after(kAcceptAgain);
    accept_again_.async_wait([self = shared_from_this()](const error_code& error) {
      if (!error && !self->closed_) self->accept();
    });
  }

  void add(tcp::socket socket) {
    error_code error;
    const tcp::endpoint endpoint = socket.remote_endpoint(error);
    if (error) return;  // gone already
    const ClientId client = next_client_++;
    const auto peer = std::make_shared<Peer>(
        std::move(socket),
        [this, client](std::string_view bytes) { handler_.onClientBytes(client, bytes); },
        [this, client] { gone(client); });
    peers_.emplace(client, peer);
    handler_.onClientConnected(client, toText(endpoint));
    if (find(client)) peer->begin();
  }

  std::shared_ptr<Peer> find(ClientId client) const {
    const auto found = peers_.find(client);
    return found == peers_.end() ? nullptr : found->second;
  }

  /// The handler hears of it later: it may be in the middle of something.
  void gone(ClientId client) {
    peers_.erase(client);
    boost::asio::post(io_, [self = shared_from_this(), client] {
      if (!self->closed_) self->handler_.onClientDisconnected(client);
    });
  }

  boost::asio::io_context& io_;
  Handler& handler_;
  tcp::acceptor acceptor_;
  boost::asio::steady_timer accept_again_;
  std::uint16_t port_ = 0;
  bool closed_ = false;
  ClientId next_client_ = 1;
  std::unordered_map<ClientId, std::shared_ptr<Peer>> peers_;
};

TcpServer::TcpServer(boost::asio::io_context& io, const std::string& address, std::uint16_t port,
                     Handler& handler)
    : impl_(std::make_shared<Impl>(io, address, port, handler)) {
  impl_->accept();
}

TcpServer::~TcpServer() { impl_->close(); }

std::uint16_t TcpServer::port() const { return impl_->port(); }

void TcpServer::send(ClientId client, std::string_view bytes) { impl_->send(client, bytes); }

void TcpServer::disconnect(ClientId client) { impl_->disconnect(client); }

void TcpServer::reset(ClientId client) { impl_->reset(client); }

void TcpServer::close() { impl_->close(); }

}  // namespace frontseat_driver::link
