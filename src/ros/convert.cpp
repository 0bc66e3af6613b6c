#include "convert.h"

#include <tf2/LinearMath/Quaternion.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace frontseat_driver::ros_layer {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// -0.0 + 0.0 is 0.0; every other sum with 0.0 is its first term.
double withoutNegativeZero(double value) { return value + 0.0; }

geometry_msgs::Vector3 vector(double x, double y, double z) {
  geometry_msgs::Vector3 out;
  out.x = withoutNegativeZero(x);
  out.y = withoutNegativeZero(y);
  out.z = withoutNegativeZero(z);
  return out;
}

geometry_msgs::Quaternion message(const tf2::Quaternion& quaternion) {
  geometry_msgs::Quaternion out;
  out.x = withoutNegativeZero(quaternion.x());
  out.y = withoutNegativeZero(quaternion.y());
  out.z = withoutNegativeZero(quaternion.z());
  out.w = withoutNegativeZero(quaternion.w());
  return out;
}

}  // namespace

double radians(double angle_deg) { return angle_deg * (kPi / 180.0); }

double degrees(double angle_rad) { return angle_rad * (180.0 / kPi); }

geometry_msgs::Quaternion toOrientation(double roll_deg, double pitch_deg, double heading_deg) {
  // Both frames change: the world swap turns heading into yaw from east, the body swap turns pitch
  // around. Yaw within half a turn of 0 keeps w from being negative in a vehicle that is upright.
  const double yaw_deg = 180.0 - wrapHeading_deg(heading_deg + 90.0);
  tf2::Quaternion out;
  out.setRPY(radians(roll_deg), -radians(pitch_deg), radians(yaw_deg));
  return message(out);
}

geometry_msgs::Quaternion identityOrientation() { return message(tf2::Quaternion::getIdentity()); }

geometry_msgs::Vector3 fluFromFrd(double x, double y, double z) { return vector(x, -y, -z); }

geometry_msgs::Vector3 bodyRates(double x_deg_s, double y_deg_s, double z_deg_s) {
  return fluFromFrd(radians(x_deg_s), radians(y_deg_s), radians(z_deg_s));
}

geometry_msgs::Vector3 enuVelocity(double east_m_s, double north_m_s, double down_m_s) {
  return vector(east_m_s, north_m_s, -down_m_s);
}

geometry_msgs::Vector3 enuVelocity(double speed_m_s, double course_deg) {
  const double course = radians(course_deg);
  return vector(speed_m_s * std::sin(course), speed_m_s * std::cos(course), 0.0);
}

geometry_msgs::Vector3 bodyFromEnu(const geometry_msgs::Vector3& enu,
                                   const geometry_msgs::Quaternion& orientation) {
  const tf2::Quaternion rotation(orientation.x, orientation.y, orientation.z, orientation.w);
  const tf2::Vector3 body = tf2::quatRotate(rotation.inverse(), tf2::Vector3(enu.x, enu.y, enu.z));
  return vector(body.x(), body.y(), body.z());
}

double meridianConvergence_deg(const vehicle::Position& position) {
  int zone = 0;
  bool north = false;
  double x = 0.0;
  double y = 0.0;
  double convergence_deg = 0.0;
  double scale = 1.0;
  GeographicLib::UTMUPS::Forward(position.latitude_deg, position.longitude_deg, zone, north, x, y,
                                 convergence_deg, scale);
  return convergence_deg;
}

CompassAngles toSpecification(CompassAngles as_sent, CompassConvention convention) {
  if (convention == CompassConvention::Spec) return as_sent;
  return {wrapHeading_deg(180.0 - as_sent.heading_deg), 0.0 - as_sent.pitch_deg};
}

double wrapHeading_deg(double heading_deg) {
  const double remainder = std::fmod(heading_deg, 360.0);
  const double wrapped = remainder < 0.0 ? remainder + 360.0 : remainder;
  return wrapped < 360.0 ? withoutNegativeZero(wrapped) : 0.0;  // -1e-20 + 360 is 360
}

bool isUsable(const vehicle::Position& position) {
  const bool in_range =
      std::abs(position.latitude_deg) <= 90.0 && std::abs(position.longitude_deg) <= 180.0;
  return in_range && (position.latitude_deg != 0.0 || position.longitude_deg != 0.0);
}

geometry_msgs::Point fromEarthCentre_m(const vehicle::Position& position) {
  geometry_msgs::Point out;
  GeographicLib::Geocentric::WGS84().Forward(position.latitude_deg, position.longitude_deg, 0.0,
                                             out.x, out.y, out.z);
  return out;
}

double distance_m(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

ros::Time toRosTime(vehicle::UtcTime time) {
  using Seconds = std::chrono::duration<std::int64_t>;
  constexpr Seconds kLast(std::numeric_limits<std::uint32_t>::max());
  const vehicle::UtcTime clamped =
      std::clamp(time, vehicle::UtcTime::zero(), kLast + vehicle::UtcTime(999'999'999));
  const auto seconds = std::chrono::duration_cast<Seconds>(clamped);
  return ros::Time(static_cast<std::uint32_t>(seconds.count()),
                   static_cast<std::uint32_t>((clamped - seconds).count()));
}

vehicle::UtcTime toUtcTime(const ros::Time& time) {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec);
}

std::chrono::nanoseconds timeFrom(const ros::Time& begin, const ros::Time& end) {
  return toUtcTime(end) - toUtcTime(begin);
}

double variance(double standard_deviation) { return standard_deviation * standard_deviation; }

std::string withId(const std::string& name, const std::optional<std::int64_t>& id) {
  return id ? name + '_' + std::to_string(*id) : name;
}

}  // namespace frontseat_driver::ros_layer
