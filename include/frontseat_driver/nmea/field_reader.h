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

  /// A decimal number, with or without sign, point, or exponent; correctly rounded, as strtod does,
  /// whatever the number of digits. `nan` and `inf` of any sign and case are no data (a standing
  /// Heron sends them). Too large for a double is OutOfRange.
  std::optional<double> number();

  /// A number within [low, high]; one outside is OutOfRange and no data.
  std::optional<double> numberIn(double low, double high);

  /// A whole number within [low, high]; decimals are refused unless they are zeros.
  std::optional<std::int64_t> integer(std::int64_t low = std::numeric_limits<std::int64_t>::min(),
                                      std::int64_t high = std::numeric_limits<std::int64_t>::max());

  /// True for the text `yes`, false for `no`; any other is BadValue.
  std::optional<bool> either(std::string_view yes, std::string_view no);

  /// hhmmss with any decimals, cut off below the microsecond; seconds may read 60.
  std::optional<TimeOfDay> timeOfDay();

  /// ddmmyy; years 80..99 are of the last century. A day that its month lacks is OutOfRange.
  std::optional<Date> date();

  /// Latitude, N or S, longitude, E or W: four fields. Nothing if any of them is blank. Minutes up
  /// to 60, because vehicles round them; a sign is BadValue, beyond 90 or 180 degrees OutOfRange.
  std::optional<LatLon> latLon(DegreeSplit split);

  /// The field as it is; empty when blank or missing. Blanks around it are taken off.
  std::string_view text();

  /// From here on the sentence may end without a MissingField fault.
  void optionalFromHere() { optional_ = true; }

  /// Fields not read yet.
  int remaining() const;

  const FieldFaults& faults() const { return faults_; }

 private:
  bool begin();
  bool finish(const char* at);
  std::string_view take();
  void note(Fault fault);
  std::nullopt_t refuse(Fault fault);
  std::nullopt_t refuseField();
  std::optional<double> degrees(DegreeSplit split, int degree_digits, double limit);

  std::string_view fields_;  ///< all of them
  const char* at_;           ///< where the next field begins
  const char* end_;
  bool ended_;             ///< no field left, not even an empty one
  bool optional_ = false;  ///< a field that is not there is no fault
  int field_ = 0;          ///< number of the field read last
  FieldFaults faults_;
};

}  // namespace frontseat_driver::nmea
