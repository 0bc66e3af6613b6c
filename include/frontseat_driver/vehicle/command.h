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

/// Thrust of a drone that moves in all axes, each -1..1 of its full force or moment. With a
/// controller of the drone on, heave and yaw are rates.
struct MotionCommand {
  double surge = 0.0;  ///< forward positive
  double sway = 0.0;   ///< starboard positive
  double heave = 0.0;  ///< down positive
  double roll = 0.0;   ///< starboard side down positive
  double pitch = 0.0;  ///< bow up positive
  double yaw = 0.0;    ///< clockwise seen from above positive
  double slow = 0.0;   ///< 0..1, lowers the gain
  double boost = 0.0;  ///< 0..1, raises the gain
};

/// Speed of a drone's camera tilt, -1..1, up positive.
struct TiltCommand {
  double velocity = 0.0;
};

/// Speeds of a drone's gripper, -1..1: opening positive, clockwise positive.
struct GripperCommand {
  double grip = 0.0;
  double rotate = 0.0;
};

/// What a drone keeps doing until it is told otherwise: a default constructed one ends it.
using DroneCommand = std::variant<MotionCommand, TiltCommand, GripperCommand>;

/// How the payload is, for the vehicle's safety rules.
struct PayloadStatus {
  bool ok = true;
  std::string message;
};

}  // namespace frontseat_driver::vehicle
