// What is written where rounding or a range is in the way.
#include <gtest/gtest.h>

#include <limits>

#include "decoding.h"

namespace frontseat_driver::protocol {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Heading {
  const char* name;
  double heading_deg;
  const char* whole;  ///< in PYDEV
  const char* fine;   ///< in CPRCM
};

const Heading kHeadings[] = {
    {"north", 0.0, "0", "0.0000"},
    {"minus_zero", -0.0, "0", "0.0000"},
    {"rounds_down", 89.4, "89", "89.4000"},
    {"rounds_up", 89.6, "90", "89.6000"},
    {"last_whole_degree", 359.4, "359", "359.4000"},
    {"rounds_up_to_north", 359.6, "0", "359.6000"},
    {"tie_below_north", 359.5, "0", "359.5000"},
    {"rounds_up_to_north_in_the_last_decimal", 359.99996, "0", "0.0000"},
    {"just_does_not", 359.99994, "0", "359.9999"},
    {"full_turn", 360.0, "0", "0.0000"},
    {"a_bit_more_than_a_turn", 360.75, "1", "0.7500"},
    {"more_than_a_turn", 450.0, "90", "90.0000"},
    {"negative", -90.0, "270", "270.0000"},
    {"barely_negative", -1e-9, "0", "0.0000"},
};

class Headings : public testing::TestWithParam<Heading> {};

TEST_P(Headings, AreNever360) {
  const kingfisher::HeadingAndSpeed course{GetParam().heading_deg, 0.0};
  EXPECT_EQ(written("PY", course),
            test::framed(std::string{"PYDEV,"} + GetParam().whole + ",0.000"));
  const kingfisher::RawCompass compass{{}, 1, GetParam().heading_deg, {}, {}, {}};
  EXPECT_EQ(written("CP", compass),
            test::framed(std::string{"CPRCM,,1,"} + GetParam().fine + ",,,"));
}

INSTANTIATE_TEST_SUITE_P(Table, Headings, testing::ValuesIn(kHeadings),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(Thrust, HasNoSignAtZero) {
  EXPECT_EQ(written("PY", kingfisher::MotorThrust{-0.4, 0.4, 0}), test::framed("PYDIR,0,0"));
  EXPECT_EQ(written("PY", kingfisher::MotorThrust{-0.04, -0.06, 1}),
            test::framed("PYDIR,0.0,-0.1"));
  EXPECT_EQ(written("PY", kingfisher::ThrustAndYawRate{-0.00004, -0.4, 0}),
            test::framed("PYDEP,0.0000,0"));
}

TEST(Position, CarriesMinutesThatRoundUpTo60) {
  NavigationUpdate nav;
  nav.position = nmea::LatLon{42.99999999999, -70.99999999999};
  EXPECT_EQ(written("BF", nav), test::framed("BFNVG,,4300.000000,N,07100.000000,W,,,,,,,"));
}

TEST(Message, WithAValueThatIsNoneIsNotWritten) {
  NavigationUpdate nav;
  nav.heading_deg = kNan;
  EXPECT_EQ(written("BF", nav), "invalid");
  EXPECT_EQ(written("PY", kingfisher::MotorThrust{kNan, 0.0, 0}), "invalid");
  EXPECT_EQ(written("PY", kingfisher::HeadingAndSpeed{kNan, 0.0}), "invalid");
  EXPECT_EQ(
      written("PY", kingfisher::HeadingAndSpeed{std::numeric_limits<double>::infinity(), 0.0}),
      "invalid");
  EXPECT_EQ(written("BP", bluefin::AbortMission{{}, "a,b", true}), "invalid");
}

TEST(Message, IsWrittenWithItsOwnTalker) {
  nmea::SentenceWriter out = write(bluefin::LogRequest{"ACK", true});
  EXPECT_EQ(out.finish(), test::framed("BPLOG,ACK,ON") + "\r\n");
}

}  // namespace
}  // namespace frontseat_driver::protocol
