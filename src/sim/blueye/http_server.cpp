#include "http_server.h"

#include <boost/asio/ip/address.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <memory>
#include <string_view>
#include <utility>

namespace frontseat_driver::sim {
namespace {

namespace http = boost::beast::http;
using boost::asio::ip::tcp;
using Error = boost::beast::error_code;

constexpr std::string_view kDroneInfo = "/diagnostics/drone_info";
constexpr std::chrono::seconds kPatience{5};
constexpr std::chrono::milliseconds kBreath{100};  // when there are no descriptors left
constexpr std::uint32_t kMostHeader = 8192;
constexpr std::uint64_t kMostBody = 8192;

/// Where clients look for the drone's logs, of both kinds; the simulated one keeps none.
bool listsLogs(std::string_view path) {
  return path == "/logs" || path == "/logs/" || path == "/logcsv" || path == "/logcsv/";
}

/// One connection, which ends with its first answer.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, const std::string& drone_info)
      : stream_(std::move(socket)), drone_info_(drone_info) {
    parser_.header_limit(kMostHeader);
    parser_.body_limit(kMostBody);
  }

  void begin() {
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](const Error& error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    const auto target = request.target();
    const std::string path{target.substr(0, target.find('?'))};
    const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
    response_.version(request.version());
    response_.keep_alive(false);
    const bool known = path == kDroneInfo || listsLogs(path);
    if (!reads) {
      response_.result(http::status::method_not_allowed);
    } else if (!known) {
      response_.result(http::status::not_found);
    } else {
      response_.result(http::status::ok);
      response_.set(http::field::content_type, "application/json");
      if (request.method() == http::verb::get) {
        response_.body() = path == kDroneInfo ? drone_info_ : "[]";
      }
    }
    response_.prepare_payload();
    http::async_write(stream_, response_, [self = shared_from_this()](const Error&, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
  const std::string& drone_info_;
};

tcp::acceptor listen(boost::asio::io_context& io, const std::string& bind, std::uint16_t port) {
  return tcp::acceptor{io, tcp::endpoint{boost::asio::ip::make_address(bind), port}};
}

}  // namespace

BlueyeHttpServer::BlueyeHttpServer(const std::string& bind, std::uint16_t port,
                                   std::string drone_info)
    : drone_info_(std::move(drone_info)),
      acceptor_(listen(io_, bind, port)),
      pause_(io_),
      port_(acceptor_.local_endpoint().port()) {
  accept();
  thread_ = std::thread{[this] { io_.run(); }};
}

BlueyeHttpServer::~BlueyeHttpServer() {
  io_.stop();
  thread_.join();
}

void BlueyeHttpServer::accept() {
  acceptor_.async_accept([this](const Error& error, tcp::socket socket) {
    if (error) {
      pause_.expires_after(kBreath);
      pause_.async_wait([this](const Error& cancelled) {
        if (!cancelled) accept();
      });
      return;
    }
    if (online_) std::make_shared<Visit>(std::move(socket), drone_info_)->begin();
    accept();
  });
}

}  // namespace frontseat_driver::sim
