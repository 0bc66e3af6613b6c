#include "orderly_close.h"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <utility>

namespace frontseat_driver::link {

using boost::asio::ip::tcp;
using boost::system::error_code;

namespace {

/// Reads in one go at most, so that a peer that floods leaves time for the rest of the io_context.
constexpr int kReadsPerTurn = 16;

class OrderlyClose : public std::enable_shared_from_this<OrderlyClose> {
 public:
  OrderlyClose(tcp::socket socket, std::string unsent, std::chrono::milliseconds limit)
      : socket_(std::move(socket)),
        timer_(socket_.get_executor(), limit),
        unsent_(std::move(unsent)) {}

  void begin() {
    error_code ignored;
    socket_.cancel(ignored);
    socket_.non_blocking(true, ignored);
    timer_.async_wait([self = shared_from_this()](const error_code&) {
      self->drain();  // what is unread at the close makes the kernel send a reset
      self->end();
    });
    flush();
    discard();
  }

 private:
  void flush() {
    error_code error;
    while (!unsent_.empty() && !error) {
      unsent_.erase(0, socket_.write_some(boost::asio::buffer(unsent_), error));
    }
    if (error == boost::asio::error::would_block) {
      socket_.async_wait(tcp::socket::wait_write, [self = shared_from_this()](const error_code& e) {
        if (!e) self->flush();
      });
      return;
    }
    socket_.shutdown(tcp::socket::shutdown_send, error);
  }

  void discard() {
    const error_code error = drain();
    if (error && error != boost::asio::error::would_block) return end();
    socket_.async_wait(tcp::socket::wait_read, [self = shared_from_this()](const error_code& e) {
      if (!e) self->discard();
    });
  }

  error_code drain() {
    error_code error;
    for (int i = 0; i < kReadsPerTurn && !error; ++i) {
      socket_.read_some(boost::asio::buffer(scrap_), error);
    }
    return error;
  }

  void end() {
    error_code ignored;
    timer_.cancel();
    socket_.close(ignored);
  }

  tcp::socket socket_;
  boost::asio::steady_timer timer_;
  std::string unsent_;
  std::array<char, 16384> scrap_;
};

}  // namespace

void closeInOrder(tcp::socket socket, std::string unsent, std::chrono::milliseconds limit) {
  std::make_shared<OrderlyClose>(std::move(socket), std::move(unsent), limit)->begin();
}

void closeWithReset(tcp::socket& socket) {
  error_code ignored;
  socket.set_option(tcp::socket::linger(true, 0), ignored);
  socket.close(ignored);
}

}  // namespace frontseat_driver::link
