#include "test/link/loopback.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <boost/asio/executor_work_guard.hpp>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace frontseat_driver::link::testing {

namespace {

using Clock = std::chrono::steady_clock;

int checked(int result, const char* call) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), call);
  return result;
}

sockaddr_in toAddress(const char* text, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = inet_addr(text);
  return address;
}

Socket boundSocket(const char* text = "127.0.0.1", std::uint16_t port = 0) {
  Socket socket(checked(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), "socket"));
  const int on = 1;
  setsockopt(socket.fd(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const sockaddr_in address = toAddress(text, port);
  checked(bind(socket.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
  return socket;
}

std::uint16_t portOf(const Socket& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  checked(getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&address), &size), "getsockname");
  return ntohs(address.sin_port);
}

/// Whether a connection to the port is answered within a time that is ample on one host.
bool connectsSoon(const Socket& socket, const char* text, std::uint16_t port) {
  const sockaddr_in address = toAddress(text, port);
  if (connect(socket.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return true;
  }
  pollfd ready{socket.fd(), POLLOUT, 0};
  return poll(&ready, 1, 200) == 1;
}

std::size_t entries(const char* directory) {
  DIR* const opened = opendir(directory);
  if (opened == nullptr) throw std::system_error(errno, std::generic_category(), directory);
  std::size_t count = 0;
  while (readdir(opened) != nullptr) ++count;
  closedir(opened);
  return count;
}

}  // namespace

bool runUntil(boost::asio::io_context& io, const std::function<bool()>& condition) {
  const auto work = boost::asio::make_work_guard(io);
  const auto end = Clock::now() + kPatience;
  while (!condition()) {
    if (Clock::now() > end) return false;
    io.restart();
    io.run_one_for(milliseconds(20));
  }
  return true;
}

bool waitUntil(const std::function<bool()>& condition) {
  const auto end = Clock::now() + kPatience;
  while (!condition()) {
    if (Clock::now() > end) return false;
    poll(nullptr, 0, 1);
  }
  return true;
}

std::size_t openFileDescriptors() { return entries("/proc/self/fd"); }

std::size_t threads() {
  // The run-time library of a sanitizer begins a thread of its own together with the first one.
  static const bool kBegun = (std::thread([] {}).join(), true);
  return kBegun ? entries("/proc/self/task") : 0;
}

bool hasIpv6() {
  const Socket socket(::socket(AF_INET6, SOCK_STREAM, 0));
  sockaddr_in6 address{};
  address.sin6_family = AF_INET6;
  address.sin6_addr = in6addr_loopback;
  return bind(socket.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

Socket::~Socket() {
  if (fd_ >= 0) ::close(fd_);
}

void Socket::reset() {
  const linger at_once{1, 0};
  setsockopt(fd_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  ::close(std::exchange(fd_, -1));
}

ReservedPort::ReservedPort() : socket_(boundSocket()), port_(portOf(socket_)) {}

RawVehicle::RawVehicle(int receive_buffer) : listener_(boundSocket()), port_(portOf(listener_)) {
  if (receive_buffer > 0) {
    setsockopt(listener_.fd(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  checked(listen(listener_.fd(), 8), "listen");
}

Socket RawVehicle::accept() const {
  return Socket(checked(::accept(listener_.fd(), nullptr, nullptr), "accept"));
}

bool RawVehicle::called() const {
  pollfd waiting{listener_.fd(), POLLIN, 0};
  return poll(&waiting, 1, 0) == 1;
}

FullVehicle::FullVehicle(const char* address, std::uint16_t port)
    : listener_(boundSocket(address, port)), port_(portOf(listener_)) {
  checked(listen(listener_.fd(), 0), "listen");
  do {
    waiting_.emplace_back(checked(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0), "socket"));
  } while (connectsSoon(waiting_.back(), address, port_));
}

Received readToEnd(const Socket& socket) {
  Received received;
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t size = recv(socket.fd(), buffer.data(), buffer.size(), 0);
    if (size < 0) received.error = errno;
    if (size <= 0) return received;
    received.bytes.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

void ClientLog::onConnected(const std::string& endpoint) {
  endpoints.push_back(endpoint);
  on_connected();
}

void ClientLog::onBytes(std::string_view bytes) {
  received.append(bytes);
  on_bytes();
}

void ClientLog::onDisconnected(const std::string& reason) {
  losses.push_back(reason);
  on_disconnected();
}

void ClientLog::onConnectFailed(const std::string& reason, milliseconds retry_in) {
  failures.push_back(reason);
  retries.push_back(retry_in);
  on_failed();
}

void ServerLog::onClientConnected(TcpServer::ClientId client, const std::string&) {
  connected.push_back(client);
  on_connected();
}

void ServerLog::onClientBytes(TcpServer::ClientId, std::string_view bytes) {
  received.append(bytes);
  on_bytes();
}

void ServerLog::onClientDisconnected(TcpServer::ClientId client) { disconnected.push_back(client); }

TcpClient::Options quickOptions(const std::string& host, std::uint16_t port) {
  TcpClient::Options options;
  options.host = host;
  options.port = port;
  options.reconnect_min = milliseconds(5);
  options.reconnect_max = milliseconds(20);
  options.jitter_seed = 1;
  return options;
}

}  // namespace frontseat_driver::link::testing
