#include "frontseat_driver/sim/simulator_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "bench.h"

namespace frontseat_driver::sim {
namespace {

using boost::asio::ip::tcp;

ServerConfig onAnyPort(double speed = 1.0) {
  ServerConfig config;
  config.port = 0;
  config.speed = speed;
  return config;
}

/// A plain client that blocks until it has what it waits for.
class Payload {
 public:
  explicit Payload(std::uint16_t port) : socket_(io_) {
    socket_.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  }

  void tell(const std::string& body) {
    boost::asio::write(socket_, boost::asio::buffer(sentence(body)));
  }

  /// The next `count` lines that begin with `start`; fewer if the connection ends.
  std::vector<std::string> hear(const std::string& start, std::size_t count) {
    std::vector<std::string> lines;
    while (lines.size() < count) {
      const std::string line = nextLine();
      if (line.empty()) break;
      if (line.rfind(start, 0) == 0) lines.push_back(line);
    }
    return lines;
  }

 private:
  std::string nextLine() {
    for (;;) {
      const std::size_t end = buffer_.find("\r\n");
      if (end != std::string::npos) {
        const std::string line = buffer_.substr(0, end);
        buffer_.erase(0, end + 2);
        return line;
      }
      char chunk[4096];
      boost::system::error_code error;
      const std::size_t size = socket_.read_some(boost::asio::buffer(chunk), error);
      if (error) return {};
      buffer_.append(chunk, size);
    }
  }

  boost::asio::io_context io_;
  tcp::socket socket_;
  std::string buffer_;
};

/// Truths, collected on the server's thread.
class Collector {
 public:
  void operator()(const Truth& truth) {
    const std::lock_guard<std::mutex> lock{mutex_};
    truths_.push_back(truth);
  }
  std::vector<Truth> truths() {
    const std::lock_guard<std::mutex> lock{mutex_};
    return truths_;
  }

 private:
  std::mutex mutex_;
  std::vector<Truth> truths_;
};

TEST(Server, SpeaksSandsharkOverTcp) {
  SimulatorServer server{std::make_unique<SandsharkFrontseat>(runningSandshark()), onAnyPort()};
  EXPECT_NE(server.port(), 0);
  server.start();
  Payload payload{server.port()};
  EXPECT_THAT(payload.hear("$BFVER", 1), testing::SizeIs(1));
  payload.tell("BPLOG,ACK,ON");
  payload.tell("BPLOG,NVG,ON");
  EXPECT_THAT(payload.hear("$BFACK", 1),
              testing::ElementsAre(testing::HasSubstr(",LOG,,,2,0,logging on,")));
  EXPECT_THAT(payload.hear("$BFNVG", 3), testing::SizeIs(3));
}

TEST(Server, ServesSeveralClientsAndThoseThatComeLater) {
  SimulatorServer server{std::make_unique<KingfisherFrontseat>(restingKingfisher()),
                         onAnyPort(20.0)};
  server.start();
  Payload first{server.port()};
  EXPECT_THAT(first.hear("$CPNVG", 3), testing::SizeIs(3));
  {
    Payload second{server.port()};
    EXPECT_THAT(second.hear("$CPNVG", 3), testing::SizeIs(3));
  }
  Payload third{server.port()};
  EXPECT_THAT(third.hear("$CPNVG", 3), testing::SizeIs(3));
  EXPECT_THAT(first.hear("$CPNVG", 30), testing::SizeIs(30));
}

TEST(Server, TimeGoesFasterAndNoInstantIsLeftOut) {
  auto truths = std::make_shared<Collector>();
  SimulatorServer server{std::make_unique<KingfisherFrontseat>(restingKingfisher()),
                         onAnyPort(50.0), [truths](const Truth& truth) { (*truths)(truth); }};
  server.start();
  Payload payload{server.port()};
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_THAT(payload.hear("$CPNVG", 300), testing::SizeIs(300));  // 30 s of the vehicle
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took, std::chrono::seconds{20});
  server.stop();
  const std::vector<Truth> all = truths->truths();
  ASSERT_GE(all.size(), 300U);
  EXPECT_EQ(all[0].stamp, kNoon);
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_EQ(all[i].stamp - all[i - 1].stamp, std::chrono::milliseconds{100});
  }
}

TEST(Server, LetsTheVehicleBeControlledFromOutside) {
  SimulatorServer server{std::make_unique<SandsharkFrontseat>(runningSandshark()), onAnyPort()};
  server.start();
  Payload payload{server.port()};
  payload.tell("BPLOG,CTL,ON");
  payload.tell("BPLOG,ACK,ON");
  payload.tell("BPSTS,120000.000,1,ready");
  ASSERT_THAT(payload.hear("$BFACK", 1), testing::SizeIs(1));
  server.post([](Frontseat& vehicle) {
    dynamic_cast<SandsharkFrontseat&>(vehicle).setBackseatControl(false);
  });
  EXPECT_THAT(payload.hear("$BFCTL", 1), testing::ElementsAre(testing::HasSubstr(",0*")));
}

TEST(Server, StopEndsConnectionsAndCanBeCalledTwice) {
  SimulatorServer server{std::make_unique<SandsharkFrontseat>(runningSandshark()), onAnyPort()};
  server.start();
  Payload payload{server.port()};
  ASSERT_THAT(payload.hear("$BFVER", 1), testing::SizeIs(1));
  server.stop();
  server.stop();
  EXPECT_THAT(payload.hear("$", 1), testing::IsEmpty());
}

TEST(Server, IsGoneWithoutEverHavingStarted) {
  const SimulatorServer server{std::make_unique<SandsharkFrontseat>(runningSandshark()),
                               onAnyPort()};
  EXPECT_NE(server.port(), 0);
}

TEST(Server, APortThatIsTakenIsAnErrorThatNamesIt) {
  SimulatorServer server{std::make_unique<SandsharkFrontseat>(runningSandshark()), onAnyPort()};
  ServerConfig same;
  same.port = server.port();
  try {
    SimulatorServer second{std::make_unique<SandsharkFrontseat>(runningSandshark()), same};
    FAIL() << "two servers on one port";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(std::to_string(same.port)));
  }
}

TEST(Server, DisconnectsAsTheFaultsWant) {
  SandsharkConfig config = runningSandshark();
  config.faults.disconnect_every_s = 5.0;
  SimulatorServer server{std::make_unique<SandsharkFrontseat>(config), onAnyPort(50.0)};
  server.start();
  for (int i = 0; i < 3; ++i) {
    Payload payload{server.port()};
    EXPECT_THAT(payload.hear("$", 1000), testing::SizeIs(1));  // BFVER, then the end
  }
}

}  // namespace
}  // namespace frontseat_driver::sim
