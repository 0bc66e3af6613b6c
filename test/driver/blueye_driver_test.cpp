// Driver, session and link together against a drone's sockets, on ports the system picks.

#include "frontseat_driver/driver/blueye_driver.h"

#include <gtest/gtest.h>
#include <zmq.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "blueye/control.pb.h"
#include "blueye/req_rep.pb.h"
#include "blueye/telemetry.pb.h"

namespace frontseat_driver::driver {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace pb = blueye::protocol;

/// Registers whoever asks, and gives control to whoever is no observer. Runs on a thread of its own
/// until it is destroyed.
class Drone {
 public:
  Drone() : thread_([this] { run(); }) {}
  ~Drone() {
    done_ = true;
    thread_.join();
    for (void* socket : {telemetry_, requests_, control_}) zmq_close(socket);
    zmq_ctx_term(context_);
  }
  Drone(const Drone&) = delete;
  Drone& operator=(const Drone&) = delete;

  link::ZmqClient::Options options() const {
    link::ZmqClient::Options options;
    options.host = "127.0.0.1";
    options.telemetry_port = telemetry_port_;
    options.request_port = request_port_;
    options.control_port = control_port_;
    options.silence_timeout = 60s;
    return options;
  }

  std::vector<pb::MotionInput> motions() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return motions_;
  }
  /// Says whatever it is, again and again.
  void say(std::vector<std::string> frames) {
    const std::lock_guard<std::mutex> lock(mutex_);
    says_ = std::move(frames);
  }
  /// Takes requests and answers none, unless `on`.
  void answer(bool on) { answers_ = on; }
  bool heardGoodbye() const { return goodbye_; }
  bool heardAnything() const { return heard_control_; }

 private:
  void* bound(int type, std::uint16_t& port) {
    void* const socket = zmq_socket(context_, type);
    const int none = 0;
    zmq_setsockopt(socket, ZMQ_LINGER, &none, sizeof none);
    if (type == ZMQ_SUB) zmq_setsockopt(socket, ZMQ_SUBSCRIBE, "", 0);
    const std::string where = "tcp://127.0.0.1:" + (port == 0 ? "*" : std::to_string(port));
    while (zmq_bind(socket, where.c_str()) != 0) {  // the port of a socket just closed
    }
    char address[64] = {};
    std::size_t size = sizeof address;
    zmq_getsockopt(socket, ZMQ_LAST_ENDPOINT, address, &size);
    const std::string text = address;
    port = static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
    return socket;
  }

  static std::string receive(void* socket) {
    char bytes[4096];
    const int size = zmq_recv(socket, bytes, sizeof bytes, 0);
    return {bytes, size > 0 ? static_cast<std::size_t>(size) : 0};
  }

  void run() {
    while (!done_) {
      zmq_pollitem_t items[] = {{requests_, 0, ZMQ_POLLIN, 0}, {control_, 0, ZMQ_POLLIN, 0}};
      zmq_poll(items, 2, 5);
      speak();
      if ((items[0].revents & ZMQ_POLLIN) != 0) answer();
      if ((items[1].revents & ZMQ_POLLIN) != 0) obey();
    }
  }

  void speak() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = 0; i < says_.size(); ++i) {
      const int more = i + 1 < says_.size() ? ZMQ_SNDMORE : 0;
      zmq_send(telemetry_, says_[i].data(), says_[i].size(), more);
    }
  }

  void answer() {
    const std::string type = receive(requests_);
    const std::string payload = receive(requests_);
    if (!answers_) return refuse();
    std::string name = "google.protobuf.Empty";
    std::string bytes;
    if (type == "blueye.protocol.ConnectClientReq") {
      pb::ConnectClientReq request;
      request.ParseFromString(payload);
      pb::ConnectClientRep reply;
      reply.set_client_id(++last_id_);
      reply.set_client_id_in_control(request.client_info().is_observer() ? 0 : last_id_);
      reply.add_connected_clients()->set_client_id(last_id_);
      name = reply.GetTypeName();
      bytes = reply.SerializeAsString();
    } else if (type == "blueye.protocol.DisconnectClientReq") {
      goodbye_ = true;
    }
    zmq_send(requests_, name.data(), name.size(), ZMQ_SNDMORE);
    zmq_send(requests_, bytes.data(), bytes.size(), 0);
  }

  /// Leaves the request without a reply, and is ready for the next one.
  void refuse() {
    zmq_close(requests_);
    requests_ = bound(ZMQ_REP, request_port_);
  }

  void obey() {
    const std::string type = receive(control_);
    const std::string payload = receive(control_);
    heard_control_ = true;
    if (type != "blueye.protocol.MotionInputCtrl") return;
    pb::MotionInputCtrl control;
    control.ParseFromString(payload);
    const std::lock_guard<std::mutex> lock(mutex_);
    motions_.push_back(control.motion_input());
  }

  void* const context_ = zmq_ctx_new();
  std::uint16_t telemetry_port_ = 0;
  std::uint16_t request_port_ = 0;
  std::uint16_t control_port_ = 0;
  void* const telemetry_ = bound(ZMQ_PUB, telemetry_port_);
  void* requests_ = bound(ZMQ_REP, request_port_);
  void* const control_ = bound(ZMQ_SUB, control_port_);
  std::uint32_t last_id_ = 0;
  std::atomic<bool> answers_{true};
  std::atomic<bool> goodbye_{false};
  std::atomic<bool> heard_control_{false};
  mutable std::mutex mutex_;
  std::vector<pb::MotionInput> motions_;
  std::vector<std::string> says_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

struct Listener : BlueyeLinkListener, session::BlueyeListener {
  void onConnected(const vehicle::Now&, const std::string&) override { connected = true; }
  void onDisconnected(const vehicle::Now&, const std::string&) override {
    connected = false;
    ++losses;
  }
  void onConnectFailed(const vehicle::Now&, const std::string&) override { ++failures; }
  void onControlSent(const vehicle::Now&, std::string_view, std::string_view) override {}
  void onRequestSent(const vehicle::Now&, std::string_view, std::string_view) override {
    ++requests;
  }
  void onTick(const vehicle::Now& now) override {
    const std::lock_guard<std::mutex> lock(mutex);
    ticks.push_back(now.steady);
  }
  void telemetry(const vehicle::Now&, std::string_view type, std::string_view payload) override {
    ++messages;
    pb::DepthTel told;
    if (type == "blueye.protocol.DepthTel" &&
        told.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) {
      depth_m = told.depth().value();
    }
  }
  void event(const vehicle::Now&, const vehicle::Event& event) override {
    if (const auto* control = std::get_if<vehicle::Control>(&event)) grant = control->grant;
  }
  void clients(const vehicle::Now&) override {}
  void note(const std::string&) override {}

  std::atomic<bool> connected{false};
  std::atomic<int> losses{0};
  std::atomic<int> failures{0};
  std::atomic<int> requests{0};
  std::atomic<int> messages{0};
  std::atomic<float> depth_m{0.0F};
  std::atomic<vehicle::Grant> grant{vehicle::Grant::Unknown};
  std::mutex mutex;
  std::vector<vehicle::SteadyTime> ticks;
};

vehicle::Now clocks() {
  vehicle::Now now;
  now.steady = Clock::now();
  now.utc = now.stamp = std::chrono::system_clock::now().time_since_epoch();
  return now;
}

template <class Condition>
bool eventually(Condition holds) {
  const auto give_up = Clock::now() + 30s;
  while (!holds() && Clock::now() < give_up) std::this_thread::yield();
  return holds();
}

bool isZero(const pb::MotionInput& motion) {
  return motion.surge() == 0.0F && motion.sway() == 0.0F && motion.heave() == 0.0F &&
         motion.yaw() == 0.0F;
}

TEST(BlueyeDriver, DrivesAndLeavesTheDroneAtRest) {
  Drone drone;
  Listener listener;
  session::BlueyeOptions options;
  options.observer = false;
  session::BlueyeSession session(options, listener);
  BlueyeDriver driver(drone.options(), session, listener, clocks);
  driver.start();
  ASSERT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Granted; }));
  const auto drive = [&] {
    driver.post([&](const vehicle::Now& now) {
      vehicle::MotionCommand motion;
      motion.surge = 0.5;
      session.command(now, motion, now.steady);
    });
  };
  ASSERT_TRUE(eventually([&] {
    drive();
    const auto motions = drone.motions();
    return !motions.empty() && motions.back().surge() == 0.5F;
  }));
  drive();
  driver.stop();
  ASSERT_TRUE(eventually([&] { return isZero(drone.motions().back()); }));
  EXPECT_TRUE(eventually([&] { return drone.heardGoodbye(); }));
  EXPECT_FALSE(listener.connected);
}

/// What is said of a command that is read so long after the last tick, after a halt perhaps. Time
/// goes slowly from there on, so that it is read soon on a busy computer, too.
std::string refusalOfACommandRead(std::chrono::milliseconds after_the_last_tick) {
  constexpr int kSlowness = 20;
  Drone drone;
  Listener listener;
  session::BlueyeOptions options;
  options.observer = false;
  session::BlueyeSession session(options, listener);
  std::atomic<bool> went_on{false};
  vehicle::Now last;
  vehicle::SteadyTime from;
  BlueyeDriver driver(drone.options(), session, listener, [&] {
    const vehicle::Now now = clocks();
    if (!went_on) return last = now;
    vehicle::Now later = last;
    later.steady = from + (now.steady - last.steady) / kSlowness;
    return later;
  });
  driver.start();
  EXPECT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Granted; }));
  std::string refusal;
  std::atomic<bool> told{false};
  driver.post([&](const vehicle::Now&) {
    const std::lock_guard<std::mutex> lock(listener.mutex);
    from = listener.ticks.back() + after_the_last_tick;
    went_on = true;
  });
  driver.post([&](const vehicle::Now& now) {
    refusal = session.command(now, vehicle::MotionCommand{}, now.steady);
    told = true;
  });
  EXPECT_TRUE(eventually([&] { return told.load(); }));
  driver.stop();
  return refusal;
}

TEST(BlueyeDriver, TakesNothingForNewThatCameWhileItStoodStill) {
  const std::string stood_still = "it may have come long ago, while the driver stood still";
  EXPECT_EQ(refusalOfACommandRead(3s), stood_still);
  EXPECT_EQ(refusalOfACommandRead(1700ms), stood_still);
  EXPECT_EQ(refusalOfACommandRead(1350ms), "");
}

// Time goes slowly while it leaves, so that no limit of it ends the wait on a busy computer.
TEST(BlueyeDriver, ClosesItsConnectionsWhenItsGoodbyeHasBeenAnswered) {
  constexpr int kSlowness = 20;
  Drone drone;
  Listener listener;
  session::BlueyeSession session({}, listener);
  std::atomic<bool> stopping{false};
  vehicle::Now last;
  bool left_while_connected = false;
  BlueyeDriver driver(drone.options(), session, listener, [&] {
    const vehicle::Now now = clocks();
    if (!stopping) last = now;
    left_while_connected = left_while_connected || (session.hasLeft() && listener.connected);
    vehicle::Now slow = last;
    slow.steady += (now.steady - last.steady) / kSlowness;
    return slow;
  });
  driver.start();
  ASSERT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Denied; }));
  stopping = true;
  driver.stop();
  EXPECT_TRUE(left_while_connected);
}

TEST(BlueyeDriver, AnObserverComesAndGoesWithoutAControlMessage) {
  Drone drone;
  Listener listener;
  session::BlueyeSession session({}, listener);
  BlueyeDriver driver(drone.options(), session, listener, clocks);
  driver.start();
  ASSERT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Denied; }));
  driver.stop();
  EXPECT_TRUE(eventually([&] { return drone.heardGoodbye(); }));
  EXPECT_FALSE(drone.heardAnything());
}

template <class Message>
std::vector<std::string> frames(const Message& message) {
  return {message.GetTypeName(), message.SerializeAsString()};
}

pb::DroneTimeTel upFor(std::int64_t seconds) {
  pb::DroneTimeTel time;
  time.mutable_monotonic_clock()->mutable_unix_timestamp()->set_seconds(seconds);
  return time;
}

TEST(BlueyeDriver, HandsOnWhatTheDroneSaysAndCountsWhatIsNoMessage) {
  Drone drone;
  Listener listener;
  session::BlueyeSession session({}, listener);
  BlueyeDriver driver(drone.options(), session, listener, clocks);
  driver.start();
  pb::DepthTel depth;
  depth.mutable_depth()->set_value(2.5F);
  drone.say(frames(depth));
  EXPECT_TRUE(eventually([&] { return listener.depth_m == 2.5F; }));
  drone.say({"one frame"});
  std::atomic<std::uint64_t> malformed{0};
  EXPECT_TRUE(eventually([&] {
    driver.post([&](const vehicle::Now&) { malformed = session.counters().malformed; });
    return malformed > 0;
  }));
  driver.stop();
}

TEST(BlueyeDriver, RegistersWithADroneThatDidNotAnswerAtFirst) {
  Drone drone;
  drone.answer(false);
  Listener listener;
  session::BlueyeSession session({}, listener);
  BlueyeDriver driver(drone.options(), session, listener, clocks);
  driver.start();
  ASSERT_TRUE(eventually([&] { return listener.requests > 1; }));
  EXPECT_EQ(listener.grant, vehicle::Grant::Unknown);
  drone.answer(true);
  EXPECT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Denied; }));
  driver.stop();
}

TEST(BlueyeDriver, ConnectsAfreshToADroneThatStartedAgain) {
  Drone drone;
  Listener listener;
  session::BlueyeSession session({}, listener);
  BlueyeDriver driver(drone.options(), session, listener, clocks);
  drone.say(frames(upFor(1000)));
  driver.start();
  driver.start();  // has no effect
  ASSERT_TRUE(eventually(
      [&] { return listener.grant == vehicle::Grant::Denied && listener.messages > 0; }));
  ASSERT_TRUE(eventually([&] {
    drone.say(frames(upFor(listener.losses == 0 ? 5 : 6)));
    return listener.losses > 0 && listener.connected;
  }));
  EXPECT_TRUE(eventually([&] { return listener.grant == vehicle::Grant::Denied; }));
  driver.stop();
  driver.stop();  // nor has this
}

TEST(BlueyeDriver, TellsOfADroneThatIsNotThere) {
  Listener listener;
  session::BlueyeSession session({}, listener);
  link::ZmqClient::Options options;
  {
    Drone gone;
    options = gone.options();
  }
  options.connect_timeout = 50ms;
  BlueyeDriver driver(options, session, listener, clocks);
  driver.start();
  EXPECT_TRUE(eventually([&] { return listener.failures > 0; }));
  driver.stop();
}

TEST(BlueyeDriver, TicksAtOnceAndThenOnceASecond) {
  Listener listener;
  session::BlueyeSession session({}, listener);
  link::ZmqClient::Options options;
  {
    Drone gone;
    options = gone.options();
  }
  BlueyeDriver driver(options, session, listener, clocks);
  const auto begin = Clock::now();
  driver.start();
  ASSERT_TRUE(eventually([&] {
    const std::lock_guard<std::mutex> lock(listener.mutex);
    return listener.ticks.size() >= 3;
  }));
  driver.stop();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(listener.ticks[i] - begin, std::chrono::seconds(i));
    EXPECT_LT(listener.ticks[i] - begin, std::chrono::seconds(i) + 900ms);
  }
}

TEST(BlueyeDriver, StopsSoonWithoutADrone) {
  Listener listener;
  session::BlueyeSession session({}, listener);
  link::ZmqClient::Options options;
  {
    Drone gone;
    options = gone.options();
  }
  BlueyeDriver driver(options, session, listener, clocks);
  driver.start();
  driver.stop();
  driver.post([&](const vehicle::Now&) { FAIL() << "posted after the end"; });
  EXPECT_FALSE(listener.connected);
}

}  // namespace
}  // namespace frontseat_driver::driver
