#include "convert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;

constexpr double kExact = 1e-14;

void expectNear(const geometry_msgs::Vector3& actual, double x, double y, double z) {
  EXPECT_NEAR(actual.x, x, kExact);
  EXPECT_NEAR(actual.y, y, kExact);
  EXPECT_NEAR(actual.z, z, kExact);
}

void expectPositiveZeros(const geometry_msgs::Vector3& actual) {
  for (const double component : {actual.x, actual.y, actual.z}) {
    EXPECT_FALSE(component == 0.0 && std::signbit(component));
  }
}

// Worked out away from the code under test, over matrices: R_ned_frd = Rz(h) Ry(p) Rx(r), then
// R_enu_flu = W R_ned_frd S with W = [0 1 0; 1 0 0; 0 0 -1] and S = diag(1, -1, -1), and the
// quaternion from the matrix. With c5 = cos 5 deg, s5 = sin 5 deg and r = sqrt(1/2) the components
// are 0.0616 = r s5, 0.7044 = r c5, 0.0872 = s5 and 0.9962 = c5. `body_*` is R_enu_flu^T (1, 2,
// -0.5): what a vehicle that goes 1 m/s east, 2 m/s north and 0.5 m/s down feels; 1.8828 =
// 2 c10 - 0.5 s10, 2.0564 = 2 c10 + 0.5 s10, 0.8980 = c10 - 0.5 s10, 1.0716 = c10 + 0.5 s10.
struct Attitude {
  const char* name;
  double heading_deg, roll_deg, pitch_deg;
  double x, y, z, w;
  double body_x, body_y, body_z;
};

constexpr double kRs5 = 0.0616284167162193;
constexpr double kRc5 = 0.704416026402759;
constexpr double kS5 = 0.0871557427476582;
constexpr double kC5 = 0.996194698091746;
constexpr double kR = 0.707106781186548;

const Attitude kAttitudes[] = {
    {"north", 0, 0, 0, 0, 0, kR, kR, 2, -1, -0.5},
    {"north_port_up", 0, 10, 0, kRs5, kRs5, kRc5, kRc5, 2, -1.07163184184567, -0.318755698839174},
    {"north_port_down", 0, -10, 0, -kRs5, -kRs5, kRc5, kRc5, 2, -0.897983664178743,
     -0.666052054173034},
    {"north_bow_up", 0, 0, 10, kRs5, -kRs5, kRc5, kRc5, 1.88279141719095, -1, -0.839700231839965},
    {"north_bow_down", 0, 0, -10, -kRs5, kRs5, kRc5, kRc5, 2.05643959485788, -1,
     -0.145107521172243},
    {"east", 90, 0, 0, 0, 0, 0, 1, 1, 2, -0.5},
    {"east_port_up", 90, 10, 0, kS5, 0, 0, kC5, 1, 1.88279141719095, -0.839700231839965},
    {"east_port_down", 90, -10, 0, -kS5, 0, 0, kC5, 1, 2.05643959485788, -0.145107521172243},
    {"east_bow_up", 90, 0, 10, 0, -kS5, 0, kC5, 0.897983664178743, 2, -0.666052054173034},
    {"east_bow_down", 90, 0, -10, 0, kS5, 0, kC5, 1.07163184184567, 2, -0.318755698839174},
    {"south", 180, 0, 0, 0, 0, -kR, kR, -2, 1, -0.5},
    {"south_port_up", 180, 10, 0, kRs5, -kRs5, -kRc5, kRc5, -2, 0.897983664178743,
     -0.666052054173034},
    {"south_port_down", 180, -10, 0, -kRs5, kRs5, -kRc5, kRc5, -2, 1.07163184184567,
     -0.318755698839174},
    {"south_bow_up", 180, 0, 10, -kRs5, -kRs5, -kRc5, kRc5, -2.05643959485788, 1,
     -0.145107521172243},
    {"south_bow_down", 180, 0, -10, kRs5, kRs5, -kRc5, kRc5, -1.88279141719095, 1,
     -0.839700231839965},
    {"west", 270, 0, 0, 0, 0, 1, 0, -1, -2, -0.5},
    {"west_port_up", 270, 10, 0, 0, kS5, kC5, 0, -1, -2.05643959485788, -0.145107521172243},
    {"west_port_down", 270, -10, 0, 0, -kS5, kC5, 0, -1, -1.88279141719095, -0.839700231839965},
    {"west_bow_up", 270, 0, 10, kS5, 0, kC5, 0, -1.07163184184567, -2, -0.318755698839174},
    {"west_bow_down", 270, 0, -10, -kS5, 0, kC5, 0, -0.897983664178743, -2, -0.666052054173034},
};

class AttitudeTest : public testing::TestWithParam<Attitude> {};

TEST_P(AttitudeTest, IsFluInEnu) {
  const Attitude& row = GetParam();
  const auto q = toOrientation(row.roll_deg, row.pitch_deg, row.heading_deg);
  EXPECT_NEAR(q.x, row.x, kExact);
  EXPECT_NEAR(q.y, row.y, kExact);
  EXPECT_NEAR(q.z, row.z, kExact);
  EXPECT_NEAR(q.w, row.w, kExact);
}

TEST_P(AttitudeTest, TurnsAVelocityIntoTheBody) {
  const Attitude& row = GetParam();
  const auto q = toOrientation(row.roll_deg, row.pitch_deg, row.heading_deg);
  expectNear(bodyFromEnu(enuVelocity(1.0, 2.0, 0.5), q), row.body_x, row.body_y, row.body_z);
}

INSTANTIATE_TEST_SUITE_P(Table, AttitudeTest, testing::ValuesIn(kAttitudes),
                         [](const auto& row) { return std::string{row.param.name}; });

// By the same matrices as above; this order of the three turns and no other gives it.
TEST(Orientation, TurnsYawThenPitchThenRoll) {
  const auto q = toOrientation(10.0, 20.0, 40.0);
  EXPECT_NEAR(q.x, 0.150897525559994, kExact);
  EXPECT_NEAR(q.y, -0.120505798950545, kExact);
  EXPECT_NEAR(q.z, 0.428330439779575, kExact);
  EXPECT_NEAR(q.w, 0.882746466182333, kExact);
}

TEST(Orientation, IsTheSameAFullTurnFurther) {
  EXPECT_EQ(toOrientation(0.0, 0.0, 400.0), toOrientation(0.0, 0.0, 40.0));
  EXPECT_EQ(toOrientation(0.0, 0.0, -90.0), toOrientation(0.0, 0.0, 270.0));
}

TEST(Orientation, OfALevelVehicleNeverHasANegativeW) {
  for (int heading = 0; heading < 360; ++heading) {
    EXPECT_GE(toOrientation(0.0, 0.0, heading).w, 0.0) << heading;
  }
}

// x bow stays; y starboard becomes port, z down becomes up. 1 deg/s = 0.0174532925199433 rad/s.
TEST(BodyRates, AreOneAxisAtATime) {
  expectNear(bodyRates(1.0, 0.0, 0.0), 0.0174532925199433, 0.0, 0.0);
  expectNear(bodyRates(0.0, 1.0, 0.0), 0.0, -0.0174532925199433, 0.0);
  expectNear(bodyRates(0.0, 0.0, 1.0), 0.0, 0.0, -0.0174532925199433);
}

TEST(BodyVectors, AreOneAxisAtATime) {
  expectNear(fluFromFrd(1.0, 0.0, 0.0), 1.0, 0.0, 0.0);
  expectNear(fluFromFrd(0.0, 1.0, 0.0), 0.0, -1.0, 0.0);
  expectNear(fluFromFrd(0.0, 0.0, 1.0), 0.0, 0.0, -1.0);
}

TEST(EnuVelocity, IsOneAxisAtATime) {
  expectNear(enuVelocity(1.0, 0.0, 0.0), 1.0, 0.0, 0.0);
  expectNear(enuVelocity(0.0, 1.0, 0.0), 0.0, 1.0, 0.0);
  expectNear(enuVelocity(0.0, 0.0, 1.0), 0.0, 0.0, -1.0);
}

TEST(EnuVelocity, FollowsTheCourse) {
  expectNear(enuVelocity(2.0, 0.0), 0.0, 2.0, 0.0);
  expectNear(enuVelocity(2.0, 90.0), 2.0, 0.0, 0.0);
  expectNear(enuVelocity(2.0, 180.0), 0.0, -2.0, 0.0);
  expectNear(enuVelocity(2.0, 270.0), -2.0, 0.0, 0.0);
  // sin 30 = 0.5, cos 30 = 0.866025403784439
  expectNear(enuVelocity(2.0, 30.0), 1.0, 1.73205080756888, 0.0);
}

TEST(Zeros, AreNotNegative) {
  expectPositiveZeros(fluFromFrd(0.0, 0.0, 0.0));
  expectPositiveZeros(fluFromFrd(-0.0, -0.0, -0.0));
  expectPositiveZeros(bodyRates(0.0, 0.0, 0.0));
  expectPositiveZeros(enuVelocity(0.0, 0.0, 0.0));
  expectPositiveZeros(enuVelocity(0.0, 180.0));
  for (const double heading_deg : {0.0, 90.0, 180.0, 270.0}) {
    const auto q = toOrientation(0.0, 0.0, heading_deg);
    expectPositiveZeros(bodyFromEnu(enuVelocity(0.0, 0.0, 0.0), q));
    EXPECT_FALSE(std::signbit(q.x)) << heading_deg;
    EXPECT_FALSE(std::signbit(q.y)) << heading_deg;
  }
}

// Redfearn's series for the convergence of the transverse Mercator projection on the ellipsoid; the
// code under test uses another.
double seriesConvergence_deg(double latitude_deg, double from_central_meridian_deg) {
  const double e2 = 0.00669437999014;
  const double lat = latitude_deg * M_PI / 180.0;
  const double l = from_central_meridian_deg * M_PI / 180.0;
  const double eta2 = e2 / (1.0 - e2) * std::pow(std::cos(lat), 2);
  const double a2 = std::pow(l * std::cos(lat), 2);
  const double third = (1.0 + 3.0 * eta2 + 2.0 * eta2 * eta2) / 3.0;
  const double fifth = (2.0 - std::pow(std::tan(lat), 2)) / 15.0;
  return l * std::sin(lat) * (1.0 + a2 * third + a2 * a2 * fifth) * 180.0 / M_PI;
}

struct Convergence {
  const char* name;
  double latitude_deg, longitude_deg;
  double central_meridian_deg;
  double rounded_deg;  ///< to see sign and size
};

const Convergence kConvergences[] = {
    {"boston_zone_19", 42.36, -71.11, -69.0, -1.42},
    {"on_the_central_meridian", 42.36, -69.0, -69.0, 0.0},
    {"east_of_the_central_meridian", 42.36, -66.89, -69.0, 1.42},
    {"sydney_zone_56", -33.86, 151.21, 153.0, 1.0},
    {"south_and_east", -33.86, 155.0, 153.0, -1.11},
    {"east_edge_of_zone_18", 42.0, -72.0001, -75.0, 2.01},
    {"west_edge_of_zone_19", 42.0, -72.0, -69.0, -2.01},
    {"equator", 0.0, -71.11, -69.0, 0.0},
    {"date_line_zone_60", 10.0, 179.9, 177.0, 0.5},
    {"date_line_zone_1", 10.0, -179.9, -177.0, -0.5},
    {"norway_zone_32", 60.0, 4.0, 9.0, -4.33},
    {"spitsbergen_zone_33", 78.0, 11.0, 15.0, -3.91},
};

class ConvergenceTest : public testing::TestWithParam<Convergence> {};

TEST_P(ConvergenceTest, AgreesWithTheSeries) {
  const Convergence& row = GetParam();
  const double actual = meridianConvergence_deg({row.latitude_deg, row.longitude_deg});
  const double east_deg = row.longitude_deg - row.central_meridian_deg;
  EXPECT_NEAR(actual, seriesConvergence_deg(row.latitude_deg, east_deg), 2e-7);
  EXPECT_NEAR(actual, row.rounded_deg, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Table, ConvergenceTest, testing::ValuesIn(kConvergences),
                         [](const auto& row) { return std::string{row.param.name}; });

// In UPS grid north points along the meridian of Greenwich: towards the pole in the north there,
// away from it in the south.
TEST(Convergence, BeyondUtmIsOfUps) {
  EXPECT_NEAR(meridianConvergence_deg({85.0, 30.0}), 30.0, 1e-9);
  EXPECT_NEAR(meridianConvergence_deg({85.0, -90.0}), -90.0, 1e-9);
  EXPECT_NEAR(meridianConvergence_deg({-81.0, 30.0}), -30.0, 1e-9);
  EXPECT_NEAR(meridianConvergence_deg({-90.0, 90.0}), -90.0, 1e-9);
}

TEST(CompassConvention, OfTheSpecificationChangesNothing) {
  const CompassAngles angles = toSpecification({234.5, -1.5}, CompassConvention::Spec);
  EXPECT_EQ(angles.heading_deg, 234.5);
  EXPECT_EQ(angles.pitch_deg, -1.5);
}

TEST(CompassConvention, OfAHeronIsUndone) {
  const double kSentAndMeant[][2] = {{180, 0},   {90, 90},   {0, 180},
                                     {270, 270}, {181, 359}, {40, 140}};
  for (const auto& row : kSentAndMeant) {
    const CompassAngles angles = toSpecification({row[0], 2.5}, CompassConvention::Heron);
    EXPECT_EQ(angles.heading_deg, row[1]);
    EXPECT_EQ(angles.pitch_deg, -2.5);
  }
}

TEST(WrapHeading, IsBelowAFullTurn) {
  EXPECT_EQ(wrapHeading_deg(0.0), 0.0);
  EXPECT_EQ(wrapHeading_deg(360.0), 0.0);
  EXPECT_EQ(wrapHeading_deg(-1.0), 359.0);
  EXPECT_EQ(wrapHeading_deg(0.5), 0.5);
  EXPECT_EQ(wrapHeading_deg(359.75), 359.75);
  EXPECT_EQ(wrapHeading_deg(360.25), 0.25);
  EXPECT_EQ(wrapHeading_deg(721.5), 1.5);
  EXPECT_EQ(wrapHeading_deg(-1e-20), 0.0);
  EXPECT_FALSE(std::signbit(wrapHeading_deg(-360.0)));
}

TEST(Positions, ThatCannotBeAreNotUsable) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isUsable({0.0, 0.0}));
  EXPECT_FALSE(isUsable({-0.0, 0.0}));
  EXPECT_FALSE(isUsable({90.1, 1.0}));
  EXPECT_FALSE(isUsable({1.0, -180.1}));
  EXPECT_FALSE(isUsable({nan, 1.0}));
  EXPECT_FALSE(isUsable({1.0, nan}));
  EXPECT_TRUE(isUsable({0.0, 1e-7}));
  EXPECT_TRUE(isUsable({-1e-7, 0.0}));
  EXPECT_TRUE(isUsable({-90.0, 180.0}));
}

// One second of latitude at 45 N is 30.87 m (111132 m per degree), and of longitude 21.9 m
// (78847 m per degree).
TEST(Distance, IsInMeters) {
  const auto apart_m = [](const vehicle::Position& a, const vehicle::Position& b) {
    return distance_m(fromEarthCentre_m(a), fromEarthCentre_m(b));
  };
  EXPECT_NEAR(apart_m({45.0, 10.0}, {45.001, 10.0}), 111.13, 0.01);
  EXPECT_NEAR(apart_m({45.0, 10.0}, {45.0, 10.001}), 78.85, 0.01);
  EXPECT_NEAR(apart_m({45.0, 179.9995}, {45.0, -179.9995}), 78.85, 0.01);
  EXPECT_EQ(apart_m({45.0, 10.0}, {45.0, 10.0}), 0.0);
}

// The half axes of WGS-84 are 6378137 m and 6356752.3142 m.
TEST(Distance, IsOfPlacesOnTheEllipsoid) {
  const auto null_island = fromEarthCentre_m({0.0, 0.0});
  EXPECT_NEAR(null_island.x, 6378137.0, 0.001);
  const auto east = fromEarthCentre_m({0.0, 90.0});
  EXPECT_NEAR(east.y, 6378137.0, 0.001);
  const auto pole = fromEarthCentre_m({90.0, 0.0});
  EXPECT_NEAR(pole.z, 6356752.3142, 0.001);
}

TEST(RosTime, KeepsNanoseconds) {
  const ros::Time time = toRosTime(1419984000s + 123456789ns);
  EXPECT_EQ(time.sec, 1419984000U);
  EXPECT_EQ(time.nsec, 123456789U);
  EXPECT_EQ(toUtcTime(time), 1419984000s + 123456789ns);
}

TEST(RosTime, SaturatesWhereItEnds) {
  EXPECT_EQ(toRosTime(-1ns), ros::Time(0, 0));
  EXPECT_EQ(toRosTime(vehicle::UtcTime::min()), ros::Time(0, 0));
  EXPECT_EQ(toRosTime(4294967295s), ros::Time(4294967295U, 0));
  EXPECT_EQ(toRosTime(4294967296s), ros::Time(4294967295U, 999999999U));
  EXPECT_EQ(toRosTime(vehicle::UtcTime::max()), ros::Time(4294967295U, 999999999U));
}

TEST(Angles, ConvertBothWays) {
  EXPECT_DOUBLE_EQ(radians(180.0), M_PI);
  EXPECT_DOUBLE_EQ(degrees(M_PI / 2.0), 90.0);
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
