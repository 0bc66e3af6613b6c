#include "survey_lines.h"

#include <gtest/gtest.h>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

std::vector<PlanePoint> square(double side_m) {
  return {{0.0, 0.0}, {side_m, 0.0}, {side_m, side_m}, {0.0, side_m}};  // east, north
}

TEST(SurveyLines, RunThereAndBackHalfASpacingFromTheEdge) {
  const auto ends = surveyLines(square(10.0), 0.0, 5.0, 0.0, false);
  ASSERT_EQ(ends.size(), 4U);
  const double expected[4][2] = {{2.5, 0.0}, {2.5, 10.0}, {7.5, 10.0}, {7.5, 0.0}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(ends[static_cast<std::size_t>(i)].east_m, expected[i][0], 1e-9) << i;
    EXPECT_NEAR(ends[static_cast<std::size_t>(i)].north_m, expected[i][1], 1e-9) << i;
  }
}

TEST(SurveyLines, LeadEastWithAHeadingOfNinetyAndTurnOutside) {
  const auto ends = surveyLines(square(10.0), kPi / 2.0, 10.0, 2.0, false);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_NEAR(ends[0].east_m, -2.0, 1e-9);
  EXPECT_NEAR(ends[1].east_m, 12.0, 1e-9);
  EXPECT_NEAR(ends[0].north_m, 5.0, 1e-9);
  const auto reversed = surveyLines(square(10.0), kPi / 2.0, 10.0, 2.0, true);
  EXPECT_NEAR(reversed[0].east_m, 12.0, 1e-9);
}

TEST(SurveyLines, AreNoneWhereThereIsNoArea) {
  EXPECT_TRUE(surveyLines({{0, 0}, {1, 1}}, 0.0, 1.0, 0.0, false).empty());
  EXPECT_TRUE(surveyLines(square(10.0), 0.0, 0.0, 0.0, false).empty());
  EXPECT_TRUE(surveyLines(square(10.0), 0.0, 1e-6, 0.0, false).empty());
}

// So far away a spacing is lost in the rounding of the place.
TEST(SurveyLines, ComeToAnEndFarAway) {
  const double far_m = 1e16;
  const auto ends =
      surveyLines({{far_m, 0.0}, {far_m + 64.0, 0.0}, {far_m, 1.0}}, 0.0, 0.5, 0.0, false);
  EXPECT_LE(ends.size(), 258U);
}

}  // namespace
}  // namespace frontseat_driver::sim
