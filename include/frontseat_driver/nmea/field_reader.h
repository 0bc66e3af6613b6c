#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/decoded.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::nmea {

struct Field;

/// What was wrong with the fields of a sentence: how many, and the first one.
struct FieldFaults {
  int count = 0;
  Failure first{Fault::BadValue, 0};
};

/// Reads the fields of a sentence one after the other, straight down like the document.
///
/// Every call takes one field (latLon takes four). An empty field is no data: nothing is returned
/// and nothing is wrong. A field that cannot be read returns nothing too and is kept in faults();
/// reading goes on. Blanks around a value are skipped. Nothing allocates, throws or looks at the
/// locale.
class FieldReader {
 public:
  /// Far beyond what a vehicle measures; what is computed from it is still a finite number.
  static constexpr double kLargest = 1e30;

  explicit FieldReader(const Sentence& sentence);

  /// A decimal number, with or without sign, point, or exponent; correctly rounded, as strtod does,
  /// whatever the number of digits. `nan` and `inf` of any sign and case are no data (a standing
  /// Heron sends them). Beyond kLargest is OutOfRange.
  std::optional<double> number() {
    double value = 0.0;
    return read(value) ? std::optional<double>{value} : std::nullopt;
  }

  /// A number within [low, high]; one outside is OutOfRange and no data.
  std::optional<double> numberIn(double low, double high) {
    double value = 0.0;
    if (!read(value)) return std::nullopt;
    if (value >= low && value <= high) return value;
    note(Fault::OutOfRange);
    return std::nullopt;
  }

  /// A whole number within [low, high]; decimals are refused unless they are zeros.
  std::optional<std::int64_t> integer(
      std::int64_t low = std::numeric_limits<std::int64_t>::min(),
      std::int64_t high = std::numeric_limits<std::int64_t>::max()) {
    std::int64_t value = 0;
    return read(value, low, high) ? std::optional<std::int64_t>{value} : std::nullopt;
  }

  /// True for the text `yes`, false for `no`; any other is BadValue.
  std::optional<bool> either(std::string_view yes, std::string_view no) {
    const std::string_view field = text();
    if (field.empty()) return std::nullopt;
    if (field == yes) return true;
    if (field != no) note(Fault::BadValue);
    return field == no ? std::optional<bool>{false} : std::nullopt;
  }

  /// The same for single letters.
  std::optional<bool> either(char yes, char no) {
    const char found = letter();
    if (found == yes) return true;
    if (found == no) return false;
    if (found != ' ') note(Fault::BadValue);
    return std::nullopt;
  }

  /// hhmmss with any decimals, cut off below the microsecond; seconds may read 60.
  std::optional<TimeOfDay> timeOfDay() {
    TimeOfDay time{};
    return read(time) ? std::optional<TimeOfDay>{time} : std::nullopt;
  }

  /// ddmmyy; years 80..99 are of the last century. A day that its month lacks is OutOfRange.
  std::optional<Date> date();

  /// Latitude, N or S, longitude, E or W: four fields. Nothing if any of them is blank. Minutes up
  /// to 60, because vehicles round them; a sign is BadValue, beyond 90 or 180 degrees OutOfRange.
  std::optional<LatLon> latLon(DegreeSplit split) {
    LatLon out;
    const bool latitude = readDegrees(out.latitude_deg, split, 2, 90.0);
    const std::optional<bool> north = either('N', 'S');
    const bool longitude = readDegrees(out.longitude_deg, split, 3, 180.0);
    const std::optional<bool> east = either('E', 'W');
    if (!latitude || !north || !longitude || !east) return std::nullopt;
    if (!*north) out.latitude_deg = -out.latitude_deg;
    if (!*east) out.longitude_deg = -out.longitude_deg;
    return out;
  }

  /// The field as it is; empty when blank or missing. Blanks around it are taken off.
  std::string_view text();

  /// From here on the sentence may end without a MissingField fault.
  void optionalFromHere() { optional_ = true; }

  /// Fields not read yet.
  int remaining() const;

  const FieldFaults& faults() const { return faults_; }

 private:
  // These give the value in an argument: an std::optional returned from a function that is not
  // inline goes through memory in pieces that the processor cannot put together again quickly.
  bool read(double& out);
  bool read(std::int64_t& out, std::int64_t low, std::int64_t high);
  bool read(TimeOfDay& out);
  bool readDegrees(double& out, DegreeSplit split, int degree_digits, double limit);

  // For fields that are not written as all vehicles write them.
  bool readTheLongWay(std::string_view text, double& out);
  bool readTheLongWay(std::string_view text, TimeOfDay& out);
  bool readDegreesTheLongWay(std::string_view text, double& out, DegreeSplit split,
                             int degree_digits, double limit);

  bool set(TimeOfDay& out, int hours, int minutes, std::int64_t microseconds);
  bool set(double& out, std::uint64_t degrees, double minutes, double limit);

  Field take();
  Field missing();
  Field takeOverBlocks();
  void findMarks();
  char letter();
  bool isShort(const Field& field, std::ptrdiff_t digits) const;
  void note(Fault fault);
  bool refuse(Fault fault);
  bool refuseField(std::string_view text);

  const char* begin_;  ///< of all fields
  const char* end_;
  const char* at_;     ///< where the next field begins; beyond end_ if there is none
  const char* block_;  ///< up to 64 characters that commas and points were sought in at once
  // A bit for each character of the block that was not come to yet, the first one lowest. The end
  // counts as both.
  std::uint64_t commas_;
  std::uint64_t marks_;    ///< commas and points
  bool optional_ = false;  ///< a field that is not there is no fault
  int field_ = 0;          ///< number of the field read last
  FieldFaults faults_;
};

}  // namespace frontseat_driver::nmea
