#include "name_lookup.h"

#include <netdb.h>
#include <sys/socket.h>

#include <boost/asio/post.hpp>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace frontseat_driver::link {

using boost::asio::ip::tcp;

struct NameLookup::Shared {
  std::mutex mutex;
  boost::asio::io_context* io;  ///< null when abandoned: it may not exist any more
  Done done;
};

namespace {

std::string failureText(const std::string& host, int error, int system_error) {
  if (error == EAI_NONAME) return "host name '" + host + "' not found";
  const std::string why = error == EAI_SYSTEM ? std::strerror(system_error) : gai_strerror(error);
  return "host name '" + host + "' could not be looked up: " + why;
}

std::vector<tcp::endpoint> toEndpoints(const addrinfo* found) {
  std::vector<tcp::endpoint> endpoints;
  for (; found != nullptr; found = found->ai_next) {
    tcp::endpoint endpoint;
    if (found->ai_addrlen > endpoint.capacity()) continue;
    std::memcpy(endpoint.data(), found->ai_addr, found->ai_addrlen);
    endpoint.resize(found->ai_addrlen);
    endpoints.push_back(endpoint);
  }
  return endpoints;
}

NameLookup::Result lookUp(const std::string& host, std::uint16_t port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error != 0) return {{}, failureText(host, error, errno)};
  NameLookup::Result result{toEndpoints(found), {}};
  freeaddrinfo(found);
  if (result.endpoints.empty()) result.failure = failureText(host, EAI_NONAME, 0);
  return result;
}

}  // namespace

NameLookup::NameLookup(boost::asio::io_context& io, const std::string& host, std::uint16_t port,
                       Done done)
    : shared_(std::make_shared<Shared>()) {
  shared_->io = &io;
  shared_->done = std::move(done);
  const auto deliver = [](const std::shared_ptr<Shared>& shared, Result result) {
    const std::lock_guard<std::mutex> lock(shared->mutex);
    if (shared->io == nullptr) return;
    boost::asio::post(*shared->io, [shared, result = std::move(result)]() mutable {
      if (shared->io == nullptr) return;  // only this thread writes it
      const Done call = std::move(shared->done);
      call(std::move(result));  // may end the life of the NameLookup
    });
  };
  try {
    std::thread([shared = shared_, deliver, host, port] {
      deliver(shared, lookUp(host, port));
    }).detach();
  } catch (const std::system_error& error) {
    deliver(shared_, {{}, "host name '" + host + "' could not be looked up: " + error.what()});
  }
}

NameLookup::~NameLookup() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->io = nullptr;
  shared_->done = nullptr;
}

}  // namespace frontseat_driver::link
