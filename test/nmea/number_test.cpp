// Numbers, which must read as strtod reads them, in any locale.
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include "frontseat_driver/nmea/field_reader.h"

namespace frontseat_driver::nmea {
namespace {

/// `fields` must outlive the reader.
FieldReader reader(std::string_view fields) { return FieldReader{Sentence{"ABCDE", fields, true}}; }

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof value);
  return result;
}

struct Number {
  const char* name;
  const char* text;
  double value;
};

const Number kNumbers[] = {
    {"zero", "0", 0.0},
    {"minus_zero", "-0.0", -0.0},
    {"one", "1", 1.0},
    {"negative", "-3.4", -3.4},
    {"plus", "+3.4", 3.4},
    {"no_digit_before_point", ".5", 0.5},
    {"no_digit_after_point", "5.", 5.0},
    {"negative_without_digit_before_point", "-.25", -0.25},
    {"leading_zeros", "000000000000000000000000012.5", 12.5},
    {"trailing_zeros", "12.5000000000000000000000000", 12.5},
    {"exponent", "1.5e3", 1500.0},
    {"capital_exponent", "15E-1", 1.5},
    {"plus_in_exponent", "1e+2", 100.0},
    {"blanks_around", "  7.25  ", 7.25},
    {"minutes", "21.711142", 21.711142},
    {"largest_exact_integer", "9007199254740992", 9007199254740992.0},
    {"tie_to_even_down", "9007199254740993", 9007199254740992.0},
    {"tie_to_even_up", "9007199254740995", 9007199254740996.0},
    {"just_above_a_tie", "9007199254740993.00000000000000000000000001", 9007199254740994.0},
    {"nineteen_digits", "1234567890123456789", 1234567890123456768.0},
    {"twenty_digits", "12345678901234567890", 12345678901234567168.0},
    {"power_22", "1e22", 1e22},
    {"power_23", "1e23", 1e23},
    {"largest", "1e30", 1e30},
    {"rounds_down_to_the_largest", "1.00000000000000000000001e30", 1e30},
    {"smallest_normal", "2.2250738585072014e-308", std::numeric_limits<double>::min()},
    {"smallest", "4.9406564584124654e-324", std::numeric_limits<double>::denorm_min()},
    {"half_of_the_smallest", "2.4703282292062327e-324", 0.0},
    {"above_half_of_the_smallest", "2.4703282292062328e-324",
     std::numeric_limits<double>::denorm_min()},
    {"below_everything", "1e-400", 0.0},
    {"zero_times_a_huge_power", "0e999999999999", 0.0},
    {"tiny_power", "1e-99999999999999999999", 0.0},
};

class Numbers : public testing::TestWithParam<Number> {};

TEST_P(Numbers, AreRead) {
  FieldReader in = reader(GetParam().text);
  const auto value = in.number();
  ASSERT_TRUE(value);
  EXPECT_EQ(bits(*value), bits(GetParam().value)) << *value;
  EXPECT_EQ(in.faults().count, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, Numbers, testing::ValuesIn(kNumbers),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Number, OfBlankOrNotFiniteFieldsIsNone) {
  for (const char* text : {"", " ", "nan", "-nan", "+nan", "NaN", "NAN", "inf", "-inf", "INF",
                           "Infinity", "-Infinity", " nan "}) {
    const std::string fields = std::string{text} + ",1";
    FieldReader in = reader(fields);
    EXPECT_EQ(in.number(), std::nullopt) << text;
    EXPECT_EQ(in.faults().count, 0) << text;
    EXPECT_EQ(in.number(), 1.0) << text;
  }
}

TEST(Number, OfAnythingElseIsBadValue) {
  for (const char* text :
       {"x",     "1x",   "x1",  "1.2.3",   "1..2", ".",     "-",   "+",    "--1",
        "+-1",   "1e",   "1e+", "e5",      ".e5",  "1 2",   "- 1", "0x10", "1e5.0",
        "1'000", "nanx", "na",  "infinit", "nan1", "1_000", "٣"}) {
    // Also where there is enough before it to be read in one piece.
    const std::string fields = std::string{text} + ",1234567890," + text + ",1";
    FieldReader in = reader(fields);
    EXPECT_EQ(in.number(), std::nullopt) << text;
    EXPECT_EQ(in.faults().count, 1) << text;
    EXPECT_EQ(in.faults().first.fault, Fault::BadValue) << text;
    EXPECT_EQ(in.faults().first.field, 1) << text;
    EXPECT_EQ(in.number(), 1234567890.0) << text;
    EXPECT_EQ(in.number(), std::nullopt) << text;
    EXPECT_EQ(in.faults().count, 2) << text;
    EXPECT_EQ(in.number(), 1.0) << text;
  }
}

TEST(Number, TooLargeIsOutOfRange) {
  for (const std::string& text :
       {std::string{"1.0000000000000003e30"}, std::string{"-1e31"}, std::string{"1e308"},
        std::string{"1e309"}, std::string{"-1e309"}, std::string{"1.7976931348623159e308"},
        std::string(400, '9'), std::string{"1e99999999999999999999"}}) {
    FieldReader in = reader(text);
    EXPECT_EQ(in.number(), std::nullopt) << text;
    EXPECT_EQ(in.faults().first.fault, Fault::OutOfRange) << text;
  }
}

TEST(Number, WithinARangeIncludesItsEdges) {
  FieldReader in = reader("-1,1,-1.0000000000000002,1.0000000000000002,nan,,x");
  EXPECT_EQ(in.numberIn(-1.0, 1.0), -1.0);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), 1.0);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), std::nullopt);
  EXPECT_EQ(in.faults().first.fault, Fault::OutOfRange);
  EXPECT_EQ(in.faults().first.field, 3);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), std::nullopt);
  EXPECT_EQ(in.faults().count, 2);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), std::nullopt);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), std::nullopt);
  EXPECT_EQ(in.faults().count, 2);
  EXPECT_EQ(in.numberIn(-1.0, 1.0), std::nullopt);
  EXPECT_EQ(in.faults().count, 3);  // once, not also out of range
}

void expectAsStrtod(const std::string& text) {
  const double expected = std::strtod(text.c_str(), nullptr);
  FieldReader in = reader(text);
  const auto value = in.number();
  if (std::abs(expected) > FieldReader::kLargest) {
    EXPECT_EQ(value, std::nullopt) << text;
    EXPECT_EQ(in.faults().first.fault, Fault::OutOfRange) << text;
    return;
  }
  ASSERT_TRUE(value) << text;
  ASSERT_EQ(bits(*value), bits(expected)) << text;
}

/// Digits with a point somewhere, or none.
std::string randomDigits(std::mt19937_64& random, std::size_t most) {
  const std::size_t size = 1 + random() % most;
  const std::size_t point = random() % (size + 4);
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    if (i == point) text += '.';
    text += static_cast<char>('0' + random() % 10);
  }
  return text;
}

TEST(Number, EqualsStrtodAsVehiclesWriteThem) {
  std::mt19937_64 random{2014};
  for (int i = 0; i < 1'000'000; ++i) {
    expectAsStrtod((i % 2 == 0 ? "-" : "") + randomDigits(random, 12));
    if (HasFatalFailure()) return;
  }
}

TEST(Number, EqualsStrtodWithAnyDigitsAndExponent) {
  std::mt19937_64 random{2015};
  for (int i = 0; i < 60'000; ++i) {
    const int exponent = static_cast<int>(random() % 700) - 350;
    expectAsStrtod(randomDigits(random, i % 100 == 0 ? 900 : 40) + "e" + std::to_string(exponent));
    if (HasFatalFailure()) return;
  }
}

TEST(Number, EqualsStrtodOnAndBesideTies) {
  std::mt19937_64 random{2016};
  for (int i = 0; i < 8'000; ++i) {
    // Half way between two doubles there are 54 bits: a 53-bit number and a half, exact in text.
    const std::uint64_t whole = (std::uint64_t{1} << 52) + random() % (std::uint64_t{1} << 52);
    for (const char* tail :
         {".5", ".50000000000000000000000000001", ".49999999999999999999999999"}) {
      expectAsStrtod(std::to_string(whole) + tail);
      expectAsStrtod("0." + std::to_string(whole) + tail[1] + "e-290");
    }
    if (HasFatalFailure()) return;
  }
}

TEST(Number, EqualsStrtodForAnyDoubleAsPrinted) {
  std::mt19937_64 random{2017};
  char text[900];
  for (int i = 0; i < 40'000; ++i) {
    const std::uint64_t pattern = random();
    double value = 0.0;
    std::memcpy(&value, &pattern, sizeof value);
    if (!std::isfinite(value)) continue;
    std::snprintf(text, sizeof text, "%.*e", i % 50 == 0 ? 800 : 16, value);
    expectAsStrtod(text);
    if (HasFatalFailure()) return;
  }
}

/// Fields of any kind one after the other, so that each stands at every place once: numbers are
/// found by where the commas and points of 64 characters at a time are.
TEST(Number, EqualsStrtodWhereverItStands) {
  std::mt19937_64 random{2018};
  for (int i = 0; i < 100'000; ++i) {
    std::vector<std::string> fields(1 + random() % 24);
    std::string line;
    for (std::string& field : fields) {
      const bool blank = random() % 8 == 0;
      if (!blank) field = (random() % 2 == 0 ? "-" : "") + randomDigits(random, 1 + random() % 12);
      line += (&field == &fields.front() ? "" : ",") + field;
    }
    const std::vector<char> exactly(line.begin(), line.end());  // nothing to read beyond its end
    FieldReader in = reader({exactly.data(), exactly.size()});
    for (const std::string& field : fields) {
      const auto value = in.number();
      ASSERT_EQ(value.has_value(), !field.empty()) << line;
      if (!value) continue;
      ASSERT_EQ(bits(*value), bits(std::strtod(field.c_str(), nullptr))) << line;
    }
    ASSERT_EQ(in.remaining(), 0) << line;
    ASSERT_EQ(in.faults().count, 0) << line;
  }
}

/// A blank in front makes a field be read the long way.
TEST(Fields, AreReadTheSameQuicklyAndTheLongWay) {
  std::mt19937_64 random{2019};
  const auto digits = [&](std::size_t count) {
    std::string out;
    while (out.size() < count) out += static_cast<char>('0' + random() % 10);
    return out;
  };
  for (int i = 0; i < 200'000; ++i) {
    const auto decimals = [&] { return random() % 4 == 0 ? "" : "." + digits(random() % 9); };
    const std::string latitude = digits(3 + random() % 3) + decimals();
    const std::string longitude = digits(3 + random() % 4) + decimals();
    const std::string time = digits(6 + (random() % 16 == 0 ? 1 : 0)) + decimals();
    const std::string whole = digits(1 + random() % 3);
    const std::string quick = time + ',' + latitude + ",N," + longitude + ",W," + whole;
    const std::string slow = ' ' + time + ", " + latitude + ", N, " + longitude + ", W, " + whole;
    const auto split = random() % 2 == 0 ? DegreeSplit::FromLeft : DegreeSplit::FromPoint;
    FieldReader a = reader(quick);
    FieldReader b = reader(slow);
    ASSERT_EQ(a.timeOfDay(), b.timeOfDay()) << quick;
    ASSERT_EQ(a.latLon(split), b.latLon(split)) << quick;
    ASSERT_EQ(a.integer(), b.integer()) << quick;
    ASSERT_EQ(a.faults().count, b.faults().count) << quick;
    ASSERT_EQ(a.faults().first.field, b.faults().first.field) << quick;
    ASSERT_EQ(a.faults().first.fault, b.faults().first.fault) << quick;
  }
}

/// Decimal commas wherever the process can have them: in C if the machine knows such a locale, and
/// in the C++ streams in any case.
class CommaLocale {
 public:
  CommaLocale() {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    }
    std::locale::global(std::locale{std::locale{}, new Commas});
  }
  ~CommaLocale() {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
  }

 private:
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
};

TEST(Number, IsTheSameInALocaleWithCommas) {
  const CommaLocale locale;
  FieldReader in = reader("4221.711142,-0.5,12345678901234567890.5");
  EXPECT_EQ(in.number(), 4221.711142);
  EXPECT_EQ(in.number(), -0.5);
  EXPECT_EQ(in.number(), 12345678901234567890.5);
  EXPECT_EQ(in.faults().count, 0);
}

}  // namespace
}  // namespace frontseat_driver::nmea
