#include "decode/fault_note.h"

#include <gtest/gtest.h>

#include <string>

#include "decode/line_output.h"
#include "records.h"

namespace frontseat_driver::decode {
namespace {

struct Faulty {
  const char* name;
  std::string line;
  const char* reason;
  int field;
  const char* field_name;
  std::size_t column;
  int more = 0;
};

std::string navigation(const std::string& heading, const std::string& rest = "0,0,000103") {
  return test::framed("BFNVG,000102,1230.0,N,01230.0,W,1,7,8," + heading + "," + rest);
}

// Columns are counted by hand; the `$` is 1.
const Faulty kFaulty[] = {
    {"wrong_checksum", "$BFCTL,000102,1*00", "wrong checksum: 00 sent, 6D computed", 0, "", 17},
    {"missing_checksum", "$BFCTL,000102,1*", "missing checksum", 0, "", 17},
    {"no_star", "$BFCTL,000102,1", "malformed frame", 0, "", 16},
    {"one_digit", "$BFCTL,000102,1*6", "malformed frame", 0, "", 18},
    {"no_hex", "$BFCTL,000102,1*G9", "malformed frame", 0, "", 17},
    {"second_digit_no_hex", "$BFCTL,000102,1*6G", "malformed frame", 0, "", 18},
    {"more_than_a_checksum", "$BFCTL,000102,1*691", "malformed frame", 0, "", 19},
    {"control_character", "$BFCTL\x07,000102,1*69", "malformed frame", 0, "", 7},
    {"beyond_ascii", "$BFCTL,00\xC3\xA9,1*69", "malformed frame", 0, "", 10},
    {"bad_address", test::framed("bfctl,000102,1"), "malformed frame", 0, "", 2},
    {"dollar_alone", "$", "malformed frame", 0, "", 2},
    {"bad_heading", navigation("4x"), "unreadable value", 9, "heading", 40},
    {"heading_beyond_the_circle", navigation("400"), "value out of range", 9, "heading", 40},
    {"blank_before_the_value", navigation(" 400"), "value out of range", 9, "heading", 41},
    {"two_bad_fields", navigation("400", "x,0,000103"), "value out of range", 9, "heading", 40, 1},
    {"bad_longitude", test::framed("BFNVG,000102,1230.0,N,99930.0,W,1,7,8,9,0,0,000103"),
     "value out of range", 4, "position", 24},
    {"fields_end_early", test::framed("BFCTL,000102"), "missing field", 2, "backseat in control",
     14},
    {"no_field_at_all", test::framed("BFCTL"), "missing field", 1, "sent at", 7, 1},
    {"battery_without_id", test::framed("CPRBS,000102,2,x,4,5"), "unreadable value", 3,
     "lowest cell", 17},
    {"battery_with_id", test::framed("CPRBS,000102,2,x,4,5,6"), "unreadable value", 3, "stack", 17},
};

class Fault : public testing::TestWithParam<Faulty> {};

TEST_P(Fault, IsNamedWithItsPlace) {
  int lines = 0;
  forEachLine(GetParam().line + "\n", [&](const DecodedLine& line) {
    ++lines;
    const auto note = faultOf(line);
    ASSERT_TRUE(note);
    EXPECT_EQ(note->reason, GetParam().reason);
    EXPECT_EQ(note->field, GetParam().field);
    EXPECT_EQ(note->field_name, GetParam().field_name);
    EXPECT_EQ(note->column, GetParam().column);
    EXPECT_EQ(note->more, GetParam().more);
  });
  EXPECT_EQ(lines, 1);
}

TEST_P(Fault, IsMarkedBelowTheLine) {
  const std::string text = written<LineOutput>(GetParam().line + "\n");
  const std::size_t mark = text.rfind('\n', text.size() - 2) + 1;
  const std::size_t line = text.rfind('\n', mark - 2) + 1;
  const std::string above = text.substr(line, mark - 1 - line);
  const std::string below = text.substr(mark, text.size() - 1 - mark);
  EXPECT_EQ(below.find_first_not_of(' '), below.size() - 1) << text;
  EXPECT_EQ(below.back(), '^') << text;
  EXPECT_LE(below.size(), above.size() + 1) << text;
}

INSTANTIATE_TEST_SUITE_P(Table, Fault, testing::ValuesIn(kFaulty),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(NoFault, IsSeenInWhatIsRightOrUnknown) {
  const std::string lines = navigation("90") + "\n" + test::framed("GPGSV,1") + "\n" +
                            "$PYDIR,1,2*\n$PYDIR,1,2\n";  // a payload may leave the sum out
  forEachLine(lines,
              [](const DecodedLine& line) { EXPECT_FALSE(faultOf(line)) << line.entry.line; });
}

}  // namespace
}  // namespace frontseat_driver::decode
