#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/simulator_config.h"

namespace frontseat_driver::sim {
namespace {

using Config = SimulatorConfig;
using Parameter = SimulatorParameter;

std::string toText(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(12) << value;
  return out.str();
}

std::optional<double> toNumber(const std::string& text) {
  std::istringstream in{text};
  in.imbue(std::locale::classic());
  double value = 0.0;
  if (!(in >> value) || !(in >> std::ws).eof() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Words between commas, blanks and brackets.
std::vector<std::string> toWords(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return std::string_view{",[]{}"}.find(c) != std::string_view::npos; }, ' ');
  std::istringstream in{text};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::optional<std::vector<double>> toNumbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : toWords(text)) {
    const auto number = toNumber(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::string toText(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + toText(number);
  return "[" + text + "]";
}

/// A number from `low` to `high`; `in_config` finds it.
Parameter number(std::string name, double& (*in_config)(Config&), double low, double high,
                 std::string meaning) {
  const std::string range =
      high >= 1e9 ? toText(low) + " or more" : "from " + toText(low) + " to " + toText(high);
  return {std::move(name), std::move(meaning), "a number, " + range,
          [=](Config& config, const std::string& text) {
            const auto value = toNumber(text);
            if (!value || *value < low || *value > high) return false;
            in_config(config) = *value;
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return toText(in_config(copy));
          }};
}

template <class Integer>
Parameter whole(std::string name, Integer& (*in_config)(Config&), double low, double high,
                std::string meaning) {
  const std::string range = "from " + toText(low) + " to " + toText(high);
  return {std::move(name), std::move(meaning), "a whole number " + range,
          [=](Config& config, const std::string& text) {
            const auto value = toNumber(text);
            if (!value || *value < low || *value > high || *value != std::floor(*value))
              return false;
            in_config(config) = static_cast<Integer>(*value);
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return toText(static_cast<double>(in_config(copy)));
          }};
}

Parameter flag(std::string name, bool& (*in_config)(Config&), std::string meaning) {
  return {std::move(name), std::move(meaning), "true or false",
          [=](Config& config, const std::string& text) {
            const bool on = text == "true" || text == "True" || text == "1";
            if (!on && text != "false" && text != "False" && text != "0") return false;
            in_config(config) = on;
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return std::string{in_config(copy) ? "true" : "false"};
          }};
}

/// One word of a few, each of which sets something.
struct Choice {
  std::string word;
  void (*choose)(Config&);
};
Parameter choice(std::string name, std::vector<Choice> choices, std::string meaning,
                 std::function<std::string(const Config&)> get) {
  std::string accepted;
  for (const Choice& row : choices) accepted += (accepted.empty() ? "" : " or ") + row.word;
  return {std::move(name), std::move(meaning), accepted,
          [choices = std::move(choices)](Config& config, const std::string& text) {
            for (const Choice& row : choices) {
              if (row.word != text) continue;
              row.choose(config);
              return true;
            }
            return false;
          },
          std::move(get)};
}

/// A list of numbers; `take` refuses one that it cannot use.
Parameter numbers(std::string name, std::string meaning, std::string accepted,
                  bool (*take)(Config&, const std::vector<double>&),
                  std::vector<double> (*get)(const Config&)) {
  return {std::move(name), std::move(meaning), std::move(accepted),
          [take](Config& config, const std::string& text) {
            const auto values = toNumbers(text);
            return values && take(config, *values);
          },
          [get](const Config& config) { return toText(get(config)); }};
}

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

bool takeLegs(Config& config, const std::vector<double>& values) {
  std::vector<Leg> legs;
  for (std::size_t i = 0; i + 4 <= values.size(); i += 4) {
    if (values[i + 2] < 0.0 || values[i + 3] <= 0.0 || values[i + 3] > Torpedo::kMaxSpeed) {
      return false;
    }
    legs.push_back(
        {{values[i], values[i + 1]}, values[i + 2], Setpoint::VerticalMode::Depth, values[i + 3]});
  }
  if (values.size() % 4 != 0) return false;
  config.legs = std::move(legs);
  return true;
}

std::vector<double> legs(const Config& config) {
  std::vector<double> values;
  for (const Leg& leg : config.legs) {
    values.insert(values.end(), {leg.to.east_m, leg.to.north_m, leg.vertical_m, leg.speed_m_s});
  }
  return values;
}

bool takeLoop(Config& config, const std::vector<double>& values) {
  if (values.size() % 2 != 0 || values.size() == 2) return false;
  config.kingfisher.loop.clear();
  for (std::size_t i = 0; i < values.size(); i += 2) {
    config.kingfisher.loop.push_back({values[i], values[i + 1]});
  }
  return true;
}

std::vector<double> loop(const Config& config) {
  std::vector<double> values;
  for (const PlanePoint& corner : config.kingfisher.loop) {
    values.insert(values.end(), {corner.east_m, corner.north_m});
  }
  return values;
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

bool isAddress(const std::string& text) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, text.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, text.c_str(), address.data()) == 1;
}

Parameter bindAddress() {
  return {"bind", "address to listen on", "an IPv4 or IPv6 address in numbers",
          [](Config& config, const std::string& text) {
            if (!isAddress(text)) return false;
            config.server.bind = text;
            return true;
          },
          [](const Config& config) { return config.server.bind; }};
}

Parameter diveFile() {
  return {"dive_file", "sandshark: name of the mission", "printable ASCII without , * and $",
          [](Config& config, const std::string& text) {
            if (!nmea::isFieldText(text)) return false;
            config.sandshark.mission.dive_file = text;
            return true;
          },
          [](const Config& config) { return config.sandshark.mission.dive_file; }};
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

constexpr double kAnyLength = 1e9;

void addCommon(std::vector<Parameter>& all) {
  all.push_back(choice(
      "dialect",
      {{"sandshark", [](Config& c) { c.dialect = protocol::Dialect::Sandshark; }},
       {"kingfisher", [](Config& c) { c.dialect = protocol::Dialect::Kingfisher; }}},
      "which vehicle", [](const Config& c) { return std::string{protocol::toString(c.dialect)}; }));
  all.push_back(bindAddress());
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
      "first_fix", [](Config & c) -> auto& { return c.vehicle.first_fix_s; }, 0, kAnyLength,
      "s without a position after the start"));
  all.push_back(number(
      "clock_offset", [](Config & c) -> auto& { return c.vehicle.clock_offset_s; }, -1e8, 1e8,
      "s that the vehicle's clock is ahead of UTC"));
  all.push_back(number(
      "clock_drift_ppm", [](Config & c) -> auto& { return c.vehicle.clock_drift_ppm; }, -1e4, 1e4,
      "microseconds per second that it gains"));
}

void addWaterAndBattery(std::vector<Parameter>& all) {
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

void addFaults(std::vector<Parameter>& all) {
  all.push_back(number(
      "drop", [](Config & c) -> auto& { return c.vehicle.faults.drop; }, 0, 1,
      "probability that a sentence is lost"));
  all.push_back(number(
      "corrupt", [](Config & c) -> auto& { return c.vehicle.faults.corrupt; }, 0, 1,
      "probability that a byte of a sentence changes"));
  all.push_back(flag(
      "split", [](Config & c) -> auto& { return c.vehicle.faults.split; },
      "sentences leave in random pieces"));
  all.push_back(number(
      "stall", [](Config & c) -> auto& { return c.vehicle.faults.stall_s; }, 0, kAnyLength,
      "s of silence every `stall_every`"));
  all.push_back(number(
      "stall_every", [](Config & c) -> auto& { return c.vehicle.faults.stall_every_s; }, 0,
      kAnyLength, "s from silence to silence; 0: never"));
  all.push_back(number(
      "disconnect_every", [](Config & c) -> auto& { return c.vehicle.faults.disconnect_every_s; },
      0, kAnyLength, "s after which all connections end; 0: never"));
  all.push_back(flag(
      "withhold_acks", [](Config & c) -> auto& { return c.vehicle.faults.withhold_acks; },
      "sandshark: commands are obeyed, not acknowledged"));
  all.push_back(number(
      "delay_acks", [](Config & c) -> auto& { return c.vehicle.faults.delay_acks_s; }, 0, 3600,
      "sandshark: s that acknowledgements are late"));
  all.push_back(flag(
      "lie", [](Config & c) -> auto& { return c.vehicle.faults.lie; },
      "commands are acknowledged, not obeyed"));
}

void addSandshark(std::vector<Parameter>& all) {
  all.push_back(diveFile());
  all.push_back(numbers("legs", "sandshark: what it runs instead of the survey",
                        "groups of four: m east, m north, m depth, m/s (up to 2.5)", takeLegs,
                        legs));
  all.push_back(whole<int>(
      "survey_lines", [](Config & c) -> auto& { return c.survey.lines; }, 1, 100,
      "sandshark: lines of the survey"));
  all.push_back(number(
      "survey_length", [](Config & c) -> auto& { return c.survey.length_m; }, 10, 1e4,
      "sandshark: m of each line"));
  all.push_back(number(
      "survey_spacing", [](Config & c) -> auto& { return c.survey.spacing_m; }, 5, 1e3,
      "sandshark: m between lines"));
  all.push_back(number(
      "survey_depth", [](Config & c) -> auto& { return c.survey.depth_m; }, 0, 1e3,
      "sandshark: m below the surface on the lines"));
  all.push_back(number(
      "survey_speed", [](Config & c) -> auto& { return c.survey.speed_m_s; }, 0.5,
      Torpedo::kMaxSpeed, "sandshark: m/s"));
  all.push_back(number(
      "ready_time", [](Config & c) -> auto& { return c.sandshark.mission.ready_s; }, 0, kAnyLength,
      "sandshark: s from Ready to Running"));
  all.push_back(number(
      "completed_time", [](Config & c) -> auto& { return c.sandshark.mission.completed_s; }, 0,
      kAnyLength, "sandshark: s from Completed to Ready"));
  all.push_back(flag(
      "loop", [](Config & c) -> auto& { return c.sandshark.mission.loop; },
      "sandshark: a completed mission starts over"));
  all.push_back(number(
      "max_depth", [](Config & c) -> auto& { return c.sandshark.limits.max_depth_m; }, 0, 1e4,
      "sandshark: m; deeper is refused"));
  all.push_back(number(
      "min_altitude", [](Config & c) -> auto& { return c.sandshark.limits.min_altitude_m; }, 0, 100,
      "sandshark: m above the bottom; lower is refused"));
  all.push_back(number(
      "altimeter_range", [](Config & c) -> auto& { return c.sandshark.altimeter_range_m; }, 0, 1e4,
      "sandshark: m; further from the bottom the altitude is sent as 0"));
  all.push_back(flag(
      "allow_dynamic_requests",
      [](Config & c) -> auto& { return c.sandshark.allow_dynamic_requests; },
      "sandshark: the backseat has control while the mission runs"));
  all.push_back(number(
      "pending_time", [](Config & c) -> auto& { return c.sandshark.pending_s; }, 0, 60,
      "sandshark: s that BPRMB is acknowledged as pending; 0: done at once"));
}

void addKingfisher(std::vector<Parameter>& all) {
  all.push_back(numbers("loop_corners", "kingfisher: its own way, m east and north of each corner",
                        "pairs [east, north, ...], none or two at least", takeLoop, loop));
  all.push_back(number(
      "loop_speed", [](Config & c) -> auto& { return c.kingfisher.loop_speed_m_s; }, 0,
      Catamaran::kMaxSpeed, "kingfisher: m/s on its own way"));
  all.push_back(number(
      "resume_loop", [](Config & c) -> auto& { return c.kingfisher.resume_loop_s; }, 0, kAnyLength,
      "kingfisher: s after the last command that it goes its own way; 0: never"));
  all.push_back({"waves", "kingfisher: amplitude of the roll, rad", "a number, from 0 to 0.5",
                 [](Config& config, const std::string& text) {
                   const auto value = toNumber(text);
                   if (!value || *value < 0.0 || *value > 0.5) return false;
                   config.kingfisher.waves_deg = degrees(*value);
                   return true;
                 },
                 [](const Config& c) { return toText(radians(c.kingfisher.waves_deg)); }});
  all.push_back(choice("yaw_rate_unit",
                       {{"rad", [](Config& c) { c.kingfisher.yaw_rate_in_degrees = false; }},
                        {"deg", [](Config& c) { c.kingfisher.yaw_rate_in_degrees = true; }}},
                       "kingfisher: PYDEP is read as rad/s or deg/s", [](const Config& c) {
                         return std::string{c.kingfisher.yaw_rate_in_degrees ? "deg" : "rad"};
                       }));
  all.push_back(choice("imu_name",
                       {{"IMU", [](Config& c) { c.kingfisher.imu_formatter = "IMU"; }},
                        {"RIM", [](Config& c) { c.kingfisher.imu_formatter = "RIM"; }}},
                       "kingfisher: CPIMU or CPRIM",
                       [](const Config& c) { return std::string{c.kingfisher.imu_formatter}; }));
  all.push_back(whole<int>(
      "compass_id", [](Config & c) -> auto& { return c.kingfisher.compass_id; }, 0, 99,
      "kingfisher: id in CPRCM; real vehicles send 0"));
}

}  // namespace

const std::vector<SimulatorParameter>& simulatorParameters() {
  static const std::vector<SimulatorParameter> kAll = [] {
    std::vector<SimulatorParameter> all;
    addCommon(all);
    addWaterAndBattery(all);
    addFaults(all);
    addSandshark(all);
    addKingfisher(all);
    return all;
  }();
  return kAll;
}

}  // namespace frontseat_driver::sim
