#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace frontseat_driver::link {

/// One look-up of a host name, on a thread of its own that nobody joins: getaddrinfo cannot be
/// interrupted, and a name server that does not answer must not hold up a stop. (The resolver of
/// Asio joins its thread when the io_context ends, and all look-ups of an io_context wait for one.)
class NameLookup {
 public:
  /// Endpoints in the system's order of preference, or the reason why there are none.
  struct Result {
    std::vector<boost::asio::ip::tcp::endpoint> endpoints;
    std::string failure;
  };
  using Done = std::function<void(Result)>;

  /// Begins at once; `done` is called once, from the io_context.
  NameLookup(boost::asio::io_context& io, const std::string& host, std::uint16_t port, Done done);

  /// A look-up that is not done is left behind; `done` is not called any more.
  ~NameLookup();
  NameLookup(const NameLookup&) = delete;
  NameLookup& operator=(const NameLookup&) = delete;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace frontseat_driver::link
