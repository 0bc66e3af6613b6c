#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/decoded.h"
#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::nmea {

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
  explicit FieldReader(const Sentence& sentence);

  /// A decimal number, with or without sign, point, or exponent; correctly rounded, as strtod does.
  /// `nan` and `inf` of any sign and case are no data (a standing Heron sends them).
  std::optional<double> number();

  /// A number within [low, high]; one outside is OutOfRange and no data.
  std::optional<double> numberIn(double low, double high);

  /// A whole number within [low, high]; decimals are refused unless they are zeros.
  std::optional<std::int64_t> integer(
      std::int64_t low = std::numeric_limits<std::int64_t>::min(),
      std::int64_t high = std::numeric_limits<std::int64_t>::max());

  /// hhmmss with any decimals; seconds may read 60.
  std::optional<TimeOfDay> timeOfDay();

  /// ddmmyy; years 80..99 are of the last century.
  std::optional<Date> date();

  /// Latitude, N or S, longitude, E or W: four fields. Nothing if any of them is blank.
  std::optional<LatLon> latLon(DegreeSplit split);

  /// The field as it is; empty when blank or missing. Blanks around it are taken off.
  std::string_view text();

  /// From here on the sentence may end without a MissingField fault.
  void optionalFromHere();

  /// Fields not read yet.
  int remaining() const;

  const FieldFaults& faults() const { return faults_; }
};

}  // namespace frontseat_driver::nmea
