#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "bench.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/geography.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::sim {
namespace {

struct Vehicle {
  const char* name;
  std::function<Bench()> make;
  std::chrono::seconds ahead;  ///< of its stamps to UTC
  bool grid;                   ///< whether its headings are
};

Bench surveyingSandshark() {
  SandsharkConfig config;
  config.start_time = kNoon;
  config.noise = false;
  config.environment.current_set_deg = 70.0;
  config.environment.current_drift_m_s = 0.2;
  return Bench{config};
}

Bench loopingKingfisher() {
  KingfisherConfig config;
  config.start_time = kNoon;
  config.noise = false;
  return Bench{config};
}

class TenMinutes : public testing::TestWithParam<Vehicle> {};

TEST_P(TenMinutes, OfSentencesAreTheTruthOfTheirInstants) {
  Bench bench = GetParam().make();
  bench.connect(1);
  bench.tell(1, "BPLOG,NVG,ON");
  bench.run(600.0);
  const nmea::LatLon datum = bench.frontseat().model().environment().datum;
  std::size_t checked = 0;
  for (const std::string& line : bench.heard(1)) {
    const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
    ASSERT_TRUE(sentence) << line;
    const auto read = protocol::decode(*sentence);
    ASSERT_TRUE(read) << line;
    const auto* nvg = std::get_if<protocol::NavigationUpdate>(&read->message);
    if (nvg == nullptr) continue;
    const Truth& truth = bench.truths.at(checked++);
    ASSERT_EQ(vehicle::resolveDate(*nvg->computed_at, truth.stamp), truth.stamp + GetParam().ahead);
    const PlanePoint point = toPlane(datum, *nvg->position);
    ASSERT_NEAR(point.east_m, truth.state.east_m, 0.005);
    ASSERT_NEAR(point.north_m, truth.state.north_m, 0.005);
    ASSERT_NEAR(nvg->depth_m.value_or(0.0), truth.state.depth_m, 0.001);
    const double convergence = GetParam().grid ? gridConvergenceDeg(*nvg->position) : 0.0;
    const double heading = radians(*nvg->heading_deg + convergence);
    ASSERT_NEAR(degrees(wrapPi(heading - truth.state.heading_rad)), 0.0, 0.001);
    ASSERT_NEAR(*nvg->roll_deg, degrees(truth.state.roll_rad), 0.001);
    ASSERT_NEAR(*nvg->pitch_deg, degrees(truth.state.pitch_rad), 0.001);
  }
  EXPECT_EQ(checked, 6000U);
}

INSTANTIATE_TEST_SUITE_P(
    Table, TenMinutes,
    testing::Values(Vehicle{"sandshark", surveyingSandshark, std::chrono::seconds{0}, true},
                    Vehicle{"kingfisher", loopingKingfisher, std::chrono::seconds{18}, false}),
    [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace frontseat_driver::sim
