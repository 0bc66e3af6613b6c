#include "frontseat_driver/capture/text_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../nmea/lines.h"
#include "chunks.h"

namespace frontseat_driver::capture {
namespace {

using namespace std::chrono_literals;
using Lines = std::vector<std::string>;

TextReader readerOf(std::string text, std::size_t pieces = 1 << 20) {
  return TextReader{std::make_unique<Pieces>(std::move(text), pieces)};
}

Lines read(const std::string& text, std::size_t pieces = 1 << 20) {
  TextReader reader = readerOf(text, pieces);
  return linesOf(reader);
}

// 1416410000 is 2014-11-19 15:13:20 UTC: `date -u -d @1416410000`.
constexpr vehicle::UtcTime kThen = 1'416'410'000s;

struct Prefixed {
  const char* name;
  const char* text;
  std::optional<vehicle::UtcTime> time;
  std::optional<Direction> direction;
};

const Prefixed kPrefixes[] = {
    {"nothing", "", {}, {}},
    {"blanks", "  \t", {}, {}},
    {"unix_seconds", "1416410000 ", kThen, {}},
    {"unix_milliseconds_after_a_point", "1416410000.123 ", kThen + 123ms, {}},
    {"unix_nanoseconds_after_a_point", "1416410000.123456789 ", kThen + 123456789ns, {}},
    {"finer_than_nanoseconds", "1416410000.1234567899 ", kThen + 123456789ns, {}},
    {"unix_milliseconds", "1416410000123 ", kThen + 123ms, {}},
    {"unix_milliseconds_with_decimals", "1416410000123.5 ", kThen + 123500us, {}},
    {"unix_microseconds", "1416410000123456 ", kThen + 123456us, {}},
    {"unix_nanoseconds", "1416410000123456789 ", kThen + 123456789ns, {}},
    {"seconds_since_the_start", "12.25 ", 12s + 250ms, {}},
    {"comma_after_the_time", "1416410000.5,", kThen + 500ms, {}},
    {"parentheses", "(1416410000.5) ", kThen + 500ms, {}},
    {"iso", "2014-11-19T15:13:20.123Z ", kThen + 123ms, {}},
    {"iso_without_zone", "2014-11-19T15:13:20 ", kThen, {}},
    {"iso_with_blank", "2014-11-19 15:13:20.5 ", kThen + 500ms, {}},
    {"iso_decimal_comma", "2014-11-19 15:13:20,5 ", kThen + 500ms, {}},
    {"iso_slashes", "2014/11/19 15:13:20 ", kThen, {}},
    {"iso_west", "2014-11-19T10:13:20-05:00 ", kThen, {}},
    {"iso_east_of_the_date_line", "2014-11-20T04:13:20+1300 ", kThen, {}},
    {"iso_leap_day", "2016-02-29T00:00:00Z ", 1'456'704'000s, {}},
    {"ros_log", "[ INFO] [1416410000.250000000]: ", kThen + 250ms, {}},
    {"ros_log_with_node", "[ INFO] [1416410000.25, 12.5] [/driver]: ", kThen + 250ms, {}},
    {"to_the_vehicle", "> ", {}, Direction::ToVehicle},
    {"from_the_vehicle", "< ", {}, Direction::FromVehicle},
    {"arrows", "1416410000 >> ", kThen, Direction::ToVehicle},
    {"mark_without_blank", "1416410000>", {}, {}},
    {"mark_first", "< 1416410000 ", kThen, Direction::FromVehicle},
    {"tx", "1416410000.0 tx: ", kThen, Direction::ToVehicle},
    {"rx_in_brackets", "[RX] 1416410000.0 ", kThen, Direction::FromVehicle},
    {"words_tell_nothing", "line 12 ", {}, {}},
    {"after_words_nothing_counts", "noise 1416410000 ", {}, {}},
    {"number_glued_to_letters", "1416410000x ", {}, {}},
    {"negative", "-5 ", {}, {}},
    {"day_that_its_month_lacks", "2015-02-29T00:00:00Z ", {}, {}},
    {"day_that_june_lacks", "2014-06-31T00:00:00Z ", {}, {}},
    {"day_0", "2014-06-00T00:00:00Z ", {}, {}},
    {"leap_day_of_2000", "2000-02-29T00:00:00Z ", 951'782'400s, {}},
    {"leap_day_that_2100_lacks", "2100-02-29T00:00:00Z ", {}, {}},
    {"iso_leap_second", "2016-12-31T23:59:60Z ", 1'483'228'800s, {}},
    {"iso_underscore", "2014-11-19_15:13:20 ", kThen, {}},
    {"iso_hours_of_zone_alone", "2014-11-19T16:13:20+01 ", kThen, {}},
    {"second_61", "2014-11-19T15:13:61Z ", {}, {}},
    {"minute_60", "2014-11-19T15:60:20Z ", {}, {}},
    {"no_clock", "2014-11-19 ", {}, {}},
    {"clock_without_seconds", "2014-11-19T15:13 ", {}, {}},
    {"date_cut_off", "2014-11-1", {}, {}},
    {"date_without_day", "2014-11 ", {}, {}},
    {"letters_in_the_date", "2014-1x-19T15:13:20Z ", {}, {}},
    {"zone_without_hours", "2014-11-19T15:13:20+x ", {}, {}},
    {"month_0", "2014-00-01T00:00:00Z ", {}, {}},
    {"month_13", "2014-13-01T00:00:00Z ", {}, {}},
    {"hour_24", "2014-11-19T24:00:00Z ", {}, {}},
    {"before_1970", "1969-12-31T00:00:00Z ", {}, {}},
    {"year_that_nanoseconds_lack", "2262-01-01T00:00:00Z ", {}, {}},
    {"largest_number", "9223372035854775807 ", 9'223'372'035'854'775'807ns, {}},
    {"more_than_nanoseconds_hold", "9999999999999999999 ", {}, {}},
    {"twenty_digits", "14164100001416410000 ", {}, {}},
    {"cut_off_sentence_behind", "1416410000 $BFNV", kThen, {}},
    {"bytes_beyond_ascii", "\xFF\xFE\x80", {}, {}},
};

class Prefix : public testing::TestWithParam<Prefixed> {};

TEST_P(Prefix, TellsTimeAndDirection) {
  const LinePrefix prefix = readPrefix(GetParam().text);
  EXPECT_EQ(prefix.time, GetParam().time);
  EXPECT_EQ(prefix.direction, GetParam().direction);
  EXPECT_FALSE(prefix.comment);
}

TEST_P(Prefix, StandsBeforeAnySentence) {
  TextReader reader = readerOf(std::string{GetParam().text} + "$A,1*00\n");
  const auto entry = reader.next();
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->time, GetParam().time);
  EXPECT_EQ(entry->direction, GetParam().direction);
  EXPECT_EQ(entry->line, "$A,1*00");
  EXPECT_FALSE(reader.next());
}

INSTANTIATE_TEST_SUITE_P(Table, Prefix, testing::ValuesIn(kPrefixes),
                         [](const auto& row) { return std::string{row.param.name}; });

struct Text {
  const char* name;
  std::string text;
  Lines lines;
  std::uint64_t other_lines = 0;
  std::uint64_t cut_off = 0;
  std::uint64_t oversized = 0;
};

const Text kTexts[] = {
    {"empty", "", {}},
    {"only_line_ends", "\r\n\n\r", {}},
    {"bare", "$A*00\n$B*00\n", {"$A*00", "$B*00"}},
    {"crlf", "$A*00\r\n$B*00\r\n", {"$A*00", "$B*00"}},
    {"cr_alone", "$A*00\r$B*00\r", {"$A*00", "$B*00"}},
    {"blank_lines", "$A*00\r\n\n\n$B*00\r\n\n", {"$A*00", "$B*00"}},
    {"no_last_line_end", "$A*00\n1.5 $B*00", {"$A*00", "$B*00"}},
    {"comments", "# a log of $A*00\n% of 2014\n$B*00\n", {"$B*00"}, 1},
    {"blanks_before_a_comment", "  # $A*00\n$B*00\n", {"$B*00"}},
    {"other_text", "hello\n$B*00\nmore\n", {"$B*00"}, 2},
    {"cut_off", "$A,1,$B*00\n", {"$B*00"}, 0, 1},
    {"oversized", "$" + std::string(1024, 'x') + "\n$B*00\n", {"$B*00"}, 0, 0, 1},
    {"longest", "$" + std::string(1023, 'x') + "\n", {"$" + std::string(1023, 'x')}},
    {"bytes_of_any_value", std::string("\0\x80\xFF\n$B*00\n", 10), {"$B*00"}, 1},
    {"zero_byte_inside", std::string("$A\0B*00\n", 8), {std::string("$A\0B*00", 7)}},
};

class TextTable : public testing::TestWithParam<Text> {};

TEST_P(TextTable, GivesTheSameLinesInPiecesOfAnySize) {
  for (const std::size_t pieces : {1U, 2U, 3U, 7U, 64U, 1U << 20U}) {
    TextReader reader = readerOf(GetParam().text, pieces);
    EXPECT_EQ(linesOf(reader), GetParam().lines) << pieces;
    EXPECT_EQ(reader.counters().bytes, GetParam().text.size());
    EXPECT_EQ(reader.counters().other_lines, GetParam().other_lines) << pieces;
    EXPECT_EQ(reader.counters().cut_off, GetParam().cut_off) << pieces;
    EXPECT_EQ(reader.counters().oversized, GetParam().oversized) << pieces;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, TextTable, testing::ValuesIn(kTexts),
                         [](const auto& row) { return std::string{row.param.name}; });

TEST(TextReader, ReadsTheHeronCapture) {
  const Lines lines = read(test::capture("heron_2014.nmea"), 100);
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_EQ(lines.front(),
            "$CPIMU,164958.858,-0.061035,-0.000097,-0.061035,-0.026916,0.104533,-0.932172*57");
  EXPECT_EQ(lines.back(), "$GPRMC,150216.20,A,4221.51616,N,07105.25215,W,0.021,0.00,260614,,,D*7C");
}

TEST(TextReader, KeepsTimesAndLinesTogetherOverManyChunks) {
  constexpr int kLines = 100'000;  // 3.6 MB, a dozen chunks
  std::string text;
  for (int i = 0; i < kLines; ++i) {
    text += std::to_string(i) + ".25 > $LINE," + std::to_string(i) + ",abcdef*00\r\n";
  }
  TextReader reader = readerOf(text, 10'007);
  for (int i = 0; i < kLines; ++i) {
    const auto entry = reader.next();
    ASSERT_TRUE(entry) << i;
    ASSERT_EQ(entry->time, std::chrono::seconds{i} + 250ms);
    ASSERT_EQ(entry->direction, Direction::ToVehicle);
    ASSERT_EQ(entry->line, "$LINE," + std::to_string(i) + ",abcdef*00");
  }
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.counters().other_lines, 0U);
}

TEST(TextReader, FindsSentencesAroundALineOfAnyLength) {
  const std::string noise(3'000'000, 'x');
  EXPECT_EQ(read("$A*00\n" + noise + "\n$B*00\n"), (Lines{"$A*00", "$B*00"}));
  EXPECT_EQ(read("$A*00\n" + noise + "$B*00\n"), (Lines{"$A*00", "$B*00"}));
  EXPECT_EQ(read("$" + noise + "$B*00"), (Lines{"$B*00"}));
  EXPECT_EQ(read(noise), Lines{});
}

TEST(TextReader, CarriesASentenceOverTheEndOfAFullBuffer) {
  for (std::size_t behind = 0; behind < 12; ++behind) {
    const std::string noise(256UL * 1024 - behind, 'x');
    EXPECT_EQ(read(noise + "$A,123*00\n1 $B*00\n"), (Lines{"$A,123*00", "$B*00"})) << behind;
  }
}

TEST(TextReader, FindsSentencesBetweenCarriageReturnsAlone) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "1.5 $A*00\r";
  EXPECT_EQ(read(text).size(), 100'000U);
}

TEST(TextReader, GivesALiveLineAtOnce) {
  TextReader reader = readerOf("$A*00\n$B*", 6);
  const auto entry = reader.next();
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->line, "$A*00");
  EXPECT_EQ(reader.counters().bytes, 6U);  // it did not wait for more
}

}  // namespace
}  // namespace frontseat_driver::capture
