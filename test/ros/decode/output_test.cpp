#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "decode/csv_output.h"
#include "decode/json_output.h"
#include "decode/line_output.h"
#include "records.h"

namespace frontseat_driver::decode {
namespace {

std::string record() {
  return "1416410000.123 < " +
         test::framed("BFNVG,120000.250,4221.5,N,07105.25,W,1,,5,90,1.5,-2.25,120000.200") +
         "\r\n1416410000.5 > " + test::framed("BPABT,120001,say \"stop\",1") + "\n" +
         test::framed("CPNVR,120000,nan,-0.5,0,1,2z,9") + "\n" + test::framed("GPGSV,2,1") +
         "\n1416410001 < $BFCTL,120000,1*00\n$BF\x1b[2J*00\n";
}

constexpr char kLines[] =
    R"(2014-11-19T15:13:20.123000Z < BFNVG navigation update: sent at 12:00:00.250, position 42.3583333 N 71.0875000 W, from gps yes, altitude -, depth 5 m, heading 90 deg, roll 1.5 deg, pitch -2.25 deg, computed at 12:00:00.200
2014-11-19T15:13:20.500000Z > BPABT abort of the mission: sent at 12:00:01.000, message "say "stop"", with errors yes
< CPNVR velocity and rates: sent at 12:00:00.000, east -, north -0.5 m/s, down 0 m/s, pitch rate 1 deg/s, roll rate -, yaw rate 9 deg/s
    field 6 (roll rate): unreadable value, column 28
    $CPNVR,120000,nan,-0.5,0,1,2z,9*61
                               ^
< GPGSV unknown sentence: $GPGSV,2,1*56
2014-11-19T15:13:21.000000Z < bad line: wrong checksum: 00 sent, 6D computed, column 17
    $BFCTL,120000,1*00
                    ^
< bad line: malformed frame, column 4
    $BF\x1b[2J*00
       ^
)";

constexpr char kJson[] =
    R"({"time_s":1416410000.123,"direction":"rx","sentence":"BFNVG","fields":{"sent_at_s":43200.25,"latitude_deg":42.358333333,"longitude_deg":-71.087500000,"from_gps":true,"altitude_m":null,"depth_m":5,"heading_deg":90,"roll_deg":1.5,"pitch_deg":-2.25,"computed_at_s":43200.2}}
{"time_s":1416410000.5,"direction":"tx","sentence":"BPABT","fields":{"sent_at_s":43201,"message":"say \"stop\"","with_errors":true}}
{"direction":"rx","sentence":"CPNVR","fields":{"sent_at_s":43200,"east_m_s":null,"north_m_s":-0.5,"down_m_s":0,"pitch_rate_deg_s":1,"roll_rate_deg_s":null,"yaw_rate_deg_s":9},"fault":{"reason":"unreadable value","field":6,"name":"roll rate","column":28,"more":0},"line":"$CPNVR,120000,nan,-0.5,0,1,2z,9*61"}
{"direction":"rx","sentence":"GPGSV","line":"$GPGSV,2,1*56"}
{"time_s":1416410001,"direction":"rx","sentence":"BFCTL","fault":{"reason":"wrong checksum: 00 sent, 6D computed","column":17,"more":0},"line":"$BFCTL,120000,1*00"}
{"direction":"rx","sentence":"BF\u001b[2J","fault":{"reason":"malformed frame","column":4,"more":0},"line":"$BF\u001b[2J*00"}
)";

TEST(Output, WritesLines) { EXPECT_EQ(written<LineOutput>(record()), kLines); }

TEST(Output, WritesJson) { EXPECT_EQ(written<JsonOutput>(record()), kJson); }

TEST(Output, WritesOneTable) {
  EXPECT_EQ(written<CsvOutput>("5 " + test::framed("BFVER,000102,SS_0.0") + "\n" +
                               test::framed("BPVER,000103,0.1") + "\n$BFVER,000102,x*00\n"),
            "time_s,sentence,sent_at_s,version,fault\n"
            "5,BFVER,62,SS_0.0,\n"
            ",BPVER,63,0.1,\n");
}

TEST(Output, ReportsAFullDisk) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  LineOutput out{full};
  forEachLine(record(), [&](const DecodedLine& line) { out.write(line); });
  EXPECT_THROW(out.flush(), std::system_error);
  std::fclose(full);
}

class Folder {
 public:
  Folder() : path_(mkdtemp(name_)) {}
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    for (const char* name : {"NVG", "NVR", "ABT", "bad", "unknown"}) {
      std::remove((tables() + "/" + name + ".csv").c_str());
    }
    std::remove(tables().c_str());
    std::remove(path_.c_str());
  }

  std::string path() const { return path_; }
  std::string tables() const { return path_ + "/tables"; }
  std::string table(const std::string& name) const {
    std::ifstream file{tables() + "/" + name + ".csv", std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
  }

 private:
  char name_[32] = "/tmp/decode_test_XXXXXX";
  std::string path_;
};

TEST(Output, WritesATableForEachKind) {
  const Folder folder;
  {
    CsvOutput out{folder.tables()};
    forEachLine(record(), [&](const DecodedLine& line) { out.write(line); });
    out.flush();
  }
  EXPECT_EQ(
      folder.table("NVG"),
      "time_s,sentence,sent_at_s,latitude_deg,longitude_deg,from_gps,altitude_m,depth_m,"
      "heading_deg,roll_deg,pitch_deg,computed_at_s,fault\n"
      "1416410000.123,BFNVG,43200.25,42.358333333,-71.087500000,1,,5,90,1.5,-2.25,43200.2,\n");
  EXPECT_EQ(folder.table("ABT"),
            "time_s,sentence,sent_at_s,message,with_errors,fault\n"
            "1416410000.5,BPABT,43201,\"say \"\"stop\"\"\",1,\n");
  EXPECT_EQ(folder.table("NVR"),
            "time_s,sentence,sent_at_s,east_m_s,north_m_s,down_m_s,pitch_rate_deg_s,"
            "roll_rate_deg_s,yaw_rate_deg_s,fault\n"
            ",CPNVR,43200,,-0.5,0,1,,9,field 6: unreadable value (column 28)\n");
  EXPECT_EQ(folder.table("unknown"), "time_s,sentence,fault,line\n,GPGSV,,\"$GPGSV,2,1*56\"\n");
  EXPECT_EQ(folder.table("bad"),
            "time_s,sentence,fault,line\n"
            "1416410001,BFCTL,\"wrong checksum: 00 sent, 6D computed (column 17)\","
            "\"$BFCTL,120000,1*00\"\n"
            ",BF\\x1b[2J,malformed frame (column 4),$BF\\x1b[2J*00\n");
}

TEST(Output, NamesAFolderThatCannotBeMade) {
  const Folder folder;
  try {
    CsvOutput out{folder.path() + "/no/such"};
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.what(), folder.path() + "/no/such: No such file or directory");
  }
}

/// The text of every kind of sentence, in every format, holds each of its fields.
TEST(Output, LeavesNoSentenceAndNoFieldOut) {
  for (const protocol::KnownSentence& sentence : protocol::knownSentences()) {
    const std::string talker{sentence.talker.empty() ? "GP" : sentence.talker};
    const std::string line = test::framed(talker + std::string{sentence.formatter} + ",") + "\n";
    const std::string lines = written<LineOutput>(line);
    const std::string json = written<JsonOutput>(line);
    const std::string csv = written<CsvOutput>(line);
    EXPECT_NE(lines.find(sentence.title), std::string::npos) << lines;
    const auto columns =
        std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ',');
    const std::size_t fields = json.find("\"fields\":{");
    ASSERT_NE(fields, std::string::npos) << json;
    const std::string inside = json.substr(fields, json.find('}') - fields);
    // All are blank; time_s, sentence and fault are columns besides.
    EXPECT_EQ(std::count(inside.begin(), inside.end(), ',') + 1, columns - 2) << csv << json;
  }
}

}  // namespace
}  // namespace frontseat_driver::decode
