#include "diagnosis/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "diagnosis/battery_watch.h"
#include "diagnosis/clock_watch.h"
#include "diagnosis/transition_log.h"

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;
using Level = Diagnosis::Level;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Pair;
using testing::SizeIs;

SentenceRates::Rate rate(const std::string& address, double hz, double age_s) {
  SentenceRates::Rate rate;
  rate.address = address;
  rate.count = 1000;
  rate.hz = hz;
  rate.age_s = age_s;
  rate.usual_hz = 10.0;
  return rate;
}

/// A boat with which all is well.
Health healthy() {
  Health health;
  health.link.connected = true;
  health.link.endpoint = "10.0.0.3:29500";
  health.link.connected_s = 100.0;
  health.dialect = health.parameter_dialect = "kingfisher";
  health.rates = {rate("CPNVG", 10.0, 0.1), rate("CPNVR", 10.0, 0.1)};
  health.counters.sentences_received = health.connection.sentences_received = 2000;
  health.connection.bytes_received = 100000;
  health.recent.sentences_received = health.recent.decoded = 200;
  health.recent.bytes_received = 10000;
  health.position_known = true;
  health.control.grant = vehicle::Grant::Granted;
  health.clock.vehicle_ahead_s = 0.01;
  health.battery_low_v = 13.2;
  return health;
}

BatteryHealth battery(double stack_v, double weakest_v, double low_for_s) {
  BatteryHealth battery;
  battery.id = 2;
  battery.stack_v = stack_v;
  battery.cells = 12;
  battery.lowest_cell_v = weakest_v / 12.0;
  battery.weakest_v = weakest_v;
  battery.low_for_s = low_for_s;
  return battery;
}

struct Row {
  const char* name;
  std::function<void(Health&)> change;
  const char* layer;  ///< the only one that may complain
  Level level;
  const char* words;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

const Row kRows[] = {
    {"all_well", [](auto&) {}, "data", Level::Ok, "CPNVG comes at 10.0 Hz"},
    {"no_fix_yet", [](auto& h) { h.position_known = false; }, "data", Level::Ok,
     "wait for the first GPS fix"},
    {"driver_hangs", [](auto& h) { h.link.unreported_s = 7.0; }, "link", Level::Error,
     "the driver itself has reported nothing for 7 s"},
    {"lost_twice",
     [](auto& h) {
       h.link.losses_lately = 2;
       h.link.last_failure = "no byte for 5.0 s";
     },
     "data", Level::Ok, "CPNVG comes at 10.0 Hz"},
    {"lost_again_and_again",
     [](auto& h) {
       h.link.losses_lately = 3;
       h.link.last_failure = "no byte for 5.0 s";
     },
     "link", Level::Warn,
     "connected to 10.0.0.3:29500, but lost 3 times in the last minute; the last time: no byte for "
     "5.0 s; the vehicle says nothing: a Sandshark serves one client"},
    {"silent_again_after_silence",
     [](auto& h) {
       h.rates.clear();
       h.connection = {};
       h.link.connected_s = 3.0;
       h.link.failed = true;
       h.link.last_failure = "no byte for 5.0 s";
       h.dialect = "";
     },
     "link", Level::Error,
     "connected to 10.0.0.3:29500 again, nothing heard yet; before: no byte for 5.0 s; the vehicle "
     "says nothing: a Sandshark serves one client"},
    {"noise_after_silence_is_no_fault_of_the_link",
     [](auto& h) {
       h.rates.clear();
       h.connection.sentences_received = 0;
       h.recent.sentences_received = h.recent.decoded = 0;
       h.link.failed = true;
       h.link.last_failure = "no byte for 5.0 s";
     },
     "data", Level::Error, "no sentence that starts with $"},
    {"nothing_heard",
     [](auto& h) {
       h.rates.clear();
       h.connection = {};
       h.recent = {};
     },
     "data", Level::Error, "a Sandshark serves one client"},
    {"some_other_service",
     [](auto& h) {
       h.rates.clear();
       h.connection.sentences_received = 0;
       h.recent = {};
     },
     "data", Level::Error, "no sentence that starts with $"},
    {"a_gps_receiver",
     [](auto& h) {
       h.dialect = "";
       h.rates = {rate("GPGGA", 1.0, 0.5), rate("GPRMC", 1.0, 0.5)};
     },
     "data", Level::Error, "(GPGGA, GPRMC), but none of a vehicle"},
    {"nothing_can_be_read",
     [](auto& h) {
       h.dialect = "";
       h.recent.bad_checksums = 200;
     },
     "decoding", Level::Error, "100.0 % of the lines are damaged"},
    {"more_noise_than_lines",
     [](auto& h) {
       h.recent.sentences_received = 100;
       h.recent.bad_frames = h.recent.no_sentences = 250;
       h.recent.oversized = 50;
     },
     "decoding", Level::Error, "75.0 % of the lines are damaged"},
    {"first_line_cut", [](auto& h) { h.recent.bad_frames = 1; }, "decoding", Level::Ok,
     "well-formed"},
    {"unreadable_fields", [](auto& h) { h.recent.bad_fields = 20; }, "decoding", Level::Warn,
     "20 fields in the last 10 s could not be read"},
    {"two_vehicles", [](auto& h) { h.recent.other_dialect = 50; }, "decoding", Level::Warn,
     "25.0 % of the sentences are of the other dialect"},
    {"navigation_slow", [](auto& h) { h.rates[0] = rate("CPNVG", 4.0, 0.2); }, "data", Level::Warn,
     "CPNVG comes at 4.0 Hz, where 10.0 Hz are usual"},
    {"navigation_slower_than_fresh",
     [](auto& h) {
       h.rates[0] = rate("CPNVG", 0.25, 3.0);
       h.rates[0].usual_hz = 0.25;
     },
     "data", Level::Error, "CPNVG comes every 4.0 s, and what is older than max_data_age, 2.0 s"},
    {"navigation_late", [](auto& h) { h.rates[0] = rate("CPNVG", 9.0, 2.1); }, "data", Level::Error,
     "no CPNVG for 2.1 s"},
    {"bytes_and_no_lines_any_more",
     [](auto& h) {
       h.rates[0] = rate("CPNVG", 0.0, 12.0);
       h.recent.sentences_received = h.recent.decoded = 0;
     },
     "data", Level::Error,
     "no CPNVG for 12.0 s: no odom, nav/fix and tf; bytes come in, but no sentence that can be "
     "read: has the baud rate of a serial line behind the TCP port changed"},
    {"sentences_and_no_navigation_any_more", [](auto& h) { h.rates[0] = rate("CPNVG", 0.0, 12.0); },
     "data", Level::Error, "it came before: has the vehicle's navigation stopped"},
    {"battery_every_15_s",
     [](auto& h) {
       h.rates.push_back(rate("CPRBS", 0.0, 12.0));
       h.rates.back().usual_hz = 1.0 / 15.0;
     },
     "data", Level::Ok, "CPNVG comes at 10.0 Hz"},
    {"five_in_the_window_tell_a_rate",
     [](auto& h) {
       h.rates.push_back(rate("CPRBS", 0.2, 5.0));
       h.rates.back().usual_hz = 0.5;
     },
     "data", Level::Warn, "CPRBS comes at 0.2 Hz, where 0.5 Hz are usual"},
    {"battery_every_15_s_gone",
     [](auto& h) {
       h.rates.push_back(rate("CPRBS", 0.0, 76.0));
       h.rates.back().usual_hz = 1.0 / 15.0;
     },
     "data", Level::Warn, "no CPRBS for 76.0 s"},
    {"velocity_late", [](auto& h) { h.rates[1] = rate("CPNVR", 9.0, 2.1); }, "data", Level::Warn,
     "no CPNVR for 2.1 s: odom has no twist"},
    {"one_step",
     [](auto& h) {
       h.clock.steps_lately = 1;
       h.clock.step_ago_s = 4.0;
     },
     "clock", Level::Ok, "stepped 4 s ago"},
    {"vehicle_set_back", [](auto& h) { h.clock.held_back_s = 7.0; }, "clock", Level::Error,
     "stand still for 7 s more: the vehicle's clock was set back"},
    {"computer_set_back",
     [](auto& h) {
       h.clock.held_back_s = 7.0;
       h.clock.computer_set_back = true;
     },
     "clock", Level::Error, "stand still for 7 s more: this computer's clock was set back"},
    {"simulated_clock_set_back",
     [](auto& h) {
       h.clock.simulated_behind_s = 60.0;
       h.clock.ros_clock_stands = true;
     },
     "clock", Level::Error, "/clock was set back by 60 s"},
    {"many_steps", [](auto& h) { h.clock.steps_lately = 5; }, "clock", Level::Warn,
     "stepped 5 times in the last minute"},
    {"vehicle_set_back_by_little", [](auto& h) { h.clock.held_back_s = 0.6; }, "clock",
     Level::Error, "stand still for 1 s more"},
    {"simulated_clock_wavers", [](auto& h) { h.clock.simulated_behind_s = 0.49; }, "clock",
     Level::Ok, "following"},
    {"simulated_clock_wavers_too_much", [](auto& h) { h.clock.simulated_behind_s = 0.51; }, "clock",
     Level::Error, "/clock was set back"},
    {"no_time_told", [](auto& h) { h.clock.vehicle_ahead_s.reset(); }, "clock", Level::Ok,
     "told no time yet"},
    {"clock_is_learned", [](auto& h) { h.clock.state = ClockHealth::State::Learning; }, "clock",
     Level::Ok, "learning the vehicle's clock"},
    {"clock_is_followed_ahead",
     [](auto& h) {
       h.clock.state = ClockHealth::State::Tracking;
       h.clock.vehicle_ahead_s = 0.5;
     },
     "clock", Level::Ok, "following the vehicle's clock, 0.500 s ahead of this computer's"},
    {"clock_is_followed_behind",
     [](auto& h) {
       h.clock.state = ClockHealth::State::Tracking;
       h.clock.vehicle_ahead_s = -0.5;
     },
     "clock", Level::Ok, "following the vehicle's clock, 0.500 s behind this computer's"},
    {"clock_off_by_less_than_counts", [](auto& h) { h.clock.vehicle_ahead_s = 4.9; }, "clock",
     Level::Ok, "following the vehicle's clock, 4.900 s ahead of"},
    {"clock_off_by_more_than_counts", [](auto& h) { h.clock.vehicle_ahead_s = 5.1; }, "clock",
     Level::Warn, "5.1 s ahead of this computer's"},
    {"clock_off_and_followed_blindly",
     [](auto& h) {
       h.clock.vehicle_ahead_s = -40.0;
       h.stamp = StampMode::Vehicle;
     },
     "clock", Level::Warn, "40.0 s behind this computer's: all stamps and tf are off by that"},
    {"clock_off_and_not_used",
     [](auto& h) {
       h.clock.vehicle_ahead_s = -40.0;
       h.stamp = StampMode::Receive;
     },
     "clock", Level::Ok, "not used (stamp: receive)"},
    {"clock_tells_gps_time", [](auto& h) { h.clock.vehicle_ahead_s = 18.1; }, "clock", Level::Warn,
     "set parameter leap_seconds to 18"},
    {"clock_tells_gps_time_with_wrong_leap_seconds",
     [](auto& h) {
       h.clock.vehicle_ahead_s = 8.0;
       h.leap_seconds = 10s;
     },
     "clock", Level::Warn, "set parameter leap_seconds to 18"},
    {"clock_tells_utc_nearly",
     [](auto& h) {
       h.clock.vehicle_ahead_s = -19.4;
       h.leap_seconds = 18s;
     },
     "clock", Level::Warn, "set parameter leap_seconds to 0"},
    {"clock_tells_nothing_known",
     [](auto& h) {
       h.clock.vehicle_ahead_s = -19.6;
       h.leap_seconds = 18s;
     },
     "clock", Level::Warn, "by GPS or NTP"},
    {"clock_in_kathmandu", [](auto& h) { h.clock.vehicle_ahead_s = 20700.2; }, "clock", Level::Warn,
     "zone UTC+5.75"},
    {"link_takes_a_command_late", [](auto& h) { h.held_back_s = 0.9; }, "commands", Level::Ok,
     "nothing is commanded"},
    {"link_takes_no_command", [](auto& h) { h.held_back_s = 3.0; }, "commands", Level::Warn,
     "no command has gone out for 3.0 s: the link still holds what it was given before"},
    {"refused_by_the_vehicle", [](auto& h) { h.vehicle_refusal = "failed: too deep"; }, "commands",
     Level::Warn, "the vehicle refuses what is sent: failed: too deep"},
    {"battery_full", [](auto& h) { h.batteries = {battery(15.0, 14.9, 0.0)}; }, "battery",
     Level::Ok, "15.00 V, the lowest of 12 cells 1.24 V"},
    {"battery_dips", [](auto& h) { h.batteries = {battery(13.1, 13.0, 5.0)}; }, "battery",
     Level::Ok, "13.10 V"},
    {"one_weak_cell",
     [](auto& h) {
       h.batteries = {battery(15.0, 14.9, 0.0), battery(14.0, 12.6, 20.0)};
     },
     "battery", Level::Warn, "battery 2 is low: 14.00 V, the lowest of 12 cells 1.05 V"},
    {"a_weak_bank_hides_behind_a_dip_of_another",
     [](auto& h) {
       h.batteries = {battery(12.5, 12.4, 3.0), battery(13.0, 12.9, 20.0)};
       h.batteries[0].id = 1;
     },
     "battery", Level::Warn, "battery 2 is low: 13.00 V"},
    {"the_weakest_of_the_low_ones",
     [](auto& h) {
       h.batteries = {battery(13.0, 12.9, 20.0), battery(12.0, 11.9, 20.0)};
       h.batteries[0].id = 1;
     },
     "battery", Level::Error, "battery 2 is empty: 12.00 V"},
    {"battery_empty", [](auto& h) { h.batteries = {battery(12.0, 11.9, 20.0)}; }, "battery",
     Level::Error, "battery 2 is empty"},
    {"battery_not_judged",
     [](auto& h) {
       h.batteries = {battery(12.0, 11.9, 20.0)};
       h.battery_low_v = 0.0;
     },
     "battery", Level::Ok, "12.00 V"},
};

class DiagnosisOf : public testing::TestWithParam<Row> {};

TEST_P(DiagnosisOf, BlamesOneLayer) {
  Health health = healthy();
  GetParam().change(health);
  const Diagnoses diagnoses = diagnose(health);
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    const bool the_one = kLayers[i].name == std::string{GetParam().layer};
    EXPECT_EQ(the_one ? GetParam().level : Level::Ok, diagnoses[i].level) << diagnoses[i].message;
    if (the_one) {
      EXPECT_THAT(diagnoses[i].message, HasSubstr(GetParam().words));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, DiagnosisOf, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(ClockValues, HaveTheirUnits) {
  Health health = healthy();
  health.clock.offset.offset = 1500ms;
  health.clock.offset.jitter = 12500us;
  health.clock.offset.drift_ppm = -3.5;
  const auto values = diagnoseClock(health).values;
  EXPECT_THAT(values,
              IsSupersetOf({Pair("vehicle minus computer, less the delay of the link", "0.010 s"),
                            Pair("learned offset", "1.500000 s"), Pair("jitter", "12.500 ms"),
                            Pair("drift", "-3.5 ppm")}));
}

/// What is told of a vehicle's clock that is ahead by so much.
double aheadOf(std::chrono::nanoseconds vehicle_ahead) {
  vehicle::Now now;
  now.utc = now.stamp = 1'700'000'000s;
  vehicle::ClockOffset::State offset;
  offset.samples = 1;
  offset.offset = -vehicle_ahead;
  return *ClockWatch{}.take(now, offset, 0s, 0ns).vehicle_ahead_s;
}

TEST(ClockWatchOf, ATimeOfDayIsTakenForThatOfTheNearestDay) {
  const std::pair<std::chrono::nanoseconds, double> kTimes[] = {
      {11h, 39600.0},    {-11h, -39600.0},  {13h, -39600.0},   {-13h, 39600.0},
      {24h + 1s, 1.0},   {-24h - 1s, -1.0}, {25h, 3600.0},     {-25h, -3600.0},
      {2400h + 1s, 1.0}, {-2400h, 0.0},     {18h, -6 * 3600.0}};
  for (const auto& [ahead, told_s] : kTimes) EXPECT_EQ(aheadOf(ahead), told_s) << ahead.count();
}

TEST(ClockWatchOf, AClockIsLearnedForTenSecondsAfterTheFirstSampleAndEachStep) {
  using State = ClockHealth::State;
  ClockWatch watch;
  vehicle::Now now;
  vehicle::ClockOffset::State offset;
  const auto state_at = [&](std::chrono::seconds time) {
    now.steady = vehicle::SteadyTime{time};
    now.utc = now.stamp = 1'700'000'000s + time;
    return watch.take(now, offset, 0s, 0ns).state;
  };
  EXPECT_EQ(state_at(100s), State::Unsynchronized);
  offset.samples = 1;
  EXPECT_EQ(state_at(101s), State::Learning);
  EXPECT_EQ(state_at(110s), State::Learning);
  EXPECT_EQ(state_at(111s), State::Tracking);
  ++offset.steps;
  EXPECT_EQ(state_at(120s), State::Learning);
  EXPECT_EQ(state_at(130s), State::Tracking);
}

TEST(Replay, WaitsForItsRecordInPeace) {
  Health health;
  health.replay = true;
  for (const Diagnosis& diagnosis : diagnose(health)) EXPECT_EQ(Level::Ok, diagnosis.level);
  EXPECT_EQ("waiting for a record on nmea/replay", diagnose(health)[0].message);
}

TEST(TransitionLogOf, FlappingSpeaksOnceInFiveSeconds) {
  TransitionLog log;
  std::size_t lines = 0;
  for (int second = 0; second < 20; ++second) {
    Health health = healthy();
    if (second % 2 == 0) health.recent.bad_fields = 20;
    const vehicle::SteadyTime now{std::chrono::seconds{100 + second}};
    lines += log.take(diagnose(health), now).size();
  }
  EXPECT_EQ(4U, lines);  // 0 s bad, 5 s well, 10 s bad, 15 s well
}

TEST(TransitionLogOf, FiguresThatChangeAreNoTransition) {
  TransitionLog log;
  Health health = healthy();
  health.rates[0] = rate("CPNVG", 4.0, 3.0);
  EXPECT_THAT(log.take(diagnose(health), vehicle::SteadyTime{100s}), SizeIs(1));
  health.rates[0] = rate("CPNVG", 3.0, 13.0);
  EXPECT_THAT(log.take(diagnose(health), vehicle::SteadyTime{110s}), IsEmpty());
}

struct Cells {
  const char* name;
  vehicle::Battery told;
  std::size_t cells;
  double weakest_v;
};

void PrintTo(const Cells& row, std::ostream* out) { *out << row.name; }

vehicle::Battery told(std::optional<double> stack, std::optional<double> lowest,
                      std::optional<double> highest) {
  vehicle::Battery battery;
  battery.stack_v = stack;
  battery.lowest_cell_v = lowest;
  battery.highest_cell_v = highest;
  return battery;
}

const Cells kCells[] = {
    {"twelve_nimh", told(14.4, 1.15, 1.22), 12, 13.8},
    {"four_lithium_ion", told(14.8, 3.6, 3.75), 4, 14.4},
    {"heron_repeats_its_stack", told(15.091787, 15.091787, 15.091787), 1, 15.091787},
    {"cells_are_zero", told(14.4, 0.0, 0.0), 0, 14.4},
    {"cells_are_blank", told(14.4, {}, {}), 0, 14.4},
};

class CellsOf : public testing::TestWithParam<Cells> {};

TEST_P(CellsOf, AreCountedByTheirVoltage) {
  BatteryWatch watch{13.2};
  watch.take(GetParam().told, vehicle::SteadyTime{});
  const auto batteries = watch.take(vehicle::SteadyTime{30s});
  ASSERT_THAT(batteries, SizeIs(1));
  EXPECT_EQ(GetParam().cells, batteries[0].cells);
  EXPECT_NEAR(GetParam().weakest_v, batteries[0].weakest_v, 1e-9);
  EXPECT_EQ(0.0, batteries[0].low_for_s);
}

INSTANTIATE_TEST_SUITE_P(Table, CellsOf, testing::ValuesIn(kCells),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(BatteryWatchOf, CountsFromTheFirstLowReading) {
  BatteryWatch watch{13.2};
  watch.take(told(13.1, {}, {}), vehicle::SteadyTime{10s});
  watch.take(told(13.0, {}, {}), vehicle::SteadyTime{15s});
  EXPECT_EQ(8.0, watch.take(vehicle::SteadyTime{18s})[0].low_for_s);
  watch.take(told(13.3, {}, {}), vehicle::SteadyTime{19s});
  EXPECT_EQ(0.0, watch.take(vehicle::SteadyTime{30s})[0].low_for_s);
  watch.take(told({}, {}, {}), vehicle::SteadyTime{31s});
  EXPECT_THAT(watch.take(vehicle::SteadyTime{31s}), SizeIs(1));
}

TEST(SentenceRatesOf, TellsRateWindowAndUsualRate) {
  SentenceRates rates;
  vehicle::SteadyTime now{1000s};
  rates.reset(now);
  const std::string_view line = "$BFNVG,...";
  for (int i = 0; i < 200; ++i) {  // 10 Hz for 20 s, every tenth 50 ms late
    now += 100ms;
    rates.count(line, now + (i % 10 == 5 ? 50ms : 0ms));
    if (i % 10 == 9 && i < 199) rates.take(now);
  }
  const auto taken = rates.take(now);
  ASSERT_THAT(taken, SizeIs(1));
  EXPECT_EQ("BFNVG", taken[0].address);
  EXPECT_EQ(200U, taken[0].count);
  EXPECT_NEAR(10.0, taken[0].hz, 1e-9);
  EXPECT_NEAR(0.05, taken[0].shortest_s, 1e-9);
  EXPECT_NEAR(0.15, taken[0].longest_s, 1e-9);
  ASSERT_TRUE(taken[0].usual_hz);
  EXPECT_NEAR(10.0, *taken[0].usual_hz, 1e-9);
  EXPECT_NEAR(0.0, taken[0].age_s, 1e-9);
  rates.reset(now);
  EXPECT_THAT(rates.take(now), IsEmpty());
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
