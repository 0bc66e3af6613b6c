#include <gtest/gtest.h>

#include <cerrno>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontseat_driver/link/tcp_client.h"
#include "frontseat_driver/link/tcp_server.h"
#include "test/link/interposed.h"
#include "test/link/loopback.h"
#include "test/link/no_more_files.h"
#include "test/link/no_more_threads.h"

namespace frontseat_driver::link::testing {
namespace {

using Clock = std::chrono::steady_clock;

struct Address {
  const char* name;
  const char* bind;
  const char* host;
  const char* endpoint;  ///< without the port
};

const Address kAddresses[] = {
    {"ipv4", "127.0.0.1", "127.0.0.1", "127.0.0.1:"},
    {"name", "127.0.0.1", "localhost", "127.0.0.1:"},
    {"second_address_of_the_name", "127.0.0.1", "second.test", "127.0.0.1:"},
    {"name_with_an_address_that_is_none_of_tcp", "127.0.0.1", "mixed.test", "127.0.0.1:"},
    {"ipv6", "::1", "::1", "[::1]:"},
    {"ipv6_in_brackets", "::1", "[::1]", "[::1]:"}};

class ConnectTo : public ::testing::TestWithParam<Address> {};

TEST_P(ConnectTo, ExchangesBytes) {
  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server(io, GetParam().bind, 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions(GetParam().host, server.port()), log);
  log.on_connected = [&] { EXPECT_TRUE(client.write("$BPVER\r\n")); };
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return vehicle.received == "$BPVER\r\n"; }));
  server.send(vehicle.connected.at(0), "$BFVER\r\n");
  ASSERT_TRUE(runUntil(io, [&] { return log.received == "$BFVER\r\n"; }));
  ASSERT_EQ(log.endpoints.size(), 1U);
  EXPECT_EQ(log.endpoints[0], GetParam().endpoint + std::to_string(server.port()));
  EXPECT_TRUE(client.connected());
}

// A host without IPv6 has no such rows.
std::vector<Address> reachableAddresses() {
  std::vector<Address> reachable;
  for (const Address& address : kAddresses) {
    if (address.bind != std::string("::1") || hasIpv6()) reachable.push_back(address);
  }
  return reachable;
}

INSTANTIATE_TEST_SUITE_P(Table, ConnectTo, ::testing::ValuesIn(reachableAddresses()),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Failure {
  const char* name;
  const char* host;
  const char* reason;
};

const Failure kFailures[] = {
    {"refused", "127.0.0.1", "connection refused"},
    {"refused_by_all_addresses", "second.test", "connection refused"},
    {"absent_name", "absent.test", "host name 'absent.test' not found"},
    {"no_name_server", "broken.test",
     "host name 'broken.test' could not be looked up: Temporary failure in name resolution"},
    {"no_file_for_the_look_up", "files.test",
     "host name 'files.test' could not be looked up: Too many open files"},
    {"no_address_of_tcp", "alien.test", "host name 'alien.test' not found"},
    {"hanging_name", "hanging.test",
     "host name 'hanging.test' could not be looked up within 0.2 s"}};

class ConnectFailure : public ::testing::TestWithParam<Failure> {};

TEST_P(ConnectFailure, IsToldAndRetried) {
  hangNames();
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  auto options = quickOptions(GetParam().host, port.port());
  options.connect_timeout = milliseconds(200);
  TcpClient client(io, options, log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() == 3; }));
  for (const std::string& failure : log.failures) EXPECT_EQ(failure, GetParam().reason);
  EXPECT_FALSE(client.connected());
  EXPECT_TRUE(log.endpoints.empty());
  EXPECT_TRUE(log.losses.empty());
  releaseHangingNames();
}

INSTANTIATE_TEST_SUITE_P(Table, ConnectFailure, ::testing::ValuesIn(kFailures),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Connect, TimesOutWhenNobodyAnswers) {
  const FullVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  auto options = quickOptions("127.0.0.1", vehicle.port());
  options.connect_timeout = milliseconds(300);
  TcpClient client(io, options, log);
  const auto begin = Clock::now();
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
  EXPECT_EQ(log.failures[0], "no answer from host 127.0.0.1 within 0.3 s");
  EXPECT_GE(Clock::now() - begin, milliseconds(300));
  EXPECT_LT(Clock::now() - begin, milliseconds(1000));
}

TEST(Connect, AnAddressThatDoesNotAnswerLeavesTimeForTheNext) {
  boost::asio::io_context io;
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", 0, vehicle);
  const FullVehicle first("127.0.0.2", server.port());
  ClientLog log;
  auto options = quickOptions("second.test", server.port());
  options.connect_timeout = milliseconds(800);
  TcpClient client(io, options, log);
  const auto begin = Clock::now();
  client.start();
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
  EXPECT_GE(Clock::now() - begin, milliseconds(400));
  EXPECT_LT(Clock::now() - begin, milliseconds(750));
  EXPECT_TRUE(log.failures.empty());
}

TEST(Connect, WaitsAsLongAsItTold) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  auto options = quickOptions("127.0.0.1", port.port());
  options.reconnect_min = milliseconds(20);
  options.reconnect_max = milliseconds(80);
  std::vector<Clock::time_point> failed_at;
  log.on_failed = [&] { failed_at.push_back(Clock::now()); };
  TcpClient client(io, options, log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() == 6; }));
  for (std::size_t i = 1; i < failed_at.size(); ++i) {
    EXPECT_GE(failed_at[i] - failed_at[i - 1], log.retries[i - 1]);
  }
  EXPECT_EQ(log.retries[0], milliseconds(20));
  EXPECT_GE(log.retries[5], milliseconds(40));
  EXPECT_LE(log.retries[5], milliseconds(80));
}

TEST(Connect, FindsAVehicleThatComesUpLater) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", port.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() == 2; }));
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", port.port(), vehicle);
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
}

TEST(Connect, WaitsUntilAFileCanBeOpened) {
  boost::asio::io_context io;
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", server.port()), log);
  {
    const NoMoreFiles scarce;
    client.start();
    ASSERT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
    EXPECT_EQ(log.failures[0], "too many open files");
  }
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
}

TEST(Connect, WaitsUntilAThreadForTheLookUpCanBegin) {
  boost::asio::io_context io;
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  TcpClient client(io, quickOptions("localhost", server.port()), log);
  {
    const NoMoreThreads scarce;
    client.start();
    ASSERT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
    EXPECT_EQ(log.failures[0],
              "host name 'localhost' could not be looked up: Resource temporarily unavailable");
  }
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
}

TEST(Connect, AKernelThatGivesUpHadNoAnswer) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", port.port()), log);
  failConnects(ETIMEDOUT);
  client.start();
  EXPECT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
  failConnects(0);
  EXPECT_EQ(log.failures.at(0), "no answer from host 127.0.0.1 within 2.0 s");
}

TEST(Connect, OneThatIsResetBeforeItIsUsedIsAFailure) {
  const RawVehicle vehicle;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", vehicle.port()), log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return vehicle.called(); }));
  vehicle.accept().reset();  // the client has not heard yet that it is connected
  ASSERT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
  EXPECT_TRUE(log.endpoints.empty());
  EXPECT_TRUE(log.losses.empty());
}

TEST(Connect, DoesNotTakeItselfForTheVehicle) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", port.port()), log);
  connectToItself(true);
  client.start();
  EXPECT_TRUE(runUntil(io, [&] { return !log.failures.empty(); }));
  connectToItself(false);
  ASSERT_EQ(log.failures.size(), 1U);
  EXPECT_EQ(log.failures[0], "connection refused");
  EXPECT_TRUE(log.endpoints.empty());
}

TEST(Connect, LeavesOneLookUpBehind) {
  hangNames();
  boost::asio::io_context io;
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  auto options = quickOptions("hanging.test", server.port());
  options.connect_timeout = milliseconds(20);
  const std::size_t threads_before = threads();
  TcpClient client(io, options, log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() == 5; }));
  EXPECT_LE(threads(), threads_before + 1);
  releaseHangingNames();
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
  EXPECT_TRUE(waitUntil([&] { return threads() <= threads_before; }));
}

TEST(Connect, UsesALateResultOfALookUp) {
  hangNames();
  boost::asio::io_context io;
  ServerLog vehicle;
  const TcpServer server(io, "127.0.0.1", 0, vehicle);
  ClientLog log;
  auto options = quickOptions("hanging.test", server.port());
  options.connect_timeout = milliseconds(20);
  options.reconnect_min = options.reconnect_max = milliseconds(300);
  const std::size_t threads_before = threads();
  TcpClient client(io, options, log);
  client.start();
  ASSERT_TRUE(runUntil(io, [&] { return log.failures.size() == 1; }));
  releaseHangingNames();  // the result comes before the next attempt
  ASSERT_TRUE(runUntil(io, [&] { return threads() <= threads_before; }));
  hangNames();
  EXPECT_TRUE(runUntil(io, [&] { return client.connected(); }));
  EXPECT_EQ(log.failures.size(), 1U);
  releaseHangingNames();
}

TEST(Connect, TheEndDoesNotWaitForALookUp) {
  hangNames();
  ClientLog log;
  const auto begin = Clock::now();
  {
    boost::asio::io_context io;
    TcpClient client(io, quickOptions("hanging.test", 1), log);
    client.start();
    io.poll();
  }
  EXPECT_LT(Clock::now() - begin, milliseconds(100));
  const std::size_t threads_hanging = threads();
  releaseHangingNames();
  EXPECT_TRUE(waitUntil([&] { return threads() < threads_hanging; }));
  EXPECT_TRUE(log.failures.empty());
}

TEST(Connect, AResultThatComesWithTheEndIsForgotten) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  auto client = std::make_unique<TcpClient>(io, quickOptions("absent.test", port.port()), log);
  const std::size_t threads_before = threads();
  client->start();
  io.run_one();  // begins the look-up
  ASSERT_TRUE(waitUntil([&] { return threads() <= threads_before; }));
  client.reset();  // while the result waits to be told
  io.restart();
  io.run();
  EXPECT_TRUE(log.failures.empty());
}

TEST(Connect, MayBeClosedFromInsideAFailure) {
  const ReservedPort port;
  boost::asio::io_context io;
  ClientLog log;
  TcpClient client(io, quickOptions("127.0.0.1", port.port()), log);
  log.on_failed = [&] { client.close(); };
  client.start();
  io.run();  // ends, since nothing is left to do
  EXPECT_EQ(log.failures.size(), 1U);
  EXPECT_TRUE(log.losses.empty());
}

}  // namespace
}  // namespace frontseat_driver::link::testing
