// Latitude and longitude, read by both rules.
#include <gtest/gtest.h>

#include <string>

#include "frontseat_driver/nmea/field_reader.h"

namespace frontseat_driver::nmea {
namespace {

constexpr auto kFromLeft = DegreeSplit::FromLeft;
constexpr auto kFromPoint = DegreeSplit::FromPoint;

/// `fields` must outlive the reader.
FieldReader reader(std::string_view fields) { return FieldReader{Sentence{"ABCDE", fields, true}}; }

struct Position {
  const char* name;
  const char* text;
  DegreeSplit split;
  double latitude, longitude;
};

const Position kPositions[] = {
    {"spi_example", "4221.81092,N,07106.84603,W", kFromLeft, 42 + 21.81092 / 60,
     -(71 + 6.84603 / 60)},
    {"well_formed_from_point", "4221.81092,N,07106.84603,W", kFromPoint, 42 + 21.81092 / 60,
     -(71 + 6.84603 / 60)},
    {"sandshark_unpadded_minutes", "429.123456,N,0715.5,W", kFromLeft, 42 + 9.123456 / 60,
     -(71 + 5.5 / 60)},
    {"heron_dropped_zero", "4221.711142,N,7105.44878,W", kFromPoint, 42 + 21.711142 / 60,
     -(71 + 5.44878 / 60)},
    {"heron_near_greenwich", "130.5,N,30.6,W", kFromPoint, 1 + 30.5 / 60, -(30.6 / 60)},
    {"one_digit_of_minutes", "5.5,N,0.25,E", kFromPoint, 5.5 / 60, 0.25 / 60},
    {"south_and_east", "3351.5,S,15112.25,E", kFromLeft, -(33 + 51.5 / 60), 151 + 12.25 / 60},
    {"whole_minutes", "4230,N,07106,W", kFromLeft, 42.5, -(71 + 6.0 / 60)},
    {"whole_minutes_from_point", "4230,N,07106,W", kFromPoint, 42.5, -(71 + 6.0 / 60)},
    {"point_without_decimals", "4230.,N,07106.,W", kFromPoint, 42.5, -(71 + 6.0 / 60)},
    {"minutes_rounded_to_60", "4260.000,N,07160.000,W", kFromLeft, 43.0, -72.0},
    {"pole_and_date_line", "9000.0,S,18000.0,W", kFromLeft, -90.0, -180.0},
    {"zero", "0000.000000,N,00000.000000,E", kFromLeft, 0.0, 0.0},
    {"zero_with_fewer_digits", "00.000000,N,0.0,E", kFromLeft, 0.0, 0.0},
    {"zero_from_point", "0.000000,N,0.000000,E", kFromPoint, 0.0, 0.0},
    {"blanks_around", " 4230.0 , N , 07106.0 , W ", kFromLeft, 42.5, -(71 + 6.0 / 60)},
};

class Positions : public testing::TestWithParam<Position> {};

TEST_P(Positions, AreReadToTheLastBit) {
  FieldReader in = reader(GetParam().text);
  const auto position = in.latLon(GetParam().split);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->latitude_deg, GetParam().latitude);
  EXPECT_EQ(position->longitude_deg, GetParam().longitude);
  EXPECT_EQ(in.faults().count, 0);
  EXPECT_EQ(in.remaining(), 0);
}

// Where there is enough before and after them they are read in one piece.
TEST_P(Positions, AreTheSameAmongOtherFields) {
  const std::string fields = std::string{"1234567890,"} + GetParam().text + ",1234567890";
  FieldReader in = reader(fields);
  EXPECT_EQ(in.number(), 1234567890.0);
  const auto position = in.latLon(GetParam().split);
  ASSERT_TRUE(position);
  EXPECT_EQ(position->latitude_deg, GetParam().latitude);
  EXPECT_EQ(position->longitude_deg, GetParam().longitude);
  EXPECT_EQ(in.number(), 1234567890.0);
  EXPECT_EQ(in.faults().count, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, Positions, testing::ValuesIn(kPositions),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Refused {
  const char* name;
  const char* text;
  DegreeSplit split;
  Fault fault;
  int field;
};

const Refused kRefused[] = {
    {"minutes_above_60", "4260.001,N,07106.0,W", kFromPoint, Fault::OutOfRange, 1},
    {"minutes_above_60_from_left", "4261.0,N,07106.0,W", kFromLeft, Fault::OutOfRange, 1},
    {"three_digits_of_minutes", "42100.0,N,07106.0,W", kFromLeft, Fault::OutOfRange, 1},
    {"latitude_above_90", "9000.001,N,07106.0,W", kFromPoint, Fault::OutOfRange, 1},
    {"longitude_above_180", "4230.0,N,18000.001,W", kFromPoint, Fault::OutOfRange, 3},
    {"longitude_without_its_zero", "4230.0,N,7106.0,W", kFromLeft, Fault::OutOfRange, 3},
    {"far_too_many_digits", "4230.0,N,123456789012345678901234567890.5,W", kFromPoint,
     Fault::OutOfRange, 3},
    {"degrees_alone", "42,N,07106.0,W", kFromLeft, Fault::BadValue, 1},
    {"decimal_degrees", "42.5,N,07106.0,W", kFromLeft, Fault::BadValue, 1},
    {"negative", "-4230.0,N,07106.0,W", kFromPoint, Fault::BadValue, 1},
    {"plus", "+4230.0,N,07106.0,W", kFromPoint, Fault::BadValue, 1},
    {"exponent", "4.2e3,N,07106.0,W", kFromPoint, Fault::BadValue, 1},
    {"letters", "4230.0,N,abc,W", kFromPoint, Fault::BadValue, 3},
    {"two_points", "42.30.0,N,07106.0,W", kFromPoint, Fault::BadValue, 1},
    {"lower_case_hemisphere", "4230.0,n,07106.0,W", kFromPoint, Fault::BadValue, 2},
    {"hemispheres_swapped", "4230.0,W,07106.0,N", kFromPoint, Fault::BadValue, 2},
    {"long_hemisphere", "4230.0,N,07106.0,WEST", kFromPoint, Fault::BadValue, 4},
    {"too_few_fields", "4230.0,N,07106.0", kFromPoint, Fault::MissingField, 4},
};

class RefusedPositions : public testing::TestWithParam<Refused> {};

TEST_P(RefusedPositions, NameTheField) {
  FieldReader in = reader(GetParam().text);
  EXPECT_EQ(in.latLon(GetParam().split), std::nullopt);
  EXPECT_EQ(in.faults().first.fault, GetParam().fault);
  EXPECT_EQ(in.faults().first.field, GetParam().field);
}

INSTANTIATE_TEST_SUITE_P(Table, RefusedPositions, testing::ValuesIn(kRefused),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Position, IsNoneIfAnyOfItsFieldsIsBlank) {
  for (const char* text : {",,,", ",N,07106.0,W", "4230.0,,07106.0,W", "4230.0,N,,W",
                           "4230.0,N,07106.0,", "nan,N,nan,W"}) {
    const std::string fields = std::string{text} + ",7";
    FieldReader in = reader(fields);
    EXPECT_EQ(in.latLon(DegreeSplit::FromPoint), std::nullopt) << text;
    EXPECT_EQ(in.faults().count, 0) << text;
    EXPECT_EQ(in.number(), 7.0) << text;
  }
}

}  // namespace
}  // namespace frontseat_driver::nmea
