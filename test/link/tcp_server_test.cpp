#include "frontseat_driver/link/tcp_server.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/system/system_error.hpp>
#include <cerrno>
#include <memory>
#include <string>
#include <vector>

#include "frontseat_driver/link/tcp_client.h"
#include "test/link/interposed.h"
#include "test/link/loopback.h"
#include "test/link/no_more_files.h"

namespace frontseat_driver::link::testing {
namespace {

struct Backseat {
  Backseat(boost::asio::io_context& io, std::uint16_t port)
      : client(io, quickOptions("127.0.0.1", port), log) {
    client.start();
  }
  ClientLog log;
  TcpClient client;
};

class Server : public ::testing::Test {
 protected:
  std::unique_ptr<Backseat> connectOne() {
    const std::size_t before = vehicle.connected.size();
    auto backseat = std::make_unique<Backseat>(io, server.port());
    EXPECT_TRUE(runUntil(
        io, [&] { return vehicle.connected.size() > before && backseat->client.connected(); }));
    return backseat;
  }

  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server{io, "127.0.0.1", 0, vehicle};
};

TEST_F(Server, ServesSeveralClients) {
  const auto first = connectOne();
  const auto second = connectOne();
  ASSERT_EQ(vehicle.connected, (std::vector<TcpServer::ClientId>{1, 2}));
  server.send(1, "one");
  server.send(2, "two");
  EXPECT_TRUE(runUntil(io, [&] { return first->log.received == "one"; }));
  EXPECT_TRUE(runUntil(io, [&] { return second->log.received == "two"; }));
  first->client.close();
  EXPECT_TRUE(runUntil(io, [&] { return vehicle.disconnected.size() == 1; }));
  EXPECT_EQ(vehicle.disconnected[0], 1U);
  const auto third = connectOne();
  EXPECT_EQ(vehicle.connected.back(), 3U);
}

TEST_F(Server, ToldOnceOfAnEndThatItMade) {
  const auto backseat = connectOne();
  server.disconnect(1);
  EXPECT_TRUE(vehicle.disconnected.empty()) << "told from inside disconnect()";
  server.disconnect(1);
  server.reset(1);
  server.send(1, "too late");
  EXPECT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 2; }));
  EXPECT_EQ(vehicle.disconnected, (std::vector<TcpServer::ClientId>{1}));
}

TEST_F(Server, DeliversABacklogBeforeTheEnd) {
  const auto backseat = connectOne();
  backseat->log.on_disconnected = [&] { backseat->client.close(); };
  const std::string backlog(1000000, 'b');
  server.send(1, backlog);
  server.disconnect(1);
  ASSERT_TRUE(runUntil(io, [&] { return !backseat->log.losses.empty(); }));
  EXPECT_EQ(backseat->log.received.size(), backlog.size());
  EXPECT_EQ(backseat->log.losses[0], "vehicle closed the connection");
}

TEST_F(Server, KeepsOrderBehindABacklog) {
  const auto backseat = connectOne();
  std::string expected;
  for (int i = 0; i < 9; ++i) {
    const std::string block(100000, static_cast<char>('0' + i));
    server.send(1, block);
    expected += block;
  }
  ASSERT_TRUE(runUntil(io, [&] { return backseat->log.received.size() == expected.size(); }));
  EXPECT_EQ(backseat->log.received, expected);
}

TEST(ServerLimits, DropsAClientThatReadsNothing) {
  boost::asio::io_context server_io;
  boost::asio::io_context client_io;  // runs only until it is connected
  ServerLog vehicle;
  TcpServer server(server_io, "127.0.0.1", 0, vehicle);
  Backseat backseat(client_io, server.port());
  ASSERT_TRUE(runUntil(client_io, [&] { return backseat.client.connected(); }));
  ASSERT_TRUE(runUntil(server_io, [&] { return vehicle.connected.size() == 1; }));
  const std::string block(500000, 'b');
  std::size_t sent = 0;
  EXPECT_TRUE(runUntil(server_io, [&] {
    server.send(1, block);
    sent += block.size();
    return !vehicle.disconnected.empty();
  }));
  EXPECT_GT(sent, std::size_t{1} << 20);
  EXPECT_LT(sent, std::size_t{20} << 20);
}

TEST_F(Server, ResetIsAReset) {
  const auto backseat = connectOne();
  server.reset(1);
  ASSERT_TRUE(runUntil(io, [&] { return !backseat->log.losses.empty(); }));
  EXPECT_EQ(backseat->log.losses[0], "vehicle reset the connection");
}

TEST_F(Server, CloseEndsAllAndTellsNobody) {
  const auto first = connectOne();
  const auto second = connectOne();
  server.close();
  ASSERT_TRUE(
      runUntil(io, [&] { return !first->log.failures.empty() && !second->log.failures.empty(); }));
  EXPECT_EQ(first->log.failures[0], "connection refused");
  EXPECT_TRUE(vehicle.disconnected.empty());
}

TEST_F(Server, AClientMayBeTurnedAwayWhenItComes) {
  vehicle.on_connected = [&] { server.disconnect(vehicle.connected.back()); };
  Backseat backseat(io, server.port());
  backseat.log.on_disconnected = [&] { backseat.client.close(); };
  ASSERT_TRUE(runUntil(io, [&] { return !vehicle.disconnected.empty(); }));
  ASSERT_TRUE(runUntil(io, [&] { return !backseat.log.losses.empty(); }));
  EXPECT_EQ(backseat.log.losses[0], "vehicle closed the connection");
  EXPECT_EQ(vehicle.disconnected, (std::vector<TcpServer::ClientId>{1}));
}

TEST_F(Server, AClientMayBeDroppedForWhatItSays) {
  vehicle.on_bytes = [&] { server.reset(1); };
  const auto backseat = connectOne();
  ASSERT_TRUE(backseat->client.write("nonsense"));
  ASSERT_TRUE(runUntil(io, [&] { return !backseat->log.losses.empty(); }));
  EXPECT_EQ(backseat->log.losses[0], "vehicle reset the connection");
  EXPECT_EQ(vehicle.received, "nonsense");
}

TEST_F(Server, MayBeClosedWhenAClientComes) {
  vehicle.on_connected = [&] { server.close(); };
  Backseat backseat(io, server.port());
  ASSERT_TRUE(runUntil(io, [&] { return !backseat.log.failures.empty(); }));
  EXPECT_EQ(backseat.log.failures[0], "connection refused");
  EXPECT_EQ(vehicle.connected.size(), 1U);
}

/// A client that the test resets itself.
Socket connectedTo(std::uint16_t port) {
  Socket socket(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket.fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return socket;
}

TEST_F(Server, HearsNothingOfAClientThatWasGoneBeforeItWasAccepted) {
  connectedTo(server.port()).reset();
  const auto backseat = connectOne();
  EXPECT_EQ(vehicle.connected.size(), 1U);
  server.send(1, "telemetry");
  EXPECT_TRUE(runUntil(io, [&] { return backseat->log.received == "telemetry"; }));
}

TEST_F(Server, ASendToAClientThatIsGoneIsItsEnd) {
  Socket client = connectedTo(server.port());
  ASSERT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1; }));
  client.reset();
  server.send(1, "telemetry");
  server.send(1, "telemetry");
  ASSERT_TRUE(runUntil(io, [&] { return !vehicle.disconnected.empty(); }));
  io.poll();
  EXPECT_EQ(vehicle.disconnected, (std::vector<TcpServer::ClientId>{1}));
}

struct BadBind {
  const char* name;
  const char* address;
  const char* text;
};

const BadBind kBadBinds[] = {
    {"not_numeric", "localhost", "cannot listen on localhost port 29500: Invalid argument"},
    {"not_ours", "192.0.2.1",
     "cannot listen on 192.0.2.1 port 29500: Cannot assign requested address"}};

class BindFailure : public ::testing::TestWithParam<BadBind> {};

TEST_P(BindFailure, NamesAddressAndPort) {
  boost::asio::io_context io;
  ServerLog vehicle;
  try {
    const TcpServer server(io, GetParam().address, 29500, vehicle);
    FAIL() << "listens";
  } catch (const boost::system::system_error& error) {
    EXPECT_STREQ(error.what(), GetParam().text);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BindFailure, ::testing::ValuesIn(kBadBinds),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Server, TakesAClientThatCameWhileNoFileCouldBeOpened) {
  using boost::asio::ip::tcp;
  tcp::socket client(io, tcp::v4());
  {
    const NoMoreFiles scarce;
    client.connect({boost::asio::ip::make_address("127.0.0.1"), server.port()});
    io.run_for(milliseconds(50));
    EXPECT_TRUE(vehicle.connected.empty());
  }
  EXPECT_TRUE(runUntil(io, [&] { return vehicle.connected.size() == 1; }));
}

TEST(ServerLimits, MayBeClosedWhileNoFileCanBeOpened) {
  boost::asio::io_context io;
  ServerLog vehicle;
  TcpServer server(io, "127.0.0.1", 0, vehicle);
  const Socket client = connectedTo(server.port());
  const NoMoreFiles scarce;
  io.run_for(milliseconds(50));  // it has tried and waits
  server.close();
  io.restart();
  io.run();  // ends, since nothing is left to do
  EXPECT_TRUE(vehicle.connected.empty());
}

TEST_F(Server, NeedsAFileToListen) {
  failSockets(EMFILE);  // and no other file: a sanitizer needs some to look into what is thrown
  try {
    const TcpServer second(io, "127.0.0.1", 29500, vehicle);
    ADD_FAILURE() << "listens";
  } catch (const boost::system::system_error& error) {
    EXPECT_STREQ(error.what(), "cannot listen on 127.0.0.1 port 29500: Too many open files");
  }
  failSockets(0);
}

TEST_F(Server, ASecondOneOnThePortIsRefused) {
  EXPECT_THROW(TcpServer(io, "127.0.0.1", server.port(), vehicle), boost::system::system_error);
}

}  // namespace
}  // namespace frontseat_driver::link::testing
