#include "written.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace frontseat_driver::closed_loop {

using protocol::Dialect;

namespace {

constexpr double kDegrees = 57.295779513082321;  // of a radian

bool within(double value, double low, double high) { return value >= low && value <= high; }

double compass(double yaw_rad, double convergence_deg) {
  const double heading = std::fmod(90.0 - yaw_rad * kDegrees - convergence_deg, 360.0);
  return heading < 0.0 ? heading + 360.0 : heading;
}

/// Half of the last digit, and what rounding of the arithmetic takes.
double half(int decimals) { return 0.5 * std::pow(10.0, -decimals) + 1e-6; }

std::optional<double> toNumber(std::string_view text) {
  const std::string copy{text};
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (copy.empty() || *end != '\0') return std::nullopt;
  return value;
}

double rpmAt(double speed, const std::vector<session::SpeedPoint>& table) {
  double from_speed = 0.0;
  double from_rpm = 0.0;
  for (const session::SpeedPoint& point : table) {
    if (speed < point.speed_m_s) {
      const double share = (speed - from_speed) / (point.speed_m_s - from_speed);
      return (1.0 - share) * from_rpm + share * point.rpm;
    }
    from_speed = point.speed_m_s;
    from_rpm = point.rpm;
  }
  return from_rpm;
}

}  // namespace

Fields::Fields(std::string_view sentence) {
  std::string_view rest = sentence.substr(0, sentence.rfind('*'));
  if (!rest.empty()) rest.remove_prefix(1);
  for (bool more = true; more && count < kMost;) {
    const std::size_t comma = rest.find(',');
    more = comma != std::string_view::npos;
    at[count++] = rest.substr(0, comma);
    if (more) rest.remove_prefix(comma + 1);
  }
}

std::optional<std::int64_t> milliseconds(std::string_view time) {
  if (time.size() != 10 || time[6] != '.') return std::nullopt;
  const auto digits = [&](std::size_t from, std::size_t size) {
    std::int64_t value = 0;
    for (const char digit : time.substr(from, size)) value = value * 10 + (digit - '0');
    return value;
  };
  return ((digits(0, 2) * 60 + digits(2, 2)) * 60 + digits(4, 2)) * 1000 + digits(7, 3);
}

bool isSound(std::string_view line) {
  if (line.size() < 4 || line[0] != '$' || line[line.size() - 3] != '*') return false;
  unsigned sum = 0;
  for (const char byte : line.substr(1, line.size() - 4)) {
    if (byte < 0x20 || byte == '*') return false;  // a char above 0x7f is negative
    sum ^= static_cast<unsigned char>(byte);
  }
  const auto is = [](char digit, unsigned value) {
    constexpr std::string_view kUpper = "0123456789ABCDEF";
    constexpr std::string_view kLower = "0123456789abcdef";
    return digit == kUpper[value] || digit == kLower[value];
  };
  return is(line[line.size() - 2], sum >> 4) && is(line[line.size() - 1], sum & 15);
}

double sphereConvergence_deg(double latitude_deg, double longitude_deg) {
  const double middle_deg = std::floor(longitude_deg / 6.0) * 6.0 + 3.0;
  return kDegrees * std::atan(std::tan((longitude_deg - middle_deg) / kDegrees) *
                              std::sin(latitude_deg / kDegrees));
}

std::optional<Written> Written::of(const Wanted& wanted, const WritingRules& rules,
                                   std::optional<double> convergence_deg) {
  Written written;
  bool good = false;
  if (const auto* message = std::get_if<Behavior>(&wanted)) {
    good = written.behavior(*message, rules, convergence_deg);
  } else if (const auto* thrusts = std::get_if<Drive>(&wanted)) {
    good = written.drive(*thrusts, rules);
  } else if (const auto* turn = std::get_if<Helm>(&wanted)) {
    good = within(turn->thrust, -1.0, 1.0) && within(turn->yaw_rate, -M_PI, M_PI) &&
           written.helm(turn->thrust, turn->yaw_rate, rules);
  } else if (const auto* hold = std::get_if<Course>(&wanted)) {
    good = written.course(*hold, convergence_deg);
  } else {
    good = written.velocity(std::get<geometry_msgs::Twist>(wanted), rules);
  }
  if (!good) return std::nullopt;
  return written;
}

void Written::add(double value, double tolerance, bool circle) {
  fields_[count_++] = {value, tolerance, circle};
}

void Written::add(std::optional<double> value, double tolerance) {
  fields_[count_++] = {value, tolerance, false};
}

// BPRMB,time,horizontal,vertical,vertical mode,speed,speed mode,horizontal mode
bool Written::behavior(const Behavior& message, const WritingRules& rules,
                       std::optional<double> convergence_deg) {
  dialect_ = Dialect::Sandshark;
  address_ = "BPRMB";
  const bool heading = message.horizontal_mode == Behavior::HORIZONTAL_HEADING;
  const bool rudder = message.horizontal_mode == Behavior::HORIZONTAL_RUDDER;
  if (message.horizontal_mode > 2 || message.vertical_mode > 4 || message.speed_mode > 2) {
    return false;
  }
  if (!std::isfinite(message.horizontal) || (heading && !convergence_deg)) return false;
  if (rudder && !within(message.horizontal, -M_PI_2, M_PI_2)) return false;
  if (heading) {
    add(compass(message.horizontal, *convergence_deg), 0.01, true);
  } else {
    add(rudder ? std::optional{message.horizontal * kDegrees} : std::nullopt, half(3));
  }
  const bool angle = message.vertical_mode >= Behavior::VERTICAL_PITCH;
  const bool no_vertical = message.vertical_mode == Behavior::VERTICAL_NONE;
  const double most = angle ? M_PI_2 : 6000.0;
  if (!std::isfinite(message.vertical)) return false;
  if (!no_vertical && !within(message.vertical, angle ? -most : 0.0, most)) return false;
  add(no_vertical ? std::nullopt
                  : std::optional{angle ? message.vertical * kDegrees : message.vertical},
      half(3));
  add(no_vertical ? std::nullopt : std::optional{message.vertical_mode - 1.0}, 0.0);
  const bool rpm = message.speed_mode == Behavior::SPEED_RPM;
  const bool no_speed = message.speed_mode == Behavior::SPEED_NONE;
  if (!std::isfinite(message.speed)) return false;
  if (!no_speed && !within(message.speed, rpm ? -1e4 : 0.0, rpm ? 1e4 : 10.0)) return false;
  const auto& table = rules.format.speed_table;
  const bool by_table = !no_speed && !rpm && !table.empty();
  add(no_speed ? std::nullopt
               : std::optional{by_table ? rpmAt(message.speed, table) : message.speed},
      half(3));
  add(no_speed ? std::nullopt : std::optional{rpm || by_table ? 0.0 : 1.0}, 0.0);
  add(heading || rudder ? std::optional{rudder ? 1.0 : 0.0} : std::nullopt, 0.0);
  return true;
}

bool Written::drive(const Drive& message, const WritingRules& rules) {
  address_ = "PYDIR";
  if (!within(message.left, -1.0, 1.0) || !within(message.right, -1.0, 1.0)) return false;
  add(100.0 * message.left, half(rules.format.thrust_decimals));
  add(100.0 * message.right, half(rules.format.thrust_decimals));
  moves_ = message.left != 0.0 || message.right != 0.0;
  return true;
}

// Counter-clockwise is the user's sense, clockwise the wire's.
bool Written::helm(double thrust, double yaw_rate_ccw, const WritingRules& rules) {
  address_ = "PYDEP";
  add(-yaw_rate_ccw * (rules.format.yaw_rate_in_degrees ? kDegrees : 1.0), half(4));
  add(100.0 * thrust, half(rules.format.thrust_decimals));
  return true;
}

bool Written::course(const Course& message, std::optional<double> convergence_deg) {
  address_ = "PYDEV";
  if (!std::isfinite(message.yaw) || !within(message.speed, 0.0, 10.0) || !convergence_deg) {
    return false;
  }
  add(compass(message.yaw, *convergence_deg), 0.5 + 1e-3, true);
  add(message.speed, half(3));
  return true;
}

bool Written::velocity(const geometry_msgs::Twist& message, const WritingRules& rules) {
  for (const double part : {message.linear.x, message.linear.y, message.linear.z, message.angular.x,
                            message.angular.y, message.angular.z}) {
    if (!std::isfinite(part)) return false;
  }
  const double most = rules.max_yaw_rate_rad_s;
  return helm(std::clamp(message.linear.x / rules.max_speed_m_s, -1.0, 1.0),
              std::clamp(message.angular.z, -most, most), rules);
}

bool Written::same(const Field& field, std::string_view text) {
  if (!field.value) return text.empty();
  const auto number = toNumber(text);
  if (!number || text.front() == '+' || text == "-0") return false;
  const double apart = *number - *field.value;
  if (!field.circle) return std::abs(apart) <= field.tolerance;
  return *number < 360.0 && std::abs(std::remainder(apart, 360.0)) <= field.tolerance;
}

bool Written::matches(const Fields& sentence, bool filled) const {
  const bool timed = dialect_ == Dialect::Sandshark;
  const std::size_t first = timed ? 2 : 1;
  if (sentence.at[0] != address_ || sentence.count != first + count_) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    const bool may_be_filled = filled && !fields_[i].value;
    if (!may_be_filled && !same(fields_[i], sentence.at[first + i])) return false;
  }
  return true;
}

}  // namespace frontseat_driver::closed_loop
