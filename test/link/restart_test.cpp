#include <gtest/gtest.h>

#include <memory>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/link/tcp_server.h"
#include "test/link/loopback.h"

namespace frontseat_driver::link::testing {
namespace {

TEST(Restart, FiftyOfThemLeaveNothingBehind) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("localhost", port.port()), log);
  client.start();
  std::size_t open_before = 0;
  std::size_t threads_before = 0;
  for (std::size_t i = 1; i <= 52; ++i) {
    ServerLog vehicle;
    const auto server = std::make_unique<TcpServer>(io, "127.0.0.1", port.port(), vehicle);
    log.received.clear();
    ASSERT_TRUE(runUntil(io, [&] { return log.endpoints.size() == i; }));
    ASSERT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1; }));
    server->send(1, "telemetry");
    ASSERT_TRUE(runUntil(io, [&] { return log.received == "telemetry"; }));
    client.confirm();
    if (i % 2 == 0) server->reset(1);
    server->close();
    ASSERT_TRUE(runUntil(io, [&] { return log.losses.size() == i; }));
    if (i > 2) continue;
    ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() >= i; }));
    open_before = openFileDescriptors();
    threads_before = threads();
  }
  // A look-up or a closing socket may be under way at the moment.
  EXPECT_TRUE(runUntil(io, [&] { return openFileDescriptors() <= open_before; }));
  EXPECT_TRUE(runUntil(io, [&] { return threads() <= threads_before; }));
}

}  // namespace
}  // namespace frontseat_driver::link::testing
