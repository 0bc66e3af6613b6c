#include <cstdint>

#include "convert.h"
#include "covariance.h"
#include "message_builder.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr const char* kGpsFrame = "gps_link";

/// NMEA 0183, GGA: 1 GPS, 2 differential, 3 PPS, 4 and 5 RTK, 6 estimated, 7 manual, 8 simulated. 9
/// stands in no standard; some receivers send it for their best fix.
std::int8_t navSatStatus(std::int64_t quality) {
  using sensor_msgs::NavSatStatus;
  switch (quality) {
    case 1:
    case 3:
    case 7:
    case 8:
      return NavSatStatus::STATUS_FIX;
    case 2:
      return NavSatStatus::STATUS_SBAS_FIX;
    case 4:
    case 5:
    case 9:
      return NavSatStatus::STATUS_GBAS_FIX;
    default:
      return NavSatStatus::STATUS_NO_FIX;
  }
}

}  // namespace

sensor_msgs::NavSatFix MessageBuilder::gpsFix(const vehicle::GpsFix& fix,
                                              const vehicle::Now& arrival) {
  using sensor_msgs::NavSatFix;
  NavSatFix out;
  out.header = header(kGpsFix, gpsStamp(fix.measured_at, arrival), kGpsFrame);
  out.status.status = navSatStatus(fix.position ? fix.quality : 0);
  out.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  out.latitude = out.longitude = out.altitude = kNan;
  out.position_covariance_type = NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  if (out.status.status == sensor_msgs::NavSatStatus::STATUS_NO_FIX) return out;
  out.latitude = fix.position->latitude_deg;
  out.longitude = fix.position->longitude_deg;
  out.altitude = fix.altitude_m.value_or(kNan) + fix.geoid_separation_m.value_or(kNan);
  const double known = variance(parameters_.position_stddev_gps_m);
  const bool altitude_known = fix.altitude_m && fix.geoid_separation_m;
  setVariances(out.position_covariance, 0,
               {known, known, altitude_known ? known : kUnknownVariance});
  out.position_covariance_type = NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
  return out;
}

std::optional<geometry_msgs::TwistStamped> MessageBuilder::gpsVelocity(
    const vehicle::GpsVelocity& velocity, const vehicle::Now& arrival) {
  if (!velocity.valid || !velocity.speed_m_s) return std::nullopt;
  // A receiver that stands still knows no course.
  if (!velocity.course_deg && *velocity.speed_m_s != 0.0) return std::nullopt;
  geometry_msgs::TwistStamped out;
  out.header = header(kGpsVelocity, gpsStamp(velocity.measured_at, arrival), kGpsFrame);
  out.twist.linear = enuVelocity(*velocity.speed_m_s, velocity.course_deg.value_or(0.0));
  return out;
}

std::optional<sensor_msgs::TimeReference> MessageBuilder::gpsTime(
    const vehicle::GpsVelocity& velocity, const vehicle::Now& arrival) {
  if (!velocity.valid || !velocity.date || !velocity.measured_at) return std::nullopt;
  sensor_msgs::TimeReference out;
  out.header = header(kGpsTime, toRosTime(arrival.stamp), kGpsFrame);
  out.time_ref = toRosTime(*velocity.date + *velocity.measured_at);
  out.source = "gps";
  return out;
}

ros::Time MessageBuilder::gpsStamp(std::optional<vehicle::TimeOfDay> measured_at,
                                   const vehicle::Now& arrival) const {
  return stamper_.stamp(measured_at, TimeScale::Utc, arrival);
}

}  // namespace frontseat_driver::ros_layer
