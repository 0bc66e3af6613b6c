#include "controls.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "frontseat_driver/sim/angles.h"
#include "reflection.h"

namespace frontseat_driver::sim {
namespace {

/// Reads a message; `act` then does as it says, and tells whether the drone could.
BlueyeTaken take(google::protobuf::MessageLite& message, std::string_view data,
                 const std::function<bool()>& act) {
  if (!message.ParseFromArray(data.data(), static_cast<int>(data.size()))) {
    return BlueyeTaken::Malformed;
  }
  if (!isFinite(nameOf(message), data)) return BlueyeTaken::Refused;
  return act() ? BlueyeTaken::Obeyed : BlueyeTaken::Refused;
}

/// A row of the table: `act` is called with the message, and tells whether the drone could.
template <class Message>
BlueyeControl control(bool (*act)(BlueyeCore&, const Message&)) {
  return {nameOf<Message>(), [act](BlueyeCore& core, std::string_view data) {
            Message message;
            return take(message, data, [&] { return act(core, message); });
          }};
}

double unit(double value) { return std::clamp(value, 0.0, 1.0); }
double signedUnit(double value) { return std::clamp(value, -1.0, 1.0); }

bool onEarth(const bp::LatLongPosition& position) {
  return std::abs(position.latitude()) <= 90.0 && std::abs(position.longitude()) <= 180.0;
}

/// The stick stays as it was put: nothing but a watchdog that stops ends it.
bool motionInput(BlueyeCore& core, const bp::MotionInputCtrl& message) {
  const bp::MotionInput& in = message.motion_input();
  const double yaw = core.config.conventions.yaw_clockwise ? 1.0 : -1.0;
  BlueyeStick& stick = core.computer.pilot.stick;
  stick.axes = {signedUnit(in.surge()),     signedUnit(in.sway()), signedUnit(in.heave()),
                yaw * signedUnit(in.yaw()), signedUnit(in.roll()), signedUnit(in.pitch())};
  stick.slow = unit(in.slow());
  stick.boost = unit(in.boost());
  return true;
}

bool watchdog(BlueyeCore& core, const bp::WatchdogCtrl& message) {
  core.computer.clients.pet(message.client_id(), core.now);
  return true;
}

bool switchMode(BlueyeCore& core, bool BlueyeModes::*member, bool on) {
  const bool needs_altitude =
      member == &BlueyeModes::auto_altitude || member == &BlueyeModes::weather_vaning;
  if (on && needs_altitude && !core.altitudeValid()) return false;
  BlueyeModes modes = core.computer.pilot.modes();
  modes.*member = on;
  if (on && member == &BlueyeModes::auto_depth) modes.auto_altitude = false;
  if (on && member == &BlueyeModes::auto_altitude) modes.auto_depth = false;
  core.setModes(modes);
  return true;
}

template <class Message>
BlueyeControl mode(bool BlueyeModes::*member) {
  // The member is part of the type of nothing: it has to be carried along.
  return {nameOf<Message>(), [member](BlueyeCore& core, std::string_view data) {
            Message message;
            return take(message, data,
                        [&] { return switchMode(core, member, message.state().enabled()); });
          }};
}

bool lights(BlueyeCore& core, const bp::LightsCtrl& message) {
  core.computer.payload.lights = unit(message.lights().value());
  core.announce("LightsTel");
  return true;
}

bool guestPortLights(BlueyeCore& core, const bp::GuestportLightsCtrl& message) {
  if (!core.has(BlueyeDevice::Light)) return false;
  core.computer.payload.guest_port_lights = unit(message.lights().value());
  core.announce("GuestPortLightsTel");
  return true;
}

bool laser(BlueyeCore& core, const bp::LaserCtrl& message) {
  if (!core.has(BlueyeDevice::Laser)) return false;
  core.computer.payload.laser = message.laser();
  core.computer.payload.laser.set_value(static_cast<float>(unit(message.laser().value())));
  core.announce("LaserTel");
  return true;
}

bool pilotPosition(BlueyeCore& core, const bp::PilotGPSPositionCtrl& message) {
  if (!onEarth(message.position())) return false;
  core.computer.settings.pilot_position = message.position();
  core.announce("PilotGPSPositionTel");
  return true;
}

bool record(BlueyeCore& core, const bp::RecordCtrl& message) {
  BlueyePayload& payload = core.computer.payload;
  payload.main.set(message.record_on().main());
  payload.guest_port.set(message.record_on().guestport() && core.has(BlueyeDevice::Camera));
  payload.multibeam.set(message.record_on().multibeam() && core.has(BlueyeDevice::Multibeam));
  if (message.storage_location() != bp::STORAGE_LOCATION_UNSPECIFIED) {
    payload.locations.fill(message.storage_location());
  }
  core.announce("RecordStateTel");
  return true;
}

bool takePicture(BlueyeCore& core, const bp::TakePictureCtrl&) {
  core.computer.payload.takePicture();
  core.announce("VideoStorageSpaceTel");
  return true;
}

std::optional<nmea::LatLon> resetPlace(const BlueyeCore& core,
                                       const bp::ResetPositionSettings& settings) {
  switch (settings.reset_coordinate_source()) {
    case bp::RESET_COORDINATE_SOURCE_DEVICE_GPS:
      if (!core.computer.settings.pilot_position) return std::nullopt;
      return nmea::LatLon{core.computer.settings.pilot_position->latitude(),
                          core.computer.settings.pilot_position->longitude()};
    case bp::RESET_COORDINATE_SOURCE_MANUAL:
      if (!settings.has_reset_coordinate()) return std::nullopt;
      return nmea::LatLon{settings.reset_coordinate().latitude(),
                          settings.reset_coordinate().longitude()};
    case bp::RESET_COORDINATE_SOURCE_BLUEYE_GNSS:
      return core.gnss();
    default:
      return std::nullopt;
  }
}

bool resetPosition(BlueyeCore& core, const bp::ResetPositionCtrl& message) {
  const bp::ResetPositionSettings& settings = message.settings();
  if (!onEarth(settings.reset_coordinate())) return false;
  BlueyeReset how;
  how.position = resetPlace(core, settings);
  how.gyro_only = settings.heading_mode() == bp::HEADING_MODE_GYRO_ONLY;
  if (settings.heading_source_during_reset() == bp::HEADING_SOURCE_MANUAL_INPUT) {
    if (settings.manual_heading() < 0.0F || settings.manual_heading() > 360.0F) return false;
    how.manual_heading_deg = settings.manual_heading();
  }
  if (!how.position) {
    const bool device =
        settings.reset_coordinate_source() == bp::RESET_COORDINATE_SOURCE_DEVICE_GPS;
    core.notify(device ? bp::NOTIFICATION_TYPE_USER_POSITION_IS_UNKNOWN
                       : bp::NOTIFICATION_TYPE_DRONE_POSITION_IS_UNKNOWN,
                bp::NOTIFICATION_LEVEL_WARNING);
  }
  core.resetPosition(how);
  return true;
}

bool tiltVelocity(BlueyeCore& core, const bp::TiltVelocityCtrl& message) {
  core.computer.payload.tilt_velocity = signedUnit(message.velocity().value());
  return true;
}

bool tiltStabilization(BlueyeCore& core, const bp::TiltStabilizationCtrl& message) {
  core.computer.payload.tilt_stabilized = message.state().enabled();
  core.announce("TiltStabilizationTel");
  return true;
}

bool waterDensity(BlueyeCore& core, const bp::WaterDensityCtrl& message) {
  constexpr double kLightest = 900.0;
  constexpr double kHeaviest = 1300.0;  // the Dead Sea has 1240
  const double value = message.density().value();
  if (value < kLightest || value > kHeaviest) return false;
  core.computer.settings.water_density_g_l = value;
  return true;
}

bool systemTime(BlueyeCore& core, const bp::SystemTimeCtrl& message) {
  const auto time = toUtc(message.system_time().unix_timestamp());
  if (!time) return false;
  core.computer.clock_offset = *time - core.now;
  core.announce("DroneTimeTel");
  return true;
}

bool gripper(BlueyeCore& core, const bp::GripperCtrl& message) {
  if (!core.has(BlueyeDevice::Gripper)) return false;
  core.computer.payload.grip_velocity = signedUnit(message.gripper_velocities().grip_velocity());
  core.computer.payload.rotate_velocity =
      signedUnit(message.gripper_velocities().rotate_velocity());
  return true;
}

bool genericServo(BlueyeCore& core, const bp::GenericServoCtrl& message) {
  if (!core.has(BlueyeDevice::Servo)) return false;
  core.computer.payload.servo_target = unit(message.servo().value());
  return true;
}

bool multibeamServo(BlueyeCore& core, const bp::MultibeamServoCtrl& message) {
  if (!core.has(BlueyeDevice::MultibeamServo)) return false;
  constexpr double kLimit = BlueyePayload::kMultibeamLimit_deg;
  core.computer.payload.multibeam_servo_target_deg =
      std::clamp<double>(message.servo().angle(), -kLimit, kLimit);
  return true;
}

void switchGuestPorts(BlueyeCore& core, bool on) {
  core.computer.guest_ports_off = !on;
  core.computer.guest_ports_on_again = UtcTime{0};
  core.announce("DroneInfoTel");
  core.announce("GuestPortCurrentTel");
}

bool restartGuestPorts(BlueyeCore& core, const bp::RestartGuestPortsCtrl& message) {
  const double off_s = message.restart_info().power_off_duration();
  if (off_s < 0.0 || off_s > 3600.0) return false;
  switchGuestPorts(core, true);
  core.computer.guest_ports_on_again =
      core.now + std::chrono::duration_cast<UtcTime>(std::chrono::duration<double>{off_s});
  return true;
}

bool configureMultibeam(BlueyeCore& core, const bp::MultibeamConfig& config) {
  if (!core.has(BlueyeDevice::Multibeam)) return false;
  core.computer.multibeam.configure(config);
  core.announce("MultibeamConfigTel");
  return true;
}

bool activateMultibeam(BlueyeCore& core, const bp::ActivateMultibeamCtrl& message) {
  if (!core.has(BlueyeDevice::Multibeam)) return false;
  if (message.has_config()) configureMultibeam(core, message.config());
  core.computer.multibeam.activate(true);
  core.announce("MultibeamDiscoveryTel");
  return true;
}

bool tracking(BlueyeCore& core, const bp::SetSotTargetCtrl& message) {
  bp::SotState& state = core.computer.settings.tracking;
  state.set_state(bp::SotState::STATE_TRACKING);
  *state.mutable_bounding_box() = message.bounding_box();
  state.set_image_width(message.image_width());
  state.set_image_height(message.image_height());
  core.announce("SotStateTel");
  return true;
}

void addMotion(std::vector<BlueyeControl>& all) {
  all.push_back(control<bp::MotionInputCtrl>(motionInput));
  all.push_back(control<bp::WatchdogCtrl>(watchdog));
  all.push_back(mode<bp::AutoDepthCtrl>(&BlueyeModes::auto_depth));
  all.push_back(mode<bp::AutoHeadingCtrl>(&BlueyeModes::auto_heading));
  all.push_back(mode<bp::AutoAltitudeCtrl>(&BlueyeModes::auto_altitude));
  all.push_back(mode<bp::StationKeepingCtrl>(&BlueyeModes::station_keeping));
  all.push_back(mode<bp::WeatherVaningCtrl>(&BlueyeModes::weather_vaning));
  all.push_back(mode<bp::AutoPilotSurgeYawCtrl>(&BlueyeModes::auto_pilot_surge_yaw));
  all.push_back(mode<bp::AutoPilotHeaveCtrl>(&BlueyeModes::auto_pilot_heave));
  all.push_back(control<bp::RunMissionCtrl>([](BlueyeCore& core, const bp::RunMissionCtrl&) {
    core.computer.mission.run(core);
    return true;
  }));
  all.push_back(control<bp::PauseMissionCtrl>([](BlueyeCore& core, const bp::PauseMissionCtrl&) {
    core.computer.mission.pause(core);
    return true;
  }));
  all.push_back(control<bp::ClearMissionCtrl>([](BlueyeCore& core, const bp::ClearMissionCtrl&) {
    core.computer.mission.clear(core);
    return true;
  }));
}

void addPosition(std::vector<BlueyeControl>& all) {
  all.push_back(control<bp::PilotGPSPositionCtrl>(pilotPosition));
  all.push_back(control<bp::ResetPositionCtrl>(resetPosition));
  all.push_back(control<bp::ResetOdometerCtrl>([](BlueyeCore& core, const bp::ResetOdometerCtrl&) {
    core.computer.navigation.resetOdometer();
    return true;
  }));
  all.push_back(
      control<bp::CalibrateDvlGyroCtrl>([](BlueyeCore& core, const bp::CalibrateDvlGyroCtrl&) {
        core.computer.navigation.calibrateGyro();
        return core.has(BlueyeDevice::Dvl);
      }));
  all.push_back(
      control<bp::StartCalibrationCtrl>([](BlueyeCore& core, const bp::StartCalibrationCtrl&) {
        core.computer.payload.startCalibration();
        core.announce("CalibrationStateTel");
        return true;
      }));
  all.push_back(
      control<bp::CancelCalibrationCtrl>([](BlueyeCore& core, const bp::CancelCalibrationCtrl&) {
        core.computer.payload.endCalibration();
        core.announce("CalibrationStateTel");
        return true;
      }));
  all.push_back(
      control<bp::FinishCalibrationCtrl>([](BlueyeCore& core, const bp::FinishCalibrationCtrl&) {
        core.computer.payload.endCalibration();
        core.announce("CalibrationStateTel");
        return true;
      }));
  all.push_back(control<bp::WaterDensityCtrl>(waterDensity));
  all.push_back(control<bp::SystemTimeCtrl>(systemTime));
  all.push_back(control<bp::PingerConfigurationCtrl>(
      [](BlueyeCore& core, const bp::PingerConfigurationCtrl& message) {
        core.computer.settings.pinger = message.configuration();
        return true;
      }));
}

void addPayload(std::vector<BlueyeControl>& all) {
  all.push_back(control<bp::LightsCtrl>(lights));
  all.push_back(control<bp::GuestportLightsCtrl>(guestPortLights));
  all.push_back(control<bp::LaserCtrl>(laser));
  all.push_back(control<bp::TiltVelocityCtrl>(tiltVelocity));
  all.push_back(control<bp::TiltStabilizationCtrl>(tiltStabilization));
  all.push_back(control<bp::RecordCtrl>(record));
  all.push_back(control<bp::TakePictureCtrl>(takePicture));
  all.push_back(control<bp::GripperCtrl>(gripper));
  all.push_back(control<bp::GenericServoCtrl>(genericServo));
  all.push_back(control<bp::MultibeamServoCtrl>(multibeamServo));
  all.push_back(
      control<bp::ActivateGuestPortsCtrl>([](BlueyeCore& core, const bp::ActivateGuestPortsCtrl&) {
        switchGuestPorts(core, true);
        return true;
      }));
  all.push_back(control<bp::DeactivateGuestPortsCtrl>(
      [](BlueyeCore& core, const bp::DeactivateGuestPortsCtrl&) {
        switchGuestPorts(core, false);
        return true;
      }));
  all.push_back(control<bp::RestartGuestPortsCtrl>(restartGuestPorts));
  all.push_back(control<bp::SetMultibeamConfigCtrl>(
      [](BlueyeCore& core, const bp::SetMultibeamConfigCtrl& message) {
        return configureMultibeam(core, message.config());
      }));
  all.push_back(control<bp::ActivateMultibeamCtrl>(activateMultibeam));
  all.push_back(control<bp::DeactivateMultibeamCtrl>(
      [](BlueyeCore& core, const bp::DeactivateMultibeamCtrl&) {
        core.computer.multibeam.activate(false);
        core.announce("MultibeamDiscoveryTel");
        return true;
      }));
  all.push_back(control<bp::SetAquaTrollParameterUnitCtrl>(
      [](BlueyeCore& core, const bp::SetAquaTrollParameterUnitCtrl& message) {
        core.announce("AquaTrollSensorParametersTel");
        return core.computer.aqua_troll.setUnit(message.parameter_info());
      }));
  all.push_back(control<bp::SetAquaTrollConnectionStatusCtrl>(
      [](BlueyeCore& core, const bp::SetAquaTrollConnectionStatusCtrl& message) {
        core.computer.aqua_troll.connect(message.connection_status().connected());
        core.announce("AquaTrollProbeMetadataTel");
        return true;
      }));
  all.push_back(control<bp::StartDiveCtrl>([](BlueyeCore&, const bp::StartDiveCtrl&) {
    return true;  // a mark in the drone's log, nothing that shows
  }));
  all.push_back(control<bp::EndDiveCtrl>([](BlueyeCore&, const bp::EndDiveCtrl&) { return true; }));
  all.push_back(control<bp::FormatRemovableStorageDeviceCtrl>(
      [](BlueyeCore& core, const bp::FormatRemovableStorageDeviceCtrl&) {
        core.computer.payload.formatting_s = 5.0;
        core.announce("RemovableStorageTel");
        return true;
      }));
}

void addLater(std::vector<BlueyeControl>& all) {
  all.push_back(control<bp::SetTurbidityFilterCtrl>(
      [](BlueyeCore& core, const bp::SetTurbidityFilterCtrl& message) {
        core.computer.settings.turbidity = message.turbidity_filter();
        core.announce("TurbidityFilterTel");
        return true;
      }));
  all.push_back(control<bp::SetColorCorrectionCtrl>(
      [](BlueyeCore& core, const bp::SetColorCorrectionCtrl& message) {
        core.computer.settings.color = message.color_correction_filter();
        core.announce("ColorCorrectionTel");
        return true;
      }));
  all.push_back(control<bp::CameraPanTiltZoomCtrl>(
      [](BlueyeCore& core, const bp::CameraPanTiltZoomCtrl& message) {
        core.computer.settings.pan_tilt_zoom = message.camera_pan_tilt_zoom();
        core.announce("CameraPanTiltZoomTel");
        return true;
      }));
  all.push_back(
      control<bp::StartLogStreamingCtrl>([](BlueyeCore& core, const bp::StartLogStreamingCtrl&) {
        core.computer.settings.log_streaming = true;
        return true;
      }));
  all.push_back(
      control<bp::StopLogStreamingCtrl>([](BlueyeCore& core, const bp::StopLogStreamingCtrl&) {
        core.computer.settings.log_streaming = false;
        return true;
      }));
  all.push_back(
      control<bp::AnnotationCtrl>([](BlueyeCore& core, const bp::AnnotationCtrl& message) {
        core.computer.last_annotation = message.annotation();
        core.announce("AnnotationTel");
        return true;
      }));
  all.push_back(control<bp::SetSotTargetCtrl>(tracking));
  all.push_back(
      control<bp::ClearSotTargetCtrl>([](BlueyeCore& core, const bp::ClearSotTargetCtrl&) {
        core.computer.settings.tracking.Clear();
        core.computer.settings.tracking.set_state(bp::SotState::STATE_IDLE);
        core.announce("SotStateTel");
        return true;
      }));
}

}  // namespace

const std::vector<BlueyeControl>& blueyeControls() {
  static const std::vector<BlueyeControl> kAll = [] {
    std::vector<BlueyeControl> all;
    addMotion(all);
    addPosition(all);
    addPayload(all);
    addLater(all);
    return all;
  }();
  return kAll;
}

const BlueyeControl* findBlueyeControl(const std::string& name) {
  for (const BlueyeControl& row : blueyeControls()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace frontseat_driver::sim
