#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <future>
#include <string>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/link/tcp_server.h"
#include "test/link/loopback.h"

namespace frontseat_driver::link::testing {
namespace {

using Clock = std::chrono::steady_clock;

const std::string kLast = "$PYDIR,0.000,0.000*00\r\n";

/// Telemetry until the socket takes no more, up to 1 MiB, since a reader may be as fast; 0, or
/// errno if the connection is broken.
int flood(const Socket& socket) {
  static const std::string kTelemetry(8192, 't');
  for (int i = 0; i < 128; ++i) {
    const int flags = MSG_DONTWAIT | MSG_NOSIGNAL;
    if (send(socket.fd(), kTelemetry.data(), kTelemetry.size(), flags) > 0) continue;
    return errno == EAGAIN ? 0 : errno;
  }
  return 0;
}

/// A vehicle that floods all the time and reads little by little, to the end of the connection.
Received floodAndRead(const Socket& socket, milliseconds pause, std::size_t bytes_per_read) {
  Received received;
  std::string buffer(bytes_per_read, '\0');
  for (;;) {
    if (received.error == 0) received.error = flood(socket);
    poll(nullptr, 0, static_cast<int>(pause.count()));
    const ssize_t size = recv(socket.fd(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size < 0 && errno == EAGAIN) continue;
    if (size < 0) received.error = errno;
    if (size <= 0) return received;
    received.bytes.append(buffer, 0, static_cast<std::size_t>(size));
  }
}

/// What such a vehicle hears of a client that writes `sentences` and the last one, and closes while
/// it is being flooded.
Received closeUnderFlood(int sentences, milliseconds pause, std::size_t bytes_per_read) {
  const RawVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
  client.start();
  auto heard = std::async(std::launch::async,
                          [&] { return floodAndRead(vehicle.accept(), pause, bytes_per_read); });
  EXPECT_TRUE(runUntil(io, [&] { return log.received.size() > 1000000; }));
  for (int i = 0; i < sentences; ++i) EXPECT_TRUE(client.write(std::string(75, 's')));
  EXPECT_TRUE(client.write(kLast));
  client.close();
  EXPECT_EQ(log.losses, std::vector<std::string>{"closed by the backseat"});
  io.restart();
  io.run();  // ends, since nothing is left to do
  return heard.get();
}

TEST(OrderlyClose, VehicleThatFloodsReadsTheLastSentenceThenTheEnd) {
  int in_order = 0;
  for (int i = 0; i < 20; ++i) {
    const Received heard = closeUnderFlood(5, milliseconds(1), 64);
    EXPECT_EQ(heard.bytes, std::string(375, 's') + kLast);
    if (heard.error == 0) ++in_order;
  }
  // It reads within some 10 ms; on a busy machine it may now and then take longer than the limit.
  EXPECT_GE(in_order, 10);
}

TEST(OrderlyClose, VehicleSlowerThanTheLimitStillReadsTheLastSentence) {
  const Received heard = closeUnderFlood(5, milliseconds(20), 32);
  EXPECT_EQ(heard.bytes, std::string(375, 's') + kLast);
}

TEST(OrderlyClose, UnreadBytesCauseNoReset) {
  const RawVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return client.connected(); }));
  const Socket peer = vehicle.accept();
  EXPECT_EQ(flood(peer), 0);
  EXPECT_TRUE(client.write(kLast));
  client.close();
  auto heard = std::async(std::launch::async, [&] {
    const Received received = readToEnd(peer);
    shutdown(peer.fd(), SHUT_WR);
    return received;
  });
  io.restart();
  io.run();
  const Received received = heard.get();
  EXPECT_EQ(received.error, 0);
  EXPECT_EQ(received.bytes, kLast);
}

TEST(OrderlyClose, IsOverWhenTheVehicleClosesToo) {
  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", server.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return client.connected() && vehicle.connected.size() == 1; }));
  const std::size_t open_before = openFileDescriptors();
  const auto begin = Clock::now();
  client.close();
  EXPECT_TRUE(runUntil(io, [&] { return openFileDescriptors() == open_before - 2; }));
  EXPECT_LT(Clock::now() - begin, milliseconds(40));
}

TEST(OrderlyClose, DoesNotWaitForAVehicleThatNeitherReadsNorCloses) {
  const RawVehicle vehicle(4096);
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return client.connected(); }));
  const Socket peer = vehicle.accept();
  while (client.write(kLast)) {
  }
  const auto begin = Clock::now();
  client.close();
  EXPECT_LT(Clock::now() - begin, milliseconds(10));
  io.restart();
  io.run();
  EXPECT_LT(Clock::now() - begin, milliseconds(90));
}

TEST(OrderlyClose, MayComeFromInsideEveryReport) {
  for (const bool at_connect : {true, false}) {
    boost::asio::io_context io;
    ServerLog vehicle;
    TcpServer server(io, "127.0.0.1", 0, vehicle);
    ClientLog log;
    TcpClient client(io, quickOptions("127.0.0.1", server.port()), log);
    const auto leave = [&] {
      client.write(kLast);
      client.close();
    };
    (at_connect ? log.on_connected : log.on_bytes) = leave;
    client.start();
    ASSERT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1; }));
    server.send(1, "telemetry");
    ASSERT_TRUE(runUntil(io, [&] { return vehicle.disconnected.size() == 1; }));
    EXPECT_EQ(vehicle.received, kLast);
    EXPECT_EQ(log.losses, std::vector<std::string>{"closed by the backseat"});
  }
}

TEST(OrderlyClose, NothingFollowsIt) {
  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", server.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return client.connected() && vehicle.connected.size() == 1; }));
  client.close();
  EXPECT_FALSE(client.connected());
  EXPECT_FALSE(client.write(kLast));
  client.close();
  client.start();
  server.send(1, "telemetry");
  ASSERT_TRUE(runUntil(io, [&] { return vehicle.disconnected.size() == 1; }));
  server.close();
  io.restart();
  io.run();
  EXPECT_EQ(log.losses.size(), 1U);
  EXPECT_EQ(log.received, "");
  EXPECT_TRUE(log.failures.empty());
}

TEST(OrderlyClose, TheEndOfTheClientIsOneToo) {
  const RawVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  {
    TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
    client.start();
    ASSERT_TRUE(runUntil(io, [&] { return client.connected(); }));
    EXPECT_TRUE(client.write(kLast));
  }
  const Received heard = readToEnd(vehicle.accept());
  EXPECT_EQ(heard.error, 0);
  EXPECT_EQ(heard.bytes, kLast);
  EXPECT_TRUE(log.losses.empty());
}

}  // namespace
}  // namespace frontseat_driver::link::testing
