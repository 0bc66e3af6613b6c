#include "frontseat_driver/sim/angles.h"
#include "parameter_kinds.h"

namespace frontseat_driver::sim {
namespace {

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

Parameter diveFile() {
  return {"dive_file", "sandshark: name of the mission", "printable ASCII without , * and $",
          [](Config& config, const std::string& text) {
            if (!nmea::isFieldText(text)) return false;
            config.sandshark.mission.dive_file = text;
            return true;
          },
          [](const Config& config) { return config.sandshark.mission.dive_file; }};
}

}  // namespace

void addSandsharkParameters(std::vector<Parameter>& all) {
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
      "ready_time", [](Config & c) -> auto& { return c.sandshark.mission.ready_s; }, 0, kAny,
      "sandshark: s from Ready to Running"));
  all.push_back(number(
      "completed_time", [](Config & c) -> auto& { return c.sandshark.mission.completed_s; }, 0,
      kAny, "sandshark: s from Completed to Ready"));
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

void addKingfisherParameters(std::vector<Parameter>& all) {
  all.push_back(numbers("loop_corners", "kingfisher: its own way, m east and north of each corner",
                        "pairs [east, north, ...], none or two at least", takeLoop, loop));
  all.push_back(number(
      "loop_speed", [](Config & c) -> auto& { return c.kingfisher.loop_speed_m_s; }, 0,
      Catamaran::kMaxSpeed, "kingfisher: m/s on its own way"));
  all.push_back(number(
      "resume_loop", [](Config & c) -> auto& { return c.kingfisher.resume_loop_s; }, 0, kAny,
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

}  // namespace frontseat_driver::sim
