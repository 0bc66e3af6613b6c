#include "blueye/health.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

// The driver's thread reports once a second.
constexpr double kReportsAtLeastEvery_s = 5.0;
constexpr double kLowBattery = 0.2;
constexpr double kLittleStorage = 0.1;

struct Advice {
  const char* in_reason;
  const char* text;
};

// The reasons are those of link::ZmqClient and of the operating system.
constexpr Advice kAdvice[] = {
    {"no answer",
     "is the drone on and its tether in, has this computer an address in its network (ip addr), "
     "and is parameter host right (192.168.1.101 on every drone)?"},
    {"Too many open files", "close programs, or raise the limit (ulimit -n)"},
    {"cannot open", "is parameter host right (192.168.1.101 on every drone)?"},
    {"closed the connection", "is the drone starting again? The driver connects by itself"},
    {"nothing heard", "look at the tether and the surface unit; the driver connects by itself"},
};

std::string adviceFor(const std::string& reason) {
  for (const Advice& advice : kAdvice) {
    if (reason.find(advice.in_reason) != std::string::npos) return std::string{"; "} + advice.text;
  }
  return {};
}

bool isGrave(const std::string& flag) {
  return flag.rfind("depth", 0) == 0 || flag.rfind("inner_pressure", 0) == 0 ||
         flag.rfind("pmu_comm", 0) == 0;
}

double bytesAt(const Health::Values& values, const std::string& path) {
  for (const auto& [name, value] : values) {
    if (name == path) return std::strtod(value.c_str(), nullptr);
  }
  return 0.0;  // the wire leaves out what is 0
}

void judgeStorage(const Health& health, DiagnosticStatusWrapper& status) {
  const auto told = health.values.find("VideoStorageSpaceTel");
  if (told == health.values.end()) return;
  const double total = bytesAt(told->second, "storage_space.total_space");
  const double free = bytesAt(told->second, "storage_space.free_space");
  if (!(total > 0.0) || free >= kLittleStorage * total) return;
  char text[100];
  std::snprintf(text, sizeof text, "%.0f %% of the video storage is free: save and delete videos",
                100.0 * free / total);
  status.mergeSummary(DiagnosticStatus::WARN, text);
}

/// What was told before the link was lost may be true no more.
std::string agedBy(const Health& health) {
  return health.connected ? "" : " when it was last heard";
}

void judgeLink(const Health& health, DiagnosticStatusWrapper& status) {
  if (health.replay) {
    status.summary(DiagnosticStatus::OK, health.counters.telemetry_received > 0
                                             ? "playing a record from " + health.endpoint
                                             : "waiting for a record on " + health.endpoint);
  } else if (health.unreported_s > kReportsAtLeastEvery_s) {
    status.summaryf(DiagnosticStatus::ERROR,
                    "the driver itself has reported nothing for %.0f s; restart it",
                    health.unreported_s);
  } else if (health.connected) {
    status.summary(DiagnosticStatus::OK, "connected to " + health.endpoint);
  } else if (health.last_failure.empty()) {
    status.summary(DiagnosticStatus::OK, "connecting to " + health.endpoint);
  } else {
    status.summary(DiagnosticStatus::ERROR, "not connected to " + health.endpoint + ": " +
                                                health.last_failure +
                                                adviceFor(health.last_failure));
  }
}

}  // namespace

void reportLink(const Health& health, DiagnosticStatusWrapper& status) {
  judgeLink(health, status);
  status.add("bytes received", health.counters.bytes_received);
  status.add("telemetry messages", health.counters.telemetry_received);
  status.add("replies", health.counters.replies_received);
  status.add("malformed", health.counters.malformed + health.unreadable);
  status.add("unknown messages", health.unknown);
}

void reportControl(const Health& health, DiagnosticStatusWrapper& status) {
  status.summary(DiagnosticStatus::OK,
                 health.refusal.empty() ? "this driver is in control" : health.refusal);
  status.add("own client", health.id);
  status.add("client in control", health.id_in_control);
}

void reportCommands(const Health& health, DiagnosticStatusWrapper& status) {
  if (health.refused_lately && !health.replay) {
    status.summary(DiagnosticStatus::WARN,
                   "commands come in and are refused: " +
                       (health.refusal.empty() ? "they were too old or out of range; the log has "
                                                 "the reason"
                                               : health.refusal));
  } else {
    status.summary(DiagnosticStatus::OK,
                   health.commanding ? "commanding the drone" : "nothing is commanded");
  }
  status.add("refused by the driver", health.counters.refused_commands);
}

void reportDrone(const Health& health, DiagnosticStatusWrapper& status) {
  if (health.error_flags.empty()) {
    status.summary(DiagnosticStatus::OK, "no error flags" + agedBy(health));
  } else {
    status.summary(DiagnosticStatus::OK, "");
    for (const std::string& flag : health.error_flags) {
      status.mergeSummary(isGrave(flag) ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, flag);
      status.add(flag, true);
    }
    status.message += agedBy(health) + ": bring the drone up, look it over and start it again";
  }
  judgeStorage(health, status);
  for (const auto& [type, values] : health.values) {
    for (const auto& [path, value] : values) status.add(path, value);
  }
}

void reportBattery(const Health& health, DiagnosticStatusWrapper& status) {
  if (!health.battery_level || !std::isfinite(*health.battery_level)) {
    return status.summary(DiagnosticStatus::OK, "the drone has told no battery yet");
  }
  const bool low = *health.battery_level < kLowBattery;
  status.summaryf(low ? DiagnosticStatus::WARN : DiagnosticStatus::OK, "%.0f %%%s%s",
                  *health.battery_level * 100.0, agedBy(health).c_str(),
                  low ? ": bring the drone up and charge it" : "");
  status.add("voltage", health.battery_v);
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
