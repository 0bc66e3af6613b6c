#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"
#include "telemetry_kinds.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kGravity = 9.80665;
constexpr double kAttitudeNoise_rad = 0.002;
constexpr double kDepthNoise_m = 0.005;
constexpr double kRangeNoise_m = 0.02;
constexpr double kVelocityNoise_m_s = 0.005;
constexpr double kForceNoise_g = 0.003;
constexpr double kRateNoise_rad_s = 0.002;
constexpr double kFieldNoise_ut = 0.3;
constexpr double kInside_c = 28.0;  // the sensors sit in the warm canister
/// The Earth's field off Norway, microtesla: towards magnetic north, and down.
constexpr double kFieldNorth_ut = 13.7;
constexpr double kFieldDown_ut = 50.2;
constexpr double kFieldAhead_m = 30.0;  // nothing is seen ahead within

struct Vector {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// A vector in north-east-down axes, in the body's forward-right-down ones.
Vector toBody(const Vector& ned, const VehicleState& state, double heading_rad) {
  const double sin_heading = std::sin(heading_rad), cos_heading = std::cos(heading_rad);
  const double sin_pitch = std::sin(state.pitch_rad), cos_pitch = std::cos(state.pitch_rad);
  const double sin_roll = std::sin(state.roll_rad), cos_roll = std::cos(state.roll_rad);
  const double ahead = cos_heading * ned.x + sin_heading * ned.y;
  const double right = -sin_heading * ned.x + cos_heading * ned.y;
  const double keel = sin_pitch * ahead + cos_pitch * ned.z;
  return {cos_pitch * ahead - sin_pitch * ned.z, cos_roll * right + sin_roll * keel,
          -sin_roll * right + cos_roll * keel};
}

void set(bp::Vector3& out, double x, double y, double z) {
  out.set_x(x);
  out.set_y(y);
  out.set_z(z);
}

/// `coarse`: how much noisier than the calibrated one; `magnetometer`: it has one.
void fill(BlueyeCore& core, bp::Imu& imu, double coarse, bool magnetometer) {
  const VehicleState& state = core.rov.state();
  const double sign = core.config.conventions.gravity_positive ? -1.0 : 1.0;
  const auto force = [&](double m_s2) {
    return sign * m_s2 / kGravity + noise(core, coarse * kForceNoise_g);
  };
  const auto rate = [&](double rad_s) { return rad_s + noise(core, coarse * kRateNoise_rad_s); };
  set(*imu.mutable_accelerometer(), force(state.force_x_m_s2), force(state.force_y_m_s2),
      force(state.force_z_m_s2));
  set(*imu.mutable_gyroscope(), rate(state.roll_rate_rad_s), rate(state.pitch_rate_rad_s),
      rate(state.yaw_rate_rad_s));
  imu.set_temperature(toFloat(kInside_c + noise(core, 0.1)));
  if (!magnetometer) return;
  const double magnetic = state.heading_rad - radians(core.config.magnetic_declination_deg);
  const Vector field = toBody({kFieldNorth_ut, 0.0, kFieldDown_ut}, state, magnetic);
  set(*imu.mutable_magnetometer(), field.x + noise(core, kFieldNoise_ut),
      field.y + noise(core, kFieldNoise_ut), field.z + noise(core, kFieldNoise_ut));
}

template <class Message>
bool imu(BlueyeCore& core, Message& message, double coarse, bool magnetometer) {
  fill(core, *message.mutable_imu(), coarse, magnetometer);
  return true;
}

bool attitude(BlueyeCore& core, bp::AttitudeTel& message) {
  const VehicleState& state = core.rov.state();
  const auto in_degrees = [&](double rad) {
    return toFloat(degrees(wrapPi(rad + noise(core, kAttitudeNoise_rad))));
  };
  bp::Attitude& out = *message.mutable_attitude();
  out.set_roll(in_degrees(state.roll_rad));
  out.set_pitch(in_degrees(state.pitch_rad));
  out.set_yaw(in_degrees(core.compassHeading()));
  return true;
}

bool depth(BlueyeCore& core, bp::DepthTel& message) {
  message.mutable_depth()->set_value(toFloat(core.depth() + noise(core, kDepthNoise_m)));
  return true;
}

bool altitude(BlueyeCore& core, bp::AltitudeTel& message) {
  bp::Altitude& out = *message.mutable_altitude();
  out.set_is_valid(core.altitudeValid());
  if (!out.is_valid()) return true;
  out.set_value(toFloat(std::max(0.0, core.rov.state().altitude_m + noise(core, kRangeNoise_m))));
  return true;
}

bool forwardDistance(BlueyeCore& core, bp::ForwardDistanceTel& message) {
  const bool forwards = core.computer.settings.pinger.mounting_direction() !=
                        bp::PingerConfiguration::MOUNTING_DIRECTION_DOWNWARDS;
  if (!core.has(BlueyeDevice::Pinger) || !forwards) return false;
  // The bottom is all there is to see: with the bow down far enough, the beam meets it.
  const VehicleState& state = core.rov.state();
  const double down = -std::sin(state.pitch_rad);
  bp::ForwardDistance& out = *message.mutable_forward_distance();
  const double range = down > 0.0 ? state.altitude_m / down : kFieldAhead_m;
  out.set_is_valid(range < kFieldAhead_m);
  if (out.is_valid()) out.set_value(toFloat(std::max(0.0, range + noise(core, kRangeNoise_m))));
  return true;
}

/// Along four beams at 22.5 degrees from straight down, as an A50 has them.
void addBeams(BlueyeCore& core, const Vector& velocity, bool locked, bp::DvlVelocity& out) {
  constexpr double kSlant_rad = 0.3927;
  for (int beam = 0; beam < 4; ++beam) {
    const double azimuth = kPi / 4.0 + beam * kPi / 2.0;
    const Vector direction{std::sin(kSlant_rad) * std::cos(azimuth),
                           std::sin(kSlant_rad) * std::sin(azimuth), std::cos(kSlant_rad)};
    bp::DvlTransducer* transducer = out.add_transducers();
    transducer->set_id(beam);
    transducer->set_beam_valid(locked);
    transducer->set_rssi(locked ? -35.0F : -90.0F);
    transducer->set_nsd(-95.0F);
    if (!locked) continue;
    transducer->set_velocity(
        toFloat(velocity.x * direction.x + velocity.y * direction.y + velocity.z * direction.z));
    transducer->set_distance(toFloat(core.rov.state().altitude_m / std::cos(kSlant_rad)));
  }
}

bool dvlVelocity(BlueyeCore& core, bp::DvlVelocityTel& message) {
  if (!core.has(BlueyeDevice::Dvl)) return false;
  const VehicleState& state = core.rov.state();
  const bool locked = core.computer.navigation.valid();
  Vector velocity =
      toBody({state.velocity_north_m_s, state.velocity_east_m_s, state.velocity_down_m_s}, state,
             state.heading_rad);
  bp::DvlVelocity& out = *message.mutable_dvl_velocity();
  out.set_sensor_id(bp::NAVIGATION_SENSOR_ID_WATERLINKED_DVL_A50);
  out.set_status(locked ? 0 : 1);
  out.set_delta_time(100.0F);
  out.set_fom(locked ? 0.005F : 0.4F);
  addBeams(core, velocity, locked, out);
  if (!locked) return true;
  const double y = core.config.conventions.dvl_y_right ? velocity.y : -velocity.y;
  set(*out.mutable_velocity(), velocity.x + noise(core, kVelocityNoise_m_s),
      y + noise(core, kVelocityNoise_m_s), velocity.z + noise(core, kVelocityNoise_m_s));
  return true;
}

void setPosition(bp::LatLongPosition& out, const nmea::LatLon& position) {
  out.set_latitude(position.latitude_deg);
  out.set_longitude(position.longitude_deg);
}

void addSensors(BlueyeCore& core, bp::PositionEstimate& out) {
  const BlueyeNavigation& navigation = core.computer.navigation;
  if (core.has(BlueyeDevice::Dvl)) {
    bp::NavigationSensorStatus* dvl = out.add_navigation_sensors();
    dvl->set_sensor_id(bp::NAVIGATION_SENSOR_ID_WATERLINKED_DVL_A50);
    dvl->set_is_valid(navigation.valid());
    dvl->set_northing(toFloat(navigation.place().north_m));
    dvl->set_easting(toFloat(navigation.place().east_m));
    dvl->set_heading(toFloat(wrapPi(navigation.heading())));
    dvl->set_fom(0.005F);
    dvl->set_std(0.01F);
  }
  if (!core.has(BlueyeDevice::Gnss)) return;
  bp::NavigationSensorStatus* receiver = out.add_navigation_sensors();
  receiver->set_sensor_id(bp::NAVIGATION_SENSOR_ID_BLUEYE_GNSS);
  const auto fix = core.gnss();
  receiver->set_is_valid(fix.has_value());
  if (!fix) return;
  receiver->set_std(1.5F);
  setPosition(*receiver->mutable_global_position(), *fix);
  if (!navigation.origin()) return;
  const PlanePoint place = toPlane(*navigation.origin(), *fix);
  receiver->set_northing(toFloat(place.north_m));
  receiver->set_easting(toFloat(place.east_m));
}

bool positionEstimate(BlueyeCore& core, bp::PositionEstimateTel& message) {
  if (!core.has(BlueyeDevice::Dvl)) return false;
  const BlueyeNavigation& navigation = core.computer.navigation;
  const VehicleState& state = core.rov.state();
  bp::PositionEstimate& out = *message.mutable_position_estimate();
  out.set_is_valid(navigation.valid());
  out.set_northing(toFloat(navigation.place().north_m));
  out.set_easting(toFloat(navigation.place().east_m));
  out.set_heading(toFloat(navigation.heading()));
  out.set_surge_rate(toFloat(navigation.surgeRate()));
  out.set_sway_rate(toFloat(navigation.swayRate()));
  out.set_yaw_rate(toFloat(core.rov.yawRate()));
  out.set_ocean_current(toFloat(core.config.environment.current_drift_m_s));
  out.set_odometer(toFloat(navigation.odometer()));
  out.set_speed_over_ground(toFloat(std::hypot(state.velocity_east_m_s, state.velocity_north_m_s)));
  const double course = std::atan2(state.velocity_east_m_s, state.velocity_north_m_s);
  out.set_course_over_ground(toFloat(wrap360(degrees(course))));
  out.set_time_since_reset_sec(static_cast<std::int32_t>(navigation.sinceReset()));
  out.set_accuracy(toFloat(navigation.accuracy()));
  if (const auto position = navigation.position()) {
    setPosition(*out.mutable_global_position(), *position);
  }
  addSensors(core, out);
  return true;
}

bool reference(BlueyeCore& core, bp::ReferenceTel& message) {
  const BlueyePilot& pilot = core.computer.pilot;
  const RovAxes& stick = pilot.stick.axes;
  const double yaw = core.config.conventions.yaw_clockwise ? stick.yaw : -stick.yaw;
  bp::Reference& out = *message.mutable_reference();
  out.set_surge(toFloat(stick.surge));
  out.set_sway(toFloat(stick.sway));
  out.set_heave(toFloat(stick.heave));
  out.set_yaw(toFloat(yaw));
  out.set_depth(toFloat(pilot.depthSetPoint()));
  out.set_heading(toFloat(degrees(wrapPi(pilot.headingSetPoint()))));
  out.set_altitude(toFloat(pilot.altitudeSetPoint()));
  return true;
}

bool controlForce(BlueyeCore& core, bp::ControlForceTel& message) {
  const RovAxes& wanted = core.rov.commanded();
  bp::ControlForce& out = *message.mutable_control_force();
  out.set_surge(toFloat(Rov::kSurge.force * wanted.surge));
  out.set_sway(toFloat(Rov::kSway.force * wanted.sway));
  out.set_heave(toFloat(Rov::kHeave.force * wanted.heave));
  out.set_yaw(toFloat(Rov::kYaw.force * wanted.yaw));
  return true;
}

bool controllerHealth(BlueyeCore& core, bp::ControllerHealthTel& message) {
  const BlueyePilot& pilot = core.computer.pilot;
  bp::ControllerHealth& out = *message.mutable_controller_health();
  out.set_depth_error(toFloat(pilot.depthError(core.rov)));
  out.set_depth_health(toFloat(std::abs(core.rov.commanded().heave)));
  out.set_heading_error(toFloat(degrees(pilot.headingError(core.computer.navigation))));
  out.set_heading_health(toFloat(std::abs(core.rov.commanded().yaw)));
  return true;
}

bool controlMode(BlueyeCore& core, bp::ControlModeTel& message) {
  const BlueyeModes& modes = core.computer.pilot.modes();
  bp::ControlMode& out = *message.mutable_state();
  out.set_auto_depth(modes.auto_depth);
  out.set_auto_heading(modes.auto_heading);
  out.set_auto_altitude(modes.auto_altitude);
  out.set_station_keeping(modes.station_keeping);
  out.set_weather_vaning(modes.weather_vaning);
  out.set_auto_pilot_surge_yaw(modes.auto_pilot_surge_yaw);
  out.set_auto_pilot_heave(modes.auto_pilot_heave);
  return true;
}

bool referenceAutoPilot(BlueyeCore& core, bp::ReferenceAutoPilotTel& message) {
  const auto state = core.computer.mission.state();
  if (state != bp::MISSION_STATE_RUNNING && state != bp::MISSION_STATE_PAUSED) return false;
  *message.mutable_reference_auto_pilot() = core.computer.mission.reference(core);
  return true;
}

}  // namespace

void addMotionTelemetry(std::vector<BlueyeTelemetry>& all) {
  all.push_back(telemetry<bp::AttitudeTel>(20.0, attitude));
  all.push_back(telemetry<bp::DepthTel>(10.0, depth));
  all.push_back(telemetry<bp::AltitudeTel>(5.0, altitude));
  all.push_back(telemetry<bp::ForwardDistanceTel>(5.0, forwardDistance));
  all.push_back(telemetry<bp::DvlVelocityTel>(5.0, dvlVelocity));
  all.push_back(telemetry<bp::PositionEstimateTel>(10.0, positionEstimate));
  all.push_back(telemetry<bp::ReferenceTel>(5.0, reference));
  all.push_back(telemetry<bp::ControlForceTel>(5.0, controlForce));
  all.push_back(telemetry<bp::ControllerHealthTel>(2.0, controllerHealth));
  all.push_back(telemetry<bp::ControlModeTel>(2.0, controlMode));
  all.push_back(telemetry<bp::ReferenceAutoPilotTel>(2.0, referenceAutoPilot));
  // Raw and calibrated inertial data comes when asked for.
  all.push_back(telemetry<bp::CalibratedImuTel>(
      0.0, [](BlueyeCore& core, bp::CalibratedImuTel& m) { return imu(core, m, 1.0, true); }));
  all.push_back(telemetry<bp::Imu1Tel>(
      0.0, [](BlueyeCore& core, bp::Imu1Tel& m) { return imu(core, m, 2.0, true); }));
  all.push_back(telemetry<bp::Imu2Tel>(
      0.0, [](BlueyeCore& core, bp::Imu2Tel& m) { return imu(core, m, 3.0, true); }));
  all.push_back(telemetry<bp::ImuHpTel>(
      0.0, [](BlueyeCore& core, bp::ImuHpTel& m) { return imu(core, m, 0.5, false); }));
  all.push_back(telemetry<bp::CalibratedImuHpTel>(
      0.0, [](BlueyeCore& core, bp::CalibratedImuHpTel& m) { return imu(core, m, 0.3, false); }));
}

}  // namespace frontseat_driver::sim
