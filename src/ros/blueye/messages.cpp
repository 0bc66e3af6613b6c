#include "blueye/messages.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>

#include "check.h"
#include "convert.h"
#include "covariance.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr double kTeslaPerMicrotesla = 1e-6;

double radiansOf(double angle_deg) { return angle_deg * M_PI / 180.0; }

/// Without -0.0.
double negated(double value) { return 0.0 - value; }

/// 0 for what is no duration: ros::Duration throws for it.
ros::Duration secondsOf(double seconds) {
  ros::Duration out;
  if (!std::isfinite(seconds)) return out;
  return out.fromSec(std::clamp(seconds, -2e9, 2e9));
}

/// A camera that is not recorded has -1 there, which the vendor's library alone says.
ros::Duration recordedFor(std::int32_t seconds) { return secondsOf(std::max(0, seconds)); }

ros::Time timeOf(const google::protobuf::Timestamp& time) {
  // Any number may come; nanoseconds of it must fit into 64 bits, and ros::Time ends in 2106.
  constexpr std::int64_t kEnd_s = 1LL << 32;
  const std::chrono::seconds whole{std::clamp<std::int64_t>(time.seconds(), 0, kEnd_s)};
  return toRosTime(whole + std::chrono::nanoseconds{time.nanos()});
}

bool isFinite(const pb::Vector3& vector) {
  return std::isfinite(vector.x()) && std::isfinite(vector.y()) && std::isfinite(vector.z());
}

bool isFinite(const geometry_msgs::Vector3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

void setPosition(double& latitude, double& longitude, bool known,
                 const pb::LatLongPosition& position) {
  const bool usable = known && isUsable(position);
  latitude = usable ? position.latitude() : kNan;
  longitude = usable ? position.longitude() : kNan;
}

std::optional<sensor_msgs::Temperature> temperature(double celsius, const std::string& frame,
                                                    const Context& context) {
  if (!std::isfinite(celsius)) return std::nullopt;
  sensor_msgs::Temperature out;
  out.header = context.header(frame);
  out.temperature = celsius;
  return out;
}

std::optional<std_msgs::Float64> number(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  std_msgs::Float64 out;
  out.data = value;
  return out;
}

std::optional<sensor_msgs::JointState> joint(const std::string& name, double position_rad,
                                             const Context& context) {
  if (!std::isfinite(position_rad)) return std::nullopt;
  sensor_msgs::JointState out;
  out.header = context.header("");
  out.name = {name};
  out.position = {position_rad};
  return out;
}

std::optional<sensor_msgs::Range> range(float distance_m, bool valid, const char* frame,
                                        float most_m, const Context& context) {
  if (!valid || !std::isfinite(distance_m)) return std::nullopt;
  sensor_msgs::Range out;
  out.header = context.header(frame);
  out.radiation_type = sensor_msgs::Range::ULTRASOUND;
  out.field_of_view = 0.5F;
  out.min_range = 0.0F;
  out.max_range = most_m;
  out.range = distance_m;
  return out;
}

sensor_msgs::BatteryState emptyBattery(int number, const Context& context) {
  sensor_msgs::BatteryState out;
  out.header = context.header(context.base_frame);
  out.voltage = out.current = out.charge = out.capacity = out.design_capacity = out.percentage =
      kNanF;
  out.power_supply_technology = sensor_msgs::BatteryState::POWER_SUPPLY_TECHNOLOGY_LION;
  out.present = true;
  out.location = "battery_" + std::to_string(number);
  return out;
}

// Older sensor_msgs know no temperature.
template <class Message>
auto setTemperature(Message& message, float celsius, int) -> decltype(message.temperature, void()) {
  message.temperature = celsius;
}
template <class Message>
void setTemperature(Message&, float, long) {}
template <class Message>
auto setCellTemperatures(Message& message, const std::array<float, 4>& celsius, int)
    -> decltype(message.cell_temperature, void()) {
  message.cell_temperature.assign(celsius.begin(), celsius.end());
}
template <class Message>
void setCellTemperatures(Message&, const std::array<float, 4>&, long) {}

sensor_msgs::NavSatFix fix(const pb::LatLongPosition& position, bool known, double altitude_m,
                           const std::string& frame, const Context& context) {
  sensor_msgs::NavSatFix out;
  out.header = context.header(frame);
  const bool usable = known && isUsable(position);
  out.status.status =
      usable ? sensor_msgs::NavSatStatus::STATUS_FIX : sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  out.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  setPosition(out.latitude, out.longitude, known, position);
  out.altitude = altitude_m;
  out.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  return out;
}

}  // namespace

std_msgs::Header Context::header(const std::string& frame) const {
  std_msgs::Header out;
  out.stamp = stamp;
  out.frame_id = frame;
  return out;
}

double wrap_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

double yawOf(double heading_rad) { return wrap_rad(M_PI_2 - heading_rad); }

double headingOf_deg(double yaw_rad) { return wrapHeading_deg(90.0 - yaw_rad * 180.0 / M_PI); }

std::string shortName(const std::string& name, const std::string& prefix) {
  return name.compare(0, prefix.size(), prefix) == 0 ? name.substr(prefix.size()) : name;
}

std::string printable(const std::string& bytes) {
  const bool text = std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return std::isprint(static_cast<unsigned char>(c)) != 0;
  });
  if (text) return bytes;
  std::string hex;
  for (const char c : bytes) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned char>(c));
    hex += digits;
  }
  return hex;
}

bool isPositive(double value) { return std::isfinite(value) && value > 0.0; }

double varianceOfRadius95(double radius_m) {
  constexpr double kRadius_sigma = 2.4477;  // sqrt(-2 ln 0.05)
  return isPositive(radius_m) ? variance(radius_m / kRadius_sigma) : kUnknownVariance;
}

bool isUsable(const pb::LatLongPosition& position) {
  return ros_layer::isUsable({position.latitude(), position.longitude()});
}

geometry_msgs::Quaternion orientationOf(const pb::Attitude& attitude, const Conventions& how) {
  return toOrientation(attitude.roll(), attitude.pitch(),
                       attitude.yaw() + how.add_declination_rad * 180.0 / M_PI);
}

std::optional<geometry_msgs::Vector3> velocityOf(const pb::DvlVelocity& dvl,
                                                 const Conventions& how) {
  const auto& beams = dvl.transducers();
  const bool valid = std::any_of(beams.begin(), beams.end(),
                                 [](const pb::DvlTransducer& beam) { return beam.beam_valid(); });
  if (!valid || !dvl.has_velocity() || !isFinite(dvl.velocity())) return std::nullopt;
  const double y = dvl.velocity().y();
  return fluFromFrd(dvl.velocity().x(), how.dvl_y_right ? y : negated(y), dvl.velocity().z());
}

void fill(sensor_msgs::Imu& out, const pb::Imu& imu, const std::optional<double>& factor,
          const Context& context) {
  out.angular_velocity_covariance[0] = out.linear_acceleration_covariance[0] = kNotMeasured;
  if (imu.has_gyroscope() && isFinite(imu.gyroscope())) {
    out.angular_velocity =
        fluFromFrd(imu.gyroscope().x(), imu.gyroscope().y(), imu.gyroscope().z());
    setVariances(out.angular_velocity_covariance, 0,
                 allAxes(variance(context.deviations.angular_rate_rad_s)));
  }
  const double scale = kStandardGravity_m_s2 * factor.value_or(kNan);
  const pb::Vector3& sensed = imu.accelerometer();
  const auto force = fluFromFrd(scale * sensed.x(), scale * sensed.y(), scale * sensed.z());
  if (imu.has_accelerometer() && isFinite(force)) {  // the product may not fit into a number
    out.linear_acceleration = force;
    setVariances(out.linear_acceleration_covariance, 0,
                 allAxes(variance(context.deviations.acceleration_m_s2)));
  }
}

// --- Navigation ---

std::optional<geometry_msgs::PoseWithCovarianceStamped> toDepth(const pb::DepthTel& told,
                                                                const Context& context) {
  if (!told.has_depth() || !std::isfinite(told.depth().value())) return std::nullopt;
  geometry_msgs::PoseWithCovarianceStamped out;
  out.header = context.header(context.odom_frame);
  out.pose.pose.position.z = negated(told.depth().value());
  out.pose.pose.orientation = identityOrientation();
  setVariances(out.pose.covariance, 0,
               {kUnknownVariance, kUnknownVariance, variance(context.deviations.depth_m)});
  setVariances(out.pose.covariance, 3, allAxes(kUnknownVariance));
  return out;
}

std::optional<sensor_msgs::FluidPressure> toPressure(const pb::DepthTel& told,
                                                     const Context& context) {
  if (!told.has_depth() || !std::isfinite(told.depth().value())) return std::nullopt;
  const double weight = context.conventions.water_density_kg_m3 * kStandardGravity_m_s2;
  sensor_msgs::FluidPressure out;
  out.header = context.header(context.base_frame);
  out.fluid_pressure = told.depth().value() * weight;
  out.variance = variance(context.deviations.depth_m * weight);
  return out;
}

std::optional<sensor_msgs::Range> toAltitude(const pb::AltitudeTel& told, const Context& context) {
  return range(told.altitude().value(), told.altitude().is_valid(), "altimeter_link", 100.0F,
               context);
}

std::optional<sensor_msgs::Range> toForwardDistance(const pb::ForwardDistanceTel& told,
                                                    const Context& context) {
  return range(told.forward_distance().value(), told.forward_distance().is_valid(), "pinger_link",
               100.0F, context);
}

std::optional<BlueyePositionEstimate> toEstimate(const pb::PositionEstimateTel& told,
                                                 const Context& context) {
  if (!told.has_position_estimate()) return std::nullopt;
  const pb::PositionEstimate& in = told.position_estimate();
  BlueyePositionEstimate out;
  out.header = context.header(context.odom_frame);
  out.valid = in.is_valid();
  out.x = in.easting();
  out.y = in.northing();
  out.yaw = yawOf(in.heading());
  out.surge_rate = in.surge_rate();
  out.sway_rate = negated(in.sway_rate());
  out.yaw_rate = negated(in.yaw_rate());
  out.ocean_current = in.ocean_current();
  out.odometer = in.odometer();
  out.speed_over_ground = in.speed_over_ground();
  out.course_over_ground = yawOf(radiansOf(in.course_over_ground()));
  out.since_reset = ros::Duration(in.time_since_reset_sec(), 0);
  out.accuracy = isPositive(in.accuracy()) ? in.accuracy() : kNan;
  setPosition(out.latitude, out.longitude, in.has_global_position(), in.global_position());
  for (const pb::NavigationSensorStatus& sensor : in.navigation_sensors()) {
    BlueyeNavigationSensor& one = out.sensors.emplace_back();
    one.name = shortName(pb::NavigationSensorID_Name(sensor.sensor_id()), "NAVIGATION_SENSOR_ID_");
    one.valid = sensor.is_valid();
    one.x = sensor.easting();
    one.y = sensor.northing();
    one.yaw = yawOf(sensor.heading());
    one.figure_of_merit = sensor.fom();
    one.standard_deviation = sensor.std();
    setPosition(one.latitude, one.longitude, sensor.has_global_position(),
                sensor.global_position());
  }
  return out;
}

std::optional<sensor_msgs::NavSatFix> toNavFix(const pb::PositionEstimateTel& told,
                                               const std::optional<double>& depth_m,
                                               const Context& context) {
  if (!told.has_position_estimate()) return std::nullopt;
  const pb::PositionEstimate& in = told.position_estimate();
  const bool known = in.is_valid() && in.has_global_position();
  sensor_msgs::NavSatFix out = fix(in.global_position(), known, depth_m ? negated(*depth_m) : kNan,
                                   context.base_frame, context);
  if (out.status.status == sensor_msgs::NavSatStatus::STATUS_NO_FIX) return out;
  const double horizontal = varianceOfRadius95(in.accuracy());
  setVariances(
      out.position_covariance, 0,
      {horizontal, horizontal, depth_m ? variance(context.deviations.depth_m) : kUnknownVariance});
  out.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_APPROXIMATED;
  return out;
}

std::optional<geometry_msgs::TwistWithCovarianceStamped> toDvlTwist(const pb::DvlVelocityTel& told,
                                                                    const Context& context) {
  const auto velocity = velocityOf(told.dvl_velocity(), context.conventions);
  if (!velocity) return std::nullopt;
  geometry_msgs::TwistWithCovarianceStamped out;
  out.header = context.header("dvl_link");
  out.twist.twist.linear = *velocity;
  const double fom_m_s = told.dvl_velocity().fom();
  const double known =
      isPositive(fom_m_s) ? variance(fom_m_s) : variance(context.deviations.velocity_m_s);
  setVariances(out.twist.covariance, 0, allAxes(known));
  setVariances(out.twist.covariance, 3, allAxes(kUnknownVariance));
  return out;
}

std::optional<Dvl> toDvl(const pb::DvlVelocityTel& told, const Context& context) {
  if (!told.has_dvl_velocity()) return std::nullopt;
  const pb::DvlVelocity& in = told.dvl_velocity();
  Dvl out;
  out.header = context.header("dvl_link");
  out.sensor = shortName(pb::NavigationSensorID_Name(in.sensor_id()), "NAVIGATION_SENSOR_ID_");
  out.water_tracking = in.is_water_tracking();
  out.velocity.x = out.velocity.y = out.velocity.z = kNan;
  if (const auto velocity = velocityOf(in, context.conventions)) out.velocity = *velocity;
  out.standard_deviation = in.fom();
  out.interval = secondsOf(in.delta_time() / 1000.0);
  out.status = in.status();
  for (const pb::DvlTransducer& transducer : in.transducers()) {
    DvlBeam& beam = out.beams.emplace_back();
    beam.id = transducer.id();
    beam.valid = transducer.beam_valid();
    beam.velocity = transducer.velocity();
    beam.distance = transducer.distance();
    beam.rssi = transducer.rssi();
    beam.nsd = transducer.nsd();
  }
  return out;
}

std::optional<sensor_msgs::MagneticField> toMagneticField(const pb::Imu& imu,
                                                          const Context& context) {
  if (!imu.has_magnetometer() || !isFinite(imu.magnetometer())) return std::nullopt;
  const pb::Vector3& field = imu.magnetometer();
  sensor_msgs::MagneticField out;
  out.header = context.header("imu_link");
  out.magnetic_field = fluFromFrd(kTeslaPerMicrotesla * field.x(), kTeslaPerMicrotesla * field.y(),
                                  kTeslaPerMicrotesla * field.z());
  return out;  // covariance 0: not known
}

std::optional<sensor_msgs::Temperature> toImuTemperature(const pb::CalibratedImuTel& told,
                                                         const Context& context) {
  if (!told.has_imu()) return std::nullopt;
  return temperature(told.imu().temperature(), "imu_link", context);
}

// --- Power ---

std::optional<sensor_msgs::BatteryState> toBattery(const pb::Battery& in, int number,
                                                   const Context& context) {
  if (!(in.voltage() > 0.0F)) return std::nullopt;  // no data
  sensor_msgs::BatteryState out = emptyBattery(number, context);
  out.voltage = in.voltage();
  out.percentage = in.level();
  setTemperature(out, in.temperature(), 0);
  return out;
}

std::optional<sensor_msgs::BatteryState> toBattery(const pb::BatteryBQ40Z50& in, int number,
                                                   const Context& context) {
  using State = sensor_msgs::BatteryState;
  if (!(in.voltage().total() > 0.0F)) return std::nullopt;
  State out = emptyBattery(number, context);
  const pb::BatteryBQ40Z50::Voltage& volts = in.voltage();
  const pb::BatteryBQ40Z50::Temperature& celsius = in.temperature();
  out.voltage = volts.total();
  out.cell_voltage = {volts.cell_1(), volts.cell_2(), volts.cell_3(), volts.cell_4()};
  setTemperature(out, celsius.average(), 0);
  setCellTemperatures(out, {celsius.cell_1(), celsius.cell_2(), celsius.cell_3(), celsius.cell_4()},
                      0);
  out.current = context.conventions.battery_discharge_negative ? in.current() : 0.0F - in.current();
  out.charge = in.remaining_capacity();
  out.capacity = in.full_charge_capacity();
  out.design_capacity = in.design_capacity();
  out.percentage = in.relative_state_of_charge();
  out.power_supply_status = in.status().fully_charged() ? State::POWER_SUPPLY_STATUS_FULL
                            : out.current < 0.0F        ? State::POWER_SUPPLY_STATUS_DISCHARGING
                            : out.current > 0.0F        ? State::POWER_SUPPLY_STATUS_CHARGING
                                                        : State::POWER_SUPPLY_STATUS_NOT_CHARGING;
  out.power_supply_health = in.status().over_temperature_alarm()
                                ? State::POWER_SUPPLY_HEALTH_OVERHEAT
                                : State::POWER_SUPPLY_HEALTH_GOOD;
  out.serial_number = std::to_string(in.serial_number());
  return out;
}

BlueyeBatteryDetails toBatteryDetails(const pb::BatteryBQ40Z50& in, int number,
                                      const Context& context) {
  BlueyeBatteryDetails out;
  out.header = context.header("");
  out.location = "battery_" + std::to_string(number);
  const bool as_it_is = context.conventions.battery_discharge_negative;
  out.average_current = as_it_is ? in.average_current() : negated(in.average_current());
  out.absolute_state_of_charge = in.absolute_state_of_charge();
  out.calculated_state_of_charge = in.calculated_state_of_charge();
  out.runtime_to_empty = secondsOf(in.runtime_to_empty());
  out.time_to_empty = secondsOf(in.average_time_to_empty());
  out.time_to_full = secondsOf(in.average_time_to_full());
  out.charging_current = in.charging_current();
  out.charging_voltage = in.charging_voltage();
  out.cycles = in.cycle_count();
  if (in.has_manufacture_date()) out.manufactured = timeOf(in.manufacture_date());
  out.manufacturer = in.manufacturer_name();
  out.device = in.device_name();
  out.chemistry = in.device_chemistry();
  const pb::BatteryBQ40Z50::BatteryStatus& status = in.status();
  const auto alarm = [&out](bool set, const char* name) {
    if (set) out.alarms.emplace_back(name);
  };
  alarm(status.overcharged_alarm(), "overcharged");
  alarm(status.terminate_charge_alarm(), "terminate_charge");
  alarm(status.over_temperature_alarm(), "over_temperature");
  alarm(status.terminate_discharge_alarm(), "terminate_discharge");
  alarm(status.remaining_capacity_alarm(), "remaining_capacity");
  alarm(status.remaining_time_alarm(), "remaining_time");
  alarm(status.fully_discharged(), "fully_discharged");
  return out;
}

std::optional<sensor_msgs::BatteryState> toSurfaceUnit(const pb::SurfaceUnitTel& told,
                                                       const Context& context) {
  using State = sensor_msgs::BatteryState;
  if (!told.has_battery_info()) return std::nullopt;
  State out = emptyBattery(0, context);
  out.header.frame_id.clear();
  out.location = "surface_unit";
  out.percentage = told.battery_info().level();
  const auto status = told.battery_info().status();
  out.power_supply_status = status == pb::SurfaceUnitBatteryInfo::CHARGE_STATUS_CHARGE
                                ? State::POWER_SUPPLY_STATUS_CHARGING
                            : status == pb::SurfaceUnitBatteryInfo::CHARGE_STATUS_DISCHARGE
                                ? State::POWER_SUPPLY_STATUS_DISCHARGING
                                : State::POWER_SUPPLY_STATUS_UNKNOWN;
  return out;
}

// --- The drone and its control ---

std::optional<BlueyeControlMode> toControlMode(const pb::ControlModeTel& told,
                                               const Context& context) {
  if (!told.has_state()) return std::nullopt;
  const pb::ControlMode& in = told.state();
  BlueyeControlMode out;
  out.header = context.header("");
  out.auto_depth = in.auto_depth();
  out.auto_heading = in.auto_heading();
  out.auto_altitude = in.auto_altitude();
  out.station_keeping = in.station_keeping();
  out.weather_vaning = in.weather_vaning();
  out.auto_pilot_surge_yaw = in.auto_pilot_surge_yaw();
  out.auto_pilot_heave = in.auto_pilot_heave();
  return out;
}

namespace {

void addPort(BlueyeInfo& out, std::uint8_t number, const pb::GuestPortConnectorInfo& port) {
  BlueyeGuestPort empty;
  empty.port = number;
  empty.depth_rating = kNan;
  if (port.has_device_list()) {
    for (const pb::GuestPortDevice& device : port.device_list().devices()) {
      BlueyeGuestPort one = empty;
      one.device_id = static_cast<std::uint32_t>(device.device_id());
      one.device =
          shortName(pb::GuestPortDeviceID_Name(device.device_id()), "GUEST_PORT_DEVICE_ID_");
      one.manufacturer = device.manufacturer();
      one.name = device.name();
      one.serial_number = device.serial_number();
      one.depth_rating = device.depth_rating();
      one.required_version = device.required_blunux_version();
      one.detached = device.detach_status() == pb::GUEST_PORT_DETACH_STATUS_DETACHED;
      out.guest_ports.push_back(one);
    }
    return;
  }
  empty.error = shortName(pb::GuestPortError_Name(port.error()), "GUEST_PORT_ERROR_");
  out.guest_ports.push_back(empty);
}

}  // namespace

std::optional<BlueyeInfo> toInfo(const pb::DroneInfoTel& told, const Context& context) {
  if (!told.has_drone_info()) return std::nullopt;
  const pb::DroneInfo& in = told.drone_info();
  BlueyeInfo out;
  out.header = context.header("");
  out.blunux_version = in.blunux_version();
  out.serial_number = printable(in.serial_number());
  out.hardware_id = printable(in.hardware_id());
  out.model = shortName(pb::Model_Name(in.model()), "MODEL_");
  out.depth_sensor =
      shortName(pb::PressureSensorType_Name(in.depth_sensor()), "PRESSURE_SENSOR_TYPE_");
  out.motherboard_serial = printable(in.mb_serial());
  out.backbone_serial = printable(in.bb_serial());
  out.drone_stack_serial = printable(in.ds_serial());
  out.motherboard_uid = printable(in.mb_uid());
  out.backbone_uid = printable(in.bb_uid());
  const pb::GuestPortInfo& ports = in.gp();
  if (ports.has_gp1()) addPort(out, 1, ports.gp1());
  if (ports.has_gp2()) addPort(out, 2, ports.gp2());
  if (ports.has_gp3()) addPort(out, 3, ports.gp3());
  if (ports.has_gp4()) addPort(out, 4, ports.gp4());
  if (ports.has_gp5()) addPort(out, 5, ports.gp5());
  if (ports.has_gp6()) addPort(out, 6, ports.gp6());
  return out;
}

BlueyeNotification toNotification(const pb::Notification& in, const Context& context) {
  BlueyeNotification out;
  out.header = context.header("");
  if (in.has_timestamp()) out.raised = timeOf(in.timestamp());
  out.level = static_cast<std::uint8_t>(in.level());
  out.type = static_cast<std::uint32_t>(in.type());
  out.name = shortName(pb::NotificationType_Name(in.type()), "NOTIFICATION_TYPE_");
  return out;
}

std::optional<sensor_msgs::TimeReference> toTimeReference(const pb::DroneTimeTel& told,
                                                          const Context& context) {
  if (!told.real_time_clock().has_unix_timestamp()) return std::nullopt;
  sensor_msgs::TimeReference out;
  out.header = context.header("");
  out.time_ref = timeOf(told.real_time_clock().unix_timestamp());
  out.source = "blueye";
  return out;
}

std::optional<BlueyeReference> toReference(const pb::ReferenceTel& told, const Context& context) {
  if (!told.has_reference()) return std::nullopt;
  const pb::Reference& in = told.reference();
  BlueyeReference out;
  out.header = context.header("");
  out.surge = in.surge();
  out.sway = negated(in.sway());
  out.heave = negated(in.heave());
  out.yaw = context.conventions.yaw_clockwise ? negated(in.yaw()) : in.yaw();
  out.z = negated(in.depth());
  out.heading = negated(radiansOf(in.heading()));
  out.altitude = in.altitude();
  return out;
}

std::optional<BlueyeControllerHealth> toHealth(const pb::ControllerHealthTel& told,
                                               const Context& context) {
  if (!told.has_controller_health()) return std::nullopt;
  const pb::ControllerHealth& in = told.controller_health();
  BlueyeControllerHealth out;
  out.header = context.header("");
  out.z_error = negated(in.depth_error());
  out.depth_load = in.depth_health();
  out.heading_error = negated(radiansOf(in.heading_error()));
  out.heading_load = in.heading_health();
  return out;
}

std::optional<geometry_msgs::WrenchStamped> toWrench(const pb::ControlForceTel& told,
                                                     const Context& context) {
  if (!told.has_control_force()) return std::nullopt;
  const pb::ControlForce& in = told.control_force();
  geometry_msgs::WrenchStamped out;
  out.header = context.header(context.base_frame);
  out.wrench.force = fluFromFrd(in.surge(), in.sway(), in.heave());
  out.wrench.torque.z = negated(in.yaw());
  if (!isFinite(out.wrench.force) || !isFinite(out.wrench.torque)) return std::nullopt;
  return out;
}

std::optional<MagneticDeclination> toDeclination(const pb::MagneticDeclinationTel& told,
                                                 const Context& context) {
  if (!told.has_magnetic_declination()) return std::nullopt;
  const pb::MagneticDeclination& in = told.magnetic_declination();
  MagneticDeclination out;
  out.header = context.header("");
  out.applied = in.location_source() != pb::LOCATION_SOURCE_UNSPECIFIED;
  out.declination = radiansOf(in.declination());
  setPosition(out.latitude, out.longitude, in.has_location(), in.location());
  return out;
}

// --- Missions ---

std::optional<BlueyeMissionStatus> toMission(const pb::MissionStatusTel& told,
                                             const Context& context) {
  if (!told.has_mission_status()) return std::nullopt;
  const pb::MissionStatus& in = told.mission_status();
  BlueyeMissionStatus out;
  out.header = context.header("");
  out.id = in.id();
  out.state = static_cast<std::uint8_t>(in.state());
  out.status = shortName(pb::MissionState_Name(in.state()), "MISSION_STATE_");
  std::transform(out.status.begin(), out.status.end(), out.status.begin(), [](char c) {
    return c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  out.elapsed = secondsOf(in.time_elapsed());
  out.remaining = secondsOf(in.estimated_time_to_complete());
  out.distance_remaining = in.distance_to_complete();
  out.instructions = in.total_number_of_instructions();
  out.completed_instructions.assign(in.completed_instruction_ids().begin(),
                                    in.completed_instruction_ids().end());
  out.path_segments = in.total_number_of_path_segments();
  out.completed_path_segments.assign(in.completed_path_segment_ids().begin(),
                                     in.completed_path_segment_ids().end());
  return out;
}

std::optional<BlueyeAutoPilotReference> toAutoPilot(const pb::ReferenceAutoPilotTel& told,
                                                    const Context& context) {
  if (!told.has_reference_auto_pilot()) return std::nullopt;
  const pb::ReferenceAutoPilot& in = told.reference_auto_pilot();
  constexpr std::uint32_t kInactive = 4294967295U;
  BlueyeAutoPilotReference out;
  out.header = context.header("");
  out.instruction = shortName(pb::InstructionType_Name(in.instruction_type()), "INSTRUCTION_TYPE_");
  out.instruction_id = in.active_instruction_id();
  out.path_segment_id =
      in.active_path_segment_id() == kInactive ? -1 : std::int64_t{in.active_path_segment_id()};
  out.course = yawOf(in.course_to_target());
  out.speed = in.speed_over_ground();
  out.horizontal_distance = in.horizontal_distance_to_target();
  out.vertical_distance = in.vertical_distance_to_target();
  out.acceptance_radius = in.circle_of_acceptance();
  out.above_bottom = in.depth_zero_reference() == pb::DEPTH_ZERO_REFERENCE_SEABED;
  out.z = out.above_bottom ? in.depth_set_point() : negated(in.depth_set_point());
  const bool down = context.conventions.heave_velocity_down;
  out.heave_velocity = down ? negated(in.heave_velocity()) : in.heave_velocity();
  out.remaining = secondsOf(in.time_to_complete());
  return out;
}

// --- Small things ---

std::optional<sensor_msgs::Temperature> toWaterTemperature(const pb::WaterTemperatureTel& told,
                                                           const Context& context) {
  if (!told.has_temperature()) return std::nullopt;
  return temperature(told.temperature().value(), context.base_frame, context);
}

std::optional<sensor_msgs::Temperature> toCpuTemperature(const pb::CPUTemperatureTel& told,
                                                         const Context& context) {
  if (!told.has_temperature()) return std::nullopt;
  return temperature(told.temperature().value(), context.base_frame, context);
}

std::optional<sensor_msgs::Temperature> toCanisterTemperature(
    const pb::CanisterBottomTemperatureTel& told, const Context& context) {
  if (!told.has_temperature()) return std::nullopt;
  return temperature(told.temperature().temperature(), context.base_frame, context);
}

std::optional<sensor_msgs::RelativeHumidity> toHumidity(const pb::CanisterBottomHumidityTel& told,
                                                        const Context& context) {
  if (!told.has_humidity() || !std::isfinite(told.humidity().humidity())) return std::nullopt;
  sensor_msgs::RelativeHumidity out;
  out.header = context.header(context.base_frame);
  out.relative_humidity = told.humidity().humidity() / 100.0;
  return out;
}

std::optional<std_msgs::Float64> toLights(const pb::LightsTel& told, const Context&) {
  if (!told.has_lights()) return std::nullopt;
  return number(told.lights().value());
}

std::optional<std_msgs::Float64> toGuestPortLights(const pb::GuestPortLightsTel& told,
                                                   const Context&) {
  if (!told.has_lights()) return std::nullopt;
  return number(told.lights().value());
}

std::optional<std_msgs::Float64> toLaser(const pb::LaserTel& told, const Context&) {
  if (!told.has_laser()) return std::nullopt;
  return number(told.laser().value());
}

// Up is a turn to the back about the axis to port: negative.
std::optional<sensor_msgs::JointState> toCameraTilt(const pb::TiltAngleTel& told,
                                                    const Context& context) {
  if (!told.has_angle()) return std::nullopt;
  return joint("camera_tilt", negated(radiansOf(told.angle().value())), context);
}

std::optional<sensor_msgs::JointState> toServo(const pb::GenericServoTel& told,
                                               const Context& context) {
  if (!told.has_servo()) return std::nullopt;
  const Conventions& how = context.conventions;
  // The vendor's library writes degrees where the document has 0 to 1.
  const double share = std::clamp<double>(told.servo().value(), 0.0, 1.0);
  const std::string name =
      "guest_port_" + std::to_string(told.servo().guest_port_number()) + "_servo";
  return joint(name, how.servo_min_rad + share * (how.servo_max_rad - how.servo_min_rad), context);
}

std::optional<sensor_msgs::JointState> toMultibeamTilt(const pb::MultibeamServoTel& told,
                                                       const Context& context) {
  if (!told.has_servo()) return std::nullopt;
  const double angle_rad = radiansOf(told.servo().angle());
  const bool up = context.conventions.multibeam_tilt_up;
  return joint("multibeam_tilt", up ? negated(angle_rad) : angle_rad, context);
}

std::optional<std_msgs::Bool> toTiltStabilization(const pb::TiltStabilizationTel& told,
                                                  const Context&) {
  if (!told.has_state()) return std::nullopt;
  std_msgs::Bool out;
  out.data = told.state().enabled();
  return out;
}

std::optional<BlueyeRecordState> toRecordState(const pb::RecordStateTel& told,
                                               const Context& context) {
  if (!told.has_record_state()) return std::nullopt;
  const pb::RecordState& in = told.record_state();
  BlueyeRecordState out;
  out.header = context.header("");
  out.main = in.main_is_recording();
  out.main_duration = recordedFor(in.main_seconds());
  out.main_rate = in.main_fps();
  out.guestport = in.guestport_is_recording();
  out.guestport_duration = recordedFor(in.guestport_seconds());
  out.guestport_rate = in.guestport_fps();
  out.multibeam = in.multibeam_is_recording();
  out.multibeam_duration = recordedFor(in.multibeam_seconds());
  out.multibeam_rate = in.multibeam_fps();
  return out;
}

std::optional<sensor_msgs::NavSatFix> toPilotFix(const pb::PilotGPSPositionTel& told,
                                                 const Context& context) {
  return fix(told.position(), told.has_position(), kNan, "pilot", context);
}

std::optional<BlueyeCalibrationState> toCalibration(const pb::CalibrationStateTel& told,
                                                    const Context& context) {
  if (!told.has_calibration_state()) return std::nullopt;
  const pb::CalibrationState& in = told.calibration_state();
  BlueyeCalibrationState out;
  out.header = context.header("");
  out.status = static_cast<std::uint8_t>(in.status());
  out.name = shortName(pb::CalibrationState_Status_Name(in.status()), "STATUS_");
  out.x_positive = in.progress_x_positive();
  out.x_negative = in.progress_x_negative();
  out.y_positive = in.progress_y_positive();
  out.y_negative = in.progress_y_negative();
  out.z_positive = in.progress_z_positive();
  out.z_negative = in.progress_z_negative();
  out.thruster = in.progress_thruster();
  return out;
}

std::optional<std_msgs::Duration> toDiveTime(const pb::DiveTimeTel& told, const Context&) {
  if (!told.has_dive_time()) return std::nullopt;
  std_msgs::Duration out;
  out.data = secondsOf(told.dive_time().value());
  return out;
}

std::optional<MultibeamPing> toPing(const pb::MultibeamPingTel& told, const Context& context) {
  if (!told.has_ping()) return std::nullopt;
  const pb::MultibeamPing& in = told.ping();
  MultibeamPing out;
  out.header = context.header("sonar_link");
  if (in.has_frame_generation_timestamp()) out.frame_time = timeOf(in.frame_generation_timestamp());
  out.range = in.range();
  out.gain = in.gain();
  out.frequency = in.frequency();
  out.speed_of_sound = in.speed_of_sound_used();
  out.device_id = static_cast<std::uint32_t>(in.device_id());
  out.rows = in.number_of_ranges();
  out.columns = in.number_of_beams();
  out.step = in.step();
  // Beyond half a turn they can only be hundredths of a degree, as older firmware sends.
  const auto& bearings = in.bearings();
  const bool hundredths =
      std::any_of(bearings.begin(), bearings.end(), [](float b) { return std::abs(b) > 180.0F; });
  const double scale =
      radiansOf(hundredths ? 0.01 : 1.0) * (context.conventions.bearings_clockwise ? -1.0 : 1.0);
  out.bearings.reserve(static_cast<std::size_t>(bearings.size()));
  for (const float bearing : bearings) {
    out.bearings.push_back(static_cast<float>(0.0 + scale * bearing));
  }
  out.image.assign(in.ping_data().begin(), in.ping_data().end());
  return out;
}

// --- Commands ---

ConvertedMotion toCommand(const MotionInput& in) {
  Check check;
  check.within("x", in.x, -1.0, 1.0);
  check.within("y", in.y, -1.0, 1.0);
  check.within("z", in.z, -1.0, 1.0);
  check.within("roll", in.roll, -1.0, 1.0);
  check.within("pitch", in.pitch, -1.0, 1.0);
  check.within("yaw", in.yaw, -1.0, 1.0);
  check.within("slow", in.slow, 0.0, 1.0);
  check.within("boost", in.boost, 0.0, 1.0);
  if (!check.refusal().empty()) return check.refusal();
  vehicle::MotionCommand out;
  out.surge = in.x;
  out.sway = negated(in.y);
  out.heave = negated(in.z);
  out.roll = in.roll;
  out.pitch = negated(in.pitch);
  out.yaw = negated(in.yaw);
  out.slow = in.slow;
  out.boost = in.boost;
  return vehicle::DroneCommand{out};
}

ConvertedMotion toCommand(const geometry_msgs::Twist& in, const FullSpeed& full) {
  Check check;
  check.finite(in);
  if (!check.refusal().empty()) return check.refusal();
  const auto share = [](double value, double most) { return std::clamp(value / most, -1.0, 1.0); };
  vehicle::MotionCommand out;
  out.surge = share(in.linear.x, full.surge_m_s);
  out.sway = negated(share(in.linear.y, full.sway_m_s));
  out.heave = negated(share(in.linear.z, full.heave_m_s));
  out.yaw = negated(share(in.angular.z, full.yaw_rate_rad_s));
  return vehicle::DroneCommand{out};
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
