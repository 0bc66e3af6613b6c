#include "frontseat_driver/protocol/navigation_update.h"

#include "fields.h"

namespace frontseat_driver::protocol {
namespace {

/// "No GPS = 0, otherwise = 1"; kinds of fix as GGA counts them are as good.
std::optional<bool> quality(nmea::FieldReader& in) {
  const auto value = in.integer(0, 9);
  return value ? std::optional<bool>{*value > 0} : std::nullopt;
}

}  // namespace

NavigationUpdate NavigationUpdate::decode(nmea::FieldReader& in, nmea::DegreeSplit split) {
  NavigationUpdate nav;
  nav.sent_at = in.timeOfDay();
  nav.position = in.latLon(split);
  nav.from_gps = quality(in);
  nav.altitude_m = in.number();
  nav.depth_m = in.number();
  nav.heading_deg = heading(in);
  nav.roll_deg = roll(in);
  nav.pitch_deg = pitch(in);
  nav.computed_at = in.timeOfDay();
  return nav;
}

void NavigationUpdate::encode(nmea::SentenceWriter& out) const {
  out.timeOfDay(sent_at);
  out.latLon(position, kMinuteDecimals);
  writeFlag(from_gps, out);
  out.number(altitude_m, kLengthDecimals);
  out.number(depth_m, kLengthDecimals);
  writeHeading(heading_deg, kAngleDecimals, out);
  out.number(roll_deg, kAngleDecimals);
  out.number(pitch_deg, kAngleDecimals);
  out.timeOfDay(computed_at);
}

void NavigationUpdate::describe(FieldVisitor& out) const {
  out.time({1, "sent_at"}, sent_at);
  out.position({2, "position"}, position);
  out.flag({6, "from_gps"}, from_gps);
  out.number({7, "altitude", unit::kMeters}, altitude_m);
  out.number({8, "depth", unit::kMeters}, depth_m);
  out.number({9, "heading", unit::kDegrees}, heading_deg);
  out.number({10, "roll", unit::kDegrees}, roll_deg);
  out.number({11, "pitch", unit::kDegrees}, pitch_deg);
  out.time({12, "computed_at"}, computed_at);
}

}  // namespace frontseat_driver::protocol
