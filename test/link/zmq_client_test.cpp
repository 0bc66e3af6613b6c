// The three sockets against ones of ours, on ports the system picks.

#include "frontseat_driver/link/zmq_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <zmq.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "test/link/no_more_files.h"

namespace frontseat_driver::link::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Message = std::vector<std::string>;

/// A bound socket that never waits.
class Socket {
 public:
  Socket(void* context, int type, std::uint16_t port) : socket_(zmq_socket(context, type)) {
    const int none = 0;
    zmq_setsockopt(socket_, ZMQ_LINGER, &none, sizeof none);
    zmq_setsockopt(socket_, ZMQ_SNDHWM, &none, sizeof none);  // no limit: it loses nothing itself
    if (type == ZMQ_SUB) zmq_setsockopt(socket_, ZMQ_SUBSCRIBE, "", 0);
    const std::string where = "tcp://127.0.0.1:" + (port == 0 ? "*" : std::to_string(port));
    const auto give_up = Clock::now() + 10s;  // the port of a socket just closed
    while (zmq_bind(socket_, where.c_str()) != 0 && Clock::now() < give_up) {
    }
  }
  ~Socket() { zmq_close(socket_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  std::uint16_t port() const {
    char address[64] = {};
    std::size_t size = sizeof address;
    zmq_getsockopt(socket_, ZMQ_LAST_ENDPOINT, address, &size);
    const std::string text = address;
    return static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
  }

  void send(const Message& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const int more = i + 1 < frames.size() ? ZMQ_SNDMORE : 0;
      zmq_send(socket_, frames[i].data(), frames[i].size(), more);
    }
  }

  /// Empty if there is none now.
  Message receive() {
    Message frames;
    int more = 1;
    while (more != 0) {
      zmq_msg_t frame;
      zmq_msg_init(&frame);
      if (zmq_msg_recv(&frame, socket_, ZMQ_DONTWAIT) < 0) return frames;
      frames.emplace_back(static_cast<char*>(zmq_msg_data(&frame)), zmq_msg_size(&frame));
      more = zmq_msg_more(&frame);
      zmq_msg_close(&frame);
    }
    return frames;
  }

 private:
  void* socket_;
};

/// The drone's three sockets.
struct Drone {
  explicit Drone(void* context, ZmqClient::Options at = ports(0, 0, 0))
      : telemetry(context, ZMQ_PUB, at.telemetry_port),
        requests(context, ZMQ_REP, at.request_port),
        control(context, ZMQ_SUB, at.control_port) {}

  static ZmqClient::Options ports(std::uint16_t telemetry, std::uint16_t request,
                                  std::uint16_t control) {
    ZmqClient::Options options;
    options.host = "127.0.0.1";
    options.telemetry_port = telemetry;
    options.request_port = request;
    options.control_port = control;
    options.reconnect_min = 20ms;
    options.reconnect_max = 40ms;
    options.connect_timeout = 300ms;
    options.silence_timeout = 60s;
    return options;
  }
  ZmqClient::Options options() const {
    return ports(telemetry.port(), requests.port(), control.port());
  }

  Socket telemetry;
  Socket requests;
  Socket control;
};

struct Recorder : ZmqClient::Handler {
  void onConnected(const std::string& at) override {
    connected.push_back(at);
    then("connected");
  }
  void onTelemetry(std::string_view type, std::string_view payload) override {
    telemetry.push_back({std::string{type}, std::string{payload}});
    then("telemetry");
  }
  void onReply(std::string_view type, std::string_view payload) override {
    replies.push_back({std::string{type}, std::string{payload}});
    then("reply");
  }
  void onNoReply(const std::string& reason) override {
    lost.push_back(reason);
    then("no_reply");
  }
  void onMalformed() override {
    ++malformed;
    then("malformed");
  }
  void onDisconnected(const std::string& reason) override {
    disconnected.push_back(reason);
    then("disconnected");
  }
  void onConnectFailed(const std::string& reason) override {
    failed.push_back(reason);
    then("failed");
  }

  std::function<void(const std::string& report)> then = [](const std::string&) {};
  std::vector<std::string> connected, disconnected, failed, lost;
  std::vector<Message> telemetry, replies;
  int malformed = 0;
};

class ZmqLink : public ::testing::Test {
 protected:
  ~ZmqLink() override {
    client_.reset();
    drone_.reset();
    zmq_ctx_term(context_);
  }

  void start(std::function<void(ZmqClient::Options&)> change = {}) {
    drone_ = std::make_unique<Drone>(context_);
    options_ = drone_->options();
    if (change) change(options_);
    client_ = std::make_unique<ZmqClient>(options_, recorder_);
    client_->start();
  }

  /// Runs the client until `done`; false if that takes longer than any machine needs.
  bool runUntil(const std::function<bool()>& done) {
    const auto give_up = Clock::now() + 30s;
    while (Clock::now() < give_up) {
      if (done()) return true;
      client_->run(Clock::now() + 5ms);
    }
    return false;
  }

  /// The next control message that is none of those that connect() tries.
  Message nextControl() {
    Message control;
    runUntil([&] {
      control = drone_->control.receive();
      return !control.empty() && control[0] != "first";
    });
    return control;
  }

  /// Connected, and the drone's subscriptions have arrived as well.
  void connect() {
    ASSERT_TRUE(runUntil([&] { return client_->connected(); }));
    ASSERT_TRUE(runUntil([&] {
      drone_->telemetry.send({"first", ""});
      client_->publish("first", "");
      return !recorder_.telemetry.empty() && !drone_->control.receive().empty();
    }));
    while (!drone_->control.receive().empty()) {
    }
    recorder_.telemetry.clear();
  }

  void* context_ = zmq_ctx_new();
  std::unique_ptr<Drone> drone_;
  ZmqClient::Options options_;
  Recorder recorder_;
  std::unique_ptr<ZmqClient> client_;
};

TEST_F(ZmqLink, CarriesAllThreeKindsOfMessages) {
  start();
  connect();
  EXPECT_EQ(recorder_.connected.size(), 1u);
  EXPECT_EQ(recorder_.connected[0], "127.0.0.1:" + std::to_string(options_.telemetry_port));
  const std::string bytes{"\0\x01\xff with a zero", 15};
  drone_->telemetry.send({"blueye.protocol.DepthTel", bytes});
  ASSERT_TRUE(runUntil(
      [&] { return !recorder_.telemetry.empty() && recorder_.telemetry.back()[0] != "first"; }));
  EXPECT_THAT(recorder_.telemetry.back(), ElementsAre("blueye.protocol.DepthTel", bytes));
  ASSERT_TRUE(client_->publish("blueye.protocol.LightsCtrl", bytes));
  EXPECT_THAT(nextControl(), ElementsAre("blueye.protocol.LightsCtrl", bytes));
  ASSERT_TRUE(client_->request("blueye.protocol.PingReq", "", 30s));
  EXPECT_FALSE(client_->request("blueye.protocol.PingReq", "", 30s)) << "one at a time";
  Message request;
  ASSERT_TRUE(runUntil([&] { return !(request = drone_->requests.receive()).empty(); }));
  EXPECT_THAT(request, ElementsAre("blueye.protocol.PingReq", ""));
  drone_->requests.send({"blueye.protocol.PingRep", ""});
  ASSERT_TRUE(runUntil([&] { return !recorder_.replies.empty(); }));
  EXPECT_THAT(recorder_.replies[0], ElementsAre("blueye.protocol.PingRep", ""));
}

TEST_F(ZmqLink, GoesOnAfterALostReplyAndNeverTakesALateOneForTheNext) {
  start();
  connect();
  ASSERT_TRUE(client_->request("A", "1", 50ms));
  Message first;
  ASSERT_TRUE(runUntil([&] { return !(first = drone_->requests.receive()).empty(); }));
  ASSERT_TRUE(runUntil([&] { return !recorder_.lost.empty(); }));
  EXPECT_THAT(recorder_.lost[0], HasSubstr("0.1 s"));
  drone_->requests.send({"ARep", "late"});
  ASSERT_TRUE(client_->request("B", "2", 30s));
  Message second;
  ASSERT_TRUE(runUntil([&] { return !(second = drone_->requests.receive()).empty(); }));
  EXPECT_THAT(second, ElementsAre("B", "2"));
  drone_->requests.send({"BRep", "good"});
  ASSERT_TRUE(runUntil([&] { return !recorder_.replies.empty(); }));
  EXPECT_THAT(recorder_.replies, ElementsAre(ElementsAre("BRep", "good")));
  EXPECT_THAT(recorder_.disconnected, IsEmpty());
}

TEST_F(ZmqLink, TakesAnAddressOfIpv6WithAndWithoutBrackets) {
  for (const char* host : {"::1", "[::1]"}) {
    recorder_.failed.clear();
    start([&](ZmqClient::Options& options) { options.host = host; });
    ASSERT_TRUE(runUntil([&] { return !recorder_.failed.empty(); })) << host;  // none listens there
    EXPECT_THAT(recorder_.failed[0], HasSubstr("[::1]:")) << host;
  }
}

TEST_F(ZmqLink, CountsMessagesThatHaveNotTwoFrames) {
  start();
  connect();
  drone_->telemetry.send({"one"});
  drone_->telemetry.send({"one", "two", "three", "four"});
  drone_->telemetry.send({"good", "x"});
  ASSERT_TRUE(runUntil(
      [&] { return !recorder_.telemetry.empty() && recorder_.telemetry.back()[0] == "good"; }));
  EXPECT_EQ(recorder_.malformed, 2);
}

TEST_F(ZmqLink, AReplyOfOneFrameIsNoneAndTheNextRequestIsSent) {
  start();
  connect();
  for (const Message& reply : {Message{"one"}, Message{"one", "two", "three"}}) {
    recorder_.lost.clear();
    ASSERT_TRUE(client_->request("A", "1", 30s));
    ASSERT_TRUE(runUntil([&] { return !drone_->requests.receive().empty(); }));
    drone_->requests.send(reply);
    ASSERT_TRUE(runUntil([&] { return !recorder_.lost.empty(); }));
    EXPECT_THAT(recorder_.lost, ElementsAre("the reply had not two frames"));
  }
  EXPECT_THAT(recorder_.replies, IsEmpty());
  EXPECT_TRUE(client_->request("A", "2", 30s));
}

TEST_F(ZmqLink, RefusesControlThatTheDroneDoesNotTake) {
  start();
  connect();
  const std::string payload(1 << 16, 'x');
  std::size_t taken = 0;
  while (client_->publish("Ctrl", payload)) ++taken;  // the drone reads nothing
  EXPECT_GT(taken, 0u);
  EXPECT_TRUE(client_->connected());
  ASSERT_TRUE(runUntil([&] {
    while (!drone_->control.receive().empty()) {
    }
    return client_->publish("last", "");
  }));
  EXPECT_THAT(recorder_.disconnected, IsEmpty());
}

TEST_F(ZmqLink, TellsNothingBeforeAllThreeConnectionsAreThere) {
  for (const auto missing : {&ZmqClient::Options::telemetry_port, &ZmqClient::Options::request_port,
                             &ZmqClient::Options::control_port}) {
    recorder_ = {};
    const Message telemetry{"DepthTel", ""};
    void* const gone = zmq_ctx_new();
    const std::uint16_t port = Socket(gone, ZMQ_REP, 0).port();
    zmq_ctx_term(gone);
    start([&](ZmqClient::Options& options) { options.*missing = port; });
    ASSERT_TRUE(runUntil([&] {
      drone_->telemetry.send(telemetry);
      return !recorder_.failed.empty();
    }));
    EXPECT_THAT(recorder_.failed[0], HasSubstr(":" + std::to_string(port) + " "));
    EXPECT_THAT(recorder_.telemetry, IsEmpty());
    EXPECT_THAT(recorder_.connected, IsEmpty());
  }
}

/// Accepts connections and ends them.
class NoDrone {
 public:
  NoDrone() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 8), 0);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~NoDrone() { close(listener_); }
  NoDrone(const NoDrone&) = delete;
  NoDrone& operator=(const NoDrone&) = delete;

  std::uint16_t port() const { return port_; }
  void endAll() {
    for (int peer = accept(listener_); peer >= 0; peer = accept(listener_)) close(peer);
  }

 private:
  static int accept(int listener) { return ::accept(listener, nullptr, nullptr); }

  int listener_;
  std::uint16_t port_ = 0;
};

TEST_F(ZmqLink, APeerThatEndsEveryConnectionIsNoDrone) {
  NoDrone peer;
  start([&](ZmqClient::Options& options) { options.request_port = peer.port(); });
  ASSERT_TRUE(runUntil([&] {
    peer.endAll();
    return !recorder_.failed.empty();
  }));
  EXPECT_THAT(recorder_.failed[0],
              HasSubstr("no answer at 127.0.0.1:" + std::to_string(peer.port())));
  EXPECT_THAT(recorder_.connected, IsEmpty());
  EXPECT_THAT(recorder_.disconnected, IsEmpty());
}

TEST_F(ZmqLink, MayBeClosedFromInsideEveryReport) {
  for (const std::string report :
       {"connected", "telemetry", "reply", "no_reply", "malformed", "disconnected", "failed"}) {
    SCOPED_TRACE(report);
    recorder_ = {};
    start([](ZmqClient::Options& options) { options.silence_timeout = 500ms; });
    bool closed = false;
    recorder_.then = [&](const std::string& heard) {
      EXPECT_FALSE(closed && heard != "disconnected") << heard << " after the end";
      if (heard == report && !closed) {
        closed = true;
        client_->close();
      }
    };
    if (report == "failed") drone_.reset();
    ASSERT_TRUE(runUntil([&] {
      if (closed || !drone_) return closed;
      if (report == "telemetry") drone_->telemetry.send({"DepthTel", ""});
      if (report == "malformed") drone_->telemetry.send({"one"});
      if (report == "reply") client_->request("A", "", 30s);
      if (report == "no_reply") client_->request("A", "", 10ms);
      if (report == "reply" && !drone_->requests.receive().empty()) {
        drone_->requests.send({"ARep", ""});
      }
      return closed;
    }));
    client_->start();
    client_->reconnect("too late");
    client_->run(Clock::now());
    EXPECT_FALSE(client_->connected());
    EXPECT_EQ(recorder_.disconnected.size(), recorder_.connected.size());
    client_->close();
    EXPECT_EQ(recorder_.disconnected.size(), recorder_.connected.size()) << "told once";
  }
}

TEST_F(ZmqLink, NoticesALostDroneConnectsToItsSuccessorAndBringsItNothingOld) {
  start();
  connect();
  drone_.reset();
  ASSERT_TRUE(runUntil([&] { return !recorder_.disconnected.empty(); }));
  EXPECT_THAT(recorder_.disconnected[0], HasSubstr("closed the connection"));
  EXPECT_FALSE(client_->publish("old", ""));
  EXPECT_FALSE(client_->request("old", "", 1s));
  drone_ = std::make_unique<Drone>(context_, options_);
  ASSERT_TRUE(runUntil([&] { return client_->connected(); }));
  EXPECT_EQ(recorder_.connected.size(), 2u);
  Message control;
  ASSERT_TRUE(runUntil([&] {
    client_->publish("new", "");
    return !(control = drone_->control.receive()).empty();
  }));
  EXPECT_EQ(control[0], "new");
}

TEST_F(ZmqLink, TakesSilenceForALostLink) {
  start([](ZmqClient::Options& options) { options.silence_timeout = 200ms; });
  ASSERT_TRUE(runUntil([&] { return !recorder_.disconnected.empty(); }));
  EXPECT_EQ(recorder_.disconnected[0], "nothing heard for 0.2 s");
  ASSERT_TRUE(runUntil([&] { return recorder_.connected.size() > 1; }));
}

TEST_F(ZmqLink, ReportsADroneThatIsNotThereAndFindsItLater) {
  void* const gone = zmq_ctx_new();
  options_ = Drone(gone).options();
  zmq_ctx_term(gone);  // else its sockets would answer for a moment yet
  client_ = std::make_unique<ZmqClient>(options_, recorder_);
  client_->start();
  ASSERT_TRUE(runUntil([&] { return !recorder_.failed.empty(); }));
  EXPECT_THAT(recorder_.failed[0], HasSubstr("no answer at 127.0.0.1:"));
  drone_ = std::make_unique<Drone>(context_, options_);
  EXPECT_TRUE(runUntil([&] { return client_->connected(); }));
  EXPECT_THAT(recorder_.disconnected, IsEmpty());
}

TEST_F(ZmqLink, ReportsAHostThatIsNoneAndTriesAgain) {
  for (const char* host : {"tcp://127.0.0.1", "127.0.0.1:5555", "a;b", ""}) {
    recorder_.failed.clear();
    options_ = ZmqClient::Options{};
    options_.host = host;
    options_.reconnect_min = 10ms;
    options_.connect_timeout = 100ms;
    client_ = std::make_unique<ZmqClient>(options_, recorder_);
    ASSERT_NO_THROW(client_->start()) << host;
    ASSERT_TRUE(runUntil([&] { return recorder_.failed.size() > 1; })) << host;
    EXPECT_THAT(recorder_.failed[0], HasSubstr(host));
    EXPECT_FALSE(client_->connected());
    ASSERT_NO_THROW(client_->close()) << host;
  }
}

TEST_F(ZmqLink, ReportsATimeThatIsNone) {
  start([](ZmqClient::Options& options) { options.connect_timeout = -1s; });
  ASSERT_TRUE(runUntil([&] { return !recorder_.failed.empty(); }));
  EXPECT_THAT(recorder_.failed[0], HasSubstr("Invalid argument"));
}

TEST_F(ZmqLink, SaysThatNoFileCanBeOpenedForIt) {
  for (const bool one_left : {false, true}) {
    std::exception_ptr thrown;  // looked into later: a sanitizer needs files to do so
    {
      NoMoreFiles scarce;
      if (one_left) scarce.spareOne();
      try {
        const ZmqClient client(options_, recorder_);
      } catch (const std::runtime_error&) {
        thrown = std::current_exception();
      }
      const int left = dup(2);
      EXPECT_EQ(left >= 0, one_left) << "none is kept";
      close(left);
    }
    ASSERT_TRUE(thrown) << "made from nothing";
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(), HasSubstr("Too many open files"));
    }
  }
}

TEST_F(ZmqLink, SurvivesThatNoSocketCanBeOpened) {
  start();
  connect();
  {
    NoMoreFiles scarce;
    client_->reconnect("test");
    ASSERT_TRUE(runUntil([&] {
      scarce.takeAll();
      return !recorder_.failed.empty() &&
             recorder_.failed.back().find("Too many open files") != std::string::npos;
    }));
    EXPECT_FALSE(client_->connected());
  }
  EXPECT_TRUE(runUntil([&] { return client_->connected(); }));
}

TEST_F(ZmqLink, LosesTheLinkWhenTheSocketOfALostReplyCannotBeReplaced) {
  start();
  connect();
  {
    NoMoreFiles scarce;
    // The monitor that goes first may leave its files to its successor once.
    ASSERT_TRUE(runUntil([&] {
      scarce.takeAll();
      client_->request("A", "1", 50ms);
      return !recorder_.disconnected.empty();
    }));
    EXPECT_THAT(recorder_.disconnected[0], HasSubstr("Too many open files"));
    EXPECT_FALSE(recorder_.lost.empty());
  }
  EXPECT_TRUE(runUntil([&] { return client_->connected(); }));
}

TEST_F(ZmqLink, ConnectsAfreshWhenItIsTold) {
  start();
  connect();
  client_->reconnect("the drone was rebooted");
  EXPECT_FALSE(client_->connected());
  EXPECT_THAT(recorder_.disconnected, ElementsAre("the drone was rebooted"));
  EXPECT_TRUE(runUntil([&] { return recorder_.connected.size() == 2; }));
}

TEST_F(ZmqLink, DeliversTheLastWordsBeforeItCloses) {
  start();
  connect();
  ASSERT_TRUE(client_->publish("last", "words"));
  ASSERT_TRUE(client_->request("good", "bye", 30s));
  client_->close();
  EXPECT_THAT(recorder_.disconnected, ElementsAre("closed"));
  EXPECT_THAT(nextControl(), ElementsAre("last", "words"));
  Message request;
  EXPECT_TRUE(runUntil([&] { return !(request = drone_->requests.receive()).empty(); }));
  EXPECT_THAT(request, ElementsAre("good", "bye"));
  client_->run(Clock::now());
  EXPECT_FALSE(client_->connected());
}

TEST_F(ZmqLink, IsWokenFromAnotherThread) {
  start();
  connect();
  std::thread other([&] { client_->wake(); });
  const auto long_ago = Clock::now();
  const auto later = long_ago + 30s;
  client_->run(later);
  other.join();
  EXPECT_LT(Clock::now(), later);
}

#ifdef __SANITIZE_THREAD__
constexpr std::size_t kImageBytes = 1 << 12;  // each 8 are a report that test/tsan.supp hides
#else
constexpr std::size_t kImageBytes = 1 << 20;
#endif

/// What a drone with a sonar sends in a second, ten times: nothing is lost while it is read.
TEST_F(ZmqLink, LosesNothingOfAKilohertzOfTelemetryWithSonarImages) {
  constexpr int kMessages = 2000;
  constexpr int kBetweenImages = 50;
  start();
  connect();
  std::thread publisher([&] {
    const std::string image(kImageBytes, 'x');
    for (int i = 0; i < kMessages; ++i) {
      drone_->telemetry.send({"Small", std::to_string(i)});
      if (i % kBetweenImages == 0) drone_->telemetry.send({"Image", image});
    }
  });
  std::size_t small = 0;
  std::size_t images = 0;
  bool in_order = true;
  const auto count = [&] {
    for (const Message& message : recorder_.telemetry) {
      if (message[0] == "Small") in_order = in_order && message[1] == std::to_string(small++);
      if (message[0] == "Image") images += message[1].size() == kImageBytes ? 1u : 0u;
    }
    recorder_.telemetry.clear();
    return small == kMessages;
  };
  EXPECT_TRUE(runUntil(count));
  publisher.join();
  EXPECT_TRUE(in_order);
  EXPECT_EQ(images, static_cast<std::size_t>(kMessages / kBetweenImages));
}

}  // namespace
}  // namespace frontseat_driver::link::testing
