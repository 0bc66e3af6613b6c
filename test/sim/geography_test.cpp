#include "frontseat_driver/sim/geography.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace frontseat_driver::sim {
namespace {

struct Convergence {
  const char* name;
  nmea::LatLon position;
  double degrees;  // (longitude - central meridian) * sin(latitude), good to 0.001 within a zone
};

class GridConvergence : public testing::TestWithParam<Convergence> {};

TEST_P(GridConvergence, IsTheBearingOfGridNorth) {
  EXPECT_NEAR(gridConvergenceDeg(GetParam().position), GetParam().degrees, 0.002);
}

INSTANTIATE_TEST_SUITE_P(
    Table, GridConvergence,
    testing::Values(Convergence{"west_of_the_meridian_69w", {42.36, -71.11}, -1.4217},
                    Convergence{"east_of_the_meridian_69w", {42.36, -66.89}, 1.4217},
                    Convergence{"southern_west_of_147e", {-42.88, 145.0}, 1.3610},
                    Convergence{"on_the_meridian", {42.36, -69.0}, 0.0},
                    Convergence{"equator", {0.0, -71.11}, 0.0}),
    [](const auto& row) { return std::string{row.param.name}; });

struct Place {
  const char* name;
  nmea::LatLon datum;
  PlanePoint point;
};

class TangentPlane : public testing::TestWithParam<Place> {};

TEST_P(TangentPlane, GoesThereAndBackWithinAMicrometre) {
  const PlanePoint back = toPlane(GetParam().datum, fromPlane(GetParam().datum, GetParam().point));
  EXPECT_NEAR(back.east_m, GetParam().point.east_m, 1e-6);
  EXPECT_NEAR(back.north_m, GetParam().point.north_m, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Table, TangentPlane,
    testing::Values(Place{"north_west", {42.358456, -71.087589}, {60.0, -40.0}},
                    Place{"ten_kilometres", {42.358456, -71.087589}, {-10000.0, 10000.0}},
                    Place{"south_east", {-42.88, 147.33}, {-300.0, -500.0}},
                    Place{"date_line", {10.0, 179.9999}, {500.0, 0.0}}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(TangentPlaneScale, AMinuteOfLatitudeAt45NorthIs1852Metres) {
  const PlanePoint point = toPlane({45.0, 7.0}, {45.0 + 1.0 / 60.0, 7.0});
  EXPECT_NEAR(point.north_m, 1852.2, 0.3);
  EXPECT_NEAR(point.east_m, 0.0, 1e-6);
}

}  // namespace
}  // namespace frontseat_driver::sim
