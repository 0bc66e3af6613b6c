#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/values.h"

namespace frontseat_driver::protocol {

/// A unit as people write it, and what a name that carries it ends with.
struct Unit {
  std::string_view symbol;
  std::string_view suffix;
};

namespace unit {
constexpr Unit kNone{"", ""};
constexpr Unit kDegrees{"deg", "_deg"};
constexpr Unit kDegreesPerSecond{"deg/s", "_deg_s"};
constexpr Unit kMeters{"m", "_m"};
constexpr Unit kMetersPerSecond{"m/s", "_m_s"};
constexpr Unit kKnots{"kn", "_kn"};
constexpr Unit kKilometersPerHour{"km/h", "_km_h"};
constexpr Unit kRpm{"rpm", "_rpm"};
constexpr Unit kPercent{"%", "_pct"};
constexpr Unit kVolts{"V", "_v"};
constexpr Unit kCelsius{"degC", "_c"};
constexpr Unit kKilopascals{"kPa", "_kpa"};
constexpr Unit kMicrosiemensPerCentimeter{"uS/cm", "_us_cm"};
constexpr Unit kAcceleration{"m/s2 or g", ""};   ///< by vehicle: older boats send g
constexpr Unit kTurnRate{"rad/s or deg/s", ""};  ///< by firmware
}  // namespace unit

/// One field of a sentence: `number` counts from 1 after the address, as the documents do; `name`
/// has underscores for blanks. Name and unit suffix together are the struct's member.
struct Field {
  int number;
  std::string_view name;
  Unit unit = unit::kNone;
};

/// Is shown every field of a sentence, in the order of the wire, whether it has a value or not:
/// what prints sentences needs to know none of them.
class FieldVisitor {
 public:
  using Words = std::initializer_list<std::string_view>;

  virtual ~FieldVisitor() = default;

  virtual void time(const Field& field, const std::optional<nmea::TimeOfDay>& value) = 0;
  virtual void date(const Field& field, const std::optional<nmea::Date>& value) = 0;
  /// Four fields from `field.number` on: latitude, N or S, longitude, E or W.
  virtual void position(const Field& field, const std::optional<nmea::LatLon>& value) = 0;
  virtual void number(const Field& field, const std::optional<double>& value) = 0;
  virtual void integer(const Field& field, const std::optional<std::int64_t>& value) = 0;
  virtual void flag(const Field& field, const std::optional<bool>& value) = 0;
  /// `value` is an index into `words`.
  virtual void choice(const Field& field, const std::optional<std::size_t>& value, Words words) = 0;
  virtual void text(const Field& field, std::string_view value) = 0;  ///< empty: blank
};

}  // namespace frontseat_driver::protocol
