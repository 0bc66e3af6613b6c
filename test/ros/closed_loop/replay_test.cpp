#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "convert.h"
#include "frontseat_driver/sim/random.h"
#include "recording.h"

// Ten minutes of each vehicle's mission, recorded as `nmea/rx` and played back: the same messages,
// byte for byte.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using ros_layer::StampMode;

struct Mission {
  const char* name;
  Dialect dialect;
  StampMode stamp = StampMode::Synced;
  bool auto_dialect = false;
  bool commands = false;
  bool troubles = false;             ///< noise on the line, lost connections, jitter
  Duration host_steps{0};            ///< the host's clock, once
  double vehicle_clock_off_s = 0.0;  /// and drifting
};

void PrintTo(const Mission& mission, std::ostream* out) { *out << mission.name; }

const Mission kMissions[] = {
    {"sandshark", Dialect::Sandshark},
    {"kingfisher", Dialect::Kingfisher},
    {"sandshark_vehicle_time", Dialect::Sandshark, StampMode::Vehicle},
    {"kingfisher_receive", Dialect::Kingfisher, StampMode::Receive},
    {"sandshark_commanded", Dialect::Sandshark, StampMode::Synced, false, true},
    {"sandshark_troubles", Dialect::Sandshark, StampMode::Synced, true, true, true},
    {"kingfisher_troubles", Dialect::Kingfisher, StampMode::Synced, true, true, true},
    {"sandshark_clock_off", Dialect::Sandshark, StampMode::Synced, true, false, true, 0s, 18018.0},
    {"kingfisher_vehicle_time", Dialect::Kingfisher, StampMode::Vehicle, true, false, true, 0s,
     -40.0},
    {"host_steps_forward", Dialect::Sandshark, StampMode::Synced, false, false, true, 1h},
    {"host_steps_back", Dialect::Kingfisher, StampMode::Synced, false, false, true, -700ms},
};

class Replayed : public testing::TestWithParam<Mission> {
 protected:
  static ros_layer::Parameters parameters() {
    ros_layer::Parameters parameters = parametersFor(GetParam().dialect);
    parameters.stamp = GetParam().stamp;
    if (GetParam().auto_dialect) parameters.session.dialect.reset();
    return parameters;
  }

  template <class Config>
  static Config prepared(Config config) {
    config.start_time = quietKingfisher().start_time;
    config.clock_offset_s = GetParam().vehicle_clock_off_s;
    config.clock_drift_ppm = GetParam().vehicle_clock_off_s == 0.0 ? 0.0 : 50.0;
    if (!GetParam().troubles) return config;
    config.faults.drop = 0.02;
    config.faults.corrupt = 0.02;
    config.faults.split = true;
    config.faults.stall_s = 3.0;  // longer than max_data_age
    config.faults.stall_every_s = 60.0;
    config.faults.disconnect_every_s = 97.0;
    return config;
  }

  static ClosedLoop loop() {
    if (GetParam().dialect == Dialect::Sandshark) {
      return ClosedLoop{parameters(), prepared(sim::SandsharkConfig{})};
    }
    return ClosedLoop{parameters(), prepared(sim::KingfisherConfig{})};
  }

  /// Commands and delays on the way, a minute at a time.
  static void voyage(ClosedLoop& loop, Recording& recording) {
    sim::Random random{7};
    if (GetParam().troubles) {
      loop.link.edit = [&](std::string_view bytes) {
        loop.link.delay = Duration{static_cast<Duration::rep>(5e6 * std::exp(random.normal()))};
        return std::string{bytes};
      };
    }
    for (int minute = 0; minute < 10; ++minute) {
      if (GetParam().commands && GetParam().dialect == Dialect::Sandshark) {
        loop.publish(heading(0.3 * minute));
      } else if (GetParam().commands) {
        loop.publish(helm(0.5, 0.1));
      }
      recording.pass(1min);
      if (minute == 4) loop.stepSystemClock(GetParam().host_steps);
    }
    loop.link.edit = nullptr;
  }
};

std::set<VehicleTopic> topicsOf(const std::vector<Published>& all) {
  std::set<VehicleTopic> topics;
  for (const Published& one : all) topics.insert(one.topic);
  return topics;
}

const std::set<VehicleTopic> kSandsharkTopics = {
    VehicleTopic::Odom,     VehicleTopic::Transform,       VehicleTopic::ImuData,
    VehicleTopic::NavFix,   VehicleTopic::NavVelocity,     VehicleTopic::Depth,
    VehicleTopic::Altitude, VehicleTopic::VehicleTime,     VehicleTopic::MissionStatus,
    VehicleTopic::Ack,      VehicleTopic::InterfaceVersion};
const std::set<VehicleTopic> kKingfisherTopics = {
    VehicleTopic::Odom,        VehicleTopic::Transform,   VehicleTopic::ImuData,
    VehicleTopic::ImuDataRaw,  VehicleTopic::CompassData, VehicleTopic::NavFix,
    VehicleTopic::NavVelocity, VehicleTopic::Battery,     VehicleTopic::GpsFix,
    VehicleTopic::GpsVelocity, VehicleTopic::VehicleTime, VehicleTopic::GpsTimeReference};

/// The first difference, if there is one, so that a failure does not print ten minutes.
template <class T>
std::size_t firstDifference(const std::vector<T>& one, const std::vector<T>& other) {
  const std::size_t length = std::min(one.size(), other.size());
  const auto end = one.begin() + static_cast<std::ptrdiff_t>(length);
  return static_cast<std::size_t>(std::mismatch(one.begin(), end, other.begin()).first -
                                  one.begin());
}

TEST_P(Replayed, GivesTheSameMessagesByteForByte) {
  ClosedLoop loop = this->loop();
  Recording live{loop, parameters()};
  voyage(loop, live);

  Playing replay{parameters()};
  replay.play(live.record);
  const auto& expected = live.outlet.published;
  const auto& actual = replay.outlet.published;
  EXPECT_EQ(firstDifference(expected, actual), expected.size());
  EXPECT_EQ(expected.size(), actual.size());
  EXPECT_EQ(firstDifference(live.record, replay.record), live.record.size());
  EXPECT_EQ(live.record.size(), replay.record.size());

  EXPECT_GT(expected.size(), 30000u) << "a short mission shows little";
  EXPECT_THAT(topicsOf(expected),
              testing::IsSupersetOf(GetParam().dialect == Dialect::Sandshark ? kSandsharkTopics
                                                                             : kKingfisherTopics));
  const std::size_t connections = GetParam().troubles ? 7 : 1;
  EXPECT_EQ(replay.connections.size(), 2 * connections - 1);
  RecordProperty("lines", static_cast<int>(live.record.size()));
  RecordProperty("messages", static_cast<int>(expected.size()));
}

INSTANTIATE_TEST_SUITE_P(Runs, Replayed, testing::ValuesIn(kMissions),
                         [](const auto& row) { return std::string{row.param.name}; });

// A boat carried 500 m between two runs of the driver: each has its own datum and its own clocks.
TEST(ReplayOfTwoRuns, GivesTheSameMessagesByteForByte) {
  const ros_layer::Parameters parameters = parametersFor(Dialect::Kingfisher);
  sim::KingfisherConfig config;
  config.start_time = quietKingfisher().start_time;
  ClosedLoop first_loop{parameters, config};
  Recording first{first_loop, parameters, "100.000"};
  first.pass(30s);
  config.start_time += 31s;
  config.start.east_m += 500.0;
  config.clock_offset_s = 3.0;
  ClosedLoop second_loop{parameters, config};
  Recording second{second_loop, parameters, "131.000"};
  second.pass(30s);

  Playing replay{parameters};
  replay.play(first.record);
  replay.play(second.record);
  std::vector<Published> expected = first.outlet.published;
  expected.insert(expected.end(), second.outlet.published.begin(), second.outlet.published.end());
  EXPECT_EQ(firstDifference(expected, replay.outlet.published), expected.size());
  EXPECT_EQ(expected.size(), replay.outlet.published.size());
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
