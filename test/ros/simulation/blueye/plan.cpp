#include "plan.h"

#include <cstdio>

namespace frontseat_driver::blueye_simulation {

using namespace std::chrono_literals;

namespace {

// 2026-03-01 12:00:00 UTC, `date -u -d '2026-03-01 12:00' +%s`.
constexpr vehicle::UtcTime kNoon = std::chrono::seconds{1772366400};

// In the order of Kind.
constexpr simulation::KindRow kRows[] = {
    {"stream of commands", 90.0, 0.2, 40.0},
    {"nonsense", 10.0, 0, 0},
    {"take_control", 80.0, 0, 0},
    {"release_control", 10.0, 0, 0},
    {"stop", 15.0, 0, 0},
    {"abort", 6.0, 0, 0},
    {"gate", 8.0, 0.2, 20.0},
    {"control", 25.0, 0, 0},
    {"mission", 12.0, 0, 0},
    {"request", 20.0, 0, 0},
    {"set_rate", 6.0, 0, 0},
    {"unload", 3.0, 0.1, 10.0},
    {"delay", 10.0, 1.0, 40.0},
    {"jitter", 10.0, 1.0, 40.0},
    {"telemetry stalled", 10.0, 0.1, 4.0},
    {"replies stalled", 10.0, 0.1, 4.0},
    {"control stalled", 9.0, 0.1, 8.0},
    {"no room", 6.0, 0.05, 6.0},
    {"link lost", 8.0, 0, 0},
    {"half-open", 4.0, 0.5, 12.0},
    {"refusal", 3.0, 0.5, 15.0},
    {"held up", 10.0, 0.01, 3.0},
    {"replies lost", 6.0, 1.0, 20.0},
    {"replies late", 6.0, 1.0, 20.0},
    {"telemetry lost", 5.0, 1.0, 20.0},
    {"silence", 3.0, 0.5, 8.0},
    {"reboot", 3.0, 2.0, 15.0},
    {"reboot that the link outlives", 2.0, 0.1, 4.0},
    {"another takes control", 20.0, 0.1, 20.0},
    {"another sends the rest away", 6.0, 0.1, 5.0},
    {"another waits its turn", 8.0, 1.0, 40.0},
    {"another fights for control", 5.0, 0.5, 8.0},
};
static_assert(sizeof kRows / sizeof kRows[0] == kKinds, "a name for each kind");

session::BlueyeOptions anyOptions(sim::Random& random) {
  session::BlueyeOptions options;
  options.observer = !random.chance(0.15);
  options.commands_enabled = !random.chance(0.1);
  options.sync_time = random.chance(0.5);
  options.clockwise_yaw = random.chance(0.7);
  options.command_timeout = oneOf<Duration>(random, {200ms, 500ms, 1s, 1s, 1s, 5s});
  options.command_rate_hz = oneOf(random, {1.0, 5.0, 10.0, 10.0, 30.0});
  options.request_timeout = oneOf<std::chrono::milliseconds>(random, {500ms, 2000ms, 2000ms});
  options.control_timeout = oneOf<std::chrono::milliseconds>(random, {200ms, 1000ms, 1000ms, 4s});
  if (random.chance(0.3)) options.water_density_kg_m3 = 1025.0;
  if (random.chance(0.3)) options.pinger_mounting = session::PingerMounting::Forwards;
  return options;
}

sim::BlueyeConfig anyDrone(sim::Random& random, bool clockwise_yaw) {
  sim::BlueyeConfig config;
  config.seed = 1 + random.below(1000000);
  config.noise = false;
  config.start_time = kNoon;
  config.watchdog_timeout_s = oneOf(random, {2.0, 3.0, 3.0, 5.0});
  config.conventions.yaw_clockwise = clockwise_yaw;
  // What the conversation needs; the rest only costs time here.
  for (const std::string& name : sim::BlueyeDrone::knownTelemetry()) config.rates[name] = 0.0;
  config.rates["ConnectedClientsTel"] = oneOf(random, {0.5, 1.0, 1.0, 10.0});
  config.rates["MissionStatusTel"] = oneOf(random, {0.5, 2.0});
  config.rates["ControlModeTel"] = 1.0;
  config.rates["DroneTimeTel"] = 1.0;
  config.rates["LightsTel"] = oneOf(random, {0.0, 1.0});
  return config;
}

}  // namespace

std::string_view nameOf(Kind kind) { return kRows[static_cast<std::size_t>(kind)].name; }

Plan planFor(std::uint64_t seed, double hours, double pace) {
  sim::Random random{seed, 3U};
  Plan plan;
  plan.seed = seed;
  plan.length = fromSeconds(hours * 3600.0);
  plan.options = anyOptions(random);
  plan.drone = anyDrone(random, plan.options.clockwise_yaw);
  plan.actions = simulation::anyHappenings<Kind>(kRows, random, plan.length, pace);
  return plan;
}

std::string describe(const Plan& plan) {
  std::string text;
  for (const Action& action : plan.actions) {
    char row[128];
    std::snprintf(row, sizeof row, "%12.3f s  %-34s for %.3f s\n", inSeconds(action.at),
                  std::string{nameOf(action.kind)}.c_str(), inSeconds(action.lasts));
    text += row;
  }
  return text;
}

}  // namespace frontseat_driver::blueye_simulation
