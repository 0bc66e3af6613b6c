#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "frontseat_driver/link/tcp_client.h"
#include "test/link/loopback.h"

/// A delayed acknowledgement, which takes 40 ms, must hold up neither side.
namespace frontseat_driver::link::testing {
namespace {

using Clock = std::chrono::steady_clock;

milliseconds medianTime(const std::function<void()>& exchange) {
  std::vector<milliseconds> times;
  for (int i = 0; i < 15; ++i) {
    const auto begin = Clock::now();
    exchange();
    times.push_back(std::chrono::duration_cast<milliseconds>(Clock::now() - begin));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// Runs a client that calls `react` at every read, against a vehicle that does `exchange`.
milliseconds medianTime(const std::function<void(TcpClient&, const std::string& received)>& react,
                        const std::function<void(const Socket&)>& exchange) {
  const RawVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
  log.on_bytes = [&] { react(client, log.received); };
  client.start();
  bool done = false;
  milliseconds median{};
  std::thread other([&] {
    const Socket socket = vehicle.accept();
    median = medianTime([&] { exchange(socket); });
    boost::asio::post(io, [&] { done = true; });
  });
  EXPECT_TRUE(runUntil(io, [&] { return done; }));
  other.join();
  return median;
}

void write(const Socket& socket, char byte) {
  EXPECT_EQ(send(socket.fd(), &byte, 1, MSG_NOSIGNAL), 1);
}

void read(const Socket& socket) {
  char byte = 0;
  EXPECT_EQ(recv(socket.fd(), &byte, 1, MSG_WAITALL), 1);
}

TEST(Latency, BundleInTwoWritesOfAVehicleWithNagle) {
  const auto react = [](TcpClient& client, const std::string& received) {
    if (received.back() == '2') client.write("a");
  };
  const auto exchange = [](const Socket& socket) {
    write(socket, '1');
    write(socket, '2');
    read(socket);
  };
  EXPECT_LT(medianTime(react, exchange), milliseconds(20));
}

TEST(Latency, TwoSentencesToAVehicleThatDelaysItsAcknowledgement) {
  const auto react = [](TcpClient& client, const std::string&) {
    client.write("1");
    client.write("2");
  };
  const auto exchange = [](const Socket& socket) {
    write(socket, 'q');
    read(socket);
    read(socket);
  };
  EXPECT_LT(medianTime(react, exchange), milliseconds(20));
}

}  // namespace
}  // namespace frontseat_driver::link::testing
