#include "mix.h"

#include <cstdio>
#include <random>
#include <stdexcept>

namespace frontseat_driver::bench {
namespace {

using Random = std::mt19937_64;

double draw(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(random);
}

/// At most six decimals without trailing zeros, as the boats print numbers.
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", value);
  std::string out{text};
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

std::string number(Random& random, double low, double high) {
  return number(draw(random, low, high));
}

std::string fixed(double value, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string clock(Random& random, int decimals) {
  char text[32];
  const auto second = static_cast<int>(random() % 86400);
  std::snprintf(text, sizeof text, "%02d%02d%0*.*f", second / 3600, second / 60 % 60, decimals + 3,
                decimals, second % 60 + draw(random, 0.0, 0.99));
  return text;
}

/// A boat leaves the longitude's leading zero out.
std::string position(Random& random, int decimals, const char* zero = "") {
  return "42" + fixed(draw(random, 10.0, 59.9), decimals) + ",N," + zero + "71" +
         fixed(draw(random, 10.0, 59.9), decimals) + ",W";
}

std::string sandsharkNavigation(Random& random) {
  return "BFNVG," + clock(random, 3) + ',' + position(random, 6, "0") + ",1," +
         fixed(draw(random, 0.0, 40.0), 1) + ',' + fixed(draw(random, 0.0, 30.0), 2) + ',' +
         fixed(draw(random, 0.0, 360.0), 2) + ',' + fixed(draw(random, -9.0, 9.0), 2) + ',' +
         fixed(draw(random, -30.0, 30.0), 2) + ',' + clock(random, 3);
}

std::string boatNavigation(Random& random) {
  return "CPNVG," + clock(random, 3) + ',' + position(random, 6) + ",1,0,0," +
         number(random, 0.0, 359.9) + ',' + number(random, -9.0, 9.0) + ',' +
         number(random, -9.0, 9.0) + ',' + clock(random, 3);
}

std::string velocity(Random& random) {
  std::string out = random() % 2 == 0 ? "BFNVR," : "CPNVR,";
  out += clock(random, 3);
  for (const double most : {2.0, 2.0, 0.5, 9.0, 9.0, 20.0})
    out += ',' + number(random, -most, most);
  return out;
}

std::string rawImu(Random& random) {
  std::string out = "CPIMU," + clock(random, 3);
  for (const double most : {9.0, 9.0, 20.0, 1.5, 1.5, 10.5})
    out += ',' + number(random, -most, most);
  return out;
}

std::string compass(Random& random) {
  return "CPRCM," + clock(random, 3) + ",0," + number(random, 0.0, 359.9) + ',' +
         number(random, -9.0, 9.0) + ',' + number(random, -9.0, 9.0) + ',' + clock(random, 3);
}

std::string battery(Random& random) {
  return "CPRBS," + clock(random, 3) + ',' + number(random, 13.0, 16.8) + ',' +
         number(random, 3.2, 4.2) + ',' + number(random, 3.2, 4.2) + ",0";
}

std::string minimumData(Random& random) {
  return "GPRMC," + clock(random, 2) + ",A," + position(random, 5) + ',' +
         fixed(draw(random, 0.0, 4.0), 3) + ',' + fixed(draw(random, 0.0, 359.9), 2) +
         ",311214,,,A";
}

std::string gpsFix(Random& random) {
  return "GPGGA," + clock(random, 2) + ',' + position(random, 5) + ",1,06," +
         fixed(draw(random, 0.7, 3.0), 2) + ',' + fixed(draw(random, 10.0, 60.0), 1) +
         ",M,-33.2,M,,";
}

std::string acknowledgement(Random& random) {
  return "BFACK," + clock(random, 3) + ",BPRMB," + clock(random, 3) +
         ",backseat,2,0,Behavior changed";
}

std::string missionStatus(Random& random) {
  return "BFMIS," + clock(random, 3) + ",survey.dive,Running,Leg " + std::to_string(random() % 40);
}

struct Kind {
  std::string_view type;
  std::string (*body)(Random&);
  int share;  ///< of 100 in the mix
};

/// Navigation, velocity and sensors at 10 Hz and more, the receiver at 5, the rest at 1.
constexpr Kind kKinds[] = {
    {"BFNVG", sandsharkNavigation, 11},
    {"CPNVG", boatNavigation, 11},
    {"NVR", velocity, 20},
    {"CPIMU", rawImu, 12},
    {"CPRCM", compass, 14},
    {"CPRBS", battery, 9},
    {"GPRMC", minimumData, 8},
    {"GPGGA", gpsFix, 8},
    {"BFACK", acknowledgement, 4},
    {"BFMIS", missionStatus, 3},
};

std::string framed(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char tail[8];
  std::snprintf(tail, sizeof tail, "*%02X\r\n", sum);
  return '$' + body + tail;
}

const Kind& kindOf(std::string_view type) {
  for (const Kind& kind : kKinds) {
    if (kind.type == type) return kind;
  }
  throw std::invalid_argument{"no such kind of sentence: " + std::string{type}};
}

const Kind& drawKind(Random& random) {
  auto left = static_cast<int>(random() % 100);
  for (const Kind& kind : kKinds) {
    if ((left -= kind.share) < 0) return kind;
  }
  throw std::logic_error{"the shares of the mix do not add up to 100"};
}

}  // namespace

std::vector<std::string_view> types() {
  std::vector<std::string_view> out;
  for (const Kind& kind : kKinds) out.push_back(kind.type);
  return out;
}

Sample vehicleMix(std::size_t sentences) {
  Random random{2014};
  Sample mix{"mix", {}, sentences};
  for (std::size_t i = 0; i < sentences; ++i) mix.bytes += framed(drawKind(random).body(random));
  return mix;
}

Sample onlyOf(std::string_view type, std::size_t sentences) {
  Random random{2015};
  const Kind& kind = kindOf(type);
  Sample sample{std::string{type}, {}, sentences};
  for (std::size_t i = 0; i < sentences; ++i) sample.bytes += framed(kind.body(random));
  return sample;
}

}  // namespace frontseat_driver::bench
