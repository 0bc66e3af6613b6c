#include "decode/field_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace frontseat_driver::decode {
namespace {

using namespace std::chrono_literals;

std::string numberText(double value) {
  std::string out;
  appendNumber(out, value);
  return out;
}

struct Number {
  double value;
  const char* text;
};

TEST(FieldText, WritesNumbersAsTheyWereRead) {
  const Number kNumbers[] = {{0.0, "0"},
                             {-0.0, "0"},
                             {1.0, "1"},
                             {-1.5, "-1.5"},
                             {234.32964, "234.32964"},
                             {-0.000097, "-0.000097"},
                             {0.1, "0.1"},
                             {0.123456789, "0.123456789"},
                             {999999.999999999, "999999.999999999"},
                             {1234567.5, "1234567.5"},
                             {123456789012345.0, "123456789012345"},
                             {1e15, "1e+15"},
                             {1e-10, "1e-10"},
                             {1.0 / 3.0, "0.3333333333333333"},
                             {4.35, "4.35"},
                             {2.675, "2.675"}};
  for (const Number& number : kNumbers) EXPECT_EQ(numberText(number.value), number.text);
}

TEST(FieldText, WritesEveryNumberSoThatItReadsBackTheSame) {
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> exponent{-20.0, 20.0};
  for (int i = 0; i < 100'000; ++i) {
    const double value =
        std::uniform_real_distribution<double>{-1.0, 1.0}(random)*std::pow(10.0, exponent(random));
    ASSERT_EQ(std::strtod(numberText(value).c_str(), nullptr), value);
  }
}

TEST(FieldText, WritesFixedDecimals) {
  const auto fixed = [](double value, int decimals) {
    std::string out;
    appendFixed(out, value, decimals);
    return out;
  };
  EXPECT_EQ(fixed(42.36185236, 7), "42.3618524");
  EXPECT_EQ(fixed(-71.090813, 9), "-71.090813000");
  EXPECT_EQ(fixed(0.00000001, 7), "0.0000000");
  EXPECT_EQ(fixed(-0.00000001, 7), "0.0000000");
  EXPECT_EQ(fixed(179.99999999, 7), "180.0000000");
}

TEST(FieldText, WritesIntegersToTheirLimits) {
  std::string out;
  appendInteger(out, std::numeric_limits<std::int64_t>::min());
  out += ' ';
  appendInteger(out, std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(out, "-9223372036854775808 9223372036854775807");
}

TEST(FieldText, WritesTimesOfDay) {
  const auto clock = [](nmea::TimeOfDay time) {
    std::string out;
    appendClock(out, time);
    return out;
  };
  EXPECT_EQ(clock(0s), "00:00:00.000");
  EXPECT_EQ(clock(12h + 34min + 56s + 7ms), "12:34:56.007");
  EXPECT_EQ(clock(12h + 34min + 56s + 7us), "12:34:56.000007");
  EXPECT_EQ(clock(24h - 1us), "23:59:59.999999");
  EXPECT_EQ(clock(24h + 500ms), "23:59:60.500");
}

TEST(FieldText, WritesUtc) {
  const auto utc = [](vehicle::UtcTime time) {
    std::string out;
    appendUtc(out, time);
    return out;
  };
  EXPECT_EQ(utc(0s), "1970-01-01T00:00:00.000000Z");
  EXPECT_EQ(utc(1'416'410'000s + 123456us),
            "2014-11-19T15:13:20.123456Z");  // date -u -d @1416410000
  EXPECT_EQ(utc(1'456'790'399s + 999'999'999ns), "2016-02-29T23:59:59.999999Z");
  EXPECT_EQ(utc(1'456'790'400s), "2016-03-01T00:00:00.000000Z");
  EXPECT_EQ(utc(1'456'704'000s), "2016-02-29T00:00:00.000000Z");
}

TEST(FieldText, WritesSeconds) {
  const auto seconds = [](std::chrono::nanoseconds time) {
    std::string out;
    appendSeconds(out, time);
    return out;
  };
  EXPECT_EQ(seconds(0s), "0");
  EXPECT_EQ(seconds(1'416'410'000s + 5ms), "1416410000.005");
  EXPECT_EQ(seconds(-1500ms), "-1.5");
  EXPECT_EQ(seconds(1ns), "0.000000001");
}

TEST(FieldText, ShowsEveryByteHarmlessly) {
  EXPECT_EQ(visible(std::string_view{"a\x1b[2J\n\0\xFF\\", 9}), "a\\x1b[2J\\x0a\\x00\\xff\\\\");
}

}  // namespace
}  // namespace frontseat_driver::decode
