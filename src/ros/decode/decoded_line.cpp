#include "decoded_line.h"

#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/session/to_vehicle.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::decode {
namespace {

using capture::Direction;

/// Up to the first comma or `*`, at most as long as an address can be.
std::string_view addressOf(std::string_view line) {
  const std::string_view body = line.substr(1);
  const std::size_t size = body.substr(0, 9).find_first_of(",*");
  return body.substr(0, size == std::string_view::npos ? 8 : size);
}

bool isOfPayload(std::string_view address) {
  const std::string_view talker = address.substr(0, 2);
  return talker == "BP" || talker == "PY";
}

/// A payload may leave the checksum out, a vehicle may not.
nmea::Decoded<protocol::Reading> read(std::string_view line, Direction direction) {
  const bool to_vehicle = direction == Direction::ToVehicle;
  const auto sentence = nmea::parseSentence(
      line, to_vehicle ? nmea::ChecksumRule::Optional : nmea::ChecksumRule::Required);
  if (!sentence) return sentence.failure();
  return protocol::decode(*sentence);
}

}  // namespace

bool DecodedLine::unknown() const {
  return !reading && reading.failure().fault == nmea::Fault::UnknownType;
}

DecodedLine LineDecoder::decode(const capture::Entry& entry) {
  const std::string_view address = addressOf(entry.line);
  const Direction told_by_talker =
      isOfPayload(address) ? Direction::ToVehicle : Direction::FromVehicle;
  const Direction direction = entry.direction.value_or(told_by_talker);
  DecodedLine line{entry, direction, address, read(entry.line, direction), {}, {}};
  const bool dated = line.reading && direction == Direction::FromVehicle;
  if (dated) line.vehicle_time = continued(session::sentAt(line.reading->message));
  recorded_times_ = recorded_times_ || entry.time;
  line.at = recorded_times_ ? entry.time : vehicle_time_;
  return line;
}

/// Half a day before what it follows at most, so that it goes on over midnight.
std::optional<vehicle::UtcTime> LineDecoder::continued(const std::optional<nmea::TimeOfDay>& time) {
  if (!time) return std::nullopt;
  vehicle_time_ = vehicle_time_ ? vehicle::resolveDate(*time, *vehicle_time_) : *time;
  return vehicle_time_;
}

}  // namespace frontseat_driver::decode
