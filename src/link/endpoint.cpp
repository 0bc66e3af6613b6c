#include "endpoint.h"

#include <boost/asio/error.hpp>

namespace frontseat_driver::link {

using boost::asio::ip::tcp;
using boost::system::error_code;

std::string toText(const tcp::endpoint& endpoint) {
  const std::string address = endpoint.address().to_string();
  const std::string port = std::to_string(endpoint.port());
  if (endpoint.address().is_v6()) return "[" + address + "]:" + port;
  return address + ":" + port;
}

std::optional<tcp::endpoint> numericEndpoint(const std::string& host, std::uint16_t port) {
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  error_code error;
  const auto address =
      boost::asio::ip::make_address(bracketed ? host.substr(1, host.size() - 2) : host, error);
  if (error) return std::nullopt;
  return tcp::endpoint(address, port);
}

std::string toText(const error_code& error) {
  if (error == boost::asio::error::eof) return "vehicle closed the connection";
  if (error == boost::asio::error::connection_reset) return "vehicle reset the connection";
  if (error == boost::asio::error::timed_out) return "vehicle does not acknowledge data any more";
  std::string text = error.message();
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  }
  return text;
}

}  // namespace frontseat_driver::link
