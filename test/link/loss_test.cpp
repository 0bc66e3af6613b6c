#include <gtest/gtest.h>

#include <boost/asio/post.hpp>
#include <cerrno>
#include <string>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/link/tcp_server.h"
#include "test/link/loopback.h"

namespace frontseat_driver::link::testing {
namespace {

using Clock = std::chrono::steady_clock;

struct Connection {
  Connection() : Connection(TcpClient::Options{}.silence_timeout) {}
  explicit Connection(milliseconds silence_timeout)
      : server(io, "127.0.0.1", 0, vehicle), client(io, options(silence_timeout), log) {
    client.start();
    EXPECT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1 && client.connected(); }));
  }

  TcpClient::Options options(milliseconds silence_timeout) const {
    auto chosen = quickOptions("127.0.0.1", server.port());
    chosen.silence_timeout = silence_timeout;
    return chosen;
  }

  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server;
  ClientLog log;
  TcpClient client;
};

TEST(Loss, VehicleCloses) {
  Connection link;
  link.server.send(1, "$BFSHT,last words\r\n");
  link.server.disconnect(1);
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "vehicle closed the connection");
  EXPECT_EQ(link.log.received, "$BFSHT,last words\r\n");
}

TEST(Loss, VehicleResets) {
  Connection link;
  link.server.reset(1);
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "vehicle reset the connection");
}

TEST(Loss, EveryLossIsFollowedByAConnection) {
  Connection link;
  link.server.disconnect(1);
  EXPECT_TRUE(runUntil(link.io, [&] { return link.log.endpoints.size() == 2; }));
  EXPECT_TRUE(link.client.connected());
}

TEST(Loss, SilentFromTheStart) {
  const auto begin = Clock::now();
  Connection link(milliseconds(200));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "no byte for 0.2 s");
  EXPECT_GE(Clock::now() - begin, milliseconds(200));
  EXPECT_LT(Clock::now() - begin, milliseconds(1000));
}

TEST(Loss, SilenceCountsFromTheLastByte) {
  Connection link(milliseconds(200));
  Clock::time_point last_byte;
  link.log.on_bytes = [&] { last_byte = Clock::now(); };
  for (const std::string text : {"a", "ab", "abc", "abcd"}) {
    const auto next = Clock::now() + milliseconds(120);
    ASSERT_TRUE(runUntil(link.io, [&] { return Clock::now() > next; }));
    link.server.send(1, text.substr(text.size() - 1));
    ASSERT_TRUE(runUntil(link.io, [&] { return link.log.received == text; }));
    ASSERT_TRUE(link.log.losses.empty());
  }
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_GE(Clock::now() - last_byte, milliseconds(200));
}

TEST(Loss, BytesThatWaitedWhileTheProcessSleptAreNoSilence) {
  Connection link(milliseconds(100));
  link.server.send(1, "here");
  const auto over = Clock::now() + milliseconds(150);
  ASSERT_TRUE(waitUntil([&] { return Clock::now() > over; }));  // nothing runs the io_context
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.received.empty(); }));
  EXPECT_TRUE(link.log.losses.empty());
}

TEST(Loss, BytesThatCameWhileAnotherTaskTookLongAreNoSilence) {
  Connection link(milliseconds(100));
  const auto over = Clock::now() + milliseconds(150);
  ASSERT_TRUE(waitUntil([&] { return Clock::now() > over; }));
  // It goes first; the look at the clock that is due follows, and only then bytes are read.
  boost::asio::post(link.io, [&] { link.server.send(1, "here"); });
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.received.empty(); }));
  EXPECT_TRUE(link.log.losses.empty());
}

TEST(Loss, OldCommandsNeverReachAVehicleThatWasSilent) {
  const RawVehicle vehicle(4096);
  boost::asio::io_context io;
  ClientLog log;
  auto options = quickOptions("127.0.0.1", vehicle.port());
  options.silence_timeout = milliseconds(200);
  TcpClient client(io, options, log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return client.connected(); }));
  const Socket frozen = vehicle.accept();
  const std::string command(100, 'c');
  std::size_t written = 0;
  while (client.write(command)) written += command.size();
  ASSERT_TRUE(runUntil(io, [&] { return !log.losses.empty(); }));
  const Received received = readToEnd(frozen);
  EXPECT_EQ(received.error, ECONNRESET);
  EXPECT_LT(received.bytes.size(), written);
}

/// Losses until `attempts` connections were made, with a back-off of at least `min` between them.
void loseRepeatedly(Connection& link, std::size_t attempts) {
  while (link.log.endpoints.size() < attempts) {
    const std::size_t before = link.log.losses.size();
    link.server.disconnect(link.vehicle.connected.back());
    ASSERT_TRUE(runUntil(link.io, [&] { return link.log.losses.size() > before; }));
    const std::size_t made = link.vehicle.connected.size();
    ASSERT_TRUE(runUntil(link.io, [&] { return link.vehicle.connected.size() > made; }));
    ASSERT_TRUE(runUntil(link.io, [&] { return link.client.connected(); }));
  }
}

TEST(Loss, UnconfirmedConnectionsCountAsFailures) {
  const ReservedPort port;
  boost::asio::io_context io;
  ServerLog vehicle;
  ClientLog log;
  auto options = quickOptions("127.0.0.1", port.port());
  options.reconnect_min = milliseconds(10);
  options.reconnect_max = milliseconds(1000);
  TcpClient client(io, options, log);
  TcpServer server(io, "127.0.0.1", port.port(), vehicle);
  client.start();
  for (std::size_t i = 1; i <= 4; ++i) {  // steps of 10, 20, 40 and 80 ms
    ASSERT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == i; }));
    ASSERT_TRUE(runUntil(io, [&] { return log.endpoints.size() == i; }));
    if (i == 4) server.close();
    if (i < 4) server.disconnect(vehicle.connected.back());
    ASSERT_TRUE(runUntil(io, [&] { return log.losses.size() == i; }));
  }
  ASSERT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
  EXPECT_GE(log.retries[0], milliseconds(80));  // the fifth step is 160 ms
  EXPECT_LE(log.retries[0], milliseconds(160));
}

TEST(Loss, ConfirmedConnectionStartsTheBackOffAgain) {
  Connection link;
  loseRepeatedly(link, 5);
  link.client.confirm();
  link.server.close();
  ASSERT_TRUE(runUntil(link.io, [&] { return link.log.retries.size() == 1; }));
  EXPECT_GE(link.log.retries[0], milliseconds(5));  // the second step is 10 ms
  EXPECT_LE(link.log.retries[0], milliseconds(10));
}

TEST(Loss, MayBeClosedFromInsideIt) {
  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", server.port()), log);
  log.on_disconnected = [&] { client.close(); };
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1 && client.connected(); }));
  server.disconnect(1);
  server.close();
  io.restart();
  io.run();  // ends, since nothing is left to do
  EXPECT_EQ(log.losses.size(), 1U);
}

}  // namespace
}  // namespace frontseat_driver::link::testing
