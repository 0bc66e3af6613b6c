#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "closed_loop.h"

namespace frontseat_driver::closed_loop {

/// The fields of a sentence in place, its address first, without `$` and checksum.
struct Fields {
  explicit Fields(std::string_view sentence);

  static constexpr std::size_t kMost = 24;
  std::array<std::string_view, kMost> at;
  std::size_t count = 0;
};

/// hhmmss.sss in milliseconds since midnight, seconds up to 60; nothing for anything else.
std::optional<std::int64_t> milliseconds(std::string_view time);

/// `$`, printable text, `*` and the right checksum.
bool isSound(std::string_view line);

/// What decides besides the message how a command is written.
struct WritingRules {
  session::CommandFormat format;
  double max_speed_m_s = 2.0;
  double max_yaw_rate_rad_s = 1.0;
};

/// Meridian convergence in degrees by the sphere's formula, right to a thousandth of a degree
/// within a UTM zone: not how the driver works it out.
double sphereConvergence_deg(double latitude_deg, double longitude_deg);

/// How a commanding message has to stand on the wire, worked out from the message's definition
/// (interface, nmea.md) and not with the driver's conversions.
class Written {
 public:
  /// `convergence_deg`: of the vehicle's headings, empty while it is not known. Nothing for a
  /// message that has to be refused.
  static std::optional<Written> of(const Wanted& wanted, const WritingRules& rules,
                                   std::optional<double> convergence_deg);

  /// Whether a sentence says this; blank fields may be filled with present values if `filled`.
  bool matches(const Fields& sentence, bool filled) const;

  protocol::Dialect dialect() const { return dialect_; }
  bool moves() const { return moves_; }  ///< a boat's motors turn

 private:
  struct Field {
    std::optional<double> value;
    double tolerance = 0.0;
    bool circle = false;  ///< degrees that end at 360
  };

  void add(double value, double tolerance, bool circle = false);
  void add(std::optional<double> value, double tolerance);
  static bool same(const Field& field, std::string_view text);
  bool behavior(const Behavior& message, const WritingRules& rules,
                std::optional<double> convergence_deg);
  bool drive(const Drive& message, const WritingRules& rules);
  bool helm(double thrust, double yaw_rate_ccw, const WritingRules& rules);
  bool course(const Course& message, std::optional<double> convergence_deg);
  bool velocity(const geometry_msgs::Twist& message, const WritingRules& rules);

  protocol::Dialect dialect_ = protocol::Dialect::Kingfisher;
  std::string_view address_;
  std::array<Field, 8> fields_;
  std::size_t count_ = 0;
  bool moves_ = true;
};

}  // namespace frontseat_driver::closed_loop
