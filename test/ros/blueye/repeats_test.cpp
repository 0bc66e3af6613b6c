#include "blueye/repeats.h"

#include <gtest/gtest.h>

namespace frontseat_driver::ros_layer::blueye_layer {
namespace {

TEST(Repeats, AreOfTheSameNameAndTime) {
  Repeats repeats;
  EXPECT_FALSE(repeats.isRepeated("DRONE_IS_STUCK", "100.5"));
  EXPECT_TRUE(repeats.isRepeated("DRONE_IS_STUCK", "100.5"));
  EXPECT_FALSE(repeats.isRepeated("MISSION_PAUSED", "100.5"));
  EXPECT_TRUE(repeats.isRepeated("DRONE_IS_STUCK", "100.5"));
  EXPECT_FALSE(repeats.isRepeated("DRONE_IS_STUCK", "100.6"));
  EXPECT_FALSE(repeats.isRepeated("DRONE_IS_STUCK", "100.5"));
}

TEST(Repeats, DoNotGrowWhateverNumbersADroneTells) {
  Repeats repeats;
  for (int i = 0; i < 5000; ++i) repeats.isRepeated(std::to_string(i), "1.0");
  EXPECT_LE(repeats.size(), Repeats::kMost);
  EXPECT_TRUE(repeats.isRepeated("4999", "1.0"));
}

}  // namespace
}  // namespace frontseat_driver::ros_layer::blueye_layer
