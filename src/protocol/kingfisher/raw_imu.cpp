#include "frontseat_driver/protocol/kingfisher/raw_imu.h"

#include "../fields.h"

namespace frontseat_driver::protocol::kingfisher {

RawImu RawImu::decode(nmea::FieldReader& in) {
  RawImu message;
  message.sent_at = in.timeOfDay();
  message.rate_x_deg_s = in.number();
  message.rate_y_deg_s = in.number();
  message.rate_z_deg_s = in.number();
  message.acceleration_x = in.number();
  message.acceleration_y = in.number();
  message.acceleration_z = in.number();
  in.optionalFromHere();
  message.measured_at = in.timeOfDay();
  return message;
}

void RawImu::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.number(rate_x_deg_s, kRateDecimals);
  out.number(rate_y_deg_s, kRateDecimals);
  out.number(rate_z_deg_s, kRateDecimals);
  out.number(acceleration_x, kAccelerationDecimals);
  out.number(acceleration_y, kAccelerationDecimals);
  out.number(acceleration_z, kAccelerationDecimals);
  out.timeOfDay(measured_at);
}

void RawImu::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.number({2, "rate_x", unit::kDegreesPerSecond}, rate_x_deg_s);
  out.number({3, "rate_y", unit::kDegreesPerSecond}, rate_y_deg_s);
  out.number({4, "rate_z", unit::kDegreesPerSecond}, rate_z_deg_s);
  out.number({5, "acceleration_x", unit::kAcceleration}, acceleration_x);
  out.number({6, "acceleration_y", unit::kAcceleration}, acceleration_y);
  out.number({7, "acceleration_z", unit::kAcceleration}, acceleration_z);
  out.time({8, "measured_at"}, measured_at);
}

}  // namespace frontseat_driver::protocol::kingfisher
