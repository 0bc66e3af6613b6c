#include "summary.h"

#include <algorithm>
#include <variant>

namespace frontseat_driver::decode {
namespace {

using std::chrono::nanoseconds;
using Seconds = std::chrono::duration<double>;

std::uint64_t pack(std::string_view address) {
  std::uint64_t key = 0;
  for (const char c : address) key = (key << 8) | static_cast<unsigned char>(c);
  return key;
}

}  // namespace

void Occurrences::add(const Occurrences& one) {
  if (count == 0) {
    first_line = one.first_line;
    first_at = one.first_at;
  }
  ++count;
  largest = std::max(largest, one.largest);
}

std::optional<double> SentenceFigures::rate_hz() const {
  if (!earliest || *latest <= *earliest) return std::nullopt;
  return static_cast<double>(count - 1) / Seconds(*latest - *earliest).count();
}

void Summary::add(const DecodedLine& line) {
  ++lines_;
  if (line.direction == capture::Direction::FromVehicle) ++from_vehicle_;
  addRecordedTime(line);
  addTimes(line, all_);
  addFaults(line);
  if (!line.reading && !line.unknown()) return;
  if (SentenceFigures* const figures = figuresOf(line)) {
    const bool clock_back =
        line.vehicle_time && figures->vehicle_time && *line.vehicle_time < *figures->vehicle_time;
    if (clock_back) {
      vehicle_goes_back_.add(
          here(line, Seconds(*figures->vehicle_time - *line.vehicle_time).count()));
    }
    addTimes(line, *figures);
  }
  if (!line.reading) return;
  addPosition(line);
  acks_.add(line);
}

void Summary::addTimes(const DecodedLine& line, SentenceFigures& figures) {
  ++figures.count;
  if (line.vehicle_time) figures.vehicle_time = line.vehicle_time;
  if (!line.at) return;
  figures.earliest = std::min(figures.earliest.value_or(*line.at), *line.at);
  figures.latest = std::max(figures.latest.value_or(*line.at), *line.at);
  if (figures.last && *line.at - *figures.last > figures.longest_gap) {
    figures.longest_gap = *line.at - *figures.last;
    figures.gap_begins = figures.last;
  }
  figures.last = line.at;
}

void Summary::addRecordedTime(const DecodedLine& line) {
  if (!line.entry.time) return;
  recorded_times_ = true;
  auto& last = line.direction == capture::Direction::ToVehicle ? recorded_to_vehicle_
                                                               : recorded_from_vehicle_;
  if (last && *line.entry.time < *last) {
    record_goes_back_.add(here(line, Seconds(*last - *line.entry.time).count()));
  }
  last = line.entry.time;
}

void Summary::addFaults(const DecodedLine& line) {
  if (line.reading) {
    if (line.reading->faults.count > 0) bad_fields_.add(here(line));
    return;
  }
  switch (line.reading.failure().fault) {
    case nmea::Fault::UnknownType:
      ++unknown_;
      return;
    case nmea::Fault::BadChecksum:
      return bad_checksums_.add(here(line));
    case nmea::Fault::MissingChecksum:
      return missing_checksums_.add(here(line));
    default:
      return malformed_.add(here(line));
  }
}

void Summary::addPosition(const DecodedLine& line) {
  const auto* const nav = std::get_if<protocol::NavigationUpdate>(&line.reading->message);
  if (nav == nullptr || !nav->position || !line.at) return;
  const nmea::LatLon& position = *nav->position;
  if (position.latitude_deg == 0.0 && position.longitude_deg == 0.0)
    return;  // before the first fix
  const vehicle::Position neutral{position.latitude_deg, position.longitude_deg};
  if (jump_filter_.accept(neutral, vehicle::SteadyTime{*line.at})) return;
  jumps_.add(here(line, jump_filter_.latestJump_m()));
}

SentenceFigures* Summary::figuresOf(const DecodedLine& line) {
  const std::uint64_t key = pack(line.address);
  const auto found = kinds_.find(key);
  if (found != kinds_.end()) return &found->second;
  if (kinds_.size() == kMostKinds) {
    ++other_kinds_;
    return nullptr;
  }
  SentenceFigures& figures = kinds_[key];
  figures.title = line.reading ? protocol::titleOf(line.reading->message) : "unknown sentence";
  return &figures;
}

Occurrences Summary::here(const DecodedLine& line, double size) const {
  return {1, lines_, line.at, size};
}

}  // namespace frontseat_driver::decode
