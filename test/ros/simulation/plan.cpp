#include "plan.h"

namespace frontseat_driver::simulation {

using namespace std::chrono_literals;
using protocol::Dialect;

namespace {

// 2026-03-01 00:00:00 UTC, `date -u -d 2026-03-01 +%s`.
constexpr vehicle::UtcTime kMidnight = std::chrono::seconds{1772323200};

// In the order of Kind.
constexpr KindRow kRows[] = {
    {"commands", 9.0, 1.0, 90.0},
    {"flood", 0.5, 0.1, 0.5},
    {"nonsense", 2.0, 0, 0},
    {"wrong vehicle's command", 1.0, 0, 0},
    {"stop", 2.0, 0, 0},
    {"gate", 2.0, 0.5, 60.0},
    {"abort", 1.0, 0, 0},
    {"modify_behavior", 3.0, 0, 0},
    {"set_logging", 1.5, 0, 0},
    {"payload_status", 1.5, 0, 0},
    {"set_datum", 0.5, 0, 0},
    {"unload", 0.5, 0.1, 20.0},
    {"delay", 2.0, 1.0, 120.0},
    {"jitter", 2.0, 1.0, 120.0},
    {"chunks", 3.0, 1.0, 120.0},
    {"corruption", 2.0, 1.0, 60.0},
    {"slow reader", 1.0, 1.0, 30.0},
    {"no room", 1.0, 0.1, 6.0},
    {"reset", 2.0, 0, 0},
    {"half-open", 1.0, 0.5, 20.0},
    {"refusal", 0.7, 0.5, 40.0},
    {"no host", 0.7, 0.5, 40.0},
    {"host clock step", 0.7, 0, 0},
    {"vehicle clock step", 0.7, 0, 0},
    {"leap second", 0.3, 0, 0},
    {"reboot", 0.7, 0, 0},
    {"reboot with a wrong clock", 0.4, 0, 0},
    {"crash", 0.6, 0.5, 10.0},
    {"hang up", 0.7, 0, 0},
    {"silence", 1.0, 0.5, 12.0},
    {"sentences lost", 1.0, 1.0, 60.0},
    {"acks lost", 1.0, 1.0, 60.0},
    {"acks late", 1.0, 1.0, 60.0},
    {"acks pending for ever", 1.0, 1.0, 60.0},
    {"acks twice", 1.0, 1.0, 60.0},
    {"acks lying", 1.0, 1.0, 60.0},
    {"acks for others", 1.0, 1.0, 60.0},
    {"disobedience", 0.5, 1.0, 60.0},
    {"control taken", 2.5, 0.1, 60.0},
    {"control tossed", 0.7, 0, 0},
    {"mission restart", 3.0, 0, 0},
    {"shutdown notice", 0.3, 0, 0},
    {"other dialect", 0.7, 0.1, 10.0},
    {"garbage", 1.0, 0.1, 10.0},
};
static_assert(sizeof kRows / sizeof kRows[0] == kKinds, "a name for each kind");

const KindRow& rowOf(Kind kind) { return kRows[static_cast<std::size_t>(kind)]; }

ros_layer::Parameters anyParameters(sim::Random& random, Dialect dialect) {
  ros_layer::Parameters parameters;
  session::NmeaOptions& session = parameters.session;
  session.dialect = dialect;
  if (random.chance(0.3)) session.dialect.reset();
  if (random.chance(0.3)) {
    session.send_spacing = oneOf<std::chrono::milliseconds>(random, {5ms, 20ms, 100ms, 300ms});
  }
  session.command_timeout = oneOf<Duration>(random, {200ms, 500ms, 1s, 1s, 1s, 5s});
  session.command_rate_hz = oneOf(random, {0.25, 2.0, 5.0, 5.0, 5.0, 20.0});
  session.ack_timeout = oneOf<Duration>(random, {500ms, 3s, 3s, 3s, 12s});
  session.status_rate_hz = oneOf(random, {0.0, 0.1, 0.1, 1.0});
  session.use_acks = !random.chance(0.1);
  session.commands_enabled = !random.chance(0.1);
  session.format.thrust_decimals = static_cast<int>(random.below(4));
  session.format.yaw_rate_in_degrees = random.chance(0.3);
  session.format.fill_behavior_fields = random.chance(0.15);
  if (random.chance(0.2)) session.format.speed_table = {{0.5, 200.0}, {1.5, 650.0}, {2.5, 1150.0}};
  session.control_hook = oneOf(random, {session::ControlHook::Ctl, session::ControlHook::Ctl,
                                        session::ControlHook::Mis, session::ControlHook::None});
  parameters.max_speed_m_s = oneOf(random, {1.0, 2.0, 2.0});
  parameters.max_yaw_rate_rad_s = oneOf(random, {0.5, 1.0, 1.0});
  parameters.stamp = oneOf(random, {ros_layer::StampMode::Synced, ros_layer::StampMode::Synced,
                                    ros_layer::StampMode::Vehicle, ros_layer::StampMode::Receive});
  if (random.chance(0.2)) parameters.link.reconnect_max = 2s;
  parameters.link.jitter_seed = 1 + random.below(1000000);
  return parameters;
}

void anyQuirks(sim::Quirks& quirks, sim::Random& random) {
  bool sim::Quirks::*const kAny[] = {
      &sim::Quirks::float32_positions,    &sim::Quirks::zero_position_before_fix,
      &sim::Quirks::blank_attitude,       &sim::Quirks::zero_altitude,
      &sim::Quirks::zero_depth,           &sim::Quirks::nan_velocities,
      &sim::Quirks::gn_talkers,           &sim::Quirks::cr_lf_lf,
      &sim::Quirks::seconds_sixty,        &sim::Quirks::long_ack_names,
      &sim::Quirks::ack_log_ack,          &sim::Quirks::one_read_one_sentence,
      &sim::Quirks::cut_last_three,       &sim::Quirks::command_by_substring,
      &sim::Quirks::blank_mission_status, &sim::Quirks::zero_temperature,
      &sim::Quirks::battery_without_id,   &sim::Quirks::acceleration_in_g,
      &sim::Quirks::heron_compass,        &sim::Quirks::zero_thrust_stops};
  for (bool sim::Quirks::*const quirk : kAny) quirks.*quirk = random.chance(0.15);
}

constexpr const char* kSlow[] = {"DVL", "CTD", "RVL", "SVS", "RCM",
                                 "IMU", "RBS", "RMC", "GGA", "VTG"};

void anyVehicle(sim::FrontseatConfig& config, sim::Random& random, bool field_rates) {
  config.seed = 1 + random.below(1000000);
  config.noise = false;
  config.environment.datum = oneOf<nmea::LatLon>(
      random, {{42.358, -71.087}, {-33.86, 151.21}, {59.9, 10.7}, {0.5, 0.5}, {5.05, -0.05}});
  config.environment.current_drift_m_s = random.chance(0.3) ? 0.3 : 0.0;
  config.start.heading_deg = between(random, 0.0, 360.0);
  // Half of all runs see midnight, of UTC or of GPS.
  const Duration before = random.chance(0.5) ? fromSeconds(between(random, 10.0, 600.0)) : 12h;
  config.start_time = kMidnight - std::chrono::duration_cast<std::chrono::milliseconds>(before);
  config.first_fix_s = random.chance(0.3) ? between(random, 1.0, 60.0) : 0.0;
  config.clock_offset_s = oneOf(random, {0.0, 0.0, 0.3, -0.2, 20.0, -3000.0});
  config.clock_drift_ppm = oneOf(random, {0.0, 0.0, 30.0, -30.0});
  config.solution_age = oneOf<std::chrono::milliseconds>(random, {0ms, 10ms, 200ms});
  anyQuirks(config.quirks, random);
  if (field_rates) return;
  config.tick = 100ms;
  config.rates["NVG"] = config.rates["NVR"] = oneOf(random, {0.5, 0.5, 1.0, 2.5});
  const double rare_hz = oneOf(random, {0.0, 0.02, 0.1});
  for (const char* sentence : kSlow) config.rates[sentence] = rare_hz;
}

// A rate that one dialect does not have is no rate of its vehicle.
void keepOwnRates(sim::FrontseatConfig& config, Dialect dialect) {
  std::map<std::string, double> own;
  for (const sim::Rate& rate : sim::defaultRates(dialect)) {
    const auto found = config.rates.find(std::string{rate.sentence});
    if (found != config.rates.end()) own.insert(*found);
  }
  config.rates = own;
}

}  // namespace

std::string_view nameOf(Kind kind) { return rowOf(kind).name; }

Dialect dialectOf(std::uint64_t seed) {
  return seed % 2 == 0 ? Dialect::Kingfisher : Dialect::Sandshark;
}

Plan planFor(std::uint64_t seed, Dialect dialect, double hours, double pace) {
  sim::Random random{seed, dialect == Dialect::Kingfisher ? 1U : 2U};
  Plan plan;
  plan.seed = seed;
  plan.dialect = dialect;
  plan.length = fromSeconds(hours * 3600.0);
  plan.parameters = anyParameters(random, dialect);
  plan.field_rates = random.chance(0.03);
  anyVehicle(plan.sandshark, random, plan.field_rates);
  static_cast<sim::FrontseatConfig&>(plan.kingfisher) = plan.sandshark;
  keepOwnRates(plan.sandshark, Dialect::Sandshark);
  keepOwnRates(plan.kingfisher, Dialect::Kingfisher);
  plan.sandshark.quirks.unpadded_minutes = random.chance(0.2);
  plan.kingfisher.quirks.dropped_zeros = random.chance(0.2);
  plan.kingfisher.quirks.course_heading = random.chance(0.15);
  plan.sandshark.quirks.dies_on_empty_field = random.chance(0.05);
  plan.sandshark.mission.ready_s = 2.0;
  plan.sandshark.mission.completed_s = 5.0;
  plan.sandshark.pending_s = oneOf(random, {0.0, 0.0, 0.3, 1.5});
  plan.kingfisher.yaw_rate_in_degrees = plan.parameters.session.format.yaw_rate_in_degrees;
  plan.kingfisher.waves_deg = random.chance(0.5) ? 1.5 : 0.0;
  plan.kingfisher.imu_formatter = random.chance(0.5) ? "IMU" : "RIM";
  plan.actions = anyHappenings<Kind>(kRows, random, plan.length, pace);
  return plan;
}

}  // namespace frontseat_driver::simulation
