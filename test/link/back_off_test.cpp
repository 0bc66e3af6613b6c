#include "src/link/back_off.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace frontseat_driver::link {
namespace {

using std::chrono::milliseconds;

struct Bounds {
  const char* name;
  milliseconds min;
  milliseconds max;
  std::vector<std::pair<int, int>> delays_ms;  ///< least and greatest of each attempt in turn
};

const Bounds kBounds[] = {
    {"of_the_driver",
     milliseconds(500),
     milliseconds(10000),
     {{500, 500},
      {500, 1000},
      {1000, 2000},
      {2000, 4000},
      {4000, 8000},
      {5000, 10000},
      {5000, 10000}}},
    {"max_is_no_power", milliseconds(100), milliseconds(250), {{100, 100}, {100, 200}, {125, 250}}},
    {"no_room", milliseconds(300), milliseconds(300), {{300, 300}, {300, 300}}},
    {"max_below_min", milliseconds(300), milliseconds(200), {{200, 200}, {200, 200}}},
    {"zero_does_not_spin", milliseconds(0), milliseconds(4), {{1, 1}, {1, 2}, {2, 4}, {2, 4}}}};

class BackOffBounds : public testing::TestWithParam<Bounds> {};

TEST_P(BackOffBounds, HoldForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    BackOff back_off(GetParam().min, GetParam().max, seed);
    for (const auto& [least_ms, greatest_ms] : GetParam().delays_ms) {
      const auto delay = back_off.next();
      EXPECT_GE(delay, milliseconds(least_ms)) << "seed " << seed;
      EXPECT_LE(delay, milliseconds(greatest_ms)) << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BackOffBounds, testing::ValuesIn(kBounds),
                         [](const auto& row) { return std::string{row.param.name}; });

std::vector<milliseconds> delays(std::uint64_t seed) {
  BackOff back_off(milliseconds(500), milliseconds(10000), seed);
  std::vector<milliseconds> found;
  for (int i = 0; i < 8; ++i) found.push_back(back_off.next());
  return found;
}

TEST(BackOff, RepeatsWithItsSeed) { EXPECT_EQ(delays(7), delays(7)); }

TEST(BackOff, IsLeftToChanceWithoutASeed) {
  std::set<std::vector<milliseconds>> found;
  for (int i = 0; i < 16; ++i) found.insert(delays(0));
  EXPECT_GT(found.size(), 1U);
}

TEST(BackOff, SpreadsOverSeeds) {
  std::set<std::vector<milliseconds>> different;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) different.insert(delays(seed));
  EXPECT_EQ(different.size(), 50U);
}

TEST(BackOff, StartsAgain) {
  BackOff back_off(milliseconds(500), milliseconds(10000), 3);
  for (int i = 0; i < 6; ++i) back_off.next();
  back_off.restart();
  EXPECT_EQ(back_off.next(), milliseconds(500));
  EXPECT_LE(back_off.next(), milliseconds(1000));
}

}  // namespace
}  // namespace frontseat_driver::link
