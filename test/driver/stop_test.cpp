#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "test/driver/fake_parts.h"
#include "test/link/interposed.h"

namespace frontseat_driver::driver::testing {
namespace {

using link::testing::FullVehicle;
using link::testing::RawVehicle;
using link::testing::ReservedPort;
using link::testing::Socket;
using link::testing::waitUntil;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

const std::string kSentence = "$PYDIR,0.000,0.000*00\r\n";

milliseconds timeOf(const std::function<void()>& action) {
  const auto begin = steady_clock::now();
  action();
  return std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
}

/// Telemetry as fast as it is taken, and no reading, until the connection ends.
void floodUntilTheEnd(const Socket& socket) {
  const std::string telemetry(65536, 't');
  while (send(socket.fd(), telemetry.data(), telemetry.size(), MSG_NOSIGNAL) > 0) {
  }
}

/// Each scene returns how long stop() took there.
milliseconds stopWhileResolving() {
  link::testing::hangNames();
  Rig rig("hanging.test", 1);
  const std::size_t threads_before = link::testing::threads();
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return link::testing::threads() == threads_before + 2; }));
  const auto took = timeOf([&] { rig.driver.stop(); });
  link::testing::releaseHangingNames();
  EXPECT_TRUE(waitUntil([&] { return link::testing::threads() == threads_before; }));
  return took;
}

milliseconds stopWhileConnecting() {
  const FullVehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  const std::size_t open_idle = link::testing::openFileDescriptors();
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return link::testing::openFileDescriptors() > open_idle; }));
  const auto took = timeOf([&] { rig.driver.stop(); });
  EXPECT_TRUE(rig.log.entries().empty());
  return took;
}

milliseconds stopWhileBackingOff() {
  const ReservedPort port;
  auto options = link::testing::quickOptions("127.0.0.1", port.port());
  options.reconnect_min = options.reconnect_max = std::chrono::seconds(60);
  Rig rig(options);
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return rig.listener.failures == 1; }));
  return timeOf([&] { rig.driver.stop(); });
}

milliseconds stopWhileConnected() {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.listener.connects == 1; }));
  return timeOf([&] { rig.driver.stop(); });
}

milliseconds stopWithAPeerThatDoesNotRead() {
  const RawVehicle vehicle(4096);
  Rig rig("127.0.0.1", vehicle.port());
  std::atomic<bool> full{false};
  rig.session.on_connected = [&](const Now& now, session::Output& out) {
    while (out.send(now, "s")) {
    }
    full = true;
  };
  rig.driver.start();
  const Socket peer = vehicle.accept();
  EXPECT_TRUE(waitUntil([&] { return full.load(); }));
  return timeOf([&] { rig.driver.stop(); });
}

milliseconds stopWithAPeerThatFloods() {
  const RawVehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  const Socket peer = vehicle.accept();
  std::thread flood([&] { floodUntilTheEnd(peer); });
  EXPECT_TRUE(waitUntil([&] { return rig.session.bytes_received > 10000000; }));
  const auto took = timeOf([&] { rig.driver.stop(); });
  flood.join();
  return took;
}

milliseconds stopBeforeStart() {
  Rig rig("127.0.0.1", 1);
  const auto took = timeOf([&] { rig.driver.stop(); });
  rig.driver.start();  // has no effect any more
  EXPECT_TRUE(rig.log.entries().empty());
  return took;
}

milliseconds stopRightAfterStart() {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  return timeOf([&] { rig.driver.stop(); });
}

milliseconds stopOfABusySession() {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.next_step = SteadyTime::min();
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  return timeOf([&] { rig.driver.stop(); });
}

/// The session never comes to an end of its last words.
milliseconds stopOfASessionThatDoesNotLeave() {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.has_left = false;
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  return timeOf([&] { rig.driver.stop(); });
}

/// Somebody goes on posting tasks all the time.
milliseconds stopUnderPosts() {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  std::atomic<bool> over{false};
  std::thread posts([&] {
    while (!over) {
      rig.driver.post([](const Now&) {});
      poll(nullptr, 0, 0);
    }
  });
  EXPECT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  const auto took = timeOf([&] { rig.driver.stop(); });
  over = true;
  posts.join();
  return took;
}

struct Scene {
  const char* name;
  milliseconds (*stop)();
};

const Scene kScenes[] = {{"resolving", stopWhileResolving},
                         {"connecting", stopWhileConnecting},
                         {"backing_off", stopWhileBackingOff},
                         {"connected", stopWhileConnected},
                         {"peer_that_does_not_read", stopWithAPeerThatDoesNotRead},
                         {"peer_that_floods", stopWithAPeerThatFloods},
                         {"not_started", stopBeforeStart},
                         {"just_started", stopRightAfterStart},
                         {"session_always_due", stopOfABusySession},
                         {"session_that_does_not_leave", stopOfASessionThatDoesNotLeave},
                         {"posts", stopUnderPosts}};

class Stop : public ::testing::TestWithParam<Scene> {};

TEST_P(Stop, IsOverWithin100Milliseconds) {
  milliseconds best = GetParam().stop();
  for (int more = 0; more < 2 && best >= milliseconds(100); ++more) {  // the machine may be busy
    best = std::min(best, GetParam().stop());
  }
  EXPECT_LT(best, milliseconds(100));
}

INSTANTIATE_TEST_SUITE_P(Table, Stop, ::testing::ValuesIn(kScenes),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(StopOrder, NothingFollowsTheEndOfTheConnection) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.on_receive = [&](auto&, auto, auto&) { rig.log.add("receive"); };
  rig.session.on_step = [&](auto&, auto&) { rig.log.add("step"); };
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.log.has("step"); }));
  vehicle.send("telemetry");
  rig.driver.stop();
  rig.driver.post([&](const Now&) { rig.log.add("task"); });
  const auto entries = rig.log.entries();
  ASSERT_GE(entries.size(), 2U);
  EXPECT_EQ(entries[entries.size() - 2], "session disconnected");
  EXPECT_EQ(entries.back(), "disconnected: closed by the backseat");
  EXPECT_EQ(rig.log.count("session disconnected"), 1U);
}

TEST(StopOrder, WhatWasPostedBeforeReachesTheVehicleThenTheEnd) {
  for (int i = 0; i < 20; ++i) {
    const RawVehicle vehicle;
    Rig rig("127.0.0.1", vehicle.port());
    rig.driver.start();
    const Socket peer = vehicle.accept();
    ASSERT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
    rig.driver.post([&](const Now&) {
      rig.session.on_step = [sent = false](const Now& now, session::Output& out) mutable {
        if (std::exchange(sent, true)) return;
        EXPECT_TRUE(out.send(now, kSentence));
      };
    });
    rig.driver.stop();
    const auto heard = link::testing::readToEnd(peer);
    EXPECT_EQ(heard.bytes, kSentence);
    EXPECT_EQ(heard.error, 0);
  }
}

TEST(StopOrder, LastWordsReachTheVehicleThenTheEnd) {
  const RawVehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.on_leave = [&](const Now& now, session::Output& out) {
    EXPECT_TRUE(out.send(now, "one "));
    rig.session.has_left = false;
    rig.session.next_step = now.steady + milliseconds(5);
    rig.session.on_step = [&](const Now& later, session::Output& output) {
      if (later.steady < rig.session.next_step) return;
      EXPECT_TRUE(output.send(later, "two"));
      rig.session.has_left = true;
    };
  };
  rig.driver.start();
  const Socket peer = vehicle.accept();
  ASSERT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  rig.driver.stop();
  const auto heard = link::testing::readToEnd(peer);
  EXPECT_EQ(heard.bytes, "one two");
  EXPECT_EQ(heard.error, 0);
}

TEST(StopOrder, NoTaskIsTakenAnyMore) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.has_left = false;  // so that there is time for it
  rig.session.on_leave = [&](auto&, auto&) {
    rig.driver.post([&](const Now&) { rig.log.add("task"); });
  };
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  rig.driver.stop();
  EXPECT_FALSE(rig.log.has("task"));
}

TEST(StopOrder, AgainAndFromSeveralThreads) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
  std::vector<std::thread> stoppers;
  for (int i = 0; i < 4; ++i) {
    stoppers.emplace_back([&] {
      rig.driver.stop();
      EXPECT_TRUE(rig.log.has("disconnected: closed by the backseat"));
    });
  }
  for (std::thread& stopper : stoppers) stopper.join();
  rig.driver.stop();
  EXPECT_EQ(rig.log.count("disconnected: closed by the backseat"), 1U);
}

TEST(StopOrder, TwentyDriversLeaveNothingBehind) {
  Vehicle vehicle;
  std::size_t open_before = 0;
  std::size_t threads_before = 0;
  for (int i = 0; i <= 20; ++i) {
    Rig rig("localhost", vehicle.port());
    rig.driver.start();
    ASSERT_TRUE(waitUntil([&] { return rig.listener.connects == 1; }));
    rig.driver.stop();
    if (i > 0) continue;
    open_before = link::testing::openFileDescriptors();
    threads_before = link::testing::threads();
  }
  EXPECT_TRUE(waitUntil([&] { return link::testing::openFileDescriptors() <= open_before; }));
  EXPECT_TRUE(waitUntil([&] { return link::testing::threads() <= threads_before; }));
}

}  // namespace
}  // namespace frontseat_driver::driver::testing
