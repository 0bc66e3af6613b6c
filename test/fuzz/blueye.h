#pragma once

#include <google/protobuf/stubs/logging.h>

#include <chrono>
#include <string>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"
#include "fuzz.h"

namespace frontseat_driver::fuzz {

/// What protobuf writes for each text that is none would be most of the work.
inline google::protobuf::LogHandler* const kSilenced = google::protobuf::SetLogHandler(nullptr);

/// A message as it is on the wire: the name of its type and its bytes.
struct Frames {
  std::string type;
  std::string_view payload;
};

/// The name up to a line feed, without the package unless it has one; then the number of bytes
/// (255: all that is left), then these.
inline Frames anyFrames(Dice& dice) {
  const std::string_view name = dice.line();
  const bool bare = name.find('.') == std::string_view::npos;
  const std::size_t size = dice.byte();
  return {(bare ? "blueye.protocol." : "") + std::string{name},
          size == 255 ? dice.rest() : dice.take(size)};
}

/// Virtual time, from some day on.
inline vehicle::Now nowAt(vehicle::SteadyTime steady) {
  const vehicle::UtcTime utc = std::chrono::seconds{1700000000} + steady.time_since_epoch();
  return {steady, utc, utc};
}

}  // namespace frontseat_driver::fuzz
