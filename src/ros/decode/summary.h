#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "../jump_filter.h"
#include "ack_round_trips.h"
#include "decoded_line.h"
#include "frontseat_driver/capture/reader.h"

namespace frontseat_driver::decode {

/// How often a thing was, where it first was, and how far it went.
struct Occurrences {
  std::uint64_t count = 0;
  std::uint64_t first_line = 0;  ///< number of the sentence in the record, from 1
  std::optional<vehicle::UtcTime> first_at;
  double largest = 0.0;

  void add(const Occurrences& one);
};

/// All sentences of one address.
struct SentenceFigures {
  std::string_view title;
  std::uint64_t count = 0;
  std::optional<vehicle::UtcTime> earliest, latest, last;
  std::chrono::nanoseconds longest_gap{};
  std::optional<vehicle::UtcTime> gap_begins;
  std::optional<vehicle::UtcTime> vehicle_time;  ///< of the last one

  /// Between the earliest and the latest; nothing if no time passed.
  std::optional<double> rate_hz() const;
};

/// What a record holds, in figures. Takes constant memory: of kinds of sentences beyond kMostKinds
/// only the number is kept.
class Summary {
 public:
  static constexpr std::size_t kMostKinds = 500;

  /// Faster than this is a jump, as for the driver's parameter `max_jump`, m/s.
  static constexpr double kMaxSpeed_m_s = 50.0;

  void add(const DecodedLine& line);

  /// Several lines of text; `read` is what the reader met besides.
  std::string text(const capture::ReadCounters& read) const;

  std::uint64_t lines() const { return lines_; }

 private:
  void addTimes(const DecodedLine& line, SentenceFigures& figures);
  void addRecordedTime(const DecodedLine& line);
  void addFaults(const DecodedLine& line);
  void addPosition(const DecodedLine& line);
  SentenceFigures* figuresOf(const DecodedLine& line);
  Occurrences here(const DecodedLine& line, double size = 0.0) const;

  std::unordered_map<std::uint64_t, SentenceFigures> kinds_;  ///< by address
  std::uint64_t lines_ = 0;
  std::uint64_t from_vehicle_ = 0;
  std::uint64_t other_kinds_ = 0;
  std::uint64_t unknown_ = 0;
  bool recorded_times_ = false;
  SentenceFigures all_;  ///< whatever the address
  /// Of the last sentence each way: in a bag they stand in the order in which they came there.
  std::optional<vehicle::UtcTime> recorded_from_vehicle_, recorded_to_vehicle_;
  Occurrences bad_checksums_, missing_checksums_, malformed_, bad_fields_;
  Occurrences record_goes_back_, vehicle_goes_back_, jumps_;
  ros_layer::JumpFilter jump_filter_{kMaxSpeed_m_s};
  AckRoundTrips acks_;
};

}  // namespace frontseat_driver::decode
