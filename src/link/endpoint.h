#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace frontseat_driver::link {

/// "127.0.0.1:29500" or "[::1]:29500".
std::string toText(const boost::asio::ip::tcp::endpoint& endpoint);

/// The endpoint of a numeric host: IPv4, or IPv6 with or without brackets and scope
/// ("fe80::1%eth0"). Empty if `host` is a name.
std::optional<boost::asio::ip::tcp::endpoint> numericEndpoint(const std::string& host,
                                                              std::uint16_t port);

/// The system's words for an error, made to stand in the middle of a sentence.
std::string toText(const boost::system::error_code& error);

}  // namespace frontseat_driver::link
