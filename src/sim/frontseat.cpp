#include "frontseat_driver/sim/frontseat.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frontseat_driver/sim/angles.h"
#include "frontseat_driver/sim/editable_sentence.h"
#include "frontseat_driver/vehicle/date_resolution.h"

namespace frontseat_driver::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::uint64_t kSensorStream = 1;
constexpr std::uint64_t kClientStream = 1000;  // and up
constexpr std::size_t kReadSize = 256;
constexpr std::size_t kMostUnread = 65536;
constexpr milliseconds kReadPeriod{50};
constexpr double kSurface_m = 0.3;  // GPS is received above
constexpr double kStanding_m_s = 0.02;
constexpr double kCourseSpeed_m_s = 0.2;
constexpr double kSwapBelow = 0.05;

nanoseconds seconds(double s) { return nanoseconds{static_cast<std::int64_t>(s * 1e9)}; }

double inSeconds(nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

double rateOf(const FrontseatConfig& config, const Rate& rate) {
  const auto found = config.rates.find(std::string{rate.sentence});
  return found == config.rates.end() ? rate.hz : found->second;
}

/// Fine enough for every rate, and whole milliseconds, so that times can be written exactly.
nanoseconds tickFor(const FrontseatConfig& config, const std::vector<Rate>& rates) {
  if (config.tick.count() > 0) return config.tick;
  double fastest = 0.0;
  for (const Rate& rate : rates) fastest = std::max(fastest, rateOf(config, rate));
  return fastest > 100.0 ? milliseconds{1} : milliseconds{10};
}

UtcTime wholeMilliseconds(UtcTime time) { return std::chrono::floor<milliseconds>(time); }

/// Volatile, because GCC 12 drops two such conversions that stand side by side.
double throughFloat(double value) {
  const volatile float narrow = static_cast<float>(value);
  return static_cast<double>(narrow);
}

}  // namespace

const std::vector<Rate>& defaultRates(protocol::Dialect dialect) {
  static const std::vector<Rate> kSandshark = {{"NVG", 10.0}, {"NVR", 10.0}, {"DVL", 1.0},
                                               {"CTD", 1.0},  {"RVL", 1.0},  {"SVS", 1.0}};
  static const std::vector<Rate> kKingfisher = {{"NVG", 10.0}, {"NVR", 10.0}, {"RCM", 10.0},
                                                {"IMU", 20.0}, {"RBS", 1.0},  {"RMC", 5.0},
                                                {"GGA", 5.0},  {"VTG", 0.0}};
  return dialect == protocol::Dialect::Sandshark ? kSandshark : kKingfisher;
}

Frontseat::Frontseat(const FrontseatConfig& config, protocol::Dialect dialect,
                     std::chrono::seconds clock_ahead_of_utc)
    : config_(config),
      default_rates_(defaultRates(dialect)),
      clock_ahead_of_utc_(clock_ahead_of_utc),
      rewrites_(rewrites(config.quirks)),
      tick_(tickFor(config, default_rates_)),
      now_(wholeMilliseconds(config.start_time)),
      next_tick_(now_),
      next_read_(now_),
      next_disconnect_(now_ + seconds(config.faults.disconnect_every_s)),
      sensors_(Random{config.seed, kSensorStream}, config.noise),
      reading_time_(now_),
      navigation_(report("NVG", nullptr)) {}

void Frontseat::clientConnected(ClientId id, UtcTime now) {
  now_ = std::max(now_, now);
  const Random random{config_.seed, kClientStream + connections_++};
  const auto [added, is_new] = clients_.emplace(std::piecewise_construct, std::forward_as_tuple(id),
                                                std::forward_as_tuple(id, config_.faults, random));
  if (!is_new) return;
  added->second.ignored = config_.quirks.single_client && clients_.size() > 1;
  if (!added->second.ignored) welcome(added->second);
}

void Frontseat::clientBytes(ClientId id, std::string_view bytes, UtcTime now) {
  now_ = std::max(now_, now);
  Client* client = find(id);
  if (client == nullptr) return;
  if (client->ignored || config_.quirks.one_read_one_sentence) {
    client->unread.append(bytes.substr(0, kMostUnread - client->unread.size()));
    return;
  }
  take(*client, bytes);
}

void Frontseat::clientDisconnected(ClientId id) {
  clients_.erase(id);
  promote();
}

void Frontseat::step(UtcTime now, Sink& sink) {
  for (; next_tick_ <= now; next_tick_ += tick_) {
    now_ = next_tick_;
    advance(sink);
  }
  now_ = std::max(now_, now);
  flush(sink);
}

void Frontseat::advance(Sink& sink) {
  if (config_.quirks.one_read_one_sentence && now_ >= next_read_) {
    next_read_ += kReadPeriod;
    for (auto& [id, client] : clients_) read(client);
  }
  const double dt_s = inSeconds(tick_);
  control(dt_s);
  mutableModel().step(dt_s);
  replaceEmptyBattery();
  say();
  for (Report& report : reports_) {
    if (now_ < report.due) continue;
    report.due += report.period;
    report.send();
  }
  navigate(sink);
  sendSolutions();
}

void Frontseat::navigate(Sink& sink) {
  if (navigation_.period.count() == 0 || now_ < navigation_.due) return;
  navigation_.due += navigation_.period;
  sink.navigation({clock(now_), model().position(), model().state()});

  const Sensors::Reading& read = reading();
  protocol::NavigationUpdate navigation;
  if (elapsed() >= config_.first_fix_s) {
    navigation.position = read.position;
  } else if (config_.quirks.zero_position_before_fix) {
    navigation.position = nmea::LatLon{};
  }
  navigation.from_gps = hasFix();
  navigation.altitude_m = read.state.altitude_m;
  navigation.depth_m = read.state.depth_m;
  navigation.heading_deg = degrees(read.state.heading_rad);
  navigation.roll_deg = degrees(read.state.roll_rad);
  navigation.pitch_deg = degrees(read.state.pitch_rad);
  navigation.computed_at = stamp(now_);
  applyQuirks(navigation, read.state);
  adapt(navigation, read);
  solutions_.push_back({now_ + config_.solution_age, navigation});
}

void Frontseat::sendSolutions() {
  for (; !solutions_.empty() && solutions_.front().due <= now_; solutions_.pop_front()) {
    solutions_.front().navigation.sent_at = stamp(now_);
    sendNavigation(solutions_.front().navigation);
  }
}

void Frontseat::applyQuirks(protocol::NavigationUpdate& navigation,
                            const VehicleState& state) const {
  const Quirks& quirks = config_.quirks;
  if (quirks.float32_positions && navigation.position) {
    navigation.position = nmea::LatLon{throughFloat(navigation.position->latitude_deg),
                                       throughFloat(navigation.position->longitude_deg)};
  }
  if (quirks.course_heading && speedOverGround(state) > kCourseSpeed_m_s) {
    const double course = std::atan2(state.velocity_east_m_s, state.velocity_north_m_s);
    navigation.heading_deg = wrap360(degrees(course));
  }
  if (quirks.blank_attitude) navigation.roll_deg = navigation.pitch_deg = std::nullopt;
}

protocol::VelocityUpdate Frontseat::velocity() {
  const VehicleState& state = reading().state;
  protocol::VelocityUpdate velocity;
  velocity.sent_at = stamp(now_);
  velocity.east_m_s = state.velocity_east_m_s;
  velocity.north_m_s = state.velocity_north_m_s;
  velocity.down_m_s = state.velocity_down_m_s;
  velocity.pitch_rate_deg_s = degrees(state.pitch_rate_rad_s);
  velocity.roll_rate_deg_s = degrees(state.roll_rate_rad_s);
  velocity.yaw_rate_deg_s = degrees(state.yaw_rate_rad_s);
  if (config_.quirks.rate_wrap) differentiate(velocity, state);
  return velocity;
}

void Frontseat::differentiate(protocol::VelocityUpdate& velocity, const VehicleState& state) {
  const Attitude before = last_attitude_;
  last_attitude_ = {now_, degrees(state.heading_rad), degrees(state.pitch_rad),
                    degrees(state.roll_rad)};
  const double dt_s = inSeconds(now_ - before.time);
  if (dt_s <= 0.0) return;
  velocity.yaw_rate_deg_s = (last_attitude_.heading_deg - before.heading_deg) / dt_s;
  velocity.pitch_rate_deg_s = (last_attitude_.pitch_deg - before.pitch_deg) / dt_s;
  velocity.roll_rate_deg_s = (last_attitude_.roll_deg - before.roll_deg) / dt_s;
}

const Sensors::Reading& Frontseat::reading() {
  if (!reading_ || reading_time_ != now_) {
    reading_ = sensors_.read(model(), inSeconds(now_ - reading_time_));
    reading_time_ = now_;
  }
  return *reading_;
}

bool Frontseat::hasFix() {
  return elapsed() >= config_.first_fix_s && model().state().depth_m < kSurface_m;
}

void Frontseat::schedule(std::string_view sentence, std::function<void()> send) {
  Report added = report(sentence, std::move(send));
  if (added.period.count() > 0) reports_.push_back(std::move(added));
}

Frontseat::Report Frontseat::report(std::string_view sentence, std::function<void()> send) const {
  const auto rate = std::find_if(default_rates_.begin(), default_rates_.end(),
                                 [&](const Rate& row) { return row.sentence == sentence; });
  const double hz = rate == default_rates_.end() ? 0.0 : rateOf(config_, *rate);
  return {hz > 0.0 ? seconds(1.0 / hz) : nanoseconds{0}, next_tick_, std::move(send)};
}

void Frontseat::broadcast(std::uint32_t bits, std::string_view sentence) {
  for (auto& [id, client] : clients_) {
    if ((client.logged & bits) != 0) queue(client, sentence);
  }
}

void Frontseat::queue(Client& client, std::string_view sentence) {
  if (!rewrites_) return client.queue(sentence);
  client.queue(rewrite(sentence, config_.quirks, speedOverGround(model().state()) < kStanding_m_s));
}

void Frontseat::take(Client& client, std::string_view bytes) {
  client.framer.feed(bytes, [&](std::string_view line) { obey(client, line); });
}

/// One read is taken for one sentence: what comes after its end is lost.
void Frontseat::read(Client& client) {
  if (client.ignored || client.unread.empty()) return;
  const std::string once = client.unread.substr(0, kReadSize);
  client.unread.erase(0, once.size());
  obey(client, std::string_view{once}.substr(0, once.find_first_of("\r\n")));
}

void Frontseat::obey(Client& client, std::string_view line) {
  if (config_.quirks.cut_last_three) line.remove_suffix(std::min<std::size_t>(3, line.size()));
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Optional);
  if (sentence) command(client, *sentence);
}

void Frontseat::replaceEmptyBattery() {
  if (config_.battery_swap && model().batteryFraction() < kSwapBelow)
    mutableModel().replaceBattery();
}

UtcTime Frontseat::clock(UtcTime utc) const {
  const double drift_s = config_.clock_drift_ppm * 1e-6 * inSeconds(utc - config_.start_time);
  return std::chrono::round<milliseconds>(utc + clock_steps_ +
                                          seconds(config_.clock_offset_s + drift_s));
}

nmea::TimeOfDay Frontseat::stamp(UtcTime utc) const {
  return vehicle::timeOfDay(clock(utc) + clock_ahead_of_utc_);
}

nmea::TimeOfDay Frontseat::utcStamp(UtcTime utc) const { return vehicle::timeOfDay(clock(utc)); }

double Frontseat::elapsed() const { return inSeconds(now_ - config_.start_time); }

Client* Frontseat::find(ClientId id) {
  const auto found = clients_.find(id);
  return found == clients_.end() ? nullptr : &found->second;
}

bool Frontseat::stalled() const {
  const Faults& faults = config_.faults;
  if (faults.stall_every_s <= 0.0 || elapsed() < faults.stall_every_s) return false;
  return std::fmod(elapsed(), faults.stall_every_s) < faults.stall_s;
}

bool Frontseat::disconnectDue() {
  if (std::exchange(rebooting_, false)) return true;
  if (config_.faults.disconnect_every_s <= 0.0 || now_ < next_disconnect_) return false;
  next_disconnect_ = now_ + seconds(config_.faults.disconnect_every_s);
  return true;
}

void Frontseat::flush(Sink& sink) {
  const bool silent = stalled();
  for (auto& [id, client] : clients_) {
    if (silent) client.lose();
    const std::string_view bytes = client.outgoing();
    if (!bytes.empty()) sink.send(id, bytes);
    client.sent();
  }
  if (disconnectDue()) disconnectAll(sink);
}

void Frontseat::disconnectAll(Sink& sink) {
  for (const auto& [id, client] : std::exchange(clients_, {})) sink.disconnect(id);
}

/// A vehicle that knows one client only takes the next one when that has left.
void Frontseat::promote() {
  const bool served = std::any_of(clients_.begin(), clients_.end(),
                                  [](const auto& entry) { return !entry.second.ignored; });
  if (served || clients_.empty()) return;
  Client& client = clients_.begin()->second;
  client.ignored = false;
  welcome(client);
  if (config_.quirks.one_read_one_sentence) return;
  take(client, std::exchange(client.unread, {}));
}

}  // namespace frontseat_driver::sim
