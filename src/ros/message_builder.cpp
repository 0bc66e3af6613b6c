#include "message_builder.h"

#include <algorithm>
#include <limits>

#include "convert.h"
#include "covariance.h"
#include "transforms.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr int kSandsharkLeapSeconds = 0;
constexpr int kKingfisherLeapSeconds = 18;
// Its positions come through 32-bit floats, in steps of up to 0.85 m (field notes, NVG).
constexpr double kSandsharkLeastStddev_m = 0.5;
constexpr const char* kAltimeterFrame = "altimeter_link";

}  // namespace

MessageBuilder::MessageBuilder(const Parameters& parameters)
    : parameters_(parameters), stamper_(parameters.stamp), filter_(parameters.max_jump_m_s) {
  startAfresh();
}

void MessageBuilder::startAfresh() {
  reset();
  dialect_.reset();
  stamper_.setLeapSeconds(parameters_.leap_seconds.value_or(std::chrono::seconds(0)));
  if (parameters_.session.dialect) setDialect(*parameters_.session.dialect);
  datum_.reset();
  if (parameters_.datum) setDatum(*parameters_.datum);
}

void MessageBuilder::setDialect(protocol::Dialect dialect) {
  dialect_ = dialect;
  const int by_dialect =
      dialect == protocol::Dialect::Kingfisher ? kKingfisherLeapSeconds : kSandsharkLeapSeconds;
  stamper_.setLeapSeconds(parameters_.leap_seconds.value_or(std::chrono::seconds(by_dialect)));
}

void MessageBuilder::setDatum(const vehicle::Position& datum) {
  datum_ = datum;
  plane_.Reset(datum.latitude_deg, datum.longitude_deg, 0.0);
}

void MessageBuilder::reset() {
  guards_ = {};
  filter_.reset();
  navigation_.reset();
  velocity_.reset();
  raw_imu_.reset();
  position_accepted_ = false;
  stamper_.reset();
  arrivals_ = {};
}

void MessageBuilder::take(const vehicle::ClockSample& clock, const vehicle::Now& arrival) {
  stamper_.take(clock.time, TimeScale::Vehicle, arrival);
}

void MessageBuilder::take(const vehicle::GpsFix& fix, const vehicle::Now& arrival) {
  if (fix.measured_at) stamper_.take(*fix.measured_at, TimeScale::Utc, arrival);
}

void MessageBuilder::take(const vehicle::GpsVelocity& velocity, const vehicle::Now& arrival) {
  if (velocity.measured_at) stamper_.take(*velocity.measured_at, TimeScale::Utc, arrival);
}

void MessageBuilder::take(const vehicle::Navigation& navigation, const vehicle::Now& heard) {
  const vehicle::Now arrival = arrivals_.take(heard);
  navigation_ = {navigation, arrival, vehicleStamp(navigation.measured_at, arrival)};
  const std::optional<vehicle::Position>& position = navigation.position;
  position_accepted_ = position && isUsable(*position) && filter_.accept(*position, arrival.steady);
  if (position_accepted_ && !datum_) setDatum(*position);
}

void MessageBuilder::take(const vehicle::Velocity& velocity, const vehicle::Now& heard) {
  const vehicle::Now arrival = arrivals_.take(heard);
  velocity_ = {velocity, arrival, vehicleStamp(velocity.measured_at, arrival)};
}

void MessageBuilder::take(const vehicle::RawImu& imu, const vehicle::Now& heard) {
  const vehicle::Now arrival = arrivals_.take(heard);
  raw_imu_ = {imu, arrival, vehicleStamp(imu.measured_at, arrival)};
}

std::optional<nav_msgs::Odometry> MessageBuilder::odometry() {
  if (!navigation_ || !position_accepted_) return std::nullopt;
  nav_msgs::Odometry out;
  out.header = header(kOdometry, navigation_->stamp, parameters_.odom_frame);
  out.child_frame_id = parameters_.base_frame;
  fillPosition(out);
  const std::optional<Attitude> attitude = attitudeOf(navigation_->event);
  out.pose.pose.orientation = attitude ? attitude->orientation : identityOrientation();
  setVariances(out.pose.covariance, 3, attitude ? attitude->variances : allAxes(kUnknownVariance));
  setVariances(out.twist.covariance, 0, allAxes(kUnknownVariance));
  setVariances(out.twist.covariance, 3, allAxes(kUnknownVariance));
  const vehicle::Velocity* velocity = fresh(velocity_, navigation_->arrival);
  if (attitude && velocity != nullptr) fillTwist(out.twist, *velocity, attitude->orientation);
  return out;
}

void MessageBuilder::fillPosition(nav_msgs::Odometry& out) const {
  const vehicle::Navigation& navigation = navigation_->event;
  double up = 0.0;  // not of the vehicle: how far the ellipsoid has curved away below the plane
  plane_.Forward(navigation.position->latitude_deg, navigation.position->longitude_deg, 0.0,
                 out.pose.pose.position.x, out.pose.pose.position.y, up);
  out.pose.pose.position.z = 0.0 - navigation.depth_m.value_or(0.0);
  const bool depth_known = navigation.depth_m || dialect_ == protocol::Dialect::Kingfisher;
  const double horizontal = positionVariance(navigation);
  setVariances(out.pose.covariance, 0,
               {horizontal, horizontal,
                depth_known ? variance(parameters_.depth_stddev_m) : kUnknownVariance});
}

void MessageBuilder::fillTwist(geometry_msgs::TwistWithCovariance& out,
                               const vehicle::Velocity& velocity,
                               const geometry_msgs::Quaternion& orientation) const {
  if (velocity.east_m_s && velocity.north_m_s) {
    const geometry_msgs::Vector3 enu =
        enuVelocity(*velocity.east_m_s, *velocity.north_m_s, velocity.down_m_s.value_or(0.0));
    out.twist.linear = bodyFromEnu(enu, orientation);
    const double known = variance(parameters_.velocity_stddev_m_s);
    setVariances(out.covariance, 0, {known, known, varianceOf(velocity.down_m_s, known)});
  }
  const Axes rates{velocity.roll_rate_deg_s, velocity.pitch_rate_deg_s, velocity.yaw_rate_deg_s};
  out.twist.angular =
      bodyRates(rates.x.value_or(0.0), rates.y.value_or(0.0), rates.z.value_or(0.0));
  setVariances(out.covariance, 3, rates.variances(variance(parameters_.angular_rate_stddev_rad_s)));
}

std::optional<geometry_msgs::TransformStamped> MessageBuilder::transform(
    const nav_msgs::Odometry& odometry) {
  if (!guards_[kTransform].advances(odometry.header.stamp)) return std::nullopt;
  return toTransform(odometry);
}

std::optional<sensor_msgs::NavSatFix> MessageBuilder::navFix() {
  if (!navigation_ || !position_accepted_) return std::nullopt;
  const vehicle::Navigation& navigation = navigation_->event;
  sensor_msgs::NavSatFix out;
  out.header = header(kNavFix, navigation_->stamp, parameters_.base_frame);
  out.status.status = navigation.from_gps ? sensor_msgs::NavSatStatus::STATUS_FIX
                                          : sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  out.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  out.latitude = navigation.position->latitude_deg;
  out.longitude = navigation.position->longitude_deg;
  out.altitude = kNan;
  const double horizontal = positionVariance(navigation);
  setVariances(out.position_covariance, 0, {horizontal, horizontal, kUnknownVariance});
  out.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
  return out;
}

std::optional<geometry_msgs::PoseWithCovarianceStamped> MessageBuilder::depth() {
  if (!navigation_ || !navigation_->event.depth_m) return std::nullopt;
  geometry_msgs::PoseWithCovarianceStamped out;
  out.header = header(kDepth, navigation_->stamp, parameters_.odom_frame);
  out.pose.pose.position.z = 0.0 - *navigation_->event.depth_m;
  out.pose.pose.orientation = identityOrientation();
  setVariances(out.pose.covariance, 0, allAxes(kUnknownVariance));
  setVariances(out.pose.covariance, 3, allAxes(kUnknownVariance));
  setVariance(out.pose.covariance, 2, variance(parameters_.depth_stddev_m));
  return out;
}

std::optional<sensor_msgs::Range> MessageBuilder::altitude() {
  if (!navigation_ || navigation_->event.altitude_m.value_or(0.0) <= 0.0) return std::nullopt;
  sensor_msgs::Range out;
  out.header = header(kAltitude, navigation_->stamp, kAltimeterFrame);
  out.radiation_type = sensor_msgs::Range::ULTRASOUND;
  // The vehicles do not tell their altimeter's limits, so none is claimed.
  out.max_range = std::numeric_limits<float>::infinity();
  out.range = static_cast<float>(*navigation_->event.altitude_m);
  return out;
}

std::optional<geometry_msgs::TwistStamped> MessageBuilder::navVelocity() {
  if (!velocity_) return std::nullopt;
  const vehicle::Velocity& velocity = velocity_->event;
  if (!velocity.east_m_s || !velocity.north_m_s) return std::nullopt;
  geometry_msgs::TwistStamped out;
  out.header = header(kNavVelocity, velocity_->stamp, parameters_.odom_frame);
  out.twist.linear =
      enuVelocity(*velocity.east_m_s, *velocity.north_m_s, velocity.down_m_s.value_or(kNan));
  return out;
}

std::array<geometry_msgs::TransformStamped, 2> MessageBuilder::helperFrames(
    const vehicle::Now& now) const {
  return frdFrames(toRosTime(now.stamp), parameters_.base_frame, parameters_.odom_frame);
}

std_msgs::Header MessageBuilder::header(Topic topic, const ros::Time& stamp,
                                        const std::string& frame) {
  std_msgs::Header out;
  out.stamp = guards_[topic].clamp(stamp);
  held_back_ = std::max(held_back_, std::chrono::nanoseconds{(out.stamp - stamp).toNSec()});
  out.frame_id = frame;
  return out;
}

ros::Time MessageBuilder::vehicleStamp(std::optional<vehicle::TimeOfDay> measured_at,
                                       const vehicle::Now& arrival) const {
  return stamper_.stamp(measured_at, TimeScale::Vehicle, arrival);
}

double MessageBuilder::positionVariance(const vehicle::Navigation& navigation) const {
  const double given_m = navigation.from_gps ? parameters_.position_stddev_gps_m
                                             : parameters_.position_stddev_dead_reckoning_m;
  const bool coarse = dialect_ == protocol::Dialect::Sandshark;
  return variance(coarse ? std::max(given_m, kSandsharkLeastStddev_m) : given_m);
}

bool MessageBuilder::headingsAreTrue() const {
  const HeadingReference by_dialect =
      dialect_ == protocol::Dialect::Sandshark ? HeadingReference::Grid : HeadingReference::True;
  return parameters_.heading_reference.value_or(by_dialect) == HeadingReference::True;
}

std::optional<double> MessageBuilder::northOffset_deg() const {
  if (headingsAreTrue()) return 0.0;
  if (!filter_.last()) return std::nullopt;
  return meridianConvergence_deg(*filter_.last());
}

std::optional<double> MessageBuilder::trueHeading_deg(const vehicle::Navigation& navigation) const {
  if (headingsAreTrue() || !navigation.heading_deg) return navigation.heading_deg;
  const std::optional<vehicle::Position>& place = filter_.last() ? filter_.last() : datum_;
  if (!place) return std::nullopt;
  return *navigation.heading_deg + meridianConvergence_deg(*place);
}

std::optional<MessageBuilder::Attitude> MessageBuilder::attitudeOf(
    const vehicle::Navigation& navigation) const {
  const std::optional<double> heading_deg = trueHeading_deg(navigation);
  if (!heading_deg) return std::nullopt;
  return attitudeOf(navigation.roll_deg, navigation.pitch_deg, *heading_deg);
}

MessageBuilder::Attitude MessageBuilder::attitudeOf(const std::optional<double>& roll_deg,
                                                    const std::optional<double>& pitch_deg,
                                                    double heading_deg) const {
  const double known = variance(parameters_.orientation_stddev_rad);
  return {toOrientation(roll_deg.value_or(0.0), pitch_deg.value_or(0.0), heading_deg),
          {varianceOf(roll_deg, known), varianceOf(pitch_deg, known), known}};
}

}  // namespace frontseat_driver::ros_layer
