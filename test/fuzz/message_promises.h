#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RelativeHumidity.h>
#include <sensor_msgs/Temperature.h>
#include <std_msgs/Float64.h>

#include <cmath>

#include "convert.h"
#include "fuzz.h"

/// What is promised of a ROS message, whatever a vehicle said.
namespace frontseat_driver::fuzz {

inline bool finite(double x, double y, double z) {
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
}
template <class Vector>
bool finite(const Vector& vector) {
  return finite(vector.x, vector.y, vector.z);
}

inline void checkRotation(const geometry_msgs::Quaternion& q) {
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  promise(std::abs(norm - 1.0) < 1e-9, "an orientation is no rotation");
}

template <class Matrix>
void checkVariances(const Matrix& covariance) {
  for (const double variance : covariance) {
    promise(std::isfinite(variance) && (variance >= 0.0 || variance == ros_layer::kNotMeasured),
            "a variance is none");
  }
}

// --- What is promised of each kind of message ---

template <class Message>
void check(const Message&) {}

inline void check(const geometry_msgs::PoseWithCovarianceStamped& out) {
  promise(finite(out.pose.pose.position), "a place is none");
  checkVariances(out.pose.covariance);
}
inline void check(const geometry_msgs::TwistWithCovarianceStamped& out) {
  promise(finite(out.twist.twist.linear), "a velocity is none");
  checkVariances(out.twist.covariance);
}
inline void check(const sensor_msgs::FluidPressure& out) {
  promise(std::isfinite(out.fluid_pressure) && out.variance > 0.0, "a pressure is none");
}
inline void check(const sensor_msgs::Range& out) {
  promise(std::isfinite(out.range), "a range is none");
}
inline void check(const sensor_msgs::Temperature& out) {
  promise(std::isfinite(out.temperature), "a temperature is none");
}
inline void check(const sensor_msgs::RelativeHumidity& out) {
  promise(std::isfinite(out.relative_humidity), "a humidity is none");
}
inline void check(const std_msgs::Float64& out) {
  promise(std::isfinite(out.data), "a number is none");
}
inline void check(const sensor_msgs::MagneticField& out) {
  promise(finite(out.magnetic_field), "a field is none");
}
inline void check(const sensor_msgs::JointState& out) {
  promise(out.name.size() == out.position.size(), "a joint without a position");
  for (const double position : out.position) promise(std::isfinite(position), "a joint is nowhere");
}
inline void check(const sensor_msgs::NavSatFix& out) {
  const bool fix = out.status.status != sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  const bool on_earth = std::abs(out.latitude) <= 90.0 && std::abs(out.longitude) <= 180.0;
  const bool unknown = std::isnan(out.latitude) && std::isnan(out.longitude);
  promise(on_earth || (unknown && !fix), "a fix is somewhere else");
  checkVariances(out.position_covariance);
}
inline void check(const sensor_msgs::Imu& out) {
  checkRotation(out.orientation);
  promise(finite(out.angular_velocity) && finite(out.linear_acceleration), "an axis is none");
  checkVariances(out.orientation_covariance);
  checkVariances(out.angular_velocity_covariance);
  checkVariances(out.linear_acceleration_covariance);
}
inline void check(const geometry_msgs::TwistStamped& out) {
  const geometry_msgs::Vector3& linear = out.twist.linear;
  promise(std::isfinite(linear.x) && std::isfinite(linear.y), "a velocity is none");
  promise(!std::isinf(linear.z), "a vertical velocity is none");  // NaN: not known
}
inline void check(const geometry_msgs::WrenchStamped& out) {
  promise(finite(out.wrench.force) && finite(out.wrench.torque), "a force is none");
}
inline void check(const nav_msgs::Odometry& out) {
  promise(finite(out.pose.pose.position), "a place is none");
  promise(finite(out.twist.twist.linear) && finite(out.twist.twist.angular), "a twist is none");
  checkRotation(out.pose.pose.orientation);
  checkVariances(out.pose.covariance);
  checkVariances(out.twist.covariance);
}
inline void check(const geometry_msgs::TransformStamped& out) {
  promise(finite(out.transform.translation), "a frame is nowhere");
  checkRotation(out.transform.rotation);
}

}  // namespace frontseat_driver::fuzz
