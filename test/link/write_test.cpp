#include <gtest/gtest.h>
#include <sys/socket.h>

#include <string>

#include "frontseat_driver/link/tcp_client.h"
#include "test/link/loopback.h"

namespace frontseat_driver::link::testing {
namespace {

struct RawConnection {
  RawConnection() : client(io, quickOptions("127.0.0.1", vehicle.port()), log) {
    client.start();
    EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
    peer = vehicle.accept();
  }

  RawVehicle vehicle{4096};
  Socket peer;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client;
};

TEST(Write, IsRefusedWithoutAConnection) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", port.port()), log);
  EXPECT_FALSE(client.write("$BPVER\r\n"));
  client.start();
  EXPECT_FALSE(client.write("$BPVER\r\n"));
}

TEST(Write, PilesUpLittleForAVehicleThatDoesNotRead) {
  RawConnection link;
  const std::string sentence(75, 's');
  std::size_t written = 0;
  while (link.client.write(sentence)) written += sentence.size();
  EXPECT_LT(written, 100000U);
  EXPECT_TRUE(link.log.losses.empty());
}

TEST(Write, WhatWasRefusedWholeEndsNothing) {
  RawConnection link;
  std::size_t written = 0;
  while (link.client.write("s")) ++written;  // one byte never goes out in part
  ASSERT_TRUE(link.client.connected());
  std::size_t taken = 0;
  EXPECT_TRUE(waitUntil([&] {
    char buffer[4096];
    const ssize_t size = recv(link.peer.fd(), buffer, sizeof buffer, MSG_DONTWAIT);
    if (size > 0) taken += static_cast<std::size_t>(size);
    return taken == written;
  }));
  EXPECT_TRUE(waitUntil([&] { return link.client.write("s"); }));
}

TEST(Write, APartThatWentOutEndsTheConnection) {
  RawConnection link;
  EXPECT_FALSE(link.client.write(std::string(1 << 20, 's')));
  EXPECT_TRUE(link.log.losses.empty()) << "told from inside write()";
  EXPECT_FALSE(link.client.connected());
  EXPECT_FALSE(link.client.write("more"));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "a sentence could be sent only in part");
}

TEST(Write, APartThatWentOutFromInsideAReportEndsTheConnection) {
  RawConnection link;
  link.log.on_bytes = [&] { EXPECT_FALSE(link.client.write(std::string(1 << 20, 's'))); };
  ASSERT_EQ(send(link.peer.fd(), "go", 2, MSG_NOSIGNAL), 2);
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "a sentence could be sent only in part");
}

TEST(Write, AFloodDoesNotKeepABrokenConnection) {
  RawConnection link;
  const std::string telemetry(1 << 14, 't');
  std::size_t flooded = 0;
  while (send(link.peer.fd(), telemetry.data(), telemetry.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >
             0 &&
         flooded < std::size_t{1} << 22) {
    flooded += telemetry.size();
  }
  ASSERT_GT(flooded, std::size_t{1} << 17);
  EXPECT_FALSE(link.client.write(std::string(1 << 20, 's')));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses[0], "a sentence could be sent only in part");
  EXPECT_GT(link.log.received.size(), 0U);
  EXPECT_LT(link.log.received.size(), flooded);
}

TEST(Write, LastWordsMayCloseTheClient) {
  RawConnection link;
  link.log.on_bytes = [&] { link.client.close(); };
  ASSERT_EQ(send(link.peer.fd(), "bye", 3, MSG_NOSIGNAL), 3);
  EXPECT_FALSE(link.client.write(std::string(1 << 20, 's')));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  link.io.restart();
  link.io.run();  // ends, since nothing is left to do
  EXPECT_EQ(link.log.losses, std::vector<std::string>{"closed by the backseat"});
}

TEST(Write, BytesAreUnacknowledgedUntilTheVehicleTakesThem) {
  RawConnection link;
  std::size_t written = 0;
  while (link.client.write("s")) ++written;  // one byte never goes out in part
  ASSERT_TRUE(link.client.connected());
  EXPECT_GT(link.client.unacknowledgedBytes(), 0U);
  EXPECT_LE(link.client.unacknowledgedBytes(), written);
  EXPECT_TRUE(waitUntil([&] {
    char buffer[4096];
    recv(link.peer.fd(), buffer, sizeof buffer, MSG_DONTWAIT);
    return link.client.unacknowledgedBytes() == 0;
  }));
  ASSERT_TRUE(link.client.write("s"));
  link.client.close();
  EXPECT_EQ(link.client.unacknowledgedBytes(), 0U);
}

TEST(Write, ToAVehicleThatIsGoneIsALoss) {
  RawConnection link;
  link.peer = Socket();  // closed; what is written now is answered by a reset
  EXPECT_TRUE(waitUntil([&] { return !link.client.write("$BPSTS\r\n"); }));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.losses.size(), 1U);
}

TEST(Write, FailedOneStillHandsOnTheLastWords) {
  RawConnection link;
  ASSERT_EQ(send(link.peer.fd(), "bye", 3, MSG_NOSIGNAL), 3);
  link.peer = Socket();
  EXPECT_TRUE(waitUntil([&] { return !link.client.write("$BPSTS\r\n"); }));
  ASSERT_TRUE(runUntil(link.io, [&] { return !link.log.losses.empty(); }));
  EXPECT_EQ(link.log.received, "bye");
}

}  // namespace
}  // namespace frontseat_driver::link::testing
