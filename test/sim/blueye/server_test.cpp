// The drone behind real sockets, on ports that the system picks.
#include "frontseat_driver/sim/blueye/server.h"

#include <gtest/gtest.h>
#include <zmq.h>

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>
#include <zmq.hpp>

#include "deck.h"
#include "test/link/no_more_files.h"

namespace frontseat_driver::sim {
namespace {

using Frames = std::vector<std::string>;
constexpr int kPatience_ms = 20000;

BlueyeServerConfig anyPorts() {
  BlueyeServerConfig config;
  config.telemetry_port = config.request_port = config.control_port = config.http_port = 0;
  return config;
}

/// A client's socket; receiving waits long enough for a busy machine, and no longer.
class Client {
 public:
  Client(zmq::context_t& context, int type, std::uint16_t port) : socket_(context, type) {
    set(ZMQ_LINGER, 0);
    set(ZMQ_RCVTIMEO, kPatience_ms);
    if (type == ZMQ_SUB) zmq_setsockopt(raw(), ZMQ_SUBSCRIBE, "", 0);
    zmq_connect(raw(), ("tcp://127.0.0.1:" + std::to_string(port)).c_str());
  }

  void send(const Frames& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const int more = i + 1 < frames.size() ? ZMQ_SNDMORE : 0;
      zmq_send(raw(), frames[i].data(), frames[i].size(), more);
    }
  }

  /// Empty if nothing came in time.
  Frames receive() {
    Frames frames;
    int more = 1;
    while (more != 0) {
      zmq_msg_t part;
      zmq_msg_init(&part);
      if (zmq_msg_recv(&part, raw(), 0) < 0) return {};
      frames.emplace_back(static_cast<const char*>(zmq_msg_data(&part)), zmq_msg_size(&part));
      more = zmq_msg_more(&part);
      zmq_msg_close(&part);
    }
    return frames;
  }

  template <class Reply, class Request>
  std::optional<Reply> ask(const Request& request) {
    send({request.GetTypeName(), request.SerializeAsString()});
    const Frames frames = receive();
    Reply reply;
    if (frames.size() != 2 || frames[0] != reply.GetTypeName()) return std::nullopt;
    if (!reply.ParseFromString(frames[1])) return std::nullopt;
    return reply;
  }

  void set(int option, int value) { zmq_setsockopt(raw(), option, &value, sizeof value); }

 private:
  void* raw() { return static_cast<void*>(socket_); }
  zmq::socket_t socket_;
};

class Server : public testing::Test {
 protected:
  void SetUp() override { server.start(); }

  /// Telemetry until one of that name.
  static std::string waitFor(Client& telemetry, const std::string& name) {
    for (;;) {
      const Frames frames = telemetry.receive();
      if (frames.size() != 2 || frames[0] == name) return frames.size() == 2 ? frames[1] : "";
    }
  }

  /// What the drone's thread sees.
  template <class Value>
  Value look(std::function<Value(BlueyeDrone&)> at) {
    std::promise<Value> seen;
    server.post([&](BlueyeDrone& drone) { seen.set_value(at(drone)); });
    return seen.get_future().get();
  }

  std::string get(const std::string& request) {
    boost::asio::io_context io;
    boost::asio::ip::tcp::socket socket{io};
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), server.httpPort()});
    boost::asio::write(socket, boost::asio::buffer(request));
    std::string answer;
    boost::system::error_code error;
    boost::asio::read(socket, boost::asio::dynamic_buffer(answer), error);
    return answer;
  }

  zmq::context_t context{1};
  BlueyeServer server{quietDrone(), anyPorts()};
};

TEST_F(Server, AnswersAndTellsInTwoFrames) {
  Client telemetry{context, ZMQ_SUB, server.telemetryPort()};
  Client requests{context, ZMQ_REQ, server.requestPort()};
  EXPECT_TRUE(requests.ask<bp::PingRep>(bp::PingReq{}));
  const auto connected = requests.ask<bp::ConnectClientRep>(bp::ConnectClientReq{});
  ASSERT_TRUE(connected);
  EXPECT_EQ(connected->client_id(), connected->client_id_in_control());
  bp::DepthTel depth;
  EXPECT_TRUE(depth.ParseFromString(waitFor(telemetry, "blueye.protocol.DepthTel")));
}

TEST_F(Server, MovesByControlMessages) {
  Client telemetry{context, ZMQ_SUB, server.telemetryPort()};
  Client requests{context, ZMQ_REQ, server.requestPort()};
  Client controls{context, ZMQ_PUB, server.controlPort()};
  bp::WatchdogCtrl watchdog;
  watchdog.set_client_id(
      requests.ask<bp::ConnectClientRep>(bp::ConnectClientReq{}).value().client_id());
  bp::MotionInputCtrl motion;
  motion.mutable_motion_input()->set_surge(1.0F);
  double speed = 0.0;
  for (int i = 0; i < 200 && speed < 0.3; ++i) {
    controls.send({watchdog.GetTypeName(), watchdog.SerializeAsString()});
    controls.send({motion.GetTypeName(), motion.SerializeAsString()});
    bp::PositionEstimateTel estimate;
    estimate.ParseFromString(waitFor(telemetry, estimate.GetTypeName()));
    speed = estimate.position_estimate().surge_rate();
  }
  EXPECT_GE(speed, 0.3);
}

TEST_F(Server, AnswersEveryoneAtOnce) {
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 20; ++i) {
    clients.push_back(std::make_unique<Client>(context, ZMQ_REQ, server.requestPort()));
    bp::PingReq ping;
    clients.back()->send({ping.GetTypeName(), ""});
  }
  for (const auto& client : clients) {
    EXPECT_EQ(client->receive(), (Frames{"blueye.protocol.PingRep", ""}));
  }
}

struct Hostile {
  const char* name;
  Frames frames;
  bool answered;
};
class HostileRequest : public Server, public testing::WithParamInterface<Hostile> {};

TEST_P(HostileRequest, CostsItselfAlone) {
  {
    Client hostile{context, ZMQ_DEALER, server.requestPort()};
    hostile.send(GetParam().frames);
    if (GetParam().answered) {
      const Frames answer = hostile.receive();
      ASSERT_EQ(answer.size(), 3U);
      EXPECT_EQ(answer[1], "google.protobuf.Empty");
    }
    Client requests{context, ZMQ_REQ, server.requestPort()};
    EXPECT_TRUE(requests.ask<bp::PingRep>(bp::PingReq{}));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, HostileRequest,
    testing::Values(Hostile{"no_delimiter", {"blueye.protocol.PingReq", ""}, false},
                    Hostile{"one_frame", {"", "blueye.protocol.PingReq"}, true},
                    Hostile{"three_frames", {"", "blueye.protocol.PingReq", "", ""}, true},
                    Hostile{"nothing", {""}, true}, Hostile{"empty_frames", {"", "", ""}, true},
                    Hostile{"too_long", {"", "x", std::string(5U << 20, 'x')}, false},
                    Hostile{"bytes", {"", "\xff\xfe", "\x01\x02\x03"}, true}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Server, HostileControlsCostThemselvesAlone) {
  Client telemetry{context, ZMQ_SUB, server.telemetryPort()};
  Client controls{context, ZMQ_PUB, server.controlPort()};
  Client requests{context, ZMQ_REQ, server.requestPort()};
  bp::LightsCtrl lights;
  lights.mutable_lights()->set_value(0.5F);
  double seen = 0.0;
  for (int i = 0; i < 200 && seen < 0.4; ++i) {
    controls.send({"one frame"});
    controls.send({"blueye.protocol.LightsCtrl", "three", "frames"});
    controls.send({"blueye.protocol.LightsCtrl", "\xff\xff\xff"});
    controls.send({"nobody.knows.Me", "x"});
    controls.send({"", ""});
    controls.send({lights.GetTypeName(), lights.SerializeAsString()});
    bp::LightsTel told;
    told.ParseFromString(waitFor(telemetry, told.GetTypeName()));
    seen = told.lights().value();
  }
  EXPECT_NEAR(seen, 0.5, 1e-6);
  EXPECT_GE(server.malformed(), 2U);
  EXPECT_TRUE(requests.ask<bp::PingRep>(bp::PingReq{}));
}

TEST_F(Server, HostileTelemetrySubscribersAreIgnored) {
  using std::string_literals::operator""s;
  boost::asio::io_context io;
  for (const std::uint16_t port :
       {server.telemetryPort(), server.requestPort(), server.controlPort()}) {
    boost::asio::ip::tcp::socket socket{io};
    socket.connect({boost::asio::ip::make_address("127.0.0.1"), port});
    boost::asio::write(socket, boost::asio::buffer("GET / HTTP/1.1\r\n\r\n\xff\x00"s));
  }
  Client requests{context, ZMQ_REQ, server.requestPort()};
  EXPECT_TRUE(requests.ask<bp::PingRep>(bp::PingReq{}));
}

TEST_F(Server, TellsDroneInfoOverHttp) {
  const std::string answer = get("GET /diagnostics/drone_info HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_NE(answer.find("200 OK"), std::string::npos) << answer;
  EXPECT_NE(answer.find("\"sw_version\": \"4.4.2-simulated\""), std::string::npos) << answer;
  EXPECT_NE(answer.find("\"serial_number\": \"SIM000001\""), std::string::npos) << answer;
  EXPECT_NE(answer.find("\"features\": \"tilt,gpdrone,lasers\""), std::string::npos) << answer;
}

struct Page {
  const char* name;
  std::string request;
  const char* status;  ///< empty: the connection ends, with or without an answer
};
class Pages : public Server, public testing::WithParamInterface<Page> {};

TEST_P(Pages, AreAnsweredInTheirWay) {
  const std::string answer = get(GetParam().request);
  EXPECT_NE(answer.find(GetParam().status), std::string::npos) << answer;
  EXPECT_NE(get("GET /diagnostics/drone_info HTTP/1.0\r\n\r\n").find("200 OK"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Pages,
    testing::Values(Page{"other", "GET /pictures HTTP/1.1\r\nHost: x\r\n\r\n", "404"},
                    Page{"logs", "GET /logs HTTP/1.1\r\nHost: x\r\n\r\n", "\r\n\r\n[]"},
                    Page{"csv_logs", "GET /logcsv?all=True HTTP/1.1\r\n\r\n", "\r\n\r\n[]"},
                    Page{"one_log", "GET /logs/1/binlog HTTP/1.1\r\n\r\n", "404"},
                    Page{"query", "GET /diagnostics/drone_info?x=1 HTTP/1.1\r\n\r\n", "200"},
                    Page{"head", "HEAD /diagnostics/drone_info HTTP/1.1\r\n\r\n", "200"},
                    Page{"post",
                         "POST /diagnostics/drone_info HTTP/1.1\r\n"
                         "Content-Length: 0\r\n\r\n",
                         "405"},
                    Page{"noise", std::string(200, '\xff') + "\r\n\r\n", ""},
                    Page{"endless_header",
                         "GET / HTTP/1.1\r\nx: " + std::string(20000, 'x') + "\r\n\r\n", ""}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST_F(Server, IsBackOnTheSamePortsAfterAReboot) {
  Client telemetry{context, ZMQ_SUB, server.telemetryPort()};
  Client requests{context, ZMQ_REQ, server.requestPort()};
  requests.ask<bp::ConnectClientRep>(bp::ConnectClientReq{});
  waitFor(telemetry, "blueye.protocol.DepthTel");
  server.post([](BlueyeDrone& drone) {
    drone.faults().reboot_s = 0.5;
    drone.reboot();
  });
  bp::ConnectedClientsTel clients;
  do {
    ASSERT_TRUE(clients.ParseFromString(waitFor(telemetry, clients.GetTypeName())));
  } while (clients.connected_clients_size() > 0);
  // A new socket, as clients open one: the old one may have lost its question.
  Client again{context, ZMQ_REQ, server.requestPort()};
  const auto connected = again.ask<bp::ConnectClientRep>(bp::ConnectClientReq{});
  ASSERT_TRUE(connected);
  EXPECT_EQ(connected->client_id(), 1U);
}

TEST_F(Server, ComesBackFromARebootWhenFilesCanBeOpenedAgain) {
  Client telemetry{context, ZMQ_SUB, server.telemetryPort()};
  ASSERT_NE(waitFor(telemetry, "blueye.protocol.DepthTel"), "");
  const auto online = [&] { return look<bool>([](BlueyeDrone& drone) { return drone.online(); }); };
  {
    server.post([](BlueyeDrone& drone) {
      drone.faults().reboot_s = 0.2;
      drone.reboot();
    });
    while (online()) {
    }
    // A sanitizer needs files to look into the first of its kind.
    EXPECT_NE(zmq::error_t{}.what(), nullptr);
    link::testing::NoMoreFiles scarce;
    while (!online()) scarce.takeAll();
    scarce.takeAll();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(online());  // it lives, without its ports
  }
  Client again{context, ZMQ_SUB, server.telemetryPort()};
  EXPECT_NE(waitFor(again, "blueye.protocol.DepthTel"), "");
}

TEST_F(Server, AnswersOverHttpWhenFilesCanBeOpenedAgain) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::socket visitor{io};
  visitor.open(boost::asio::ip::tcp::v4());
  {
    const link::testing::NoMoreFiles scarce;
    visitor.connect({boost::asio::ip::make_address("127.0.0.1"), server.httpPort()});
    std::atomic<bool> turned{false};  // no future: a sanitizer needs files to look into one
    server.post([&](BlueyeDrone&) { turned = true; });
    while (!turned) std::this_thread::yield();
  }
  const std::string request = "GET /diagnostics/drone_info HTTP/1.1\r\nHost: x\r\n\r\n";
  boost::asio::write(visitor, boost::asio::buffer(request));
  std::string answer;
  boost::system::error_code error;
  boost::asio::read(visitor, boost::asio::dynamic_buffer(answer), error);
  EXPECT_NE(answer.find("200 OK"), std::string::npos) << answer;
}

TEST(ServerPorts, WithoutThatOfHttpADroneIsOnlyWhereThatIsAllowed) {
  const BlueyeServer first{quietDrone(), anyPorts()};
  BlueyeServerConfig same = anyPorts();
  same.http_port = first.httpPort();
  const std::string where = "127.0.0.1:" + std::to_string(same.http_port);
  same.http_optional = true;
  const BlueyeServer second{quietDrone(), same};
  EXPECT_NE(second.httpProblem().find(where), std::string::npos) << second.httpProblem();
  EXPECT_EQ(second.httpPort(), 0);
  same.http_optional = false;
  try {
    const BlueyeServer third{quietDrone(), same};
    FAIL() << "both serve HTTP at " << where;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string{error.what()}.find(where), std::string::npos) << error.what();
  }
}

TEST(ServerPorts, TakenOnesAreNamed) {
  BlueyeServer first{quietDrone(), anyPorts()};
  BlueyeServerConfig same = anyPorts();
  same.request_port = first.requestPort();
  try {
    BlueyeServer second{quietDrone(), same};
    FAIL() << "both listen on port " << same.request_port;
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string{error.what()}.find(std::to_string(same.request_port)), std::string::npos)
        << error.what();
  }
}

TEST(ServerPorts, StopEndsEverything) {
  BlueyeServer server{quietDrone(), anyPorts()};
  server.start();
  server.stop();
  server.stop();
  BlueyeServerConfig same = anyPorts();
  same.request_port = server.requestPort();
  BlueyeServer again{quietDrone(), same};
  EXPECT_EQ(again.requestPort(), server.requestPort());
}

}  // namespace
}  // namespace frontseat_driver::sim
