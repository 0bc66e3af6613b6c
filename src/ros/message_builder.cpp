#include "message_builder.h"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "convert.h"

namespace frontseat_driver::ros_layer {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kSandsharkLeapSeconds = 0;
constexpr int kKingfisherLeapSeconds = 18;

constexpr const char* kImuFrame = "imu_link";
constexpr const char* kAltimeterFrame = "altimeter_link";
constexpr const char* kGpsFrame = "gps_link";
constexpr const char* kNoFrame = "";

/// A covariance matrix in a message, row by row, with only its diagonal set.
template <class Matrix>
void setVariance(Matrix& covariance, std::size_t axis, double value) {
  constexpr std::size_t kSize = Matrix::static_size == 36 ? 6 : 3;
  covariance[axis * (kSize + 1)] = value;
}

template <class Matrix>
void setVariances(Matrix& covariance, std::size_t first_axis, const std::array<double, 3>& values) {
  for (std::size_t i = 0; i < 3; ++i) setVariance(covariance, first_axis + i, values[i]);
}

std::array<double, 3> allAxes(double value) { return {value, value, value}; }

double varianceOf(const std::optional<double>& measured, double known) {
  return measured ? known : kUnknownVariance;
}

/// Three axes of one sensor, blank ones as 0 with unknown variance.
struct Axes {
  std::optional<double> x, y, z;

  bool blank() const { return !x && !y && !z; }
  std::array<double, 3> variances(double known) const {
    return {varianceOf(x, known), varianceOf(y, known), varianceOf(z, known)};
  }
};

float toFloat(const std::optional<double>& value) {
  return static_cast<float>(value.value_or(kNan));
}

std::string withId(const std::string& name, const std::optional<std::int64_t>& id) {
  return id ? name + '_' + std::to_string(*id) : name;
}

// Older sensor_msgs know no temperature.
template <class Message>
auto setTemperature(Message& message, float temperature_c, int)
    -> decltype(message.temperature, void()) {
  message.temperature = temperature_c;
}
template <class Message>
void setTemperature(Message&, float, long) {}

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

geometry_msgs::TransformStamped rotation(const ros::Time& stamp, const std::string& parent,
                                         const std::string& child, double x, double y) {
  geometry_msgs::TransformStamped out;
  out.header.stamp = stamp;
  out.header.frame_id = parent;
  out.child_frame_id = child;
  out.transform.rotation.x = x;
  out.transform.rotation.y = y;
  return out;
}

}  // namespace

MessageBuilder::MessageBuilder(const Parameters& parameters)
    : parameters_(parameters), stamper_(parameters.stamp), filter_(parameters.max_jump_m_s) {
  stamper_.setLeapSeconds(parameters.leap_seconds.value_or(std::chrono::seconds(0)));
  if (parameters.session.dialect) setDialect(*parameters.session.dialect);
  if (parameters.datum) setDatum(*parameters.datum);
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
}

void MessageBuilder::take(const vehicle::Navigation& navigation, const vehicle::Now& arrival) {
  navigation_ = {navigation, arrival, vehicleStamp(navigation.measured_at, arrival)};
  const std::optional<vehicle::Position>& position = navigation.position;
  position_accepted_ = position && isUsable(*position) && filter_.accept(*position, arrival.steady);
  if (position_accepted_ && !datum_) setDatum(*position);
}

void MessageBuilder::take(const vehicle::Velocity& velocity, const vehicle::Now& arrival) {
  velocity_ = {velocity, arrival, vehicleStamp(velocity.measured_at, arrival)};
}

void MessageBuilder::take(const vehicle::RawImu& imu, const vehicle::Now& arrival) {
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
  geometry_msgs::TransformStamped out;
  out.header = odometry.header;
  out.child_frame_id = odometry.child_frame_id;
  out.transform.translation.x = odometry.pose.pose.position.x;
  out.transform.translation.y = odometry.pose.pose.position.y;
  out.transform.translation.z = odometry.pose.pose.position.z;
  out.transform.rotation = odometry.pose.pose.orientation;
  return out;
}

std::optional<sensor_msgs::NavSatFix> MessageBuilder::navFix() {
  if (!navigation_ || !position_accepted_) return std::nullopt;
  const vehicle::Navigation& navigation = navigation_->event;
  sensor_msgs::NavSatFix out;
  out.header = header(kNavFix, navigation_->stamp, parameters_.base_frame);
  out.status.status = navSatStatus(navigation.from_gps ? 1 : 0);
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
  out.range = toFloat(navigation_->event.altitude_m);
  return out;
}

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

sensor_msgs::BatteryState MessageBuilder::battery(const vehicle::Battery& battery,
                                                  const vehicle::Now& arrival) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  sensor_msgs::BatteryState out;
  out.header = header(kBattery, vehicleStamp(battery.measured_at, arrival), parameters_.base_frame);
  out.voltage = toFloat(battery.stack_v);
  out.cell_voltage = {toFloat(battery.lowest_cell_v), toFloat(battery.highest_cell_v)};
  setTemperature(out, toFloat(battery.temperature_c), 0);
  out.current = out.charge = out.capacity = out.design_capacity = out.percentage = kUnknown;
  out.present = true;
  out.location = withId("battery", battery.id);
  return out;
}

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

MissionStatus MessageBuilder::missionStatus(const vehicle::MissionStatus& status,
                                            const vehicle::Now& arrival) {
  using State = vehicle::MissionStatus::State;
  static_assert(static_cast<int>(State::Unknown) == MissionStatus::UNKNOWN &&
                    static_cast<int>(State::Running) == MissionStatus::RUNNING &&
                    static_cast<int>(State::Stopped) == MissionStatus::STOPPED,
                "the message counts states as the event does");
  MissionStatus out;
  out.header = header(kMissionStatus, vehicleStamp(status.sent_at, arrival), kNoFrame);
  out.state = static_cast<std::uint8_t>(status.state);
  out.status = std::string(status.status);
  out.dive_file = std::string(status.dive_file);
  out.log_directory = std::string(status.log_directory);
  out.details = std::string(status.details);
  return out;
}

ControlStatus MessageBuilder::controlStatus(const vehicle::Control& control,
                                            const vehicle::Now& arrival) {
  static_assert(static_cast<int>(vehicle::Grant::Unknown) == ControlStatus::UNKNOWN &&
                    static_cast<int>(vehicle::Grant::Denied) == ControlStatus::DENIED &&
                    static_cast<int>(vehicle::Grant::Granted) == ControlStatus::GRANTED,
                "the message counts grants as the event does");
  ControlStatus out;
  out.header = header(kControlStatus, toRosTime(arrival.stamp), kNoFrame);
  out.grant = static_cast<std::uint8_t>(control.grant);
  out.commands_enabled = control.commands_enabled;
  out.commanding = control.commanding;
  out.reason = std::string(control.reason);
  return out;
}

InterfaceVersion MessageBuilder::interfaceVersion(const vehicle::InterfaceVersion& version,
                                                  const vehicle::Now& arrival) {
  InterfaceVersion out;
  out.header = header(kInterfaceVersion, vehicleStamp(version.sent_at, arrival), kNoFrame);
  out.vehicle = std::string(version.version);
  out.payload = parameters_.session.interface_version;
  return out;
}

ShutdownNotice MessageBuilder::shutdownNotice(const vehicle::Shutdown& shutdown,
                                              const vehicle::Now& arrival) {
  ShutdownNotice out;
  out.header = header(kShutdownNotice, vehicleStamp(shutdown.sent_at, arrival), kNoFrame);
  out.earliest_power_off = toRosTime(toUtcTime(out.header.stamp) + shutdown.notice);
  return out;
}

CommandAck MessageBuilder::commandAck(const vehicle::Acknowledgement& ack,
                                      const vehicle::Now& arrival) {
  using std::chrono::duration;
  CommandAck out;
  out.header = header(kCommandAck, vehicleStamp(ack.sent_at, arrival), kNoFrame);
  out.command = (ack.command.size() == 3 ? "BP" : "") + std::string(ack.command);
  if (ack.command_time) out.command_stamp = stamper_.ownTime(*ack.command_time, arrival);
  out.behavior_id = std::string(ack.behavior_id);
  out.status = static_cast<std::uint8_t>(ack.status);
  out.message = std::string(ack.message);
  out.round_trip = ack.round_trip ? duration<double>(*ack.round_trip).count() : kNan;
  return out;
}

std::array<geometry_msgs::TransformStamped, 2> MessageBuilder::helperFrames(
    const vehicle::Now& now) const {
  constexpr double kHalfRoot = 0.70710678118654752440;
  const ros::Time stamp = toRosTime(now.stamp);
  const std::string& base = parameters_.base_frame;
  const std::string& odom = parameters_.odom_frame;
  // Half a turn about the bow, and half a turn about north-east.
  return {rotation(stamp, base, base + "_frd", 1.0, 0.0),
          rotation(stamp, odom, odom + "_ned", kHalfRoot, kHalfRoot)};
}

std_msgs::Header MessageBuilder::header(Topic topic, const ros::Time& stamp,
                                        const std::string& frame) {
  std_msgs::Header out;
  out.stamp = guards_[topic].clamp(stamp);
  out.frame_id = frame;
  return out;
}

ros::Time MessageBuilder::vehicleStamp(std::optional<vehicle::TimeOfDay> measured_at,
                                       const vehicle::Now& arrival) const {
  return stamper_.stamp(measured_at, TimeScale::Vehicle, arrival);
}

ros::Time MessageBuilder::gpsStamp(std::optional<vehicle::TimeOfDay> measured_at,
                                   const vehicle::Now& arrival) const {
  return stamper_.stamp(measured_at, TimeScale::Utc, arrival);
}

template <class Event>
const Event* MessageBuilder::fresh(const std::optional<Latest<Event>>& latest,
                                   const vehicle::Now& now) const {
  if (!latest || now.steady - latest->arrival.steady > parameters_.max_data_age) return nullptr;
  return &latest->event;
}

double MessageBuilder::positionVariance(const vehicle::Navigation& navigation) const {
  return variance(navigation.from_gps ? parameters_.position_stddev_gps_m
                                      : parameters_.position_stddev_dead_reckoning_m);
}

std::optional<double> MessageBuilder::trueHeading_deg(const vehicle::Navigation& navigation) const {
  const HeadingReference by_dialect =
      dialect_ == protocol::Dialect::Sandshark ? HeadingReference::Grid : HeadingReference::True;
  const bool is_true = parameters_.heading_reference.value_or(by_dialect) == HeadingReference::True;
  if (is_true || !navigation.heading_deg) return navigation.heading_deg;
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
