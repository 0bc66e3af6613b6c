#include "frontseat_driver/protocol/velocity_update.h"

#include <cmath>
#include <optional>

#include "fields.h"

namespace frontseat_driver::protocol {
namespace {

/// A Sandshark's rates are differences of angles, which jump where the heading wraps: no rate, but
/// no fault of the sentence either, since a healthy vehicle does it at every wrap.
std::optional<double> rate(nmea::FieldReader& in) {
  const std::optional<double> rate_deg_s = in.number();
  return rate_deg_s && std::abs(*rate_deg_s) > 360.0 ? std::nullopt : rate_deg_s;
}

}  // namespace

VelocityUpdate VelocityUpdate::decode(nmea::FieldReader& in) {
  VelocityUpdate message;
  message.sent_at = in.timeOfDay();
  message.east_m_s = in.number();
  message.north_m_s = in.number();
  message.down_m_s = in.number();
  message.pitch_rate_deg_s = rate(in);
  message.roll_rate_deg_s = rate(in);
  message.yaw_rate_deg_s = rate(in);
  return message;
}

void VelocityUpdate::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(east_m_s, kVelocityDecimals);
  out.number(north_m_s, kVelocityDecimals);
  out.number(down_m_s, kVelocityDecimals);
  out.number(pitch_rate_deg_s, kRateDecimals);
  out.number(roll_rate_deg_s, kRateDecimals);
  out.number(yaw_rate_deg_s, kRateDecimals);
}

void VelocityUpdate::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "east", unit::kMetersPerSecond}, east_m_s);
  out.number({3, "north", unit::kMetersPerSecond}, north_m_s);
  out.number({4, "down", unit::kMetersPerSecond}, down_m_s);
  out.number({5, "pitch_rate", unit::kDegreesPerSecond}, pitch_rate_deg_s);
  out.number({6, "roll_rate", unit::kDegreesPerSecond}, roll_rate_deg_s);
  out.number({7, "yaw_rate", unit::kDegreesPerSecond}, yaw_rate_deg_s);
}

}  // namespace frontseat_driver::protocol
