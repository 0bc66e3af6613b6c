#include "frontseat_driver/nmea/sentence.h"

#include <gtest/gtest.h>

#include <random>

#include "lines.h"

namespace frontseat_driver::nmea {
namespace {

TEST(Checksum, IsTheXorOfAllBytes) {
  EXPECT_EQ(checksum(""), 0x00);
  EXPECT_EQ(checksum("A"), 0x41);
  EXPECT_EQ(checksum("AA"), 0x00);
  EXPECT_EQ(checksum("ABCDEFGH"), 0x08);   // 0x41 ^ 0x42 ^ ... ^ 0x48
  EXPECT_EQ(checksum("ABCDEFGHI"), 0x41);  // 0x08 ^ 0x49
}

TEST(Checksum, EqualsTheByteWiseSumAtAnyLength) {
  std::mt19937 random{1};
  std::string bytes;
  unsigned sum = 0;
  for (int size = 0; size < 300; ++size) {
    ASSERT_EQ(checksum(bytes), sum) << size << " bytes";
    bytes += static_cast<char>(random());
    sum ^= static_cast<unsigned char>(bytes.back());
  }
}

struct Good {
  const char* name;
  std::string line;
  const char* address;
  const char* fields;
  bool has_fields;
};

// "ABCDE" adds up to 0x41, "ABCDE," to 0x6D, "ABCDE,1" to 0x5C, "AAAAA,mA" to 0x41.
const Good kGood[] = {
    {"no_field", "$ABCDE*41", "ABCDE", "", false},
    {"one_empty_field", "$ABCDE,*6D", "ABCDE", "", true},
    {"one_field", "$ABCDE,1*5C", "ABCDE", "1", true},
    {"lower_case_hex", "$ABCDE,1*5c", "ABCDE", "1", true},
    {"checksum_zero", "$ABCDE,m*00", "ABCDE", "m", true},
    {"blanks_after_checksum", "$ABCDE,1*5C  ", "ABCDE", "1", true},
    {"digits_in_address", test::framed("AB3D4,1"), "AB3D4", "1", true},
    {"proprietary", test::framed("PSAT,HPR"), "PSAT", "HPR", true},
    {"longest_address", test::framed("ABCDEFGH,1"), "ABCDEFGH", "1", true},
    {"shortest_address", test::framed("ABC,1"), "ABC", "1", true},
    {"highest_character", test::framed("ABCDE,\x7F"), "ABCDE", "\x7F", true},
    {"blanks_in_fields", test::framed("ABCDE, 1, 2"), "ABCDE", " 1, 2", true},
};

class GoodLines : public testing::TestWithParam<Good> {};

TEST_P(GoodLines, AreTakenApart) {
  for (const ChecksumRule rule : {ChecksumRule::Required, ChecksumRule::Optional}) {
    const auto sentence = parseSentence(GetParam().line, rule);
    ASSERT_TRUE(sentence) << toString(sentence.failure().fault);
    EXPECT_EQ(sentence->address, GetParam().address);
    EXPECT_EQ(sentence->fields, GetParam().fields);
    EXPECT_EQ(sentence->has_fields, GetParam().has_fields);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, GoodLines, testing::ValuesIn(kGood),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Bad {
  const char* name;
  std::string line;
  Fault fault;
};

const Bad kBad[] = {
    {"nothing", "", Fault::BadFrame},
    {"no_dollar", "ABCDE*41", Fault::BadFrame},
    {"dollar_alone", "$", Fault::BadFrame},
    {"no_star", "$ABCDE,1", Fault::BadFrame},
    {"no_checksum", "$ABCDE,1*", Fault::MissingChecksum},
    {"no_checksum_but_blanks", "$ABCDE,1* ", Fault::MissingChecksum},
    {"one_hex_digit", "$ABCDE,1*5", Fault::BadFrame},
    {"three_hex_digits", "$ABCDE,1*05C", Fault::BadFrame},
    {"no_hex_digits", "$ABCDE,1*5G", Fault::BadFrame},
    {"blank_in_checksum", "$ABCDE,1*5 C", Fault::BadFrame},
    {"wrong_checksum", "$ABCDE,1*5D", Fault::BadChecksum},
    {"swapped_digits", "$ABCDE,1*C5", Fault::BadChecksum},
    {"spi_example_as_printed",
     "$BFNVG,081025.987,4221.81092,N,07106.84603,W,1,45.3,20.1,203.1,-3.4,4.5,081025.980*5b",
     Fault::BadChecksum},
    {"kingfisher_example_as_printed",
     "$BFNVG,081025.987,4221.81092,N,07106.84603,W,1,,,203.1,-3.4,4.5,081025.980*5B",
     Fault::BadChecksum},
    {"star_in_data", "$ABCDE,*,1*76", Fault::BadFrame},
    {"two_checksums", "$ABCDE,1*5C*5C", Fault::BadFrame},
    {"control_character", test::framed("ABCDE,\x1F"), Fault::BadFrame},
    {"tab", test::framed("ABCDE,\t1"), Fault::BadFrame},
    {"zero_byte", test::framed(std::string("ABCDE,\0", 7)), Fault::BadFrame},
    {"not_ascii", test::framed("ABCDE,\x80"), Fault::BadFrame},
    {"not_ascii_in_a_long_line", test::framed("ABCDE,12345678,12345678,\xFF,12345678"),
     Fault::BadFrame},
    {"lower_case_address", test::framed("abcde,1"), Fault::BadFrame},
    {"blank_in_address", test::framed("AB DE,1"), Fault::BadFrame},
    {"address_too_short", test::framed("AB,1"), Fault::BadFrame},
    {"address_too_long", test::framed("ABCDEFGHI,1"), Fault::BadFrame},
    {"no_address", test::framed(",1"), Fault::BadFrame},
    {"wrong_checksum_and_address", "$abcde,1*00", Fault::BadChecksum},
};

class BadLines : public testing::TestWithParam<Bad> {};

TEST_P(BadLines, AreRefused) {
  const auto sentence = parseSentence(GetParam().line, ChecksumRule::Required);
  ASSERT_FALSE(sentence);
  EXPECT_EQ(sentence.failure().fault, GetParam().fault);
  EXPECT_EQ(sentence.failure().field, 0);
}

INSTANTIATE_TEST_SUITE_P(Table, BadLines, testing::ValuesIn(kBad),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(OptionalChecksum, MayBeLeftOut) {
  for (const char* line : {"$PYDIR,10,-10*", "$PYDIR,10,-10", "$PYDIR,10,-10* "}) {
    const auto sentence = parseSentence(line, ChecksumRule::Optional);
    ASSERT_TRUE(sentence) << line;
    EXPECT_EQ(sentence->talker(), "PY");
    EXPECT_EQ(sentence->formatter(), "DIR");
    EXPECT_EQ(sentence->fields, "10,-10");
  }
}

TEST(OptionalChecksum, MustBeRightIfThere) {
  const auto sentence = parseSentence("$PYDIR,10,-10*00", ChecksumRule::Optional);
  ASSERT_FALSE(sentence);
  EXPECT_EQ(sentence.failure().fault, Fault::BadChecksum);
}

TEST(Fault, HasWords) {
  EXPECT_STREQ(toString(Fault::BadFrame), "malformed frame");
  EXPECT_STREQ(toString(Fault::MissingChecksum), "missing checksum");
  EXPECT_STREQ(toString(Fault::BadChecksum), "wrong checksum");
  EXPECT_STREQ(toString(Fault::UnknownType), "unknown sentence");
  EXPECT_STREQ(toString(Fault::MissingField), "missing field");
  EXPECT_STREQ(toString(Fault::BadValue), "unreadable value");
  EXPECT_STREQ(toString(Fault::OutOfRange), "value out of range");
}

}  // namespace
}  // namespace frontseat_driver::nmea
