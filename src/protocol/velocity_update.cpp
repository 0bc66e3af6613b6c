#include "frontseat_driver/protocol/velocity_update.h"

#include "fields.h"

namespace frontseat_driver::protocol {
namespace {

/// A Sandshark's rates are differences of angles: they jump where the heading wraps.
std::optional<double> rate(nmea::FieldReader& in) { return in.numberIn(-360.0, 360.0); }

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

}  // namespace frontseat_driver::protocol
