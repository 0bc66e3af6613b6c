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

}  // namespace frontseat_driver::protocol::kingfisher
