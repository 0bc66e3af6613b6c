#include "frontseat_driver/sim/blueye/parameters.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../parameter_of.h"
#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

using Config = BlueyeSimulatorConfig;
using Kinds = ParameterKinds<Config>;
using Parameter = Kinds::Parameter;

bool takeDatum(Config& config, const std::vector<double>& values) {
  if (values.size() != 2 || std::abs(values[0]) > 90.0 || std::abs(values[1]) > 180.0) return false;
  config.drone.environment.datum = {values[0], values[1]};
  return true;
}

std::vector<double> datum(const Config& config) {
  const nmea::LatLon& at = config.drone.environment.datum;
  return {at.latitude_deg, at.longitude_deg};
}

bool takeStart(Config& config, const std::vector<double>& values) {
  if (values.size() != 3) return false;
  config.drone.start = {values[0], values[1], wrap360(90.0 - degrees(values[2]))};
  return true;
}

std::vector<double> start(const Config& config) {
  const Start& from = config.drone.start;
  return {from.east_m, from.north_m, radians(90.0 - from.heading_deg)};
}

bool takeCurrent(Config& config, const std::vector<double>& values) {
  constexpr double kFastest = 2.0;
  if (values.size() != 2 || std::hypot(values[0], values[1]) > kFastest) return false;
  config.drone.environment.current_drift_m_s = std::hypot(values[0], values[1]);
  config.drone.environment.current_set_deg = wrap360(degrees(std::atan2(values[0], values[1])));
  return true;
}

std::vector<double> current(const Config& config) {
  const Environment& water = config.drone.environment;
  const double set = radians(water.current_set_deg);
  return {water.current_drift_m_s * std::sin(set), water.current_drift_m_s * std::cos(set)};
}

/// Pairs of a message and a rate: `{DepthTel: 40, Imu1Tel: 100}`.
bool takeRates(Config& config, const std::string& text) {
  constexpr double kFastest_hz = 100.0;
  std::string spaced = text;
  std::replace_if(
      spaced.begin(), spaced.end(), [](char c) { return c == ':' || c == '='; }, ' ');
  const std::vector<std::string> words = toWords(spaced);
  if (words.size() % 2 != 0) return false;
  std::map<std::string, double> rates;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const auto hz = toNumber(words[i + 1]);
    if (!hz || *hz < 0.0 || *hz > kFastest_hz) return false;
    if (!BlueyeDrone::defaultRate(words[i])) return false;
    rates[words[i]] = *hz;
  }
  config.drone.rates = std::move(rates);
  return true;
}

std::string ratesOf(const Config& config) {
  std::string text;
  for (const auto& [message, hz] : config.drone.rates) {
    text += (text.empty() ? "" : ", ") + message + ": " + toText(hz);
  }
  return "{" + text + "}";
}

bool takeDevices(Config& config, const std::string& text) {
  std::vector<BlueyeDevice> devices;
  for (const std::string& word : toWords(text)) {
    const auto& known = blueyeDeviceNames();
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto& entry) { return entry.first == word; });
    if (found == known.end()) return false;
    if (std::find(devices.begin(), devices.end(), found->second) == devices.end()) {
      devices.push_back(found->second);
    }
  }
  config.drone.devices = std::move(devices);
  return true;
}

std::string devicesOf(const Config& config) {
  std::string text;
  for (const auto& [name, device] : blueyeDeviceNames()) {
    const auto& fitted = config.drone.devices;
    if (std::find(fitted.begin(), fitted.end(), device) == fitted.end()) continue;
    text += (text.empty() ? "" : ", ") + name;
  }
  return "[" + text + "]";
}

/// One of two words, which sets a flag.
Parameter eitherOr(std::string name, bool& (*in_config)(Config&), const std::string& when_true,
                   const std::string& when_false, std::string meaning) {
  return {std::move(name), std::move(meaning), when_true + " or " + when_false,
          [=](Config& config, const std::string& text) {
            if (text != when_true && text != when_false) return false;
            in_config(config) = text == when_true;
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return in_config(copy) ? when_true : when_false;
          }};
}

Parameter text(std::string name, std::string& (*in_config)(Config&), std::string meaning) {
  return {std::move(name), std::move(meaning), "text",
          [=](Config& config, const std::string& value) {
            if (value.empty()) return false;
            in_config(config) = value;
            return true;
          },
          [=](const Config& config) {
            Config copy = config;
            return in_config(copy);
          }};
}

void addServer(std::vector<Parameter>& all) {
  all.push_back(Kinds::address(
      "bind", [](Config & c) -> auto& { return c.server.bind; }));
  all.push_back(Kinds::whole<std::uint16_t>(
      "telemetry_port", [](Config & c) -> auto& { return c.server.telemetry_port; }, 0, 65535,
      "ZeroMQ port of telemetry; 0: the system chooses"));
  all.push_back(Kinds::whole<std::uint16_t>(
      "request_port", [](Config & c) -> auto& { return c.server.request_port; }, 0, 65535,
      "ZeroMQ port of requests; 0: the system chooses"));
  all.push_back(Kinds::whole<std::uint16_t>(
      "control_port", [](Config & c) -> auto& { return c.server.control_port; }, 0, 65535,
      "ZeroMQ port of control messages; 0: the system chooses"));
  all.push_back(Kinds::whole<std::uint16_t>(
      "http_port", [](Config & c) -> auto& { return c.server.http_port; }, 0, 65535,
      "port of drone_info, where clients ask on 80; 0: the system chooses"));
  all.push_back(Kinds::flag(
      "http", [](Config & c) -> auto& { return c.server.http; }, "serve drone_info over HTTP"));
  all.push_back(Kinds::number(
      "speed", [](Config & c) -> auto& { return c.server.speed; }, 0.01, 100,
      "seconds of the drone per second"));
}

void addWater(std::vector<Parameter>& all) {
  all.push_back(Kinds::numbers("datum", "origin of ~odom: latitude and longitude, degrees",
                               "[latitude -90..90, longitude -180..180]", takeDatum, datum));
  all.push_back(Kinds::numbers("start", "where it starts: m east and north of the datum, yaw rad",
                               "[east, north, yaw]", takeStart, start));
  all.push_back(Kinds::numbers("current", "the water flows so, m/s east and north",
                               "[east, north], together 2 m/s at most", takeCurrent, current));
  all.push_back(Kinds::number(
      "bottom_depth", [](Config & c) -> auto& { return c.drone.environment.bottom_depth_m; }, 1,
      1000, "m of water"));
  all.push_back(Kinds::number(
      "water_density", [](Config & c) -> auto& { return c.drone.water_density_g_l; }, 900, 1300,
      "g/l of the water itself; the drone assumes 1025 until it is told"));
  all.push_back(Kinds::number(
      "water_temperature", [](Config & c) -> auto& { return c.drone.water_temperature_c; }, -2, 40,
      "degrees C at the surface"));
  all.push_back(Kinds::number(
      "magnetic_declination", [](Config & c) -> auto& { return c.drone.magnetic_declination_deg; },
      -180, 180, "degrees, east positive"));
}

void addDrone(std::vector<Parameter>& all) {
  all.push_back(Kinds::number(
      "buoyancy", [](Config & c) -> auto& { return c.drone.buoyancy_n; }, 0, 10,
      "N that push it up"));
  all.push_back(Kinds::number(
      "battery_capacity", [](Config & c) -> auto& { return c.drone.battery.capacity_wh; }, 0.1, 1e6,
      "Wh"));
  all.push_back(Kinds::number(
      "watchdog_timeout", [](Config & c) -> auto& { return c.drone.watchdog_timeout_s; }, 0.1, 60,
      "s without a watchdog after which the client in control is lost"));
  all.push_back({"devices", "what is on the guest ports",
                 "a list of " + devicesOf(Config{}).substr(1, devicesOf(Config{}).size() - 2),
                 takeDevices, devicesOf});
  all.push_back({"rates", "messages per second, Hz by name, 0: none; the rest as a drone has them",
                 "pairs of a telemetry message and a number from 0 to 100, such as {DepthTel: 40}",
                 takeRates, ratesOf});
  all.push_back(Kinds::flag(
      "noise", [](Config & c) -> auto& { return c.drone.noise; },
      "errors of the instruments; false: telemetry is the truth"));
  all.push_back(Kinds::whole<std::uint64_t>(
      "seed", [](Config & c) -> auto& { return c.drone.seed; }, 0, 4294967295.0,
      "of noise and faults"));
  all.push_back(Kinds::number(
      "clock_offset", [](Config & c) -> auto& { return c.drone.clock_offset_s; }, -1e8, 1e8,
      "s that the drone's clock is ahead of UTC until a client sets it"));
  all.push_back(text(
      "software_version", [](Config & c) -> auto& { return c.drone.software_version; },
      "what the drone says its software is"));
  all.push_back(text(
      "serial_number", [](Config & c) -> auto& { return c.drone.serial_number; },
      "what the drone says its number is"));
}

void addConventions(std::vector<Parameter>& all) {
  all.push_back(eitherOr(
      "yaw_positive", [](Config & c) -> auto& { return c.drone.conventions.yaw_clockwise; },
      "right", "left", "where positive yaw in MotionInput turns the bow"));
  all.push_back(eitherOr(
      "dvl_y_axis", [](Config & c) -> auto& { return c.drone.conventions.dvl_y_right; }, "right",
      "left", "where y of DvlVelocity points"));
  all.push_back(eitherOr(
      "accelerometer_sign",
      [](Config & c) -> auto& { return c.drone.conventions.gravity_positive; }, "gravity",
      "specific_force", "gravity: z is +1 g level and at rest; specific_force: -1 g"));
  all.push_back(eitherOr(
      "bearing_unit", [](Config & c) -> auto& { return c.drone.conventions.bearings_in_degrees; },
      "degrees", "hundredths", "of the multibeam's bearings: degrees, or hundredths of them"));
  all.push_back(Kinds::flag(
      "pause_instructions",
      [](Config & c) -> auto& { return c.drone.conventions.pause_instructions; },
      "a mission pauses after each instruction without auto_continue"));
}

void addMultibeam(std::vector<Parameter>& all) {
  all.push_back(Kinds::flag(
      "multibeam_active", [](Config & c) -> auto& { return c.drone.multibeam.active_from_start; },
      "the multibeam pings from the start on, not only when activated"));
  all.push_back(Kinds::whole<std::uint32_t>(
      "multibeam_beams", [](Config & c) -> auto& { return c.drone.multibeam.beams; }, 1, 4096,
      "beams of an image"));
  all.push_back(Kinds::whole<std::uint32_t>(
      "multibeam_ranges", [](Config & c) -> auto& { return c.drone.multibeam.ranges; }, 1, 8192,
      "ranges of an image; a byte for each beam and range"));
  all.push_back(Kinds::number(
      "multibeam_rate", [](Config & c) -> auto& { return c.drone.multibeam.rate_hz; }, 0, 100,
      "images per second; 0: as the client configures it"));
}

void addFaults(std::vector<Parameter>& all) {
  all.push_back(Kinds::number(
      "lose_replies", [](Config & c) -> auto& { return c.drone.faults.lose_replies; }, 0, 1,
      "probability that a request is obeyed, not answered"));
  all.push_back(Kinds::number(
      "reply_delay", [](Config & c) -> auto& { return c.drone.faults.reply_delay_s; }, 0, 60,
      "s that replies are late"));
  all.push_back(Kinds::number(
      "drop", [](Config & c) -> auto& { return c.drone.faults.lose_telemetry; }, 0, 1,
      "probability that a telemetry message is lost"));
  all.push_back(Kinds::number(
      "corrupt", [](Config & c) -> auto& { return c.drone.faults.corrupt; }, 0, 1,
      "probability that a bit of a message changes"));
  all.push_back(Kinds::number(
      "silence", [](Config & c) -> auto& { return c.drone.faults.silence_s; }, 0, kAny,
      "s in which nothing is sent, every `silence_every`"));
  all.push_back(Kinds::number(
      "silence_every", [](Config & c) -> auto& { return c.drone.faults.silence_every_s; }, 0, kAny,
      "s from silence to silence; 0: never"));
  all.push_back(Kinds::number(
      "reboot_every", [](Config & c) -> auto& { return c.drone.faults.reboot_every_s; }, 0, kAny,
      "s after which its computer starts anew; 0: never"));
  all.push_back(Kinds::number(
      "reboot_time", [](Config & c) -> auto& { return c.drone.faults.reboot_s; }, 0, 3600,
      "s that it is gone then"));
}

}  // namespace

const std::vector<ParameterOf<BlueyeSimulatorConfig>>& blueyeParameters() {
  static const std::vector<Parameter> kAll = [] {
    std::vector<Parameter> all;
    addServer(all);
    addWater(all);
    addDrone(all);
    addConventions(all);
    addMultibeam(all);
    addFaults(all);
    return all;
  }();
  return kAll;
}

}  // namespace frontseat_driver::sim
