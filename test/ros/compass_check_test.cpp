#include "compass_check.h"

#include <gtest/gtest.h>

#include <string>

namespace frontseat_driver::ros_layer {
namespace {

using namespace std::chrono_literals;

class CompassDisagreement : public testing::Test {
 protected:
  /// What is told while both headings stay as they are.
  int told(CompassCheck& check, double navigation_deg, double compass_deg,
           std::chrono::seconds duration) {
    int lines = 0;
    for (const auto end = now_ + duration; now_ < end; now_ += 100ms) {
      vehicle::Navigation navigation;
      navigation.heading_deg = navigation_deg;
      check.take(navigation, now_);
      vehicle::Compass compass;
      compass.heading_deg = compass_deg;
      const std::string line = check.take(compass, now_);
      lines += line.empty() ? 0 : 1;
      if (!line.empty()) last_ = line;
    }
    return lines;
  }

  vehicle::SteadyTime now_{1h};
  std::string last_;
};

TEST_F(CompassDisagreement, IsToldOnceWhenItLasts) {
  CompassCheck check{Parameters{}};
  EXPECT_EQ(told(check, 234.0, 306.0, 19s), 0);
  EXPECT_EQ(told(check, 234.0, 306.0, 60s), 1);
  EXPECT_EQ(last_,
            "the compass tells 306 deg where the navigation tells 234 deg, for 20 s now; is "
            "parameter compass_convention right? It is spec");
}

TEST_F(CompassDisagreement, IsToldAgainAfterTheyHaveAgreed) {
  CompassCheck check{Parameters{}};
  EXPECT_EQ(told(check, 234.0, 306.0, 60s), 1);
  EXPECT_EQ(told(check, 10.0, 350.0, 60s), 0);  // 20 degrees apart, across north
  EXPECT_EQ(told(check, 234.0, 306.0, 60s), 1);
}

TEST_F(CompassDisagreement, IsNotToldFromAHeadingOfLongAgo) {
  CompassCheck check{Parameters{}};
  EXPECT_EQ(told(check, 234.0, 306.0, 10s), 0);
  vehicle::Compass compass;
  compass.heading_deg = 306.0;
  for (const auto end = now_ + 60s; now_ < end; now_ += 100ms) {
    EXPECT_EQ(check.take(compass, now_), "");  // the navigation is silent
  }
  EXPECT_EQ(told(check, 234.0, 306.0, 19s), 0);  // what was before does not count
}

TEST_F(CompassDisagreement, HeedsConventionAndDeclination) {
  Parameters parameters;
  parameters.compass_convention = CompassConvention::Heron;
  CompassCheck heron{parameters};
  EXPECT_EQ(told(heron, 234.0, 306.0, 60s), 0);  // (180 - 306) mod 360
  parameters.compass_convention = CompassConvention::Spec;
  parameters.magnetic_declination_rad = -1.0;
  CompassCheck declined{parameters};
  EXPECT_EQ(told(declined, 234.0, 234.0 + 57.3, 60s), 0);
  EXPECT_EQ(told(declined, 234.0, 10.0, 60s), 1);
  EXPECT_EQ(last_.substr(0, 26), "the compass tells 313 deg ");  // 10 - 57.3
}

}  // namespace
}  // namespace frontseat_driver::ros_layer
