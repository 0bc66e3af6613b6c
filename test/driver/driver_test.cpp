#include "frontseat_driver/driver/driver.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <functional>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "test/driver/fake_parts.h"

namespace frontseat_driver::driver::testing {
namespace {

using link::testing::RawVehicle;
using link::testing::ReservedPort;
using link::testing::waitUntil;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Strings = std::vector<std::string>;

/// Lets the driver's thread do all that it has been given so far.
void drain(Driver& driver) {
  std::promise<void> done;
  driver.post([&](const Now&) { done.set_value(); });
  done.get_future().wait();
}

TEST(Driver, CallsInOrder) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.on_receive = [&](const Now&, std::string_view bytes, session::Output&) {
    rig.log.add("receive " + std::string(bytes));
  };
  rig.session.on_step = [&](const Now&, session::Output&) { rig.log.add("step"); };
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.log.has("step"); }));
  vehicle.send("$");
  ASSERT_TRUE(waitUntil([&] { return rig.log.count("step") == 2; }));
  const std::string endpoint = "127.0.0.1:" + std::to_string(vehicle.port());
  vehicle.disconnect();
  ASSERT_TRUE(
      waitUntil([&] { return rig.log.has("disconnected: vehicle closed the connection"); }));
  rig.driver.stop();
  const auto entries = rig.log.entries();
  ASSERT_GE(entries.size(), 8U);
  EXPECT_EQ(
      Strings(entries.begin(), entries.begin() + 8),
      (Strings{"connected to " + endpoint, "session connected", "step", "receive $", "step",
               "session disconnected", "step", "disconnected: vehicle closed the connection"}));
}

TEST(Driver, PassesOnWhatTheSessionSays) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.on_connected = [&](const Now& now, session::Output& out) {
    EXPECT_TRUE(out.send(now, "$BPVER*1A\r\n"));
    out.heard(now, "$BFVER");
    out.event(now, vehicle::Shutdown{});
  };
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return vehicle.received() == "$BPVER*1A\r\n"; }));
  drain(rig.driver);
  const auto entries = rig.log.entries();
  const auto shutdown = vehicle::Event(vehicle::Shutdown{}).index();
  EXPECT_EQ(Strings(entries.begin() + 1, entries.end()),
            (Strings{"session connected", "sent $BPVER*1A", "heard $BFVER",
                     "event " + std::to_string(shutdown)}));
}

TEST(Driver, WhatWasNotTakenWasNotSent) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  int steps = 0;
  rig.session.on_step = [&](const Now& now, session::Output& out) {
    ++steps;
    EXPECT_FALSE(out.send(now, "$BPVER*1A\r\n"));
  };
  rig.driver.post([](const Now&) {});
  rig.driver.start();
  rig.driver.stop();
  EXPECT_GE(steps, 1);
  EXPECT_FALSE(rig.log.has("sent $BPVER*1A"));
}

TEST(Driver, ToldOfAVehicleThatTakesNothing) {
  const RawVehicle vehicle(4096);
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  const auto deaf = vehicle.accept();
  std::atomic<bool> congested{false};
  EXPECT_TRUE(waitUntil([&] {
    rig.driver.post([&](const Now& now) {
      rig.driver.output().send(now, "$BPVER*1A\r\n");
      congested = rig.driver.output().congested();
    });
    return congested.load();
  }));
  rig.driver.stop();
}

TEST(Driver, AFewSentencesOnTheirWayAreNoCongestion) {
  const RawVehicle vehicle(4096);
  Rig rig("127.0.0.1", vehicle.port());
  rig.driver.start();
  const auto deaf = vehicle.accept();
  const std::string sentence = "$BPVER*1A\r\n";
  std::size_t bytes_sent = 0;
  const auto congested_after_one_more = [&] {
    std::promise<bool> congested;
    rig.driver.post([&](const Now& now) {
      if (rig.driver.output().send(now, sentence)) bytes_sent += sentence.size();
      congested.set_value(rig.driver.output().congested());
    });
    return congested.get_future().get();
  };
  EXPECT_TRUE(waitUntil(congested_after_one_more));
  EXPECT_GT(bytes_sent, 240U);  // three sentences of 80 bytes
  rig.driver.stop();
}

/// The wait after the fourth loss and one failed attempt, when only the last connection was good
/// if `confirmed`, and none otherwise. The steps are 5, 10, 20, 20 ms.
milliseconds waitAfterLosses(bool confirmed) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  rig.session.on_receive = [&](const Now&, std::string_view, session::Output& out) {
    if (confirmed) out.confirmed();
  };
  Vehicle vehicle(port.port());
  rig.driver.start();
  for (std::size_t i = 1; i <= 4; ++i) {
    EXPECT_TRUE(waitUntil([&] { return rig.listener.connects == i && vehicle.clients() == i; }));
    if (i < 4) vehicle.disconnect();
  }
  vehicle.send("good");
  EXPECT_TRUE(waitUntil([&] { return rig.session.bytes_received == 4; }));
  vehicle.close();
  EXPECT_TRUE(waitUntil([&] { return rig.listener.failures == 1; }));
  const milliseconds retry(rig.listener.last_retry_ms.load());
  rig.driver.stop();
  return retry;
}

TEST(Driver, ConfirmsTheLink) {
  EXPECT_LE(waitAfterLosses(true), milliseconds(10));
  EXPECT_GE(waitAfterLosses(false), milliseconds(10));
}

TEST(Driver, OneClockReadingPerRead) {
  Vehicle vehicle;
  std::atomic<int> readings{0};
  Rig rig("127.0.0.1", vehicle.port(), [&] {
    Now now = systemNow();
    now.utc = std::chrono::nanoseconds(++readings);
    return now;
  });
  std::vector<vehicle::UtcTime> times;
  rig.session.on_receive = [&](const Now& now, auto, auto&) { times.push_back(now.utc); };
  rig.session.on_step = [&](const Now& now, auto&) { times.push_back(now.utc); };
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.listener.connects == 1; }));
  vehicle.send("$");
  ASSERT_TRUE(waitUntil([&] { return rig.session.bytes_received == 1; }));
  rig.driver.stop();
  using std::chrono::nanoseconds;
  times.resize(3);  // up to the step after the read
  EXPECT_EQ(times, (std::vector<vehicle::UtcTime>{nanoseconds(1), nanoseconds(2), nanoseconds(2)}));
}

/// How old the time of the step was that followed work which took a while.
milliseconds ageOfTheStepAfter(const std::function<void(Rig&, Vehicle&)>& begin_work) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  std::promise<steady_clock::duration> age;
  bool worked = false;
  rig.session.on_receive = [&](const Now& now, auto, auto&) {
    while (steady_clock::now() < now.steady + milliseconds(300)) {
    }
    worked = true;
  };
  rig.session.on_step = [&](const Now& now, auto&) {
    if (std::exchange(worked, false)) age.set_value(steady_clock::now() - now.steady);
  };
  rig.driver.start();
  EXPECT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.listener.connects == 1; }));
  begin_work(rig, vehicle);
  const auto found = age.get_future().get();
  rig.driver.stop();
  return std::chrono::duration_cast<milliseconds>(found);
}

TEST(Driver, WhatHeldItUpMakesNothingStaleLookFresh) {
  EXPECT_LT(ageOfTheStepAfter([](Rig&, Vehicle& vehicle) { vehicle.send("$"); }),
            milliseconds(300));
  EXPECT_LT(ageOfTheStepAfter([](Rig& rig, Vehicle&) {
              rig.driver.post(
                  [&](const Now& now) { rig.session.receive(now, "$", rig.driver.output()); });
            }),
            milliseconds(300));
}

TEST(Driver, TellsTheSessionThatTheProcessStoodStillBeforeAnythingElse) {
  const ReservedPort port;
  std::atomic<bool> later{false};
  Rig rig("127.0.0.1", port.port(), [&] {
    Now now = systemNow();
    if (later) now.steady += std::chrono::seconds(2);
    return now;
  });
  rig.driver.start();
  rig.driver.post([&](const Now&) { rig.log.add("task before"); });
  drain(rig.driver);
  later = true;
  rig.driver.post([&](const Now&) { rig.log.add("task after"); });
  drain(rig.driver);
  rig.driver.stop();
  const auto entries = rig.log.entries();
  const auto before = std::find(entries.begin(), entries.end(), "task before");
  const auto still = std::find(entries.begin(), entries.end(), "session stood still");
  const auto after = std::find(entries.begin(), entries.end(), "task after");
  EXPECT_LT(before, still);
  EXPECT_LT(still, after);
  EXPECT_NE(after, entries.end());
}

/// Whether the driver says that it stood still when it goes on so long after its start, at which
/// its first tick is a second away.
bool findsThatItStoodStill(milliseconds after_its_start) {
  const ReservedPort port;
  Now then = systemNow();
  then.steady += after_its_start;
  std::atomic<bool> later{false};
  Rig rig("127.0.0.1", port.port(), [&] { return later ? then : systemNow(); });
  rig.driver.start();
  drain(rig.driver);
  later = true;
  drain(rig.driver);
  rig.driver.stop();
  return rig.log.has("session stood still");
}

TEST(Driver, StoodStillWhenATickIsHalfASecondLate) {
  EXPECT_FALSE(findsThatItStoodStill(milliseconds(600)));
  EXPECT_FALSE(findsThatItStoodStill(milliseconds(1350)));
  EXPECT_TRUE(findsThatItStoodStill(milliseconds(1700)));
}

TEST(Driver, StepsWhenAskedAndNeverEarlier) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  constexpr milliseconds kPeriod(10);
  std::vector<steady_clock::duration> late;
  std::promise<void> done;
  rig.session.next_step = steady_clock::now() + kPeriod;
  rig.session.on_step = [&](const Now& now, session::Output&) {
    if (late.size() == 30) return;
    EXPECT_GE(now.steady, rig.session.next_step);
    late.push_back(now.steady - rig.session.next_step);
    rig.session.next_step += kPeriod;
    if (late.size() < 30) return;
    rig.session.next_step = SteadyTime::max();
    done.set_value();
  };
  rig.driver.start();
  done.get_future().wait();
  rig.driver.stop();
  std::sort(late.begin(), late.end());
  // Half of them may fall to a computer that does other things; a driver that is late is so always.
  EXPECT_LT(late[late.size() / 4], milliseconds(5));
}

/// How long after `asked` the step came whose time was moved there from `planned`.
milliseconds lateness(milliseconds planned, milliseconds asked) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  std::promise<SteadyTime> stepped;
  const auto begin = steady_clock::now();
  bool of_the_task = true;
  rig.session.next_step = begin + planned;
  rig.driver.start();
  rig.driver.post([&](const Now&) {
    rig.session.next_step = begin + asked;
    rig.session.on_step = [&](const Now& now, session::Output&) {
      if (std::exchange(of_the_task, false)) return;  // the step that follows this task
      if (rig.session.next_step != SteadyTime::max()) stepped.set_value(now.steady);
      rig.session.next_step = SteadyTime::max();
    };
  });
  const auto at = stepped.get_future().get();
  return std::chrono::duration_cast<milliseconds>(at - (begin + asked));
}

TEST(Driver, StepMovedEarlierComesEarlier) {
  const auto late = lateness(milliseconds(5000), milliseconds(60));
  EXPECT_GE(late, milliseconds(0));
  EXPECT_LT(late, milliseconds(500));
}

TEST(Driver, StepMovedLaterComesLater) {
  const auto late = lateness(milliseconds(30), milliseconds(120));
  EXPECT_GE(late, milliseconds(0));
  EXPECT_LT(late, milliseconds(500));
}

TEST(Driver, ASessionThatIsAlwaysDueLetsTheLinkWork) {
  Vehicle vehicle;
  Rig rig("127.0.0.1", vehicle.port());
  rig.session.next_step = SteadyTime::min();
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] { return vehicle.clients() == 1 && rig.listener.connects == 1; }));
  vehicle.send("$");
  EXPECT_TRUE(waitUntil([&] { return rig.session.bytes_received == 1; }));
  rig.driver.stop();
}

TEST(Driver, RunsTasksInOrderEachWithAStep) {
  const ReservedPort port;
  auto options = link::testing::quickOptions("127.0.0.1", port.port());
  options.reconnect_min = options.reconnect_max = std::chrono::seconds(60);
  Rig rig(options);
  std::vector<int> order;
  constexpr int kStep = -1;
  rig.session.on_step = [&](const Now&, session::Output&) { order.push_back(kStep); };
  rig.driver.post([&](const Now&) { order.push_back(0); });
  rig.driver.start();
  std::vector<int> expected{0, kStep};
  for (int i = 1; i <= 1000; ++i) {
    rig.driver.post([&order, i](const Now&) { order.push_back(i); });
    expected.push_back(i);
    expected.push_back(kStep);
  }
  rig.driver.stop();
  order.resize(expected.size());  // without the step of leaving
  EXPECT_EQ(order, expected);
}

TEST(Driver, TasksMayPostTasks) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  std::promise<void> done;
  rig.driver.start();
  rig.driver.post([&](const Now&) { rig.driver.post([&](const Now&) { done.set_value(); }); });
  done.get_future().wait();
}

TEST(Driver, TicksOnceASecond) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  const auto begin = steady_clock::now();
  rig.driver.start();
  ASSERT_TRUE(waitUntil([&] {
    const std::lock_guard<std::mutex> lock(rig.listener.mutex);
    return rig.listener.ticks.size() == 3;
  }));
  rig.driver.stop();
  const auto& ticks = rig.listener.ticks;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_GE(ticks[i] - begin, std::chrono::seconds(i + 1));
    EXPECT_LT(ticks[i] - begin, std::chrono::seconds(i + 1) + milliseconds(500));
  }
}

TEST(Driver, NamesItsThread) {
  const ReservedPort port;
  Rig rig("127.0.0.1", port.port());
  std::promise<std::string> name;
  rig.driver.post([&](const Now&) {
    char text[16];
    pthread_getname_np(pthread_self(), text, sizeof text);
    name.set_value(text);
  });
  rig.driver.start();
  EXPECT_EQ(name.get_future().get(), "frontseat");
}

}  // namespace
}  // namespace frontseat_driver::driver::testing
