#pragma once

#include <tuple>

#include "frontseat_driver/protocol/message.h"

namespace frontseat_driver::protocol {

// The fields of every message in the order of the wire, so that tests can compare whole messages.

inline auto values(const NavigationUpdate& m) {
  return std::tie(m.sent_at, m.position, m.from_gps, m.altitude_m, m.depth_m, m.heading_deg,
                  m.roll_deg, m.pitch_deg, m.computed_at);
}
inline auto values(const VelocityUpdate& m) {
  return std::tie(m.sent_at, m.east_m_s, m.north_m_s, m.down_m_s, m.pitch_rate_deg_s,
                  m.roll_rate_deg_s, m.yaw_rate_deg_s);
}
inline auto values(const bluefin::VehicleVersion& m) { return std::tie(m.sent_at, m.version); }
inline auto values(const bluefin::PayloadShutdown& m) { return std::tie(m.sent_at); }
inline auto values(const bluefin::MissionStatus& m) {
  return std::tie(m.sent_at, m.dive_file, m.status, m.details);
}
inline auto values(const bluefin::Acknowledgement& m) {
  return std::tie(m.sent_at, m.command, m.command_time, m.behavior_id, m.status, m.message);
}
inline auto values(const bluefin::BackseatControl& m) {
  return std::tie(m.sent_at, m.backseat_in_control);
}
inline auto values(const bluefin::Dvl& m) {
  return std::tie(m.sent_at, m.bow_m_s, m.starboard_m_s, m.down_m_s, m.beam_range_m,
                  m.temperature_c, m.measured_at);
}
inline auto values(const bluefin::Ctd& m) {
  return std::tie(m.sent_at, m.conductivity_us_cm, m.temperature_c, m.pressure_kpa, m.measured_at);
}
inline auto values(const bluefin::RawVehicleSpeed& m) {
  return std::tie(m.sent_at, m.thruster_rpm, m.water_speed_m_s);
}
inline auto values(const bluefin::BehaviorBegin& m) {
  return std::tie(m.sent_at, m.dive_file, m.number, m.payload_behavior_id, m.behavior_type);
}
inline auto values(const bluefin::BehaviorEnd& m) {
  return std::tie(m.sent_at, m.dive_file, m.number, m.payload_behavior_id, m.behavior_type);
}
inline auto values(const bluefin::SoundSpeed& m) { return std::tie(m.sent_at, m.sound_speed_m_s); }
inline auto values(const bluefin::PayloadVersion& m) { return std::tie(m.sent_at, m.version); }
inline auto values(const bluefin::LogRequest& m) { return std::tie(m.sentence, m.on); }
inline auto values(const bluefin::PayloadStatus& m) { return std::tie(m.sent_at, m.ok, m.message); }
inline auto values(const bluefin::BehaviorChange& m) {
  return std::tie(m.sent_at, m.horizontal, m.vertical, m.vertical_mode, m.speed, m.speed_mode,
                  m.horizontal_mode);
}
inline auto values(const bluefin::AbortMission& m) {
  return std::tie(m.sent_at, m.message, m.with_errors);
}
inline auto values(const kingfisher::RawCompass& m) {
  return std::tie(m.sent_at, m.compass_id, m.heading_deg, m.pitch_deg, m.roll_deg, m.measured_at);
}
inline auto values(const kingfisher::BatteryVoltage& m) {
  return std::tie(m.sent_at, m.battery_id, m.stack_v, m.lowest_cell_v, m.highest_cell_v,
                  m.temperature_c);
}
inline auto values(const kingfisher::RawImu& m) {
  return std::tie(m.sent_at, m.rate_x_deg_s, m.rate_y_deg_s, m.rate_z_deg_s, m.acceleration_x,
                  m.acceleration_y, m.acceleration_z, m.measured_at);
}
inline auto values(const kingfisher::ThrustAndYawRate& m) {
  return std::tie(m.yaw_rate, m.thrust_pct);
}
inline auto values(const kingfisher::HeadingAndSpeed& m) {
  return std::tie(m.heading_deg, m.speed_m_s);
}
inline auto values(const kingfisher::MotorThrust& m) {
  return std::tie(m.port_pct, m.starboard_pct);
}
inline auto values(const gps::Fix& m) {
  return std::tie(m.measured_at, m.position, m.quality, m.satellites, m.hdop, m.altitude_m,
                  m.geoid_separation_m);
}
inline auto values(const gps::MinimumData& m) {
  return std::tie(m.measured_at, m.valid, m.position, m.speed_kn, m.course_deg, m.date);
}
inline auto values(const gps::CourseAndSpeed& m) {
  return std::tie(m.course_true_deg, m.course_magnetic_deg, m.speed_kn, m.speed_km_h);
}

/// The same kind of message with the same values, each to the last bit.
inline bool same(const Message& a, const Message& b) {
  const auto equal = [](const auto& x, const auto& y) {
    if constexpr (std::is_same_v<decltype(x), decltype(y)>) return values(x) == values(y);
    return false;
  };
  return std::visit(equal, a, b);
}

}  // namespace frontseat_driver::protocol
