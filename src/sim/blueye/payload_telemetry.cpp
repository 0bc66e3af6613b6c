#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"
#include "telemetry_kinds.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kWall_mm = 12.4;  // what the thickness gauge is held against
constexpr float kFramesPerSecond = 30.0F;

/// The document names no value for a camera that does not record; the vendor's library says -1.
std::int32_t secondsOf(const BlueyeRecorder& recorder) {
  return recorder.on ? static_cast<std::int32_t>(recorder.seconds) : -1;
}

bool recordState(BlueyeCore& core, bp::RecordStateTel& message) {
  const BlueyePayload& payload = core.computer.payload;
  bp::RecordState& out = *message.mutable_record_state();
  out.set_main_is_recording(payload.main.on);
  out.set_main_seconds(secondsOf(payload.main));
  out.set_guestport_is_recording(payload.guest_port.on);
  out.set_guestport_seconds(secondsOf(payload.guest_port));
  out.set_multibeam_is_recording(payload.multibeam.on);
  out.set_multibeam_seconds(secondsOf(payload.multibeam));
  if (payload.main.on) out.set_main_fps(kFramesPerSecond);
  if (payload.guest_port.on) out.set_guestport_fps(kFramesPerSecond);
  if (payload.multibeam.on) {
    out.set_multibeam_fps(toFloat(core.computer.multibeam.rateHz()));
  }
  out.set_main_storage_location(payload.locations[0]);
  out.set_guestport_storage_location(payload.locations[1]);
  out.set_multibeam_storage_location(payload.locations[2]);
  return true;
}

bool timeLapse(BlueyeCore& core, bp::TimeLapseStateTel& message) {
  const BlueyeTimeLapse& series = core.computer.payload.time_lapse;
  if (!series.running()) return false;
  bp::TimeLapseState& out = *message.mutable_time_lapse_state();
  out.set_interval(toFloat(series.interval));
  out.set_interval_type(series.type);
  out.set_photos_taken(series.taken);
  return true;
}

/// Against the horizon when it is stabilized, so the hull's pitch is taken off.
bool tiltAngle(BlueyeCore& core, bp::TiltAngleTel& message) {
  const BlueyePayload& payload = core.computer.payload;
  double angle = payload.tilt_deg;
  if (payload.tilt_stabilized) angle -= degrees(core.rov.state().pitch_rad);
  message.mutable_angle()->set_value(
      toFloat(std::clamp(angle, -BlueyePayload::kTiltLimit_deg, BlueyePayload::kTiltLimit_deg)));
  return true;
}

bool thickness(BlueyeCore& core, bp::ThicknessGaugeTel& message) {
  if (!core.has(BlueyeDevice::ThicknessGauge)) return false;
  bp::ThicknessGauge& out = *message.mutable_thickness_gauge();
  const std::uint32_t velocity = core.computer.settings.sound_velocity_m_s;
  out.set_sound_velocity(velocity);
  out.set_echo_count(3);
  out.set_is_measurement_valid(true);
  // It times the echo: with another velocity the same wall seems thicker or thinner.
  out.set_thickness_measurement(toFloat(kWall_mm * velocity / 5920.0 + noise(core, 0.02)));
  return true;
}

bool cpProbe(BlueyeCore& core, bp::CpProbeTel& message) {
  if (!core.has(BlueyeDevice::CpProbe)) return false;
  message.mutable_cp_probe()->set_measurement(toFloat(-0.95 + noise(core, 0.002)));
  message.mutable_cp_probe()->set_is_measurement_valid(true);
  return true;
}

BlueyeWater water(const BlueyeCore& core) {
  return {core.config.water_temperature_c, core.rov.state().depth_m, core.config.water_density_g_l};
}

bool aquaTrollProbe(BlueyeCore& core, bp::AquaTrollProbeMetadataTel& message) {
  if (!core.has(BlueyeDevice::AquaTroll)) return false;
  *message.mutable_probe() = core.computer.aqua_troll.probe(toTimestamp(core.clock()));
  return true;
}

bool aquaTrollSensors(BlueyeCore& core, bp::AquaTrollSensorMetadataTel& message) {
  const BlueyeAquaTroll& probe = core.computer.aqua_troll;
  if (!core.has(BlueyeDevice::AquaTroll) || !probe.connected()) return false;
  *message.mutable_sensors() = probe.sensors(toTimestamp(core.clock()), water(core));
  return true;
}

bool aquaTrollParameters(BlueyeCore& core, bp::AquaTrollSensorParametersTel& message) {
  const BlueyeAquaTroll& probe = core.computer.aqua_troll;
  if (!core.has(BlueyeDevice::AquaTroll) || !probe.connected()) return false;
  *message.mutable_sensors() = probe.parameters(toTimestamp(core.clock()), water(core));
  return true;
}

bool medusa(BlueyeCore& core, bp::MedusaSpectrometerDataTel& message) {
  if (!core.has(BlueyeDevice::Medusa)) return false;
  bp::MedusaSpectrometerData& out = *message.mutable_data();
  out.set_realtime(1.0F);
  out.set_livetime(0.998F);
  const double counts = std::max(0.0, 120.0 + noise(core, 11.0));
  out.set_total(static_cast<std::uint32_t>(counts));
  out.set_countrate(static_cast<std::uint32_t>(counts));
  out.set_cosmics(2);
  *out.mutable_drone_time() = toTimestamp(core.clock());
  *out.mutable_sensor_time() = toTimestamp(core.clock());
  return true;
}

bool multibeamPing(BlueyeCore& core, bp::MultibeamPingTel& message) {
  BlueyeMultibeam& sonar = core.computer.multibeam;
  if (!core.has(BlueyeDevice::Multibeam) || !sonar.active()) return false;
  const VehicleState& state = core.rov.state();
  const double pitch = state.pitch_rad + radians(core.computer.payload.multibeam_servo_deg);
  *message.mutable_ping() = sonar.ping(core.clock(), state.altitude_m, pitch,
                                       core.config.conventions.bearings_in_degrees);
  return true;
}

bool multibeamConfig(BlueyeCore& core, bp::MultibeamConfigTel& message) {
  if (!core.has(BlueyeDevice::Multibeam)) return false;
  *message.mutable_config() = core.computer.multibeam.config();
  return true;
}

bool multibeamDiscovery(BlueyeCore& core, bp::MultibeamDiscoveryTel& message) {
  if (!core.has(BlueyeDevice::Multibeam)) return false;
  bp::MultibeamDiscovery& out = *message.mutable_discovery();
  out.set_enabled(core.computer.multibeam.active());
  out.set_ip("192.168.1.45");
  out.set_mask("255.255.255.0");
  out.set_serial_number("SIM1013");
  out.set_fw_version("1.0");
  if (out.enabled()) out.set_connected_ip("192.168.1.101");
  out.set_device_id(core.computer.multibeam.config().device_id());
  out.mutable_error_flags()->set_out_of_water(core.rov.state().depth_m < 0.05);
  return true;
}

bool genericServo(BlueyeCore& core, bp::GenericServoTel& message) {
  if (!core.has(BlueyeDevice::Servo)) return false;
  message.mutable_servo()->set_value(toFloat(core.computer.payload.servo));
  message.mutable_servo()->set_guest_port_number(bp::GUEST_PORT_NUMBER_PORT_3);
  message.set_set_point(toFloat(core.computer.payload.servo_target));
  return true;
}

bool multibeamServo(BlueyeCore& core, bp::MultibeamServoTel& message) {
  if (!core.has(BlueyeDevice::MultibeamServo)) return false;
  message.mutable_servo()->set_angle(toFloat(core.computer.payload.multibeam_servo_deg));
  message.set_set_point(toFloat(core.computer.payload.multibeam_servo_target_deg));
  return true;
}

}  // namespace

void addPayloadTelemetry(std::vector<BlueyeTelemetry>& all) {
  all.push_back(telemetry<bp::LightsTel>(2.0, [](BlueyeCore& core, bp::LightsTel& m) {
    m.mutable_lights()->set_value(toFloat(core.computer.payload.lights));
    return true;
  }));
  all.push_back(
      telemetry<bp::GuestPortLightsTel>(2.0, [](BlueyeCore& core, bp::GuestPortLightsTel& m) {
        if (!core.has(BlueyeDevice::Light)) return false;
        m.mutable_lights()->set_value(toFloat(core.computer.payload.guest_port_lights));
        return true;
      }));
  all.push_back(telemetry<bp::LaserTel>(2.0, [](BlueyeCore& core, bp::LaserTel& m) {
    if (!core.has(BlueyeDevice::Laser)) return false;
    *m.mutable_laser() = core.computer.payload.laser;
    return true;
  }));
  all.push_back(
      telemetry<bp::PilotGPSPositionTel>(1.0, [](BlueyeCore& core, bp::PilotGPSPositionTel& m) {
        if (!core.computer.settings.pilot_position) return false;
        *m.mutable_position() = *core.computer.settings.pilot_position;
        return true;
      }));
  all.push_back(telemetry<bp::RecordStateTel>(2.0, recordState));
  all.push_back(telemetry<bp::TimeLapseStateTel>(1.0, timeLapse));
  all.push_back(
      telemetry<bp::CalibrationStateTel>(2.0, [](BlueyeCore& core, bp::CalibrationStateTel& m) {
        *m.mutable_calibration_state() = core.computer.payload.calibration;
        return true;
      }));
  all.push_back(
      telemetry<bp::TiltStabilizationTel>(1.0, [](BlueyeCore& core, bp::TiltStabilizationTel& m) {
        m.mutable_state()->set_enabled(core.computer.payload.tilt_stabilized);
        return true;
      }));
  all.push_back(telemetry<bp::NStreamersTel>(1.0, [](BlueyeCore&, bp::NStreamersTel& m) {
    m.mutable_n_streamers()->set_main(0);  // there is no video in here
    return true;
  }));
  all.push_back(telemetry<bp::TiltAngleTel>(10.0, tiltAngle));
  all.push_back(telemetry<bp::ThicknessGaugeTel>(2.0, thickness));
  all.push_back(telemetry<bp::CpProbeTel>(2.0, cpProbe));
  all.push_back(telemetry<bp::AquaTrollProbeMetadataTel>(0.2, aquaTrollProbe));
  all.push_back(telemetry<bp::AquaTrollSensorMetadataTel>(0.2, aquaTrollSensors));
  all.push_back(telemetry<bp::AquaTrollSensorParametersTel>(0.5, aquaTrollParameters));
  all.push_back(telemetry<bp::MedusaSpectrometerDataTel>(1.0, medusa));
  all.push_back(telemetry<bp::MultibeamPingTel>(0.0, multibeamPing));
  all.push_back(telemetry<bp::MultibeamConfigTel>(0.5, multibeamConfig));
  all.push_back(telemetry<bp::MultibeamDiscoveryTel>(0.5, multibeamDiscovery));
  all.push_back(telemetry<bp::GenericServoTel>(2.0, genericServo));
  all.push_back(telemetry<bp::MultibeamServoTel>(2.0, multibeamServo));
}

}  // namespace frontseat_driver::sim
