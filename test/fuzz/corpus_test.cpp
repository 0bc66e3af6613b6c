#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz.h"

namespace frontseat_driver::fuzz {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// Every input that the fuzzer kept, and every one that ever broke something.
TEST(Corpus, KeepsEveryPromise) {
  int inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator{CORPUS}) {
    EXPECT_NO_THROW(run(contents(entry.path()))) << entry.path();
    ++inputs;
  }
  EXPECT_GE(inputs, 10) << "there is hardly anything in " << CORPUS;
}

TEST(Corpus, OfNothingAndOfZeros) {
  EXPECT_NO_THROW(run(""));
  EXPECT_NO_THROW(run(std::string(5000, '\0')));
}

}  // namespace
}  // namespace frontseat_driver::fuzz
