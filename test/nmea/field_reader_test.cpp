#include "frontseat_driver/nmea/field_reader.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace frontseat_driver::nmea {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

/// `fields` must outlive the reader.
FieldReader reader(std::string_view fields) { return FieldReader{Sentence{"ABCDE", fields, true}}; }

struct Time {
  const char* name;
  const char* text;
  TimeOfDay time;
};

const Time kTimes[] = {
    {"midnight", "000000", hours{0}},
    {"whole_seconds", "081025", hours{8} + minutes{10} + seconds{25}},
    {"point_without_decimals", "081025.", hours{8} + minutes{10} + seconds{25}},
    {"two_decimals", "150216.20", hours{15} + minutes{2} + seconds{16} + milliseconds{200}},
    {"milliseconds", "081025.987", hours{8} + minutes{10} + seconds{25} + milliseconds{987}},
    {"microseconds", "000000.000001", microseconds{1}},
    {"finer_is_cut_off", "000000.0000019999", microseconds{1}},
    {"last_of_the_day", "235959.999999", hours{24} - microseconds{1}},
    {"leap_second", "235960.5", hours{24} + milliseconds{500}},
    {"rounded_up_seconds", "120060.000", hours{12} + minutes{1}},
    {"blanks_around", " 010203.5 ", hours{1} + minutes{2} + seconds{3} + milliseconds{500}},
};

class Times : public testing::TestWithParam<Time> {};

TEST_P(Times, AreRead) {
  FieldReader in = reader(GetParam().text);
  EXPECT_EQ(in.timeOfDay(), GetParam().time);
  EXPECT_EQ(in.faults().count, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, Times, testing::ValuesIn(kTimes),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Refused {
  const char* name;
  const char* text;
  Fault fault;
};

std::string nameOf(const testing::TestParamInfo<Refused>& row) { return row.param.name; }

/// Expects that `read` refuses the text, and that the next field is read all the same.
template <class Read>
void expectRefused(const Refused& row, Read read) {
  const std::string fields = std::string{row.text} + ",7";
  FieldReader in = reader(fields);
  EXPECT_FALSE(read(in));
  EXPECT_EQ(in.faults().count, 1);
  EXPECT_EQ(in.faults().first.fault, row.fault);
  EXPECT_EQ(in.faults().first.field, 1);
  EXPECT_EQ(in.integer(), 7);
}

const Refused kRefusedTimes[] = {
    {"five_digits", "81025", Fault::BadValue},
    {"five_digits_and_decimals", "81025.98", Fault::BadValue},
    {"seven_digits", "0810250", Fault::BadValue},
    {"short", "0810", Fault::BadValue},
    {"letter_in_hours", "x81025", Fault::BadValue},
    {"letter_in_seconds", "08102x", Fault::BadValue},
    {"letter_in_decimals", "081025.9x", Fault::BadValue},
    {"sign", "-81025", Fault::BadValue},
    {"colons", "08:10:25", Fault::BadValue},
    {"hour_24", "240000", Fault::OutOfRange},
    {"minute_60", "006000", Fault::OutOfRange},
    {"second_61", "000061", Fault::OutOfRange},
};

class RefusedTimes : public testing::TestWithParam<Refused> {};

TEST_P(RefusedTimes, AreFaults) {
  expectRefused(GetParam(), [](FieldReader& in) { return in.timeOfDay().has_value(); });
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedTimes, testing::ValuesIn(kRefusedTimes), nameOf);

TEST(DateField, IsReadInBothCenturies) {
  FieldReader in = reader("311214,010180,311279,290200,290224, 260614 ,");
  EXPECT_EQ(in.date(), (Date{2014, 12, 31}));
  EXPECT_EQ(in.date(), (Date{1980, 1, 1}));
  EXPECT_EQ(in.date(), (Date{2079, 12, 31}));
  EXPECT_EQ(in.date(), (Date{2000, 2, 29}));
  EXPECT_EQ(in.date(), (Date{2024, 2, 29}));
  EXPECT_EQ(in.date(), (Date{2014, 6, 26}));
  EXPECT_EQ(in.date(), std::nullopt);
  EXPECT_EQ(in.faults().count, 0);
}

const Refused kRefusedDates[] = {
    {"five_digits", "31121", Fault::BadValue},    {"seven_digits", "3112140", Fault::BadValue},
    {"letter", "31x214", Fault::BadValue},        {"day_0", "001214", Fault::OutOfRange},
    {"day_32", "321214", Fault::OutOfRange},      {"month_0", "310014", Fault::OutOfRange},
    {"month_13", "311314", Fault::OutOfRange},    {"april_31", "310414", Fault::OutOfRange},
    {"no_leap_day", "290223", Fault::OutOfRange},
};

class RefusedDates : public testing::TestWithParam<Refused> {};

TEST_P(RefusedDates, AreFaults) {
  expectRefused(GetParam(), [](FieldReader& in) { return in.date().has_value(); });
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedDates, testing::ValuesIn(kRefusedDates), nameOf);

TEST(IntegerField, IsRead) {
  FieldReader in = reader("0,-0,+5,-12,007,3.,3.000, 42 ,9223372036854775807,-9223372036854775808");
  for (const std::int64_t value : {0, 0, 5, -12, 7, 3, 3, 42}) EXPECT_EQ(in.integer(), value);
  EXPECT_EQ(in.integer(), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(in.integer(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(in.faults().count, 0);
}

TEST(IntegerField, WithinARangeIncludesItsEdges) {
  FieldReader in = reader("0,3,-1,4,,nan");
  EXPECT_EQ(in.integer(0, 3), 0);
  EXPECT_EQ(in.integer(0, 3), 3);
  EXPECT_EQ(in.integer(0, 3), std::nullopt);
  EXPECT_EQ(in.faults().first.fault, Fault::OutOfRange);
  EXPECT_EQ(in.integer(0, 3), std::nullopt);
  EXPECT_EQ(in.faults().count, 2);
  EXPECT_EQ(in.integer(0, 3), std::nullopt);
  EXPECT_EQ(in.integer(0, 3), std::nullopt);
  EXPECT_EQ(in.faults().count, 2);
}

const Refused kRefusedIntegers[] = {
    {"decimals", "1.5", Fault::BadValue},
    {"late_decimal", "1.0001", Fault::BadValue},
    {"exponent", "1e3", Fault::BadValue},
    {"point_first", ".0", Fault::BadValue},
    {"letter", "x", Fault::BadValue},
    {"sign_alone", "-", Fault::BadValue},
    {"two_numbers", "1 2", Fault::BadValue},
    {"too_large", "9223372036854775808", Fault::OutOfRange},
    {"too_small", "-9223372036854775809", Fault::OutOfRange},
    {"twice_too_large", "18446744073709551617", Fault::OutOfRange},
    {"much_too_large", "100000000000000000000000000000", Fault::OutOfRange},
};

class RefusedIntegers : public testing::TestWithParam<Refused> {};

TEST_P(RefusedIntegers, AreFaults) {
  expectRefused(GetParam(), [](FieldReader& in) { return in.integer().has_value(); });
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedIntegers, testing::ValuesIn(kRefusedIntegers), nameOf);

TEST(EitherField, IsOneOfTwoTexts) {
  FieldReader in = reader("ON,OFF,, ON ,on");
  EXPECT_EQ(in.either("ON", "OFF"), true);
  EXPECT_EQ(in.either("ON", "OFF"), false);
  EXPECT_EQ(in.either("ON", "OFF"), std::nullopt);
  EXPECT_EQ(in.either("ON", "OFF"), true);
  EXPECT_EQ(in.faults().count, 0);
  EXPECT_EQ(in.either("ON", "OFF"), std::nullopt);
  EXPECT_EQ(in.faults().first.fault, Fault::BadValue);
  EXPECT_EQ(in.faults().first.field, 5);
}

TEST(TextField, IsTakenWithoutTheBlanksAround) {
  FieldReader in = reader("Running /logs/1,  a b  ,, ,nan");
  EXPECT_EQ(in.text(), "Running /logs/1");
  EXPECT_EQ(in.text(), "a b");
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.text(), "nan");
  EXPECT_EQ(in.faults().count, 0);
}

TEST(FieldReader, CountsWhatIsLeft) {
  FieldReader in = reader("1,,3");
  EXPECT_EQ(in.remaining(), 3);
  in.text();
  EXPECT_EQ(in.remaining(), 2);
  in.text();
  EXPECT_EQ(in.remaining(), 1);
  in.text();
  EXPECT_EQ(in.remaining(), 0);
  in.text();
  EXPECT_EQ(in.remaining(), 0);
  EXPECT_EQ(reader("").remaining(), 1);
  EXPECT_EQ(reader(",").remaining(), 2);
  EXPECT_EQ((FieldReader{Sentence{"ABCDE", "", false}}.remaining()), 0);
}

TEST(FieldReader, TellsAMissingFieldFromABlankOne) {
  FieldReader in = reader("1,");
  EXPECT_EQ(in.number(), 1.0);
  EXPECT_EQ(in.number(), std::nullopt);
  EXPECT_EQ(in.faults().count, 0);
  EXPECT_EQ(in.number(), std::nullopt);
  EXPECT_EQ(in.faults().count, 1);
  EXPECT_EQ(in.faults().first.fault, Fault::MissingField);
  EXPECT_EQ(in.faults().first.field, 3);
}

TEST(FieldReader, OfASentenceWithoutCommaHasNoField) {
  for (const std::string_view nothing : {std::string_view{""}, std::string_view{}}) {
    FieldReader in{Sentence{"ABCDE", nothing, false}};
    EXPECT_EQ(in.text(), "");
    EXPECT_EQ(in.faults().first.fault, Fault::MissingField);
    EXPECT_EQ(in.faults().first.field, 1);
  }
}

TEST(FieldReader, LetsOptionalFieldsBeMissing) {
  FieldReader in = reader("1");
  EXPECT_EQ(in.number(), 1.0);
  in.optionalFromHere();
  EXPECT_EQ(in.timeOfDay(), std::nullopt);
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.latLon(DegreeSplit::FromPoint), std::nullopt);
  EXPECT_EQ(in.faults().count, 0);
}

TEST(FieldReader, KeepsTheFirstFaultAndCountsAll) {
  FieldReader in = reader("1,x,250000,y");
  in.number();
  in.number();
  in.timeOfDay();
  in.integer();
  in.text();
  EXPECT_EQ(in.faults().count, 4);
  EXPECT_EQ(in.faults().first.fault, Fault::BadValue);
  EXPECT_EQ(in.faults().first.field, 2);
}

}  // namespace
}  // namespace frontseat_driver::nmea
