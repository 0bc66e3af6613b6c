#include "decode/selection.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "records.h"

namespace frontseat_driver::decode {
namespace {

using namespace std::chrono_literals;

std::string selected(const Selection::Config& config, const std::string& text) {
  Selection selection{config};
  std::string bodies;
  forEachLine(text, [&](const DecodedLine& line) {
    if (selection.accepts(line)) bodies += std::string{line.entry.line.substr(1, 8)} + " ";
  });
  return bodies;
}

std::string record() {
  return "100000010 " + test::framed("BFVER,01,a") + "\n" + "100000020 " +
         test::framed("BPVER,02,b") + "\n" + test::framed("CPNVR,03") + "\n" + "100000030 " +
         test::framed("GPGGA,04") + "\n100000040 $BFVER,05*00\n";
}

Selection::Config only(std::vector<std::string> names) {
  Selection::Config config;
  config.only = std::move(names);
  return config;
}

TEST(Selection, TakesAllUnlessTold) {
  EXPECT_EQ(selected({}, record()), "BFVER,01 BPVER,02 CPNVR,03 GPGGA,04 BFVER,05 ");
}

TEST(Selection, KnowsSentencesByAddressAndByTheirEnd) {
  EXPECT_EQ(selected(only({"VER"}), record()), "BFVER,01 BPVER,02 BFVER,05 ");
  EXPECT_EQ(selected(only({"BPVER", "GGA"}), record()), "BPVER,02 GPGGA,04 ");
  EXPECT_EQ(selected(only({"ER"}), record()), "");
  Selection::Config config = only({"VER"});
  config.except = {"BFVER"};
  EXPECT_EQ(selected(config, record()), "BPVER,02 ");
}

TEST(Selection, KeepsToTheDialectAndToGps) {
  Selection::Config config;
  config.dialect = protocol::Dialect::Kingfisher;
  EXPECT_EQ(selected(config, record()), "CPNVR,03 GPGGA,04 ");
  config.dialect = protocol::Dialect::Sandshark;
  EXPECT_EQ(selected(config, record()), "BFVER,01 BPVER,02 GPGGA,04 BFVER,05 ");
}

struct Range {
  const char* from;
  const char* to;
  const char* lines;
};

TEST(Selection, CutsAtTimes) {
  const Range kRanges[] = {{"0", "", "BFVER,01 BPVER,02 CPNVR,03 GPGGA,04 BFVER,05 "},
                           {"10", "", "BPVER,02 CPNVR,03 GPGGA,04 BFVER,05 "},
                           {"10.001", "", "GPGGA,04 BFVER,05 "},
                           {"", "20", "BFVER,01 BPVER,02 CPNVR,03 "},
                           {"10", "20", "BPVER,02 CPNVR,03 "},
                           {"100000030", "100000040", "GPGGA,04 "},
                           {"1973-03-03T09:47:10Z", "", "GPGGA,04 BFVER,05 "},  // 100000030
                           {"1973-03-03T09:47:10Z", "20", ""},
                           {"99", "", ""}};
  for (const Range& range : kRanges) {
    Selection::Config config;
    config.from = toMoment(range.from);
    config.to = toMoment(range.to);
    EXPECT_EQ(selected(config, record()), range.lines) << range.from << " " << range.to;
  }
}

TEST(Selection, CutsARecordWithoutTimesByTheVehiclesClock) {
  const std::string text = test::framed("PYDIR,1,2") + "\n" + test::framed("BFVER,235959,a") +
                           "\n" + test::framed("BFVER,000001,b") + "\n" +
                           test::framed("BFVER,000005,c") + "\n";
  Selection::Config config;
  config.from = toMoment("1");
  config.to = toMoment("6");
  EXPECT_EQ(selected(config, text), "BFVER,00 ");  // two seconds later, over midnight
}

TEST(Selection, KnowsAMomentWhenItSeesOne) {
  EXPECT_EQ(toMoment("90.5")->time, vehicle::UtcTime{90s + 500ms});
  EXPECT_TRUE(toMoment("90.5")->after_start);
  EXPECT_EQ(toMoment("1416410000")->time, vehicle::UtcTime{1'416'410'000s});
  EXPECT_FALSE(toMoment("1416410000")->after_start);
  EXPECT_EQ(toMoment("2014-11-19 15:13:20")->time, vehicle::UtcTime{1'416'410'000s});
  for (const char* text : {"", "x", "-5", "5x", "5 6", "2014-11-19", "12:00:00", " 5", "<"}) {
    EXPECT_FALSE(toMoment(text)) << text;
  }
}

}  // namespace
}  // namespace frontseat_driver::decode
