#include "frontseat_driver/nmea/sentence_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "lines.h"

namespace frontseat_driver::nmea {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// The fields that `write` wrote, or "invalid".
template <class Write>
std::string written(Write write) {
  SentenceWriter out{"AB", "CDE"};
  write(out);
  const auto line = out.finish();
  if (!line) return "invalid";
  const std::size_t head = std::strlen("$ABCDE,");
  const std::size_t tail = std::strlen("*hh\r\n");
  return std::string{line->substr(head, line->size() - head - tail)};
}

TEST(SentenceWriter, FramesTheSentence) {
  SentenceWriter out{"BF", "NVG"};
  out.integer(1);
  out.blank();
  out.text("a b");
  const auto line = out.finish();
  ASSERT_TRUE(line);
  EXPECT_EQ(*line, test::framed("BFNVG,1,,a b") + "\r\n");
  EXPECT_EQ(*out.finish(), *line);
}

TEST(SentenceWriter, WritesASentenceWithoutFields) {
  SentenceWriter out{"AB", "CDE"};
  EXPECT_EQ(out.finish(), "$ABCDE*41\r\n");
}

TEST(SentenceWriter, StaysGoodWhenCopied) {
  SentenceWriter first{"AB", "CDE"};
  first.integer(1);
  SentenceWriter second = first;
  second.integer(2);
  EXPECT_EQ(first.finish(), test::framed("ABCDE,1") + "\r\n");
  EXPECT_EQ(second.finish(), test::framed("ABCDE,1,2") + "\r\n");
}

struct Number {
  const char* name;
  double value;
  int decimals;
  const char* text;
};

const Number kNumbers[] = {
    {"zero", 0.0, 0, "0"},
    {"zero_with_decimals", 0.0, 3, "0.000"},
    {"minus_zero", -0.0, 1, "0.0"},
    {"rounds_to_zero", -0.04, 1, "0.0"},
    {"rounds_to_zero_without_decimals", -0.5, 0, "0"},
    {"rounds_up", 0.06, 1, "0.1"},
    {"rounds_away_below_zero", -0.06, 1, "-0.1"},
    {"carries", 9.9996, 3, "10.000"},
    {"carries_without_decimals", 99.7, 0, "100"},
    {"tie_to_even_down", 0.5, 0, "0"},
    {"tie_to_even_up", 1.5, 0, "2"},
    {"tie_to_even_of_decimals", 0.125, 2, "0.12"},
    {"tie_to_even_of_decimals_up", 0.375, 2, "0.38"},
    {"just_below_a_tie", 1.005, 2, "1.00"},   // the double is 1.00499999999999989
    {"just_above_a_tie", 1.015, 2, "1.01"},   // 1.01499999999999990
    {"above_a_tie", 1.025, 2, "1.02"},        // 1.02499999999999991
    {"truly_above_a_tie", 2.675, 2, "2.67"},  // 2.67499999999999982
    {"over_a_tie", 8.345, 2, "8.35"},         // 8.3450000000000006
    {"small", 1e-300, 9, "0.000000000"},
    {"smallest", 5e-324, 9, "0.000000000"},
    {"nine_decimals", 0.123456789, 9, "0.123456789"},
    {"many_digits", 123456789012345.0, 3, "123456789012345.000"},
    {"largest", 999999999999999.0, 9, "999999999999999.000000000"},
    {"negative", -71.114, 3, "-71.114"},
};

class WrittenNumbers : public testing::TestWithParam<Number> {};

TEST_P(WrittenNumbers, AreFixedPoint) {
  const Number& row = GetParam();
  EXPECT_EQ(written([&](SentenceWriter& out) { out.number(row.value, row.decimals); }), row.text);
}

INSTANTIATE_TEST_SUITE_P(Table, WrittenNumbers, testing::ValuesIn(kNumbers),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(WrittenNumber, EqualsPrintfButForTheSignOfZero) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> magnitude{-30.0, 49.8};
  for (int i = 0; i < 100'000; ++i) {
    // Every fourth one lies on a tie of a few decimals, or a power of two beside it.
    const double any = std::exp2(magnitude(random)) * (i % 2 == 0 ? 1.0 : -1.0);
    const double value = i % 4 == 0 ? std::round(any * 64.0) / 64.0 : any;
    const int decimals = static_cast<int>(random() % 10);
    char expected[64];
    std::snprintf(expected, sizeof expected, "%.*f", decimals, value);
    const bool zero = std::strpbrk(expected, "123456789") == nullptr;
    const char* const text = zero && expected[0] == '-' ? expected + 1 : expected;
    ASSERT_EQ(written([&](SentenceWriter& out) { out.number(value, decimals); }), text);
  }
}

TEST(WrittenNumber, ThatIsNoneIsAnEmptyField) {
  const auto write = [](SentenceWriter& out) {
    out.number(std::optional<double>{}, 3);
    out.integer(std::optional<std::int64_t>{});
    out.timeOfDay(std::nullopt);
    out.date(std::nullopt);
    out.latLon(std::nullopt, 6);
    out.number(std::optional<double>{1.5}, 1);
    out.integer(std::optional<std::int64_t>{-2});
  };
  EXPECT_EQ(written(write), ",,,,,,,,1.5,-2");
}

TEST(WrittenInteger, HasAllItsDigits) {
  const auto write = [](SentenceWriter& out) {
    for (const std::int64_t value : {0, 7, -7, 100}) out.integer(value);
    out.integer(std::numeric_limits<std::int64_t>::max());
    out.integer(std::numeric_limits<std::int64_t>::min());
  };
  EXPECT_EQ(written(write), "0,7,-7,100,9223372036854775807,-9223372036854775808");
}

TEST(WrittenTime, HasMillisecondsCutOff) {
  const auto write = [](SentenceWriter& out) {
    out.timeOfDay(TimeOfDay{0});
    out.timeOfDay(hours{8} + std::chrono::minutes{10} + milliseconds{25'987});
    out.timeOfDay(hours{13} + std::chrono::minutes{5} + milliseconds{6'007});
    out.timeOfDay(hours{24} - microseconds{1});
    out.timeOfDay(hours{24});
    out.timeOfDay(hours{24} + milliseconds{999});
  };
  EXPECT_EQ(written(write), "000000.000,081025.987,130506.007,235959.999,235960.000,235960.999");
}

TEST(WrittenDate, IsDayMonthYear) {
  const auto write = [](SentenceWriter& out) {
    out.date(Date{2014, 6, 26});
    out.date(Date{1980, 1, 1});
    out.date(Date{2079, 12, 31});
  };
  EXPECT_EQ(written(write), "260614,010180,311279");
}

struct Position {
  const char* name;
  LatLon position;
  int decimals;
  const char* text;
};

const Position kPositions[] = {
    {"half_degrees", {42.5, -71.25}, 3, "4230.000,N,07115.000,W"},
    {"south_and_east", {-33.75, 151.5}, 3, "3345.000,S,15130.000,E"},
    {"padded", {1.125, 2.0625}, 4, "0107.5000,N,00203.7500,E"},
    {"zero", {0.0, -0.0}, 1, "0000.0,N,00000.0,E"},
    {"rounds_to_zero", {-1e-9, -1e-9}, 6, "0000.000000,N,00000.000000,E"},
    {"minutes_round_up_to_60", {42.9999999999, -71.9999999999}, 6, "4300.000000,N,07200.000000,W"},
    {"minutes_just_do_not_round_up", {42.9999, -71.9999}, 3, "4259.994,N,07159.994,W"},
    {"edges", {90.0, -180.0}, 6, "9000.000000,N,18000.000000,W"},
    {"no_decimals", {42.5, -71.25}, 0, "4230,N,07115,W"},
    {"nine_decimals", {0.5, 0.5}, 9, "0030.000000000,N,00030.000000000,E"},
};

class WrittenPositions : public testing::TestWithParam<Position> {};

TEST_P(WrittenPositions, AreDegreesAndMinutes) {
  const Position& row = GetParam();
  EXPECT_EQ(written([&](SentenceWriter& out) { out.latLon(row.position, row.decimals); }),
            row.text);
}

INSTANTIATE_TEST_SUITE_P(Table, WrittenPositions, testing::ValuesIn(kPositions),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Invalid {
  const char* name;
  void (*write)(SentenceWriter&);
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Invalid kInvalid[] = {
    {"nan", [](SentenceWriter& out) { out.number(kNan, 1); }},
    {"infinity", [](SentenceWriter& out) { out.number(kInfinity, 1); }},
    {"minus_infinity", [](SentenceWriter& out) { out.number(-kInfinity, 1); }},
    {"sixteen_digits", [](SentenceWriter& out) { out.number(1e15, 1); }},
    {"negative_decimals", [](SentenceWriter& out) { out.number(1.0, -1); }},
    {"too_many_decimals", [](SentenceWriter& out) { out.number(1.0, 10); }},
    {"negative_time", [](SentenceWriter& out) { out.timeOfDay(microseconds{-1}); }},
    {"time_after_the_leap_second",
     [](SentenceWriter& out) { out.timeOfDay(hours{24} + milliseconds{1000}); }},
    {"year_1979",
     [](SentenceWriter& out) {
       out.date(Date{1979, 12, 31});
     }},
    {"year_2080",
     [](SentenceWriter& out) {
       out.date(Date{2080, 1, 1});
     }},
    {"month_13",
     [](SentenceWriter& out) {
       out.date(Date{2014, 13, 1});
     }},
    {"day_0",
     [](SentenceWriter& out) {
       out.date(Date{2014, 12, 0});
     }},
    {"latitude_above_90",
     [](SentenceWriter& out) {
       out.latLon(LatLon{90.1, 0.0}, 6);
     }},
    {"longitude_above_180",
     [](SentenceWriter& out) {
       out.latLon(LatLon{0.0, -180.1}, 6);
     }},
    {"latitude_nan",
     [](SentenceWriter& out) {
       out.latLon(LatLon{kNan, 0.0}, 6);
     }},
    {"too_many_minute_decimals",
     [](SentenceWriter& out) {
       out.latLon(LatLon{0.0, 0.0}, 10);
     }},
    {"comma", [](SentenceWriter& out) { out.text("a,b"); }},
    {"asterisk", [](SentenceWriter& out) { out.text("a*b"); }},
    {"dollar", [](SentenceWriter& out) { out.text("a$b"); }},
    {"line_break", [](SentenceWriter& out) { out.text("a\r\nb"); }},
    {"not_ascii", [](SentenceWriter& out) { out.text("\xC3\xA9"); }},
    {"delete", [](SentenceWriter& out) { out.text("\x7F"); }},
    {"too_long", [](SentenceWriter& out) { out.text(std::string(1015, 'x')); }},
    {"too_many_fields",
     [](SentenceWriter& out) {
       for (int i = 0; i < 2000; ++i) out.blank();
     }},
    {"written_after_its_end",
     [](SentenceWriter& out) {
       out.finish();
       out.blank();
     }},
};

class InvalidSentences : public testing::TestWithParam<Invalid> {};

TEST_P(InvalidSentences, AreNotSent) { EXPECT_EQ(written(GetParam().write), "invalid"); }

TEST_P(InvalidSentences, StayInvalid) {
  const auto write = [](SentenceWriter& out) {
    GetParam().write(out);
    out.integer(1);
  };
  EXPECT_EQ(written(write), "invalid");
}

INSTANTIATE_TEST_SUITE_P(Table, InvalidSentences, testing::ValuesIn(kInvalid),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(SentenceWriter, FillsItsBufferToTheLastByte) {
  const std::string text(1014, 'x');  // with `$ABCDE,` and `*hh` CR LF: 1026
  SentenceWriter out{"AB", "CDE"};
  out.text(text);
  const auto line = out.finish();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->size(), SentenceWriter::kCapacity);
}

TEST(SentenceWriter, RefusesWhatIsNoAddress) {
  for (const char* formatter : {"", "nvg", "N G", "NVG,", "NVGNVGN"}) {
    SentenceWriter out{"BF", formatter};
    EXPECT_EQ(out.finish(), std::nullopt) << formatter;
  }
}

TEST(FieldText, IsPrintableWithoutWhatEndsAField) {
  EXPECT_TRUE(isFieldText(""));
  EXPECT_TRUE(isFieldText(" abc ~ !#+-./:;_"));
  for (const char* text : {",", "*", "$", "\n", "\r", "\t", "\x7F", "\x80", "\x1F"}) {
    EXPECT_FALSE(isFieldText(text));
  }
}

}  // namespace
}  // namespace frontseat_driver::nmea
