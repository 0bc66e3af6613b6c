#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <string>

namespace frontseat_driver::link {

/// Ends a connection so that the peer reads everything written before, then `unsent`, then the end.
///
/// A socket that is closed while the peer still sends answers with a reset, and a reset may destroy
/// what the peer has received but not read. So the sending side is ended first, and what comes in
/// is read and thrown away until the peer ends its side too, or until `limit` is over; a peer that
/// goes on sending after that still gets the reset. Returns at once; the io_context does the rest.
/// If it is destroyed earlier, the socket is closed then.
void closeInOrder(boost::asio::ip::tcp::socket socket, std::string unsent,
                  std::chrono::milliseconds limit);

/// Ends a connection with a reset: what the kernel has not sent yet is never sent.
void closeWithReset(boost::asio::ip::tcp::socket& socket);

}  // namespace frontseat_driver::link
