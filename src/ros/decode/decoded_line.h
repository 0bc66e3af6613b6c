#pragma once

#include <optional>
#include <string_view>

#include "frontseat_driver/capture/entry.h"
#include "frontseat_driver/protocol/message.h"

namespace frontseat_driver::decode {

/// One line of a record and what it says. Views into the entry's line.
struct DecodedLine {
  capture::Entry entry;
  capture::Direction direction;
  std::string_view address;  ///< of a bad line: what stands in its place
  nmea::Decoded<protocol::Reading> reading;
  /// The vehicle's clock when it made the sentence, where the sentence tells, on a time that goes
  /// on over midnight; its first day is 1970-01-01.
  std::optional<vehicle::UtcTime> vehicle_time;
  /// When it was recorded; in a record without times the latest time of the vehicle's clock.
  std::optional<vehicle::UtcTime> at;

  /// A frame with a right checksum, of a type that is not known.
  bool unknown() const;
};

/// Decodes the lines of one record in their order.
class LineDecoder {
 public:
  DecodedLine decode(const capture::Entry& entry);

 private:
  std::optional<vehicle::UtcTime> continued(const std::optional<nmea::TimeOfDay>& time);

  std::optional<vehicle::UtcTime> vehicle_time_;
  bool recorded_times_ = false;
};

}  // namespace frontseat_driver::decode
