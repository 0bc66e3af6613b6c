#pragma once

#include <optional>
#include <string>
#include <variant>

/// What any frontseat can be told, in nautical terms: degrees, compass headings, depths.
namespace frontseat_driver::vehicle {

/// A change of the Sandshark's current behavior. What is empty is left alone.
struct BehaviorCommand {
  enum class Horizontal { Heading, Rudder };
  enum class Vertical { Depth, Altitude, Pitch, Elevator };
  enum class Speed { Rpm, MetresPerSecond };

  template <class Mode>
  struct Aspect {
    Mode mode;
    double value;
  };

  /// Degrees: heading from the north the vehicle counts from, [0, 360), or rudder to starboard.
  std::optional<Aspect<Horizontal>> horizontal;
  /// Metres of depth or of altitude; degrees of pitch or elevator, bow up.
  std::optional<Aspect<Vertical>> vertical;
  /// rpm or m/s.
  std::optional<Aspect<Speed>> speed;
};

/// Thrust of each motor of a boat, -1..1, forward positive.
struct DriveCommand {
  double port = 0.0;
  double starboard = 0.0;
};

/// Thrust and rate of turn of a boat.
struct HelmCommand {
  double thrust = 0.0;          ///< -1..1, forward positive
  double yaw_rate_rad_s = 0.0;  ///< clockwise seen from above
};

/// Heading and speed that a boat keeps by itself.
struct CourseCommand {
  double heading_deg = 0.0;  ///< clockwise from true north, [0, 360)
  double speed_m_s = 0.0;    ///< 0 or more
};

using Command = std::variant<BehaviorCommand, DriveCommand, HelmCommand, CourseCommand>;

/// How the payload is, for the vehicle's safety rules.
struct PayloadStatus {
  bool ok = true;
  std::string message;
};

}  // namespace frontseat_driver::vehicle
