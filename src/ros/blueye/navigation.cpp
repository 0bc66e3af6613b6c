#include "blueye/navigation.h"

#include <utility>

#include "convert.h"
#include "covariance.h"
#include "transforms.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

// The rounding of positions and a little jitter of arrival.
constexpr double kStepMargin_m = 1.0;
// Depths have the time of their arrival alone: over less, its jitter would be most of the speed.
constexpr std::chrono::milliseconds kSpeedOver{50};
// Closer together than any rate of the drone: sent one after the other, delivered at once.
constexpr std::chrono::milliseconds kBurst{5};

double seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

bool isFinite(const pb::PositionEstimate& estimate) {
  return std::isfinite(estimate.northing()) && std::isfinite(estimate.easting()) &&
         std::isfinite(estimate.heading());
}

bool isFinite(const pb::Attitude& attitude) {
  return std::isfinite(attitude.roll()) && std::isfinite(attitude.pitch()) &&
         std::isfinite(attitude.yaw());
}

}  // namespace

Navigation::Navigation(NavigationOptions options)
    : options_(std::move(options)), accelerometer_(options_.conventions.accelerometer_sign) {
  datum_ = options_.datum;
  if (datum_) plane_.Reset(datum_->latitude_deg, datum_->longitude_deg, 0.0);
}

Context Navigation::context(const ros::Time& stamp) const {
  return {stamp, options_.conventions, options_.deviations, options_.base_frame,
          options_.odom_frame};
}

void Navigation::forget() {
  attitude_.reset();
  depth_.reset();
  last_depth_.reset();
  sinking_m_s_.reset();
  imu_.reset();
  dvl_.reset();
  estimate_.reset();
}

// --- What the drone tells ---

void Navigation::take(const pb::AttitudeTel& told, const vehicle::Now& now) {
  if (!told.has_attitude() || !isFinite(told.attitude())) return;
  attitude_ = {told, now.steady};
}

void Navigation::take(const pb::DepthTel& told, const vehicle::Now& now) {
  if (!told.has_depth() || !std::isfinite(told.depth().value())) return;
  depth_ = {told, now.steady};
  if (fresh(last_depth_, now) == nullptr) {
    sinking_m_s_.reset();
    last_depth_ = depth_;
    return;
  }
  const auto apart = now.steady - last_depth_->at;
  if (apart >= kSpeedOver) {
    const double change_m = told.depth().value() - last_depth_->message.depth().value();
    sinking_m_s_ = change_m / seconds(apart);
  }
  // Of a burst the last is nearest to the time of its arrival.
  if (apart >= kSpeedOver || apart < kBurst) last_depth_ = depth_;
}

void Navigation::take(const pb::CalibratedImuTel& told, const vehicle::Now& now) {
  if (!told.has_imu()) return;
  imu_ = {told, now.steady};
  if (!told.imu().has_accelerometer()) return;
  const pb::Vector3& sensed = told.imu().accelerometer();
  const double norm_g =
      std::sqrt(sensed.x() * sensed.x() + sensed.y() * sensed.y() + sensed.z() * sensed.z());
  std::optional<double> tilt_rad;
  if (const auto* attitude = fresh(attitude_, now)) {
    tilt_rad = radians(std::hypot(attitude->attitude().roll(), attitude->attitude().pitch()));
  }
  accelerometer_.take(sensed.z(), norm_g, tilt_rad);
}

void Navigation::take(const pb::DvlVelocityTel& told, const vehicle::Now& now) {
  if (!told.has_dvl_velocity()) return;
  dvl_ = {told, now.steady};
  const auto velocity = velocityOf(told.dvl_velocity(), options_.conventions);
  const auto* estimate = fresh(estimate_, now);
  if (!velocity || told.dvl_velocity().is_water_tracking() || estimate == nullptr) return;
  if (!estimate->position_estimate().is_valid()) return;
  dvl_disagrees_ = dvl_sense_.disagrees(-velocity->y, estimate->position_estimate().sway_rate()) ||
                   dvl_disagrees_;
}

bool Navigation::dvlDisagrees() { return std::exchange(dvl_disagrees_, false); }

bool Navigation::take(const pb::PositionEstimateTel& told, const vehicle::Now& now) {
  if (!told.has_position_estimate()) return false;
  const pb::PositionEstimate& estimate = told.position_estimate();
  // Without is_valid no number counts, so none spoils it.
  if (estimate.is_valid() && !isFinite(estimate)) return false;
  estimate_ = {told, now.steady};
  if (!estimate.is_valid()) return true;
  followReset(estimate, now);
  followMap(estimate);
  return true;
}

void Navigation::followReset(const pb::PositionEstimate& estimate, const vehicle::Now& now) {
  const Point raw{estimate.easting(), estimate.northing()};
  const bool restarted = estimate.time_since_reset_sec() < last_since_reset_s_;
  if (last_raw_) {
    const double step_m = std::hypot(raw.x - last_raw_->x, raw.y - last_raw_->y);
    const double most_m =
        options_.max_speed_m_s * seconds(now.steady - last_raw_at_) + kStepMargin_m;
    if (restarted || step_m > most_m) {
      const Point jump{raw.x - last_raw_->x, raw.y - last_raw_->y};
      offset_ = {offset_.x - jump.x, offset_.y - jump.y};
      // Where the drone is in the map is told by the next global position; until then the map
      // follows the drone's word.
      map_settled_ = false;
      if (map_from_odom_ && !restarted) {
        map_from_odom_ = Point{map_from_odom_->x + jump.x, map_from_odom_->y + jump.y};
        map_moved_ = true;
      }
    }
  }
  last_raw_ = raw;
  last_raw_at_ = now.steady;
  last_since_reset_s_ = estimate.time_since_reset_sec();
}

void Navigation::followMap(const pb::PositionEstimate& estimate) {
  if (map_settled_ || !estimate.has_global_position() || !isUsable(estimate.global_position())) {
    return;
  }
  const vehicle::Position position{estimate.global_position().latitude(),
                                   estimate.global_position().longitude()};
  if (!datum_) {
    datum_ = position;
    plane_.Reset(position.latitude_deg, position.longitude_deg, 0.0);
  }
  double x = 0.0;
  double y = 0.0;
  double up = 0.0;
  plane_.Forward(position.latitude_deg, position.longitude_deg, 0.0, x, y, up);
  map_from_odom_ =
      Point{x - (estimate.easting() + offset_.x), y - (estimate.northing() + offset_.y)};
  map_moved_ = map_settled_ = true;
}

bool Navigation::mapMoved() { return std::exchange(map_moved_, false); }

std::optional<double> Navigation::depth_m(const vehicle::Now& now) const {
  const auto* depth = fresh(depth_, now);
  if (depth == nullptr) return std::nullopt;
  return depth->depth().value();
}

// --- What comes of it ---

std::optional<nav_msgs::Odometry> Navigation::odometry(const vehicle::Now& now,
                                                       const ros::Time& stamp) const {
  if (!estimate_) return std::nullopt;
  nav_msgs::Odometry out;
  out.header = context(stamp).header(options_.odom_frame);
  out.child_frame_id = options_.base_frame;
  fillPose(out, now);
  fillTwist(out, now);
  return out;
}

void Navigation::fillPose(nav_msgs::Odometry& out, const vehicle::Now& now) const {
  const pb::PositionEstimate& estimate = estimate_->message.position_estimate();
  double horizontal = kUnknownVariance;
  if (estimate.is_valid()) {
    out.pose.pose.position.x = estimate.easting() + offset_.x;
    out.pose.pose.position.y = estimate.northing() + offset_.y;
    horizontal = varianceOfRadius95(estimate.accuracy());
  }
  const auto depth = depth_m(now);
  out.pose.pose.position.z = 0.0 - depth.value_or(0.0);
  setVariances(
      out.pose.covariance, 0,
      {horizontal, horizontal, depth ? variance(options_.deviations.depth_m) : kUnknownVariance});
  const auto* attitude = fresh(attitude_, now);
  const double known = variance(options_.deviations.orientation_rad);
  setVariances(out.pose.covariance, 3, allAxes(kUnknownVariance));
  out.pose.pose.orientation = identityOrientation();
  if (!estimate.is_valid() && attitude == nullptr) return;
  // The estimate's heading is the one its position was reckoned with.
  const double heading_deg =
      estimate.is_valid()
          ? degrees(estimate.heading())
          : attitude->attitude().yaw() + degrees(options_.conventions.add_declination_rad);
  const double roll_deg = attitude != nullptr ? attitude->attitude().roll() : 0.0;
  const double pitch_deg = attitude != nullptr ? attitude->attitude().pitch() : 0.0;
  out.pose.pose.orientation = toOrientation(roll_deg, pitch_deg, heading_deg);
  const double tilt = attitude != nullptr ? known : kUnknownVariance;
  setVariances(out.pose.covariance, 3, {tilt, tilt, known});
}

void Navigation::fillTwist(nav_msgs::Odometry& out, const vehicle::Now& now) const {
  const pb::PositionEstimate& estimate = estimate_->message.position_estimate();
  geometry_msgs::Twist& twist = out.twist.twist;
  const double speed = variance(options_.deviations.velocity_m_s);
  const double rate = variance(options_.deviations.angular_rate_rad_s);
  const auto up = up_m_s(now);
  twist.linear.z = up.value_or(0.0);
  // What is not valid, or no number, is unknown.
  const auto known = [&estimate](float value) {
    return estimate.is_valid() && std::isfinite(value) ? std::optional<double>{value}
                                                       : std::nullopt;
  };
  const auto surge = known(estimate.surge_rate());
  const auto sway = known(estimate.sway_rate());
  const auto yaw = known(estimate.yaw_rate());
  twist.linear.x = surge.value_or(0.0);
  twist.linear.y = 0.0 - sway.value_or(0.0);
  setVariances(out.twist.covariance, 0,
               {surge ? speed : kUnknownVariance, sway ? speed : kUnknownVariance,
                up ? speed : kUnknownVariance});
  sensor_msgs::Imu turning;
  turning.angular_velocity_covariance[0] = kNotMeasured;
  if (const auto* imu = fresh(imu_, now)) fill(turning, imu->imu(), {}, context({}));
  const bool has_gyro = turning.angular_velocity_covariance[0] >= 0.0;
  twist.angular = turning.angular_velocity;
  if (yaw) twist.angular.z = 0.0 - *yaw;
  const double gyro = has_gyro ? rate : kUnknownVariance;
  setVariances(out.twist.covariance, 3, {gyro, gyro, yaw ? rate : gyro});
}

std::optional<double> Navigation::up_m_s(const vehicle::Now& now) const {
  const auto* dvl = fresh(dvl_, now);
  if (dvl != nullptr && !dvl->dvl_velocity().is_water_tracking()) {
    if (const auto velocity = velocityOf(dvl->dvl_velocity(), options_.conventions)) {
      return velocity->z;
    }
  }
  if (fresh(depth_, now) == nullptr || !sinking_m_s_) return std::nullopt;
  return 0.0 - *sinking_m_s_;
}

std::optional<geometry_msgs::TransformStamped> Navigation::transform(
    const nav_msgs::Odometry& odometry) const {
  if (!estimate_ || !estimate_->message.position_estimate().is_valid()) return std::nullopt;
  return toTransform(odometry);
}

std::optional<geometry_msgs::TransformStamped> Navigation::mapTransform(
    const ros::Time& stamp) const {
  if (!map_from_odom_) return std::nullopt;
  geometry_msgs::TransformStamped out;
  out.header = context(stamp).header(options_.map_frame);
  out.child_frame_id = options_.odom_frame;
  out.transform.translation.x = map_from_odom_->x;
  out.transform.translation.y = map_from_odom_->y;
  out.transform.rotation = identityOrientation();
  return out;
}

sensor_msgs::Imu Navigation::imu(const vehicle::Now& now, const ros::Time& stamp) const {
  sensor_msgs::Imu out;
  out.header = context(stamp).header(options_.base_frame);
  out.orientation = identityOrientation();
  out.orientation_covariance[0] = kNotMeasured;
  out.angular_velocity_covariance[0] = out.linear_acceleration_covariance[0] = kNotMeasured;
  if (const auto* attitude = fresh(attitude_, now)) {
    out.orientation = orientationOf(attitude->attitude(), options_.conventions);
    setVariances(out.orientation_covariance, 0,
                 allAxes(variance(options_.deviations.orientation_rad)));
  }
  if (const auto* imu = fresh(imu_, now)) {
    fill(out, imu->imu(), accelerometer_.factor(), context(stamp));
  }
  return out;
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
