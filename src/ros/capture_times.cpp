#include "capture_times.h"

#include <algorithm>
#include <utility>

#include "frontseat_driver/capture/text_reader.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/session/to_vehicle.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;

// Sentences overtake each other by less; a clock that goes back further was set.
constexpr auto kSetBack = 5s;

}  // namespace

std::optional<CaptureTimes::Start> CaptureTimes::readStart(const std::string& text) {
  constexpr std::size_t kDate = 10;  // 2014-11-19
  const bool number = text.find_first_not_of("0123456789.") == std::string::npos;
  if (!number && text.find('-') == std::string::npos) return std::nullopt;
  const bool day_only = text.size() == kDate && text.find('-') != std::string::npos;
  const auto time = capture::readPrefix(day_only ? text + "T00:00:00Z" : text).time;
  if (!time) return std::nullopt;
  return Start{*time, day_only};
}

CaptureTimes::CaptureTimes(std::optional<vehicle::TimeOfDay> first_time, const Start& start)
    : by_vehicle_(first_time), last_(start.at) {
  if (!first_time) return;
  if (start.day_only) last_ += *first_time;
  ahead_ = vehicle::resolveDate(*first_time, last_) - last_;
}

vehicle::UtcTime CaptureTimes::timeOf(const capture::Entry& entry) {
  last_ = next(entry);
  return last_;
}

vehicle::UtcTime CaptureTimes::next(const capture::Entry& entry) {
  if (entry.time) {
    // The first one has nothing to be held back by.
    const bool first = !std::exchange(stamped_, true);
    return first ? *entry.time : std::max(last_, *entry.time);
  }
  if (stamped_) return last_;
  if (!by_vehicle_) return last_ + kSpacing;
  const auto told = vehicleTimeIn(entry.line);
  if (!told) return last_;
  const vehicle::UtcTime at = vehicle::resolveDate(*told, last_ + ahead_) - ahead_;
  if (at < last_ - kSetBack) ahead_ += at - last_;
  return std::max(last_, at);
}

std::optional<vehicle::TimeOfDay> vehicleTimeIn(std::string_view line) {
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  if (!sentence || !protocol::dialectOf(sentence->talker())) return std::nullopt;
  const auto reading = protocol::decode(*sentence);
  return reading ? session::sentAt(reading->message) : std::nullopt;
}

std::optional<vehicle::TimeOfDay> firstTime(capture::Reader& capture) {
  while (const auto entry = capture.next()) {
    if (const auto time = vehicleTimeIn(entry->line)) return time;
  }
  return std::nullopt;
}

}  // namespace frontseat_driver::ros_layer
