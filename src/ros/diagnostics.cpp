#include "diagnostics.h"

#include <cmath>
#include <utility>

namespace frontseat_driver::ros_layer {

namespace {

using diagnostic_msgs::DiagnosticStatus;

// More than the clocks of two computers without NTP differ after a day.
constexpr double kClockOffsetWarned_s = 5.0;
constexpr double kBadShareWarned = 0.01;

constexpr std::chrono::seconds kReportsAtLeastEvery{5};

constexpr const char* kNotConnected = "no connection";

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node,
                         const std::string& name, double max_data_age_s)
    : max_data_age_s_(max_data_age_s), updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  updater_.add("link", [this](Status& status) { link(status); });
  updater_.add("data", [this](Status& status) { data(status); });
  updater_.add("decoding", [this](Status& status) { decoding(status); });
  updater_.add("clock", [this](Status& status) { clock(status); });
  updater_.add("control", [this](Status& status) { control(status); });
  updater_.add("commands", [this](Status& status) { commands(status); });
  updater_.add("battery", [this](Status& status) { battery(status); });
  timer_ = node.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { update(); });
}

void Diagnostics::set(Health health) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = std::move(health);
}

void Diagnostics::update() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    health_ = newest_;
  }
  updater_.setHardwareID(health_.endpoint.empty() ? "none" : health_.endpoint);
  updater_.force_update();
}

void Diagnostics::link(Status& status) const {
  const auto silent = std::chrono::steady_clock::now() - health_.taken;
  if (silent > kReportsAtLeastEvery && !health_.replay) {
    status.summaryf(DiagnosticStatus::ERROR, "the driver itself has reported nothing for %.0f s",
                    std::chrono::duration<double>(silent).count());
  } else if (health_.connected) {
    status.summaryf(DiagnosticStatus::OK, "connected to %s", health_.endpoint.c_str());
  } else {
    status.summaryf(DiagnosticStatus::ERROR, "not connected to %s: %s", health_.endpoint.c_str(),
                    health_.last_failure.c_str());
  }
  status.add("dialect", health_.dialect);
  status.add("bytes received", health_.counters.bytes_received);
  status.add("bytes sent", health_.counters.bytes_sent);
}

void Diagnostics::data(Status& status) const {
  const auto& age_s = health_.navigation_age_s;
  if (!health_.connected) {
    status.summary(DiagnosticStatus::ERROR, kNotConnected);
  } else if (!age_s) {
    status.summary(DiagnosticStatus::WARN,
                   "no navigation sentence (NVG) since the connection was made; a Sandshark sends "
                   "what parameter log_sentences asks for");
  } else if (*age_s > max_data_age_s_) {
    status.summaryf(DiagnosticStatus::ERROR, "no navigation sentence (NVG) for %.1f s", *age_s);
  } else if (const auto silent_s = velocitySilence_s(); silent_s && *silent_s > max_data_age_s_) {
    status.summaryf(DiagnosticStatus::WARN,
                    "no velocity sentence (NVR) for %.1f s: odom has no twist", *silent_s);
  } else {
    status.summary(DiagnosticStatus::OK, "navigation comes in");
  }
  for (const SentenceRates::Rate& rate : health_.rates) {
    status.addf(rate.address, "%.1f Hz", rate.hz);
  }
  status.add("positions dropped as jumps", health_.jumps);
}

// Only of a vehicle that has sent some: a Sandshark need not be asked for it.
std::optional<double> Diagnostics::velocitySilence_s() const {
  for (const SentenceRates::Rate& rate : health_.rates) {
    if (rate.address == "BFNVR" || rate.address == "CPNVR") {
      return std::chrono::duration<double>(health_.taken - rate.last).count();
    }
  }
  return std::nullopt;
}

void Diagnostics::decoding(Status& status) const {
  const session::NmeaCounters& now = health_.counters;
  const session::NmeaCounters& before = health_.counters_before;
  const std::uint64_t sentences = now.sentences_received - before.sentences_received;
  const double bad = share(now.bad_checksums - before.bad_checksums, sentences);
  const double other = share(now.other_dialect - before.other_dialect, sentences);
  if (other > kBadShareWarned) {
    status.summaryf(DiagnosticStatus::ERROR,
                    "the vehicle speaks the other dialect; parameter dialect is %s, set it to auto",
                    health_.dialect.c_str());
  } else if (bad > kBadShareWarned) {
    status.summaryf(DiagnosticStatus::WARN, "%.1f %% of the sentences have a wrong checksum",
                    100.0 * bad);
  } else {
    status.summary(DiagnosticStatus::OK, "sentences are well-formed");
  }
  status.add("sentences received", now.sentences_received);
  status.add("decoded", now.decoded);
  status.add("wrong checksum", now.bad_checksums);
  status.add("malformed lines", now.bad_frames);
  status.add("malformed fields", now.bad_fields);
  status.add("unknown", now.unknown);
  status.add("too long", now.oversized);
}

void Diagnostics::clock(Status& status) const {
  const auto& offset_s = health_.clock_offset_s;
  if (!offset_s) {
    status.summary(DiagnosticStatus::OK, "the vehicle has told no time yet");
    return;
  }
  if (std::abs(*offset_s) > kClockOffsetWarned_s) {
    status.summaryf(DiagnosticStatus::WARN,
                    "the vehicle's clock is %.1f s %s this computer's; set one of them by NTP, or "
                    "parameter leap_seconds if it is the vehicle's time scale",
                    std::abs(*offset_s), *offset_s > 0.0 ? "ahead of" : "behind");
  } else {
    status.summary(DiagnosticStatus::OK, "the vehicle's clock and this computer's agree");
  }
  status.addf("vehicle minus computer, with the delay of the link", "%.3f s", *offset_s);
  const vehicle::ClockOffset::State& clock = health_.clock;
  status.addf("learned offset", "%.6f s", std::chrono::duration<double>(clock.offset).count());
  status.addf("jitter", "%.3f ms", std::chrono::duration<double, std::milli>(clock.jitter).count());
  status.addf("drift", "%.1f ppm", clock.drift_ppm);
  status.add("clock steps", clock.steps);
}

void Diagnostics::control(Status& status) const {
  const bool free = health_.control_reason.empty();
  status.summary(DiagnosticStatus::OK,
                 free ? "the vehicle takes commands" : health_.control_reason);
  status.add("commands enabled", health_.commands_enabled);
}

// What this driver refuses it says to whoever sent it, so it is counted and no warning here.
void Diagnostics::commands(Status& status) const {
  if (!health_.vehicle_refusal.empty()) {
    status.summary(DiagnosticStatus::WARN,
                   "the vehicle refuses what is sent: " + health_.vehicle_refusal);
  } else if (!health_.effect_complaint.empty()) {
    status.summary(DiagnosticStatus::WARN,
                   "the vehicle does not do what it is told: " + health_.effect_complaint);
  } else if (health_.commanded.empty()) {
    status.summary(DiagnosticStatus::OK, "nothing is commanded");
  } else {
    status.summary(DiagnosticStatus::OK, "commanding " + health_.commanded);
  }
  status.add("commanded", health_.commanded);
  status.add("refused by the driver", health_.counters.refused_commands);
  status.add("sent and not acknowledged", health_.unacknowledged);
}

void Diagnostics::battery(Status& status) const {
  if (!health_.battery_v) {
    status.summary(DiagnosticStatus::OK, "the vehicle tells no voltage");
  } else {
    status.summaryf(DiagnosticStatus::OK, "%.2f V", *health_.battery_v);
  }
}

}  // namespace frontseat_driver::ros_layer
