#include "core.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "frontseat_driver/sim/angles.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kSubmerged_m = 0.25;  // the dive time counts below, a GNSS receiver hears above
constexpr double kDevicePower_w = 12.0;

double horizontalSpeed(const VehicleState& state) {
  return std::hypot(state.velocity_east_m_s, state.velocity_north_m_s);
}

bp::CameraParameters defaultCamera(bp::Camera camera) {
  bp::CameraParameters parameters;
  parameters.set_camera(camera);
  parameters.set_h264_bitrate(5000000);
  parameters.set_mjpg_bitrate(28000000);
  parameters.set_exposure(-1);
  parameters.set_white_balance(-1);
  parameters.set_resolution(bp::RESOLUTION_FULLHD_1080P);
  parameters.set_stream_resolution(bp::RESOLUTION_FULLHD_1080P);
  parameters.set_recording_resolution(bp::RESOLUTION_FULLHD_1080P);
  parameters.set_framerate(bp::FRAMERATE_FPS_30);
  return parameters;
}

}  // namespace

UtcTime seconds(double value) {
  return std::chrono::duration_cast<UtcTime>(std::chrono::duration<double>{value});
}

google::protobuf::Timestamp toTimestamp(UtcTime time) {
  google::protobuf::Timestamp stamp;
  stamp.set_seconds(time.count() / 1000000000);
  stamp.set_nanos(static_cast<std::int32_t>(time.count() % 1000000000));
  return stamp;
}

std::optional<UtcTime> toUtc(const google::protobuf::Timestamp& stamp) {
  constexpr std::int64_t kEnd_s = 7258118400;  // 2200
  if (stamp.seconds() < 0 || stamp.seconds() >= kEnd_s) return std::nullopt;
  if (stamp.nanos() < 0 || stamp.nanos() >= 1000000000) return std::nullopt;
  return std::chrono::seconds{stamp.seconds()} + UtcTime{stamp.nanos()};
}

double noise(BlueyeCore& core, double sigma) {
  return core.config.noise ? sigma * core.random.normal() : 0.0;
}

BlueyeSettings::BlueyeSettings() {
  for (const auto camera : {bp::CAMERA_MAIN, bp::CAMERA_GUESTPORT}) {
    cameras[camera] = defaultCamera(camera);
  }
  overlay.set_logo_type(bp::LOGO_TYPE_DEFAULT);
  overlay.set_depth_unit(bp::DEPTH_UNIT_METERS);
  overlay.set_temperature_unit(bp::TEMPERATURE_UNIT_CELSIUS);
  overlay.set_font_size(bp::FONT_SIZE_PX25);
  overlay.set_date_format("%m/%d/%Y %I:%M:%S %p");
  storage.set_videos(true);
  storage.set_images(true);
  storage.set_binlog(true);
  pinger.set_mounting_direction(bp::PingerConfiguration::MOUNTING_DIRECTION_FORWARDS);
  declination.set_location_source(bp::LOCATION_SOURCE_UNSPECIFIED);
  tracking.set_state(bp::SotState::STATE_IDLE);
}

BlueyeComputer::BlueyeComputer(const BlueyeConfig& config, const Rov& rov, Random random,
                               UtcTime now)
    : booted(now),
      clock_offset(seconds(config.clock_offset_s)),
      navigation(rov, random, config.noise),
      multibeam(config.multibeam, random) {}

BlueyeCore::BlueyeCore(const BlueyeConfig& all)
    : config(all),
      now(all.start_time),
      rov(all.environment, all.start, all.battery, all.buoyancy_n),
      random(all.seed, 1),
      computer(config, rov, Random{all.seed, 2}, now) {}

void BlueyeCore::reboot() {
  computer = BlueyeComputer{config, rov, Random{config.seed, random.below(1U << 30)}, now};
}

bool BlueyeCore::has(BlueyeDevice device) const {
  if (computer.guest_ports_off || now < computer.guest_ports_on_again) return false;
  return std::find(config.devices.begin(), config.devices.end(), device) != config.devices.end();
}

UtcTime BlueyeCore::watchdogTimeout() const { return seconds(config.watchdog_timeout_s); }

bool BlueyeCore::armed() const { return computer.clients.armed(now, watchdogTimeout()); }

bool BlueyeCore::altitudeValid() const {
  const bool downwards = computer.settings.pinger.mounting_direction() ==
                         bp::PingerConfiguration::MOUNTING_DIRECTION_DOWNWARDS;
  return (has(BlueyeDevice::Dvl) || (has(BlueyeDevice::Pinger) && downwards)) &&
         rov.state().altitude_m <= BlueyeNavigation::kBottomLock_m;
}

double BlueyeCore::depth() const {
  return rov.state().depth_m * config.water_density_g_l / computer.settings.water_density_g_l;
}

std::optional<nmea::LatLon> BlueyeCore::gnss() const {
  if (!has(BlueyeDevice::Gnss) || rov.state().depth_m > kSubmerged_m) return std::nullopt;
  return rov.position();
}

double BlueyeCore::compassHeading() const {
  const double true_heading = rov.state().heading_rad;
  const bool located =
      computer.settings.declination.location_source() != bp::LOCATION_SOURCE_UNSPECIFIED;
  return located ? true_heading : true_heading - radians(config.magnetic_declination_deg);
}

void BlueyeCore::setModes(const BlueyeModes& modes) {
  computer.pilot.setModes(modes, rov, computer.navigation);
  announce("ControlModeTel");
}

void BlueyeCore::zeroMotion() { computer.pilot.stick = {}; }

void BlueyeCore::notify(bp::NotificationType type, bp::NotificationLevel level,
                        std::optional<std::int32_t> value) {
  bp::Notification notification;
  notification.set_type(type);
  notification.set_level(level);
  if (value) {
    google::protobuf::Int32Value number;
    number.set_value(*value);
    notification.mutable_value()->PackFrom(number);
  }
  // Clients take two of the same time for one, and Python's times have no more than microseconds.
  const std::chrono::microseconds apart{computer.notifications.size()};
  *notification.mutable_timestamp() = toTimestamp(clock() + apart);
  computer.last_notification = notification;
  computer.notifications.push_back(std::move(notification));
}

void BlueyeCore::resetPosition(const BlueyeReset& how) {
  computer.navigation.reset(how);
  if (how.position) {
    computer.settings.declination.set_location_source(bp::LOCATION_SOURCE_USER);
    computer.settings.declination.set_declination(
        static_cast<float>(config.magnetic_declination_deg));
    computer.settings.declination.mutable_location()->set_latitude(how.position->latitude_deg);
    computer.settings.declination.mutable_location()->set_longitude(how.position->longitude_deg);
    announce("MagneticDeclinationTel");
  }
  announce("PositionEstimateTel");
}

/// Lights and automatic functions end with the client in control; the next in line takes over.
void BlueyeCore::watch() {
  if (!computer.clients.drop(now, watchdogTimeout())) return;
  zeroMotion();
  BlueyePayload& payload = computer.payload;
  payload.lights = 0.0;
  payload.guest_port_lights = 0.0;
  payload.laser.set_value(0.0F);
  payload.tilt_velocity = 0.0;
  payload.grip_velocity = 0.0;
  payload.rotate_velocity = 0.0;
  computer.mission.abort(*this);
  setModes({});
  clientsChanged();
  for (const char* changed : {"LightsTel", "GuestPortLightsTel", "LaserTel"}) announce(changed);
}

/// The first GNSS fix tells where the estimate began.
void BlueyeCore::lookUp() {
  if (computer.gnss_seen) return;
  const auto fix = gnss();
  if (!fix) return;
  computer.gnss_seen = true;
  if (computer.navigation.origin()) return;
  BlueyeReset how;
  how.position = fix;
  resetPosition(how);
  computer.settings.declination.set_location_source(bp::LOCATION_SOURCE_DRONE);
}

void BlueyeCore::steer(double dt_s) {
  if (!altitudeValid() && computer.pilot.modes().auto_altitude) {
    BlueyeModes modes = computer.pilot.modes();
    modes.auto_altitude = false;
    modes.auto_depth = true;
    setModes(modes);
  }
  computer.mission.step(*this, dt_s);
  const bool may = armed() || computer.mission.state() == bp::MISSION_STATE_RUNNING;
  rov.command(computer.pilot.control(rov, computer.navigation, may, dt_s));
}

void BlueyeCore::step(double dt_s) {
  watch();
  lookUp();
  steer(dt_s);
  const auto fitted =
      static_cast<double>(computer.guest_ports_off ? std::size_t{0} : config.devices.size());
  rov.setAuxiliaryPower(computer.payload.power() + kDevicePower_w * fitted / 10.0);
  rov.step(dt_s);
  computer.navigation.step(rov, has(BlueyeDevice::Dvl), dt_s);
  computer.payload.step(dt_s, horizontalSpeed(rov.state()) * dt_s);
  if (rov.state().depth_m > kSubmerged_m) computer.dive_s += dt_s;
}

}  // namespace frontseat_driver::sim
