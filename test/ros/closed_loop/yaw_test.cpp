#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>

#include "closed_loop.h"

// A commanded yaw ends as that yaw in `odom`, wherever on Earth: what is taken off a heading on its
// way to the vehicle is what is added on its way back.

namespace frontseat_driver::closed_loop {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using ros_layer::HeadingReference;

constexpr double kDegree = M_PI / 180.0;

struct Place {
  const char* name;
  nmea::LatLon position;
  double central_meridian_deg;  ///< of the UTM zone, from the map of the zones
};

void PrintTo(const Place& place, std::ostream* out) { *out << place.name; }

// Zones are 6 degrees wide, zone 31 from 0 to 6 E. Zone 32 reaches to 3 E between 56 N and 64 N,
// and between 72 N and 84 N zone 31 reaches to 9 E, zone 33 from there to 21 E.
const Place kPlaces[] = {
    {"boston", {42.36, -71.11}, -69.0},
    {"rio", {-22.9, -43.17}, -45.0},
    {"sydney", {-33.86, 151.21}, 153.0},
    {"equator", {0.01, -78.5}, -81.0},
    {"north_edge_west_side", {50.0, 5.95}, 3.0},
    {"north_edge_east_side", {50.0, 6.05}, 9.0},
    {"south_edge_west_side", {-33.9, 17.95}, 15.0},
    {"south_edge_east_side", {-33.9, 18.05}, 21.0},
    {"date_line_west_side", {-16.8, 179.95}, 177.0},
    {"date_line_east_side", {-16.8, -179.95}, -177.0},
    {"norway_no_edge_at_6_west", {60.0, 5.95}, 9.0},
    {"norway_no_edge_at_6_east", {60.0, 6.05}, 9.0},
    {"norway_edge_at_3_west_side", {60.0, 2.95}, 3.0},
    {"norway_edge_at_3_east_side", {60.0, 3.05}, 9.0},
    {"svalbard_edge_at_9_west_side", {78.0, 8.95}, 3.0},
    {"svalbard_edge_at_9_east_side", {78.0, 9.05}, 15.0},
};

// One in each quadrant, the axis that yaw wraps at, and one beyond it.
const double kYaws[] = {30 * kDegree,  120 * kDegree, -150 * kDegree, -60 * kDegree,
                        180 * kDegree, 0.0,           300 * kDegree};

/// On the sphere; the ellipsoid adds less than 0.005 degrees within a zone.
double convergence_deg(const Place& place) {
  const double from_meridian =
      (place.position.longitude_deg - place.central_meridian_deg) * kDegree;
  return std::atan(std::tan(from_meridian) * std::sin(place.position.latitude_deg * kDegree)) /
         kDegree;
}

ClosedLoop loopAt(const Place& place, Dialect dialect,
                  std::optional<HeadingReference> reference = std::nullopt) {
  ros_layer::Parameters parameters = parametersFor(dialect);
  parameters.heading_reference = reference;
  if (dialect == Dialect::Sandshark) {
    sim::SandsharkConfig config = quietSandshark();
    config.environment.datum = place.position;
    return ClosedLoop{parameters, config};
  }
  sim::KingfisherConfig config = quietKingfisher();
  config.environment.datum = place.position;
  return ClosedLoop{parameters, config};
}

/// Until the vehicle has given control and told its position.
void begin(ClosedLoop& loop) {
  loop.connect();
  ASSERT_TRUE(loop.passUntil([&] { return loop.reason().empty(); }, 5s)) << loop.reason();
  loop.pass(1s);
}

double trueYaw(const ClosedLoop& loop) { return M_PI_2 - loop.state().heading_rad; }

/// The heading in the last command, degrees.
double wireHeading_deg(const ClosedLoop& loop, const char* address, std::size_t field) {
  const auto sent = loop.sent(address);
  return sent.empty() ? NAN : std::stod(fields(sent.back().sentence)[field]);
}

class Yaw : public testing::TestWithParam<Place> {};

TEST_P(Yaw, OfABehaviorEndsAsThatYawInOdom) {
  ClosedLoop loop = loopAt(GetParam(), Dialect::Sandshark);
  begin(loop);
  for (const double yaw : kYaws) {
    loop.publishFor(heading(yaw), 200ms, 25s);
    EXPECT_LT(apart(loop.yaw(), yaw), kDegree) << yaw;
    EXPECT_LT(apart(trueYaw(loop), yaw), kDegree) << yaw;
    const double grid_heading = (90.0 - convergence_deg(GetParam())) * kDegree - yaw;
    EXPECT_LT(apart(wireHeading_deg(loop, "BPRMB", 2) * kDegree, grid_heading), 0.01 * kDegree)
        << yaw;
  }
}

TEST_P(Yaw, OfACourseEndsAsThatYawInOdom) {
  ClosedLoop loop = loopAt(GetParam(), Dialect::Kingfisher);
  begin(loop);
  for (const double yaw : kYaws) {
    loop.publishFor(course(yaw, 1.0), 200ms, 25s);
    EXPECT_LT(apart(loop.yaw(), yaw), kDegree) << yaw;
    EXPECT_LT(apart(trueYaw(loop), yaw), kDegree) << yaw;
    // Whole degrees from true north.
    EXPECT_LT(apart(wireHeading_deg(loop, "PYDEV", 1) * kDegree, M_PI_2 - yaw), 1e-9) << yaw;
  }
}

// The vehicles do as before, so that the truth is off by the convergence; what is commanded and
// what is published still agree.
TEST_P(Yaw, OfABehaviorCountedFromTrueNorthEndsAsThatYawInOdom) {
  ClosedLoop loop = loopAt(GetParam(), Dialect::Sandshark, HeadingReference::True);
  begin(loop);
  for (const double yaw : kYaws) {
    loop.publishFor(heading(yaw), 200ms, 25s);
    EXPECT_LT(apart(loop.yaw(), yaw), kDegree) << yaw;
    EXPECT_LT(apart(wireHeading_deg(loop, "BPRMB", 2) * kDegree, M_PI_2 - yaw), 1e-4) << yaw;
  }
}

TEST_P(Yaw, OfACourseCountedFromGridNorthEndsAsThatYawInOdom) {
  ClosedLoop loop = loopAt(GetParam(), Dialect::Kingfisher, HeadingReference::Grid);
  begin(loop);
  for (const double yaw : kYaws) {
    loop.publishFor(course(yaw, 1.0), 200ms, 25s);
    EXPECT_LT(apart(loop.yaw(), yaw), kDegree) << yaw;
  }
}

INSTANTIATE_TEST_SUITE_P(Places, Yaw, testing::ValuesIn(kPlaces),
                         [](const auto& row) { return std::string{row.param.name}; });

// Headings jump by 4.6 degrees there, the vehicle does not.
TEST(YawAcrossAZoneEdge, StaysAsItIsCommanded) {
  const Place just_west{"", {50.0, 5.9994}, 3.0};  // 43 m from the edge
  const double yaw = 10 * kDegree;
  ClosedLoop loop = loopAt(just_west, Dialect::Sandshark);
  begin(loop);
  loop.publishFor(heading(yaw), 200ms, 20s);
  double worst_rad = 0.0;
  loop.watch.odometry = [&](const nav_msgs::Odometry&, const sim::Truth& truth) {
    worst_rad =
        std::max({worst_rad, apart(loop.yaw(), yaw), apart(M_PI_2 - truth.state.heading_rad, yaw)});
  };
  ASSERT_LT(loop.frontseat().model().position().longitude_deg, 6.0);
  loop.publishFor(heading(yaw), 200ms, 30s);
  ASSERT_GT(loop.frontseat().model().position().longitude_deg, 6.0);
  EXPECT_LT(worst_rad, kDegree);
}

}  // namespace
}  // namespace frontseat_driver::closed_loop
