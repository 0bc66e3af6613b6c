#include <string>
#include <utility>

#include "convert.h"
#include "covariance.h"
#include "message_builder.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr const char* kImuFrame = "imu_link";

}  // namespace

std::optional<sensor_msgs::Imu> MessageBuilder::imu() {
  if (!velocity_) return std::nullopt;
  sensor_msgs::Imu out;
  out.header = header(kImu, velocity_->stamp, parameters_.base_frame);
  const vehicle::Navigation* navigation = fresh(navigation_, velocity_->arrival);
  fillOrientation(out, navigation != nullptr ? attitudeOf(*navigation) : std::nullopt);
  const vehicle::Velocity& velocity = velocity_->event;
  fillRates(out, velocity.roll_rate_deg_s, velocity.pitch_rate_deg_s, velocity.yaw_rate_deg_s);
  fillAcceleration(out, fresh(raw_imu_, velocity_->arrival));
  return out;
}

std::optional<sensor_msgs::Imu> MessageBuilder::rawImu() {
  if (!raw_imu_) return std::nullopt;
  const vehicle::RawImu& raw = raw_imu_->event;
  sensor_msgs::Imu out;
  out.header = header(kRawImu, raw_imu_->stamp, kImuFrame);
  fillOrientation(out, std::nullopt);
  fillRates(out, raw.rate_x_deg_s, raw.rate_y_deg_s, raw.rate_z_deg_s);
  fillAcceleration(out, &raw);
  const bool blank = out.angular_velocity_covariance[0] == kNotMeasured &&
                     out.linear_acceleration_covariance[0] == kNotMeasured;
  return blank ? std::nullopt : std::make_optional(std::move(out));
}

std::optional<sensor_msgs::Imu> MessageBuilder::compass(const vehicle::Compass& compass,
                                                        const vehicle::Now& arrival) {
  if (!compass.heading_deg) return std::nullopt;
  CompassAngles angles{*compass.heading_deg, compass.pitch_deg.value_or(0.0)};
  angles = toSpecification(angles, parameters_.compass_convention);
  const double declination_deg = degrees(parameters_.magnetic_declination_rad);
  const std::optional<double> pitch_deg =
      compass.pitch_deg ? std::make_optional(angles.pitch_deg) : std::nullopt;
  sensor_msgs::Imu out;
  out.header = header(kCompass, vehicleStamp(compass.measured_at, arrival),
                      withId("compass", compass.id) + "_link");
  fillOrientation(out,
                  attitudeOf(compass.roll_deg, pitch_deg, angles.heading_deg + declination_deg));
  fillRates(out, std::nullopt, std::nullopt, std::nullopt);
  fillAcceleration(out, nullptr);
  return out;
}

void MessageBuilder::fillOrientation(sensor_msgs::Imu& out,
                                     const std::optional<Attitude>& attitude) const {
  out.orientation = attitude ? attitude->orientation : identityOrientation();
  if (attitude) {
    setVariances(out.orientation_covariance, 0, attitude->variances);
  } else {
    out.orientation_covariance[0] = kNotMeasured;
  }
}

void MessageBuilder::fillRates(sensor_msgs::Imu& out, std::optional<double> x_deg_s,
                               std::optional<double> y_deg_s, std::optional<double> z_deg_s) const {
  const Axes rates{x_deg_s, y_deg_s, z_deg_s};
  out.angular_velocity_covariance[0] = kNotMeasured;
  if (rates.blank()) return;
  out.angular_velocity =
      bodyRates(x_deg_s.value_or(0.0), y_deg_s.value_or(0.0), z_deg_s.value_or(0.0));
  setVariances(out.angular_velocity_covariance, 0,
               rates.variances(variance(parameters_.angular_rate_stddev_rad_s)));
}

void MessageBuilder::fillAcceleration(sensor_msgs::Imu& out, const vehicle::RawImu* raw) const {
  out.linear_acceleration_covariance[0] = kNotMeasured;
  if (raw == nullptr) return;
  const Axes force{raw->acceleration_x, raw->acceleration_y, raw->acceleration_z};
  if (force.blank()) return;
  const bool in_g = parameters_.acceleration_unit == AccelerationUnit::StandardGravity;
  const double unit_m_s2 = in_g ? kStandardGravity_m_s2 : 1.0;
  out.linear_acceleration =
      fluFromFrd(force.x.value_or(0.0) * unit_m_s2, force.y.value_or(0.0) * unit_m_s2,
                 force.z.value_or(0.0) * unit_m_s2);
  setVariances(out.linear_acceleration_covariance, 0,
               force.variances(variance(parameters_.acceleration_stddev_m_s2)));
}

}  // namespace frontseat_driver::ros_layer
