#include "decode/summary.h"

#include <gtest/gtest.h>

#include <string>

#include "records.h"

namespace frontseat_driver::decode {
namespace {

std::string summaryOf(const std::string& text, const capture::ReadCounters& read = {}) {
  Summary summary;
  forEachLine(text, [&](const DecodedLine& line) { summary.add(line); });
  return summary.text(read);
}

void expectRow(const std::string& summary, const std::string& row) {
  EXPECT_NE(summary.find(row + "\n"), std::string::npos) << row << "\n-- is not in --\n" << summary;
}

/// A position so many seconds of latitude north of 42 degrees; one is 30.85 m.
std::string navigation(const std::string& time, const std::string& clock, int seconds_north) {
  char minutes[16];
  std::snprintf(minutes, sizeof minutes, "%09.6f", seconds_north / 60.0);
  return time + " < " +
         test::framed("BFNVG," + clock + ",42" + minutes + ",N,07100.0,W,1,0,0,0,0,0,") + "\n";
}

TEST(Summary, CountsRatesAndGaps) {
  // 5 sentences over 2 s: 4 intervals, so 2 Hz; the longest is 1.25 s and begins at 1000000000.25.
  std::string text;
  for (const char* time :
       {"1000000000.00", "1000000000.25", "1000000001.50", "1000000001.75", "1000000002.00"}) {
    text += std::string{time} + " < " + test::framed("BFNVR,000000,0,0,0,0,0,0") + "\n";
  }
  text += "1000000002.5 > " + test::framed("BPSTS,000000,1,fine") + "\n";
  const std::string summary = summaryOf(text);
  expectRow(summary, "6 sentences: 5 from the vehicle, 1 to it");
  expectRow(summary, "2.500 s, from 2001-09-09T01:46:40.000000Z to 2001-09-09T01:46:42.500000Z");
  expectRow(summary,
            "  BFNVR    velocity and rates                              5     2.000      1.250  "
            "2001-09-09T01:46:40.250000Z");
  expectRow(summary, "  BPSTS    status of the payload                           1");
  expectRow(summary,
            "  longest silence, s                  1.250  begins 2001-09-09T01:46:40.250000Z");
}

TEST(Summary, CountsFaultsAndTellsTheFirst) {
  const std::string summary = summaryOf(
      "1000000000 < " + test::framed("BFCTL,000000,1") + "\n1000000001 < $BFCTL,000000,1*00\n" +
          "1000000002 < $BFCTL,000000,0*00\n$BFCTL,000000,1*\n$x\n" +
          test::framed("BFCTL,000000,7") + "\n" + test::framed("GPGSV,1") + "\n",
      {1000, 2, 3, 4, 5, 6, true});
  expectRow(summary,
            "  wrong checksum                          2  first at sentence 2, "
            "2001-09-09T01:46:41.000000Z");
  expectRow(summary, "  missing checksum                        1  first at sentence 4");
  expectRow(summary, "  malformed                               1  first at sentence 5");
  expectRow(summary, "  with bad fields                         1  first at sentence 6");
  expectRow(summary, "  unknown                                 1");
  expectRow(summary, "  too long                                2");
  expectRow(summary, "  cut off by the next one                 3");
  expectRow(summary, "  lines without a sentence                4");
  expectRow(summary, "  bytes of TCP sent again                 5");
  expectRow(summary, "  bytes of TCP not captured               6");
  expectRow(summary, "  the capture breaks off, or is damaged from here on");
}

TEST(Summary, FindsPositionsThatJump) {
  // A second of latitude is 30.85 m here: one each second is well, ten are not within 50 m/s.
  const std::string summary =
      summaryOf(navigation("1000000000", "000000", 0) + navigation("1000000001", "000001", 1) +
                navigation("1000000002", "000002", 11) + navigation("1000000003", "000003", 3));
  expectRow(summary,
            "  position jumps, over 50 m/s             1  first at sentence 3, "
            "2001-09-09T01:46:42.000000Z; largest 308.536 m");
}

TEST(Summary, FindsClocksThatGoBack) {
  const std::string summary =
      summaryOf(navigation("1000000000", "235959", 0) + navigation("1000000001", "000000", 0) +
                navigation("1000000000.5", "235958", 0) + navigation("1000000002", "000002", 0));
  expectRow(summary,
            "  record goes back in time                1  first at sentence 3, "
            "2001-09-09T01:46:40.500000Z; largest 0.500 s");
  expectRow(summary,
            "  vehicle's clock goes back               1  first at sentence 3, "
            "2001-09-09T01:46:40.500000Z; largest 2.000 s");
}

TEST(Summary, MatchesAcknowledgementsWithCommands) {
  const std::string text = "1000000000.0 > " + test::framed("BPLOG,NVG,ON") + "\n1000000000.1 < " +
                           test::framed("BFACK,000000,BPLOG,,,2,0,,") + "\n1000000001.0 > " +
                           test::framed("BPRMB,000001,90,,,,,0") + "\n1000000001.05 < " +
                           test::framed("BFACK,000001,RMB,000001,,3,0,,") + "\n1000000001.5 < " +
                           test::framed("BFACK,000001,RMB,000001,,2,0,,") + "\n1000000002.0 > " +
                           test::framed("BPABT,000002,stop,0") + "\n1000000002.3 < " +
                           test::framed("BFACK,000002,ABT,000002,,1,0,no,") + "\n1000000003.0 > " +
                           test::framed("BPRMB,000003,90,,,,,0") + "\n1000000003.1 < " +
                           test::framed("BFACK,000003,RMB,111111,,2,0,,") + "\n";
  const std::string summary = summaryOf(text);
  expectRow(summary, "  commands                                4");
  expectRow(summary, "  done                                    2");
  expectRow(summary, "  refused                                 1");
  expectRow(summary, "  pending                                 1");
  expectRow(summary, "  for no command of the record            1");
  expectRow(summary, "  commands without an answer              1");
  // 0.1, 0.5 and 0.3 s
  expectRow(summary, "  round trip, s                       0.100 least, 0.300 mean, 0.500 most");
}

TEST(Summary, GoesByTheVehiclesClockWhereTheRecordHasNoTimes) {
  const std::string summary =
      summaryOf(test::framed("BFVER,235959.5,a") + "\n" + test::framed("BFVER,000001,a") + "\n");
  expectRow(summary,
            "1.500 s, from 23:59:59.500000 to 00:00:01.000000 by the vehicle's clock: the record "
            "has no times");
}

TEST(Summary, TellsWhatIsInTheHeronCapture) {
  const std::string summary = summaryOf(test::capture("heron_2014.nmea"));
  expectRow(summary, "14 sentences: 14 from the vehicle, 0 to it");
  expectRow(summary, "  unknown                                 3");
  expectRow(summary, "  wrong checksum                          0");
  EXPECT_NE(summary.find("CPNVG    navigation update                               2"),
            std::string::npos);
}

TEST(Summary, SaysSoWhenThereIsNothing) {
  const std::string summary = summaryOf("");
  expectRow(summary, "0 sentences: 0 from the vehicle, 0 to it");
  EXPECT_EQ(summary.find("silence"), std::string::npos);
}

TEST(Summary, TakesConstantMemoryWhateverTheAddresses) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) text += test::framed("QQ" + std::to_string(i + 10'000)) + "\n";
  const std::string summary = summaryOf(text);
  expectRow(summary, "  of further kinds                     9500");
  expectRow(summary, "  unknown                             10000");
}

}  // namespace
}  // namespace frontseat_driver::decode
