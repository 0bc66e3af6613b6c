
#include <algorithm>
#include <map>

#include "frontseat_driver/sim/angles.h"
#include "parameter_kinds.h"

namespace frontseat_driver::sim {
namespace {

bool takeDatum(Config& config, const std::vector<double>& values) {
  if (values.size() != 2 || std::abs(values[0]) > 90.0 || std::abs(values[1]) > 180.0) return false;
  config.vehicle.environment.datum = {values[0], values[1]};
  return true;
}

std::vector<double> datum(const Config& config) {
  const nmea::LatLon& at = config.vehicle.environment.datum;
  return {at.latitude_deg, at.longitude_deg};
}

bool takeStart(Config& config, const std::vector<double>& values) {
  if (values.size() != 3) return false;
  config.vehicle.start = {values[0], values[1], wrap360(90.0 - degrees(values[2]))};
  return true;
}

std::vector<double> start(const Config& config) {
  const Start& at = config.vehicle.start;
  return {at.east_m, at.north_m, wrapPi(radians(90.0 - at.heading_deg))};
}

bool takeCurrent(Config& config, const std::vector<double>& values) {
  if (values.size() != 2 || std::hypot(values[0], values[1]) > 5.0) return false;
  config.vehicle.environment.current_drift_m_s = std::hypot(values[0], values[1]);
  config.vehicle.environment.current_set_deg = degrees(std::atan2(values[0], values[1]));
  return true;
}

std::vector<double> current(const Config& config) {
  const Environment& water = config.vehicle.environment;
  const double set = radians(water.current_set_deg);
  return {water.current_drift_m_s * std::sin(set), water.current_drift_m_s * std::cos(set)};
}

/// `NVG: 10, NVR: 5`, also with `=`. CPRIM and CPIMU are one sentence with two names.
bool takeRates(Config& config, const std::string& text) {
  std::string spaced = text;
  std::replace_if(
      spaced.begin(), spaced.end(), [](char c) { return c == ':' || c == '='; }, ' ');
  const std::vector<std::string> words = toWords(spaced);
  std::map<std::string, double> rates;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    const auto hz = toNumber(words[i + 1]);
    if (!hz || *hz < 0.0 || *hz > 1000.0) return false;
    rates[words[i] == "RIM" ? "IMU" : words[i]] = *hz;
  }
  if (words.size() % 2 != 0) return false;
  config.vehicle.rates = std::move(rates);
  return true;
}

std::string ratesOf(const Config& config) {
  std::string text;
  for (const auto& [sentence, hz] : config.vehicle.rates) {
    text += (text.empty() ? "" : ", ") + sentence + ": " + toText(hz);
  }
  return "{" + text + "}";
}

bool takeQuirks(Config& config, const std::string& text) {
  Quirks quirks;
  for (const std::string& word : toWords(text)) {
    if (!enable(quirks, word)) return false;
  }
  config.vehicle.quirks = quirks;
  return true;
}

std::string quirksOf(const Config& config) {
  std::string text;
  for (const QuirkName& quirk : quirkNames()) {
    if (!(config.vehicle.quirks.*quirk.member)) continue;
    text.append(text.empty() ? "" : ", ").append(quirk.name);
  }
  return "[" + text + "]";
}

std::string allQuirks() {
  std::string text = "a list of";
  for (const QuirkName& quirk : quirkNames()) {
    text.append(&quirk == &quirkNames().front() ? " " : ", ").append(quirk.name);
  }
  return text;
}

Parameter solutionAge() {
  return {"solution_age", "s from a navigation solution to its sentence",
          "a number, from 0 to 1, of whole milliseconds",
          [](Config& config, const std::string& text) {
            const auto value = toNumber(text);
            if (!value || *value < 0.0 || *value > 1.0) return false;
            config.vehicle.solution_age = std::chrono::milliseconds{std::lround(*value * 1e3)};
            return true;
          },
          [](const Config& config) {
            return toText(static_cast<double>(config.vehicle.solution_age.count()) * 1e-3);
          }};
}

}  // namespace

void addCommonParameters(std::vector<Parameter>& all) {
  all.push_back(choice(
      "dialect",
      {{"sandshark", [](Config& c) { c.dialect = protocol::Dialect::Sandshark; }},
       {"kingfisher", [](Config& c) { c.dialect = protocol::Dialect::Kingfisher; }}},
      "which vehicle", [](const Config& c) { return std::string{protocol::toString(c.dialect)}; }));
  all.push_back(ParameterKinds<Config>::address(
      "bind", [](Config & c) -> auto& { return c.server.bind; }));
  all.push_back(whole<std::uint16_t>(
      "port", [](Config & c) -> auto& { return c.server.port; }, 0, 65535,
      "TCP port; 0: the system chooses"));
  all.push_back(number(
      "speed", [](Config & c) -> auto& { return c.server.speed; }, 0.01, 1000,
      "seconds of the vehicle per second"));
  all.push_back(numbers("datum", "origin of ~odom: latitude and longitude, degrees",
                        "[latitude -90..90, longitude -180..180]", takeDatum, datum));
  all.push_back(numbers("start", "where it starts: m east and north of the datum, yaw rad",
                        "[east, north, yaw]", takeStart, start));
  all.push_back(whole<std::uint64_t>(
      "seed", [](Config & c) -> auto& { return c.vehicle.seed; }, 0, 4294967295.0,
      "of noise and faults"));
  all.push_back(flag(
      "noise", [](Config & c) -> auto& { return c.vehicle.noise; },
      "errors of the instruments; false: all sentences are the truth"));
  all.push_back({"rates", "sentences per second, Hz by name; 0: none",
                 "pairs of a sentence and a number from 0 to 1000, such as {NVG: 5, NVR: 0}",
                 takeRates, ratesOf});
  all.push_back({"quirks", "habits of real vehicles that the documents do not know", allQuirks(),
                 takeQuirks, quirksOf});
  all.push_back(solutionAge());
  all.push_back(number(
      "first_fix", [](Config & c) -> auto& { return c.vehicle.first_fix_s; }, 0, kAny,
      "s without a position after the start"));
  all.push_back(number(
      "clock_offset", [](Config & c) -> auto& { return c.vehicle.clock_offset_s; }, -1e8, 1e8,
      "s that the vehicle's clock is ahead of UTC"));
  all.push_back(number(
      "clock_drift_ppm", [](Config & c) -> auto& { return c.vehicle.clock_drift_ppm; }, -1e4, 1e4,
      "microseconds per second that it gains"));
}

void addWaterAndBatteryParameters(std::vector<Parameter>& all) {
  all.push_back(numbers("current", "the water flows so, m/s east and north",
                        "[east, north], together 5 m/s at most", takeCurrent, current));
  all.push_back(number(
      "bottom_depth", [](Config & c) -> auto& { return c.vehicle.environment.bottom_depth_m; }, 1,
      1e4, "m of water"));
  all.push_back(number(
      "battery_capacity", [](Config & c) -> auto& { return c.vehicle.battery.capacity_wh; }, 0.1,
      1e6, "Wh"));
  all.push_back(flag(
      "battery_swap", [](Config & c) -> auto& { return c.vehicle.battery_swap; },
      "an almost empty battery is replaced by a full one"));
}

}  // namespace frontseat_driver::sim
