#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

/// What any frontseat can say, in nautical terms: degrees, compass headings, depths, body axes
/// x bow, y starboard, z down. A value that is missing is empty. Texts are views that hold while
/// the event is handled.
namespace frontseat_driver::vehicle {

/// Time of day on the vehicle's clock; which day, only the receive time tells.
using TimeOfDay = std::chrono::microseconds;

/// WGS-84 degrees, north and east positive.
struct Position {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

/// What the vehicle's clock showed when it made the sentence that arrived now.
struct ClockSample {
  TimeOfDay time{};
};

/// Where the vehicle believes it is.
struct Navigation {
  std::optional<TimeOfDay> measured_at;
  std::optional<Position> position;
  bool from_gps = false;              ///< false: dead reckoning
  std::optional<double> altitude_m;   ///< above the bottom
  std::optional<double> depth_m;      ///< below the surface
  std::optional<double> heading_deg;  ///< clockwise from the north of the vehicle's reference
  std::optional<double> roll_deg;     ///< positive port side up
  std::optional<double> pitch_deg;    ///< positive bow up
};

/// Velocity over ground and body rates.
struct Velocity {
  std::optional<TimeOfDay> measured_at;
  std::optional<double> east_m_s;
  std::optional<double> north_m_s;
  std::optional<double> down_m_s;
  std::optional<double> roll_rate_deg_s;   ///< about the bow, positive port side rising
  std::optional<double> pitch_rate_deg_s;  ///< about starboard, positive bow rising
  std::optional<double> yaw_rate_deg_s;    ///< about down, positive clockwise from above
};

/// An inertial sensor in body axes.
struct RawImu {
  std::optional<TimeOfDay> measured_at;
  std::optional<double> rate_x_deg_s;
  std::optional<double> rate_y_deg_s;
  std::optional<double> rate_z_deg_s;
  std::optional<double> acceleration_x;  ///< specific force, in the vehicle's unit
  std::optional<double> acceleration_y;
  std::optional<double> acceleration_z;
};

/// One compass, as the vehicle read it.
struct Compass {
  std::optional<TimeOfDay> measured_at;
  std::optional<std::int64_t> id;
  std::optional<double> heading_deg;
  std::optional<double> pitch_deg;
  std::optional<double> roll_deg;
};

/// One bank of cells.
struct Battery {
  std::optional<TimeOfDay> measured_at;
  std::optional<std::int64_t> id;
  std::optional<double> stack_v;
  std::optional<double> lowest_cell_v;
  std::optional<double> highest_cell_v;
  std::optional<double> temperature_c;
};

/// Position from the GPS receiver itself. Times are UTC whatever the vehicle's clock is.
struct GpsFix {
  std::optional<TimeOfDay> measured_at;
  std::int64_t quality = 0;  ///< as GGA: 0 none, 1 GPS, 2 differential, 4 and 5 RTK, 6 estimated
  std::optional<Position> position;
  std::optional<double> altitude_m;          ///< above the geoid
  std::optional<double> geoid_separation_m;  ///< geoid above the ellipsoid
};

/// Velocity and date from the GPS receiver itself. Times are UTC.
struct GpsVelocity {
  std::optional<TimeOfDay> measured_at;
  std::optional<std::chrono::nanoseconds> date;  ///< midnight of the day, since 1970
  bool valid = false;
  std::optional<double> speed_m_s;
  std::optional<double> course_deg;  ///< over ground, clockwise from true north
};

/// The mission changed its state.
struct MissionStatus {
  enum class State {
    Unknown,
    Offline,
    Waiting,
    InvalidDiveFile,
    InvalidWrapupFile,
    Ready,
    Running,
    WrappingUp,
    Aborting,
    Completed,
    Aborted,
    Stopped
  };
  std::optional<TimeOfDay> sent_at;
  State state = State::Unknown;
  std::string_view status;  ///< the vehicle's words, without the log directory
  std::string_view dive_file;
  std::string_view log_directory;
  std::string_view details;
};

/// The vehicle's last word on who commands it.
enum class Grant { Unknown, Denied, Granted };

/// Whether commands would be obeyed now, and why not.
struct Control {
  Grant grant = Grant::Unknown;
  bool commands_enabled = true;
  bool commanding = false;
  std::string_view reason;  ///< why a command would be refused now; empty if it would not
};

/// The vehicle's answer to one command.
struct Acknowledgement {
  enum class Status : std::uint8_t { Invalid = 0, Failed = 1, Done = 2, Pending = 3 };
  std::optional<TimeOfDay> sent_at;
  std::string_view command;  ///< without the talker: "RMB"
  std::optional<TimeOfDay> command_time;
  std::string_view behavior_id;
  Status status = Status::Invalid;
  std::string_view message;
  std::optional<std::chrono::nanoseconds> round_trip;  ///< empty: not an answer to us
};

/// The version of the interface the vehicle speaks.
struct InterfaceVersion {
  std::optional<TimeOfDay> sent_at;
  std::string_view version;
};

/// The payload is going to lose its power.
struct Shutdown {
  std::optional<TimeOfDay> sent_at;
  std::chrono::seconds notice{60};  ///< least time until then
};

using Event =
    std::variant<ClockSample, Navigation, Velocity, RawImu, Compass, Battery, GpsFix, GpsVelocity,
                 MissionStatus, Control, Acknowledgement, InterfaceVersion, Shutdown>;

}  // namespace frontseat_driver::vehicle
