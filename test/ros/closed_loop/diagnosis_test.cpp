// What /diagnostics says of healthy and of broken set-ups: driver and vehicle in virtual time.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "examined.h"

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ros_layer::Parameters parametersOf(Dialect dialect) {
  ros_layer::Parameters parameters;
  parameters.session.dialect = dialect;
  return parameters;
}

// BFCTL comes on change only, so the mission begins after the connection is made.
sim::SandsharkConfig sandshark() {
  sim::SandsharkConfig vehicle = quietSandshark();
  vehicle.mission.ready_s = 6.0;
  return vehicle;
}

sim::SandsharkConfig fieldSandshark() {
  sim::SandsharkConfig vehicle = sandshark();
  vehicle.noise = true;
  vehicle.first_fix_s = 5.0;
  sim::Quirks& quirks = vehicle.quirks;
  quirks.unpadded_minutes = quirks.float32_positions = quirks.zero_position_before_fix = true;
  quirks.zero_altitude = quirks.rate_wrap = quirks.cr_lf_lf = quirks.blank_mission_status = true;
  quirks.single_client = quirks.one_read_one_sentence = quirks.cut_last_three = true;
  quirks.command_by_substring = quirks.dies_on_empty_field = true;
  return vehicle;
}

sim::KingfisherConfig fieldKingfisher() {
  sim::KingfisherConfig vehicle = quietKingfisher();
  vehicle.noise = true;
  vehicle.yaw_rate_in_degrees = true;
  vehicle.compass_id = 0;
  // As in test/captures/heron_2014.nmea: some ten a second of NVG, one of the battery.
  vehicle.rates = {{"NVG", 10.0}, {"NVR", 10.0}, {"RCM", 10.0}, {"IMU", 0.0}, {"RBS", 1.0}};
  sim::Quirks& quirks = vehicle.quirks;
  quirks.dropped_zeros = quirks.zero_altitude = quirks.zero_depth = quirks.course_heading = true;
  quirks.nan_velocities = quirks.acceleration_in_g = quirks.battery_without_id = true;
  quirks.zero_temperature = true;
  return vehicle;
}

Behavior everything() {
  Behavior behavior = heading(0.5);
  behavior.vertical_mode = Behavior::VERTICAL_DEPTH;
  behavior.vertical = 2.0;
  behavior.speed_mode = Behavior::SPEED_SPEED;
  behavior.speed = 1.5;
  return behavior;
}

/// Takes the sentences with this address out of all that the vehicle says.
auto without(const std::string& address) {
  return [address](std::string_view bytes) {
    std::string left;
    while (!bytes.empty()) {
      const auto line = bytes.substr(0, bytes.find('\n') + 1);
      if (line.find(address) == std::string_view::npos) left += line;
      bytes.remove_prefix(line.size());
    }
    return left;
  };
}

// --- Healthy: green from the first second on, and not a line in the log ---

struct Healthy {
  const char* name;
  std::function<std::unique_ptr<Examined>()> make;
  std::optional<Wanted> wanted;
};

template <class Vehicle>
auto examined(Dialect dialect, const Vehicle& vehicle) {
  return [=] { return std::make_unique<Examined>(parametersOf(dialect), vehicle); };
}

auto inAuto() {
  return [] { return std::make_unique<Examined>(ros_layer::Parameters{}, quietKingfisher()); };
}

auto slowLink() {
  return [] {
    auto made = std::make_unique<Examined>(parametersOf(Dialect::Sandshark), sandshark());
    made->loop.link.delay = 300ms;
    return made;
  };
}

const Healthy kHealthy[] = {
    {"sandshark_idle", examined(Dialect::Sandshark, sandshark()), {}},
    {"sandshark_commanded", examined(Dialect::Sandshark, sandshark()), heading(0.5)},
    {"kingfisher_idle", examined(Dialect::Kingfisher, quietKingfisher()), {}},
    {"kingfisher_commanded", examined(Dialect::Kingfisher, quietKingfisher()), drive(0.5, 0.4)},
    {"kingfisher_in_auto", inAuto(), {}},
    {"field_sandshark_idle", examined(Dialect::Sandshark, fieldSandshark()), {}},
    {"field_sandshark_commanded", examined(Dialect::Sandshark, fieldSandshark()), everything()},
    {"field_kingfisher_idle", examined(Dialect::Kingfisher, fieldKingfisher()), {}},
    {"field_kingfisher_commanded", examined(Dialect::Kingfisher, fieldKingfisher()),
     course(1.0, 1.0)},
    {"sandshark_over_a_slow_link", slowLink(), {}},
};

void PrintTo(const Healthy& row, std::ostream* out) { *out << row.name; }

class HealthySetUp : public testing::TestWithParam<Healthy> {};

TEST_P(HealthySetUp, IsGreenFromTheFirstSecond) {
  const auto examined = GetParam().make();
  examined->pass(2s);
  examined->connect();
  examined->pass(10s);
  ASSERT_TRUE(examined->loop.reason().empty()) << examined->loop.reason();
  examined->pass(80s, GetParam().wanted);
  EXPECT_THAT(examined->complaints, IsEmpty());
  EXPECT_THAT(examined->log, IsEmpty());
  EXPECT_THAT(examined->of("data").message, HasSubstr("NVG comes at 10.0 Hz"));
  EXPECT_THAT(examined->of("clock").message, HasSubstr("following the vehicle's clock"));
  EXPECT_EQ(GetParam().wanted.has_value(),
            examined->of("commands").message.find("commanding ") == 0);
}

INSTANTIATE_TEST_SUITE_P(Table, HealthySetUp, testing::ValuesIn(kHealthy),
                         [](const auto& row) { return std::string{row.param.name}; });

// --- Broken: one layer complains, and says what to do ---

struct Broken {
  const char* name;
  std::function<std::unique_ptr<Examined>()> make;
  std::optional<Wanted> wanted;
  const char* layer;
  std::vector<std::string> words;
  std::size_t log_lines;  ///< 0 where what is refused is logged as it comes
};

template <class Vehicle, class Change>
auto broken(Dialect dialect, Vehicle vehicle, Change change) {
  change(vehicle);
  return examined(dialect, vehicle);
}

const Broken kBroken[] = {
    {"sandshark_without_nvg",
     broken(Dialect::Sandshark, quietSandshark(), [](auto& v) { v.rates["NVG"] = 0.0; }),
     {},
     "data",
     {"no BFNVG for ", "BPLOG,NVG,ON", "payload configuration"},
     1},
    {"kingfisher_without_nvg",
     broken(Dialect::Kingfisher, quietKingfisher(), [](auto& v) { v.rates["NVG"] = 0.0; }),
     {},
     "data",
     {"no CPNVG for ", "no odom", "turned off on the vehicle?"},
     1},
    {"wrong_dialect_forced",
     examined(Dialect::Sandshark, quietKingfisher()),
     {},
     "decoding",
     {"speaks the other dialect", "parameter dialect is sandshark: set it to auto"},
     1},
    {"checksum_noise",
     broken(Dialect::Kingfisher, quietKingfisher(), [](auto& v) { v.faults.corrupt = 0.05; }),
     {},
     "decoding",
     {"% of the lines are damaged", "wrong checksums", "Check cable, ground and baud rate"},
     1},
    {"clock_40_s_off",
     broken(Dialect::Sandshark, quietSandshark(), [](auto& v) { v.clock_offset_s = 40.0; }),
     {},
     "clock",
     {"40.0 s ahead of this computer's", "stamps are right all the same", "by GPS or NTP"},
     1},
    {"clock_in_another_zone",
     broken(Dialect::Kingfisher, quietKingfisher(), [](auto& v) { v.clock_offset_s = -14400.0; }),
     {},
     "clock",
     {"14400.0 s behind", "zone UTC-4", "set it to UTC"},
     1},
    {"clock_tells_utc_where_gps_is_expected",
     broken(Dialect::Kingfisher, quietKingfisher(), [](auto& v) { v.clock_offset_s = -18.0; }),
     {},
     "clock",
     {"18.0 s behind", "leap_seconds to 0"},
     1},
    {"permission_never_given",
     broken(Dialect::Sandshark, quietSandshark(),
            [](auto& v) { v.allow_dynamic_requests = false; }),
     heading(0.5),
     "control",
     {"commands come in and are refused", "BFCTL", "start the mission", "control_hook"},
     0},
    {"acknowledged_without_effect",
     broken(Dialect::Sandshark, quietSandshark(), [](auto& v) { v.faults.lie = true; }),
     heading(3.0),
     "commands",
     {"does not do what it is told", "heading", "commanded", "measured", "kill switch"},
     1},
    {"battery_low",
     broken(Dialect::Kingfisher, quietKingfisher(),
            [](auto& v) {
              v.battery.full_v = 13.0;
              v.battery.empty_v = 12.5;
            }),
     {},
     "battery",
     {"battery 1 is low: 12.9", "of 4 cells 3.2", "battery_low_voltage is 13.2 V", "charge it"},
     1},
};

void PrintTo(const Broken& row, std::ostream* out) { *out << row.name; }

class BrokenSetUp : public testing::TestWithParam<Broken> {};

TEST_P(BrokenSetUp, HasOneLayerThatTellsWhatToDo) {
  const auto examined = GetParam().make();
  examined->connect();
  examined->pass(10s);
  examined->pass(60s, GetParam().wanted);
  EXPECT_THAT(examined->complaining(0s), ElementsAre(GetParam().layer))
      << testing::PrintToString(examined->complaints.front());
  const ros_layer::Diagnosis& diagnosis = examined->of(GetParam().layer);
  EXPECT_NE(Level::Ok, diagnosis.level);
  for (const std::string& words : GetParam().words) {
    EXPECT_THAT(diagnosis.message, HasSubstr(words));
  }
  EXPECT_THAT(examined->log, SizeIs(GetParam().log_lines));
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenSetUp, testing::ValuesIn(kBroken),
                         [](const auto& row) { return std::string{row.param.name}; });

// --- What the tables cannot tell ---

TEST(DiagnosisInTime, LinkThatIsLostAgainAndAgainIsNoGoodLink) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  for (int loss = 0; loss < 3; ++loss) {
    examined.connect();
    examined.pass(8s);
    EXPECT_EQ("connected to vehicle", examined.of("link").message);
    examined.disconnect("no byte for 5.0 s");
    examined.pass(2s);
  }
  examined.connect();
  examined.pass(8s);
  EXPECT_EQ(Level::Warn, examined.of("link").level);
  EXPECT_THAT(examined.of("link").message, HasSubstr("lost 3 times in the last minute"));
  examined.pass(60s);
  EXPECT_EQ(Level::Ok, examined.of("link").level);
}

TEST(DiagnosisInTime, PermissionTakenBackIsRedOnlyWhileSomebodyCommands) {
  Examined examined{parametersOf(Dialect::Sandshark), quietSandshark()};
  examined.connect();
  examined.pass(10s);
  examined.loop.sandshark().setBackseatControl(false);
  examined.pass(10s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  EXPECT_EQ("the vehicle keeps control (BFCTL 0)", examined.of("control").message);
  examined.pass(10s, heading(0.5));
  EXPECT_THAT(examined.complaining(0s), ElementsAre("control"));
  EXPECT_THAT(examined.of("control").message, HasSubstr("allowDynamicRequests"));
  examined.pass(5s);
  EXPECT_EQ(Level::Ok, examined.of("control").level);
}

TEST(DiagnosisInTime, AClosedGateIsNoFault) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(5s);
  examined.loop.gate(false);
  examined.pass(10s, drive(0.5, 0.5));
  EXPECT_THAT(examined.complaints, IsEmpty());
  EXPECT_EQ("the command gate is closed; service enable_commands opens it",
            examined.of("control").message);
}

TEST(DiagnosisInTime, CommandsThatCannotBeSentAreToldWithTheReason) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(5s);
  examined.pass(5s, heading(0.5));
  EXPECT_THAT(examined.complaining(0s), ElementsAre("commands"));
  EXPECT_THAT(examined.of("commands").message, HasSubstr("for a sandshark, and the vehicle is a"));
}

TEST(DiagnosisInTime, WithoutALinkNothingElseIsToBlame) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.disconnect("no byte for 5.0 s");
  examined.pass(20s);
  EXPECT_THAT(examined.complaining(0s), ElementsAre("link"));
  EXPECT_THAT(examined.of("link").message,
              HasSubstr("no byte for 5.0 s; the vehicle says nothing"));
  EXPECT_EQ("not known without a link", examined.of("data").message);
  const Duration reconnected = examined.loop.elapsed();
  examined.connect();
  examined.pass(20s);
  EXPECT_THAT(examined.complaining(reconnected), IsEmpty());
  EXPECT_THAT(examined.log, IsEmpty());
}

// The second client of a Sandshark: TCP accepts it, the vehicle never speaks to it.
TEST(DiagnosisInTime, AVehicleThatNeverSpeaksIsRedFromTheFirstLossOn) {
  Examined examined{ros_layer::Parameters{}, quietSandshark()};
  examined.loop.link.edit = [](std::string_view) { return std::string{}; };
  examined.connect();
  examined.pass(4s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  for (int connection = 0; connection < 3; ++connection) {
    examined.disconnect("no byte for 5.0 s");
    const std::size_t before = examined.complaints.size();
    examined.pass(1s);
    examined.connect();
    examined.pass(4s);
    EXPECT_EQ(5U, examined.complaints.size() - before) << "every second";
    EXPECT_THAT(examined.of("link").message, HasSubstr("nothing heard yet; before: no byte for"));
  }
  EXPECT_THAT(examined.complaining(0s), ElementsAre("link"));
  examined.disconnect("no byte for 5.0 s");
  examined.loop.link.edit = nullptr;
  examined.connect();
  examined.pass(60s);
  EXPECT_EQ(Level::Ok, examined.of("link").level);
}

TEST(DiagnosisInTime, ASentenceThatComesEvery15SecondsIsNotMissed) {
  sim::KingfisherConfig vehicle = quietKingfisher();
  vehicle.rates["RBS"] = 1.0 / 15.0;
  Examined examined{parametersOf(Dialect::Kingfisher), vehicle};
  examined.connect();
  examined.pass(300s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  ASSERT_GE(examined.loop.session().counters().decoded, 20U);
}

// As when the baud rate of a serial line behind the port changes.
TEST(DiagnosisInTime, NoiseInPlaceOfSentencesIsNamed) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.loop.link.edit = [](std::string_view bytes) {
    std::string noise{bytes};
    for (char& byte : noise) byte = static_cast<char>(byte == '\n' ? byte : byte ^ 0x55);
    return noise;
  };
  examined.pass(20s);
  EXPECT_EQ(Level::Error, examined.of("data").level);
  EXPECT_THAT(examined.of("data").message, HasSubstr("bytes come in, but no sentence that can be"));
  EXPECT_EQ(Level::Error, examined.of("decoding").level);
  EXPECT_THAT(examined.of("decoding").message, HasSubstr("100.0 % of the lines are damaged"));
}

TEST(DiagnosisInTime, CommandsThatACongestedLinkHoldsBackAreTold) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(10s, drive(0.5, 0.5));
  examined.loop.link.congested = true;
  examined.pass(5s, drive(0.5, 0.5));
  EXPECT_THAT(examined.complaining(0s), ElementsAre("commands"));
  EXPECT_THAT(examined.of("commands").message, HasSubstr("no command has gone out for 5.0 s"));
  examined.loop.link.congested = false;
  examined.pass(2s, drive(0.5, 0.5));
  EXPECT_EQ(Level::Ok, examined.of("commands").level);
  examined.loop.link.takes = false;
  examined.pass(3s, drive(0.5, 0.5));
  EXPECT_THAT(examined.of("commands").message, HasSubstr("no command has gone out for 3.0 s"));
  examined.pass(3s);  // the zero thrust that ends a boat's commands waits too
  EXPECT_THAT(examined.of("commands").message, HasSubstr("no command has gone out for"));
  examined.loop.link.takes = true;
  examined.pass(1s);
  EXPECT_EQ("nothing is commanded", examined.of("commands").message);
}

TEST(DiagnosisInTime, ASandsharkTakenForABoatIsRecognizedThoughItFallsSilent) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietSandshark()};
  for (int connection = 0; connection < 3; ++connection) {
    examined.connect();
    examined.pass(5s);
    EXPECT_THAT(examined.of("decoding").message, HasSubstr("set it to auto"));
    examined.disconnect("no byte for 5.0 s");
    examined.pass(2s);
    EXPECT_THAT(examined.of("link").message, HasSubstr("parameter dialect is kingfisher: set it"));
  }
  EXPECT_THAT(examined.complaining(0s), ElementsAre("decoding", "link"));
}

TEST(DiagnosisInTime, WhatComesAndGoesIsLoggedOnceEach) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.loop.link.edit = without("CPNVG");
  examined.pass(30s);
  examined.loop.link.edit = nullptr;
  examined.pass(30s);
  ASSERT_THAT(examined.log, SizeIs(testing::Ge(2)));
  EXPECT_EQ(Level::Error, examined.log.front().level);
  EXPECT_THAT(examined.log.front().text, HasSubstr("data: no CPNVG for "));
  EXPECT_EQ(Level::Ok, examined.log.back().level);
  EXPECT_THAT(examined.log.back().text, HasSubstr("data: well again, CPNVG comes at "));
  EXPECT_LE(examined.log.size(), 3U);  // while the rate recovers, it is slow
}

TEST(DiagnosisInTime, ASensorThatFallsSilentIsNamed) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.loop.link.edit = without("CPRCM");
  examined.pass(10s);
  EXPECT_THAT(examined.complaining(0s), ElementsAre("data"));
  EXPECT_EQ(Level::Warn, examined.of("data").level);
  EXPECT_THAT(examined.of("data").message, HasSubstr("no CPRCM for "));
}

TEST(DiagnosisInTime, ASentenceThatIsTurnedOffIsNotMissed) {
  Examined examined{parametersOf(Dialect::Sandshark), quietSandshark()};
  examined.connect();
  examined.pass(20s);
  examined.loop.request(session::LogSwitch{"NVR", false});
  examined.pass(20s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  examined.loop.request(session::LogSwitch{"NVG", false});
  examined.pass(20s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  EXPECT_THAT(examined.of("data").message, HasSubstr("BFNVG is not asked for"));
}

TEST(DiagnosisInTime, AClockStepIsToldAndNoFault) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.loop.stepSystemClock(3s);
  examined.pass(20s);
  EXPECT_THAT(examined.complaints, IsEmpty());
  EXPECT_THAT(examined.of("clock").message, HasSubstr("stepped "));
  examined.pass(60s);
  EXPECT_EQ(std::string::npos, examined.of("clock").message.find("stepped"));
}

TEST(DiagnosisInTime, StampsThatAreHeldBackAreToldWithTheTimeLeft) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.connect();
  examined.pass(20s);
  examined.loop.stepSystemClock(-30s);
  examined.pass(10s);
  EXPECT_THAT(examined.complaining(0s), ElementsAre("clock"));
  EXPECT_EQ(Level::Error, examined.of("clock").level);
  EXPECT_THAT(examined.of("clock").message,
              HasSubstr("stand still for 20 s more: this computer's clock was set back"));
  examined.pass(25s);
  EXPECT_THAT(examined.of("clock").message, HasSubstr("30.0 s ahead of this computer's"));
}

TEST(DiagnosisInTime, ARosClockThatStandsStillIsTold) {
  Examined examined{parametersOf(Dialect::Kingfisher), quietKingfisher()};
  examined.loop.holdStampsAtZero();
  examined.connect();
  examined.pass(10s);
  EXPECT_THAT(examined.complaining(0s), ElementsAre("clock"));
  EXPECT_THAT(examined.of("clock").message, HasSubstr("/use_sim_time"));
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
