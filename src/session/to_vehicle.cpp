#include "frontseat_driver/session/to_vehicle.h"

#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::session {

namespace {

using vehicle::Event;

constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600.0;

template <class T>
std::optional<T> firstOf(const std::optional<T>& first, const std::optional<T>& second) {
  return first ? first : second;
}

std::optional<vehicle::Position> toPosition(const std::optional<nmea::LatLon>& position) {
  if (!position) return std::nullopt;
  return vehicle::Position{position->latitude_deg, position->longitude_deg};
}

// A Sandshark sends altitude 0 for no bottom, a Heron sends it always (field notes, NVG).
std::optional<double> bottomSeen(const std::optional<double>& altitude_m) {
  return altitude_m && *altitude_m != 0.0 ? altitude_m : std::nullopt;
}

// Field vehicles leave the id out and send temperature 0 when they have none (field notes, CPRBS).
std::optional<double> temperatureOf(const protocol::kingfisher::BatteryVoltage& battery) {
  const bool none = !battery.battery_id && battery.temperature_c == 0.0;
  return none ? std::nullopt : battery.temperature_c;
}

struct ToEvent {
  using Result = std::optional<Event>;

  Result operator()(const protocol::NavigationUpdate& in) const {
    vehicle::Navigation out;
    out.measured_at = firstOf(in.computed_at, in.sent_at);
    out.position = toPosition(in.position);
    out.from_gps = in.from_gps.value_or(false);
    out.altitude_m = bottomSeen(in.altitude_m);
    out.depth_m = in.depth_m;
    out.heading_deg = in.heading_deg;
    out.roll_deg = in.roll_deg;
    out.pitch_deg = in.pitch_deg;
    return out;
  }

  Result operator()(const protocol::VelocityUpdate& in) const {
    vehicle::Velocity out;
    out.measured_at = in.sent_at;
    out.east_m_s = in.east_m_s;
    out.north_m_s = in.north_m_s;
    out.down_m_s = in.down_m_s;
    out.roll_rate_deg_s = in.roll_rate_deg_s;
    out.pitch_rate_deg_s = in.pitch_rate_deg_s;
    out.yaw_rate_deg_s = in.yaw_rate_deg_s;
    return out;
  }

  Result operator()(const protocol::kingfisher::RawImu& in) const {
    vehicle::RawImu out;
    out.measured_at = firstOf(in.measured_at, in.sent_at);
    out.rate_x_deg_s = in.rate_x_deg_s;
    out.rate_y_deg_s = in.rate_y_deg_s;
    out.rate_z_deg_s = in.rate_z_deg_s;
    out.acceleration_x = in.acceleration_x;
    out.acceleration_y = in.acceleration_y;
    out.acceleration_z = in.acceleration_z;
    return out;
  }

  Result operator()(const protocol::kingfisher::RawCompass& in) const {
    vehicle::Compass out;
    out.measured_at = firstOf(in.measured_at, in.sent_at);
    out.id = in.compass_id;
    out.heading_deg = in.heading_deg;
    out.pitch_deg = in.pitch_deg;
    out.roll_deg = in.roll_deg;
    return out;
  }

  Result operator()(const protocol::kingfisher::BatteryVoltage& in) const {
    vehicle::Battery out;
    out.measured_at = in.sent_at;
    out.id = in.battery_id;
    out.stack_v = in.stack_v;
    out.lowest_cell_v = in.lowest_cell_v;
    out.highest_cell_v = in.highest_cell_v;
    out.temperature_c = temperatureOf(in);
    return out;
  }

  Result operator()(const protocol::gps::Fix& in) const {
    vehicle::GpsFix out;
    out.measured_at = in.measured_at;
    out.quality = in.quality.value_or(0);
    out.position = toPosition(in.position);
    out.altitude_m = in.altitude_m;
    out.geoid_separation_m = in.geoid_separation_m;
    return out;
  }

  Result operator()(const protocol::gps::MinimumData& in) const {
    vehicle::GpsVelocity out;
    out.measured_at = in.measured_at;
    if (in.date) out.date = vehicle::midnightOf(in.date->year, in.date->month, in.date->day);
    out.valid = in.valid;
    if (in.speed_kn) out.speed_m_s = *in.speed_kn * kMetresPerSecondPerKnot;
    out.course_deg = in.course_deg;
    return out;
  }

  Result operator()(const protocol::bluefin::VehicleVersion& in) const {
    return vehicle::InterfaceVersion{in.sent_at, in.version};
  }

  Result operator()(const protocol::bluefin::PayloadShutdown& in) const {
    return vehicle::Shutdown{in.sent_at};
  }

  Result operator()(const protocol::bluefin::MissionStatus& in) const { return toVehicle(in); }

  Result operator()(const protocol::bluefin::Acknowledgement& in) const {
    if (!in.status) return std::nullopt;
    vehicle::Acknowledgement out;
    out.sent_at = in.sent_at;
    out.command = commandFormatter(in.command);
    out.command_time = in.command_time;
    out.behavior_id = in.behavior_id;
    out.status = static_cast<vehicle::Acknowledgement::Status>(*in.status);
    out.message = in.message;
    return out;
  }

  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }
};

using Time = std::optional<vehicle::TimeOfDay>;

template <class T>
auto sentAtOf(const T& in, int) -> decltype(Time{in.sent_at}) {
  return in.sent_at;
}

// A sentence without a time of its own.
template <class T>
Time sentAtOf(const T&, long) {
  return std::nullopt;
}

struct NamedState {
  std::string_view status;
  vehicle::MissionStatus::State state;
};

constexpr std::string_view kRunning = "Running";

constexpr NamedState kStates[] = {
    {"Offline", vehicle::MissionStatus::State::Offline},
    {"Waiting", vehicle::MissionStatus::State::Waiting},
    {"Invalid Dive File", vehicle::MissionStatus::State::InvalidDiveFile},
    {"Invalid Wrapup File", vehicle::MissionStatus::State::InvalidWrapupFile},
    {"Ready", vehicle::MissionStatus::State::Ready},
    {kRunning, vehicle::MissionStatus::State::Running},
    {"WrappingUp", vehicle::MissionStatus::State::WrappingUp},
    {"Aborting", vehicle::MissionStatus::State::Aborting},
    {"Completed", vehicle::MissionStatus::State::Completed},
    {"Aborted", vehicle::MissionStatus::State::Aborted},
    {"Stopped", vehicle::MissionStatus::State::Stopped},
};

vehicle::MissionStatus::State stateOf(std::string_view status) {
  for (const NamedState& named : kStates) {
    if (named.status == status) return named.state;
  }
  return vehicle::MissionStatus::State::Unknown;
}

// The document does not say what stands between "Running" and the directory.
std::string_view afterSeparator(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" :=-");
  return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

}  // namespace

std::optional<Event> toVehicle(const protocol::Message& message) {
  return std::visit(ToEvent{}, message);
}

std::optional<vehicle::TimeOfDay> sentAt(const protocol::Message& message) {
  return std::visit([](const auto& in) { return sentAtOf(in, 0); }, message);
}

vehicle::MissionStatus toVehicle(const protocol::bluefin::MissionStatus& mission) {
  vehicle::MissionStatus out;
  out.sent_at = mission.sent_at;
  out.status = mission.status;
  if (mission.status.substr(0, kRunning.size()) == kRunning) {
    out.status = kRunning;
    out.log_directory = afterSeparator(mission.status.substr(kRunning.size()));
  }
  out.state = stateOf(out.status);
  out.dive_file = mission.dive_file;
  out.details = mission.details;
  return out;
}

std::string_view commandFormatter(std::string_view name) {
  return name.size() == 5 ? name.substr(2) : name;
}

}  // namespace frontseat_driver::session
