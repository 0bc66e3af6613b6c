#include "frontseat_driver/sim/kingfisher_frontseat.h"

#include <algorithm>
#include <cmath>

#include "frontseat_driver/sim/angles.h"
#include "plain_numbers.h"

namespace frontseat_driver::sim {
namespace {

namespace kingfisher = protocol::kingfisher;
namespace gps = protocol::gps;

constexpr std::chrono::seconds kMotorWatchdog{1};
constexpr double kGravity = 9.80665;
constexpr double kKnot_m_s = 1852.0 / 3600.0;
constexpr int kCells = 4;
constexpr double kCellSpread_v = 0.012;
constexpr double kCorner_m = 4.0;
constexpr double kLookahead_m = 6.0;
constexpr double kFastestTurn_rad_s = kPi;

double course(const VehicleState& state) {
  return wrap360(degrees(std::atan2(state.velocity_east_m_s, state.velocity_north_m_s)));
}

/// The calendar day of a time, by the algorithm of H. Hinnant, "chrono-compatible low-level date
/// algorithms", civil_from_days.
nmea::Date dateOf(UtcTime utc) {
  using Days = std::chrono::duration<std::int64_t, std::ratio<86400>>;
  const std::int64_t days = std::chrono::floor<Days>(utc).count() + 719468;
  const std::int64_t era = days / 146097;
  const std::int64_t day_of_era = days - era * 146097;
  const std::int64_t year_of_era =
      (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const std::int64_t day_of_year =
      day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const std::int64_t shifted_month = (5 * day_of_year + 2) / 153;
  const std::int64_t day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
  const std::int64_t month = shifted_month < 10 ? shifted_month + 3 : shifted_month - 9;
  const std::int64_t year = year_of_era + era * 400 + (month <= 2 ? 1 : 0);
  return {static_cast<int>(year), static_cast<int>(month), static_cast<int>(day)};
}

bool within(const std::optional<double>& value, double low, double high) {
  return value && *value >= low && *value <= high;
}

bool usable(const kingfisher::MotorThrust& wanted) {
  return within(wanted.port_pct, -100.0, 100.0) && within(wanted.starboard_pct, -100.0, 100.0);
}

bool usable(const kingfisher::ThrustAndYawRate& wanted) {
  return wanted.yaw_rate && within(wanted.thrust_pct, -100.0, 100.0);
}

bool usable(const kingfisher::HeadingAndSpeed& wanted) {
  return within(wanted.heading_deg, 0.0, 360.0) && within(wanted.speed_m_s, 0.0, 100.0);
}

}  // namespace

KingfisherFrontseat::KingfisherFrontseat(const KingfisherConfig& config)
    : Frontseat(config, protocol::Dialect::Kingfisher, kGpsAheadOfUtc),
      settings_(config),
      catamaran_(config.environment, config.start, config.battery, config.waves_deg),
      gps_talker_(config.quirks.gn_talkers ? "GN" : "GP") {
  scheduleReports();
}

void KingfisherFrontseat::scheduleReports() {
  schedule("NVR", [this] { broadcast(kAll, "CP", velocity()); });
  schedule("RCM", [this] { sendCompass(); });
  schedule("IMU", [this] { sendImu(); });
  schedule("RBS", [this] { sendBattery(); });
  schedule("RMC", [this] { sendMinimumData(); });
  schedule("GGA", [this] { sendFix(); });
  schedule("VTG", [this] { sendCourseAndSpeed(); });
}

void KingfisherFrontseat::adapt(protocol::NavigationUpdate& navigation, const Sensors::Reading&) {
  navigation.altitude_m = navigation.depth_m = std::nullopt;  // a surface vehicle
  if (config().quirks.zero_altitude) navigation.altitude_m = 0.0;
  if (config().quirks.zero_depth) navigation.depth_m = 0.0;
}

void KingfisherFrontseat::sendNavigation(const protocol::NavigationUpdate& navigation) {
  broadcast(kAll, "CP", navigation);
}

void KingfisherFrontseat::sendCompass() {
  const VehicleState& state = reading().state;
  const bool heron = config().quirks.heron_compass;
  const double heading_deg = degrees(state.heading_rad);
  kingfisher::RawCompass message;
  message.sent_at = message.measured_at = stamp(now());
  message.compass_id = settings_.compass_id;
  message.heading_deg = heron ? wrap360(180.0 - heading_deg) : heading_deg;
  message.pitch_deg = degrees(heron ? -state.pitch_rad : state.pitch_rad);
  message.roll_deg = degrees(state.roll_rad);
  broadcast(kAll, "CP", message);
}

void KingfisherFrontseat::sendImu() {
  const VehicleState& state = reading().state;
  const double unit = config().quirks.acceleration_in_g ? kGravity : 1.0;
  kingfisher::RawImu message;
  message.sent_at = message.measured_at = stamp(now());
  message.rate_x_deg_s = degrees(state.roll_rate_rad_s);
  message.rate_y_deg_s = degrees(state.pitch_rate_rad_s);
  message.rate_z_deg_s = degrees(state.yaw_rate_rad_s);
  message.acceleration_x = state.force_x_m_s2 / unit;
  message.acceleration_y = state.force_y_m_s2 / unit;
  message.acceleration_z = state.force_z_m_s2 / unit;
  nmea::SentenceWriter out{"CP", settings_.imu_formatter};
  message.encode(out);
  if (const auto text = out.finish()) broadcast(kAll, *text);
}

void KingfisherFrontseat::sendBattery() {
  const double stack_v = reading().state.stack_v;
  kingfisher::BatteryVoltage message;
  message.sent_at = stamp(now());
  message.battery_id = 1;
  message.stack_v = stack_v;
  message.lowest_cell_v = stack_v / kCells - kCellSpread_v;
  message.highest_cell_v = stack_v / kCells + kCellSpread_v;
  message.temperature_c = config().quirks.zero_temperature ? 0.0 : 24.5;
  broadcast(kAll, "CP", message);
}

void KingfisherFrontseat::sendMinimumData() {
  const Sensors::Reading& read = reading();
  gps::MinimumData message;
  message.measured_at = utcStamp(now());
  message.date = dateOf(clock(now()));
  message.valid = hasFix();
  if (message.valid) {
    message.position = read.position;
    message.speed_kn = speedOverGround(read.state) / kKnot_m_s;
    message.course_deg = course(read.state);
  }
  broadcast(kAll, gps_talker_, message);
}

void KingfisherFrontseat::sendFix() {
  gps::Fix message;
  message.measured_at = utcStamp(now());
  message.quality = hasFix() ? 1 : 0;
  if (hasFix()) {
    message.position = reading().position;
    message.satellites = 9;
    message.hdop = 0.9;
    message.altitude_m = 33.2;  // the model floats on the ellipsoid
    message.geoid_separation_m = -33.2;
  }
  broadcast(kAll, gps_talker_, message);
}

void KingfisherFrontseat::sendCourseAndSpeed() {
  const VehicleState& state = reading().state;
  gps::CourseAndSpeed message;
  message.course_true_deg = course(state);
  message.speed_kn = speedOverGround(state) / kKnot_m_s;
  message.speed_km_h = speedOverGround(state) * 3.6;
  broadcast(kAll, gps_talker_, message);
}

void KingfisherFrontseat::command(Client&, const nmea::Sentence& sentence) {
  if (sentence.talker() != "PY" || !arePlainNumbers(sentence.fields)) return;
  const auto read = protocol::decode(sentence);
  if (!read || read->faults.count > 0) return;
  const auto take = [this](const auto& wanted) {
    if (!usable(wanted)) return;
    command_ = wanted;
    command_time_ = now();
  };
  if (const auto* motors = std::get_if<kingfisher::MotorThrust>(&read->message)) take(*motors);
  if (const auto* helm = std::get_if<kingfisher::ThrustAndYawRate>(&read->message)) take(*helm);
  if (const auto* hold = std::get_if<kingfisher::HeadingAndSpeed>(&read->message)) take(*hold);
}

void KingfisherFrontseat::control(double) {
  const auto age = now() - command_time_;
  const bool commanded = command_.index() != 0;
  const std::chrono::duration<double> resume{settings_.resume_loop_s};
  if (commanded && resume.count() > 0.0 && age > resume) command_ = std::monostate{};
  if (command_.index() == 0) return catamaran_.command(loopThrust());
  const bool obeyed = age <= kMotorWatchdog && !config().faults.lie;
  catamaran_.command(obeyed ? commandedThrust() : Catamaran::Thrust{});
}

Catamaran::Thrust KingfisherFrontseat::commandedThrust() const {
  const VehicleState& state = catamaran_.state();
  if (const auto* motors = std::get_if<kingfisher::MotorThrust>(&command_)) {
    return {*motors->port_pct / 100.0, *motors->starboard_pct / 100.0};
  }
  if (const auto* course = std::get_if<kingfisher::HeadingAndSpeed>(&command_)) {
    if (*course->speed_m_s == 0.0) return {};
    return hold(*course->heading_deg, std::min(*course->speed_m_s, Catamaran::kMaxSpeed), state);
  }
  const auto& wanted = std::get<kingfisher::ThrustAndYawRate>(command_);
  if (config().quirks.zero_thrust_stops && *wanted.thrust_pct == 0.0) return {};
  const double rate = settings_.yaw_rate_in_degrees ? radians(*wanted.yaw_rate) : *wanted.yaw_rate;
  return helm(std::clamp(rate, -kFastestTurn_rad_s, kFastestTurn_rad_s), *wanted.thrust_pct / 100.0,
              state);
}

Catamaran::Thrust KingfisherFrontseat::loopThrust() {
  if (settings_.loop.empty()) return {};
  const VehicleState& state = catamaran_.state();
  const std::size_t corners = settings_.loop.size();
  const PlanePoint from = settings_.loop[(corner_ + corners - 1) % corners];
  if (atEnd({from, settings_.loop[corner_]}, state, kCorner_m)) corner_ = (corner_ + 1) % corners;
  const Line side{settings_.loop[(corner_ + corners - 1) % corners], settings_.loop[corner_]};
  return hold(headingAlong(side, state, kLookahead_m), settings_.loop_speed_m_s, state);
}

}  // namespace frontseat_driver::sim
