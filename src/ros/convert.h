#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"
#include "parameters.h"

/// The only place where frames and units change: nautical degrees, NED and FRD on the vehicle's
/// side, REP-103 radians, ENU and FLU on the ROS side. Pure functions; no result is ever -0.0 that
/// would be 0.
namespace frontseat_driver::ros_layer {

/// What "not known" is in a covariance diagonal.
constexpr double kUnknownVariance = 1e6;

/// What "not measured at all" is in the first element of an IMU covariance (sensor_msgs/Imu).
constexpr double kNotMeasured = -1.0;

constexpr double kStandardGravity_m_s2 = 9.80665;

double radians(double angle_deg);
double degrees(double angle_rad);

/// Attitude of the FRD body in NED, as REP-103 wants it: the FLU body in ENU. Heading clockwise
/// from true north, roll positive port side up, pitch positive bow up.
geometry_msgs::Quaternion toOrientation(double roll_deg, double pitch_deg, double heading_deg);

/// No rotation at all.
geometry_msgs::Quaternion identityOrientation();

/// A vector in FRD body axes, in FLU body axes: x stays, y and z turn.
geometry_msgs::Vector3 fluFromFrd(double x, double y, double z);

/// Rates about FRD body axes in deg/s, about FLU body axes in rad/s.
geometry_msgs::Vector3 bodyRates(double x_deg_s, double y_deg_s, double z_deg_s);

/// A velocity told as east, north and down, in ENU.
geometry_msgs::Vector3 enuVelocity(double east_m_s, double north_m_s, double down_m_s);

/// A speed over ground towards a course (clockwise from true north), in ENU.
geometry_msgs::Vector3 enuVelocity(double speed_m_s, double course_deg);

/// A vector in ENU, in the body axes that `orientation` describes.
geometry_msgs::Vector3 bodyFromEnu(const geometry_msgs::Vector3& enu,
                                   const geometry_msgs::Quaternion& orientation);

/// How far grid north lies clockwise of true north in the position's standard UTM zone, beyond
/// 84 N and 80 S in UPS: true heading = grid heading + convergence.
double meridianConvergence_deg(const vehicle::Position& position);

/// A compass reading as the specification counts it.
struct CompassAngles {
  double heading_deg = 0.0;
  double pitch_deg = 0.0;
};

/// Heron firmware sends (180 - heading) mod 360, and pitch with the sign turned.
CompassAngles toSpecification(CompassAngles as_sent, CompassConvention convention);

/// In [0, 360).
double wrapHeading_deg(double heading_deg);

/// Within the world and not the 0, 0 that vehicles send before their first fix.
bool isUsable(const vehicle::Position& position);

/// From the centre of the Earth to a position at ellipsoid height 0: x to 0 N 0 E, z to the pole.
geometry_msgs::Point fromEarthCentre_m(const vehicle::Position& position);

double distance_m(const geometry_msgs::Point& a, const geometry_msgs::Point& b);

/// Nearest moment that ros::Time can hold; never throws. Times before 1970 become 0.
ros::Time toRosTime(vehicle::UtcTime time);

vehicle::UtcTime toUtcTime(const ros::Time& time);

/// How long `end` is after `begin`, for all times there are: the difference of two ros::Time throws
/// when it is more than 68 years.
std::chrono::nanoseconds timeFrom(const ros::Time& begin, const ros::Time& end);

/// A standard deviation as a variance.
double variance(double standard_deviation);

/// `name_id`, or `name` alone without an id.
std::string withId(const std::string& name, const std::optional<std::int64_t>& id);

}  // namespace frontseat_driver::ros_layer
