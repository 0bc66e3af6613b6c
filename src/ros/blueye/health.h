#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/session/blueye_session.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// What `/diagnostics` tell of a Blueye, taken once a second: they are asked for on another thread.
struct Health {
  using Values = std::vector<std::pair<std::string, std::string>>;

  bool replay = false;  ///< a record is played, no drone is there
  std::optional<vehicle::SteadyTime> taken_at;
  double unreported_s = 0.0;  ///< since it was taken, when it is told
  bool connected = false;
  std::string endpoint;
  std::string last_failure;  ///< why there is no connection; empty before the first failure
  session::BlueyeCounters counters;
  std::uint64_t unknown = 0;
  std::uint64_t unreadable = 0;
  std::string refusal;  ///< why commands would be refused now; empty: they would not
  bool refused_lately = false;
  bool commanding = false;
  std::uint32_t id = 0;
  std::uint32_t id_in_control = 0;
  std::vector<std::string> error_flags;
  std::map<std::string, Values> values;  ///< of messages that are for diagnostics alone
  std::optional<double> battery_level;   ///< 0..1
  double battery_v = 0.0;
};

using Report = void (*)(const Health&, diagnostic_updater::DiagnosticStatusWrapper&);

/// From the link up: the first that is not OK is the cause. Texts say what to do; what is normal,
/// as observing while another client drives, is OK.
void reportLink(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& status);
void reportControl(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& status);
void reportCommands(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& status);
void reportDrone(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& status);
void reportBattery(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& status);

constexpr std::array<std::pair<const char*, Report>, 5> kReports{{{"link", reportLink},
                                                                  {"control", reportControl},
                                                                  {"commands", reportCommands},
                                                                  {"drone", reportDrone},
                                                                  {"battery", reportBattery}}};

}  // namespace frontseat_driver::ros_layer::blueye_layer
