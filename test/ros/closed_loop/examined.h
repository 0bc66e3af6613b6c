#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "closed_loop.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/health_monitor.h"
#include "diagnosis/transition_log.h"

namespace frontseat_driver::closed_loop {

using Level = ros_layer::Diagnosis::Level;

/// A closed loop that is examined once a second, as the bridge does it.
class Examined {
 public:
  struct Complaint {
    Duration at{};
    std::string layer;
    Level level = Level::Ok;
    std::string message;
  };

  template <class Vehicle>
  Examined(const ros_layer::Parameters& parameters, const Vehicle& vehicle)
      : loop(parameters, vehicle), monitor_(parameters, loop.session()) {
    loop.watch.heard = [this](std::string_view line) { monitor_.heard(loop.now(), line); };
    loop.watch.event = [this](const vehicle::Now& now, const vehicle::Event& event) {
      monitor_.event(now, event);
    };
  }

  void connect() {
    monitor_.connected(loop.now(), "vehicle");
    loop.connect();
  }
  void disconnect(const std::string& reason) {
    loop.disconnect();
    monitor_.disconnected(loop.now(), reason);
  }

  /// Lets time pass; publishes `wanted` ten times a second, if there is any.
  void pass(Duration duration, const std::optional<Wanted>& wanted = std::nullopt) {
    using std::chrono_literals::operator""ms;
    for (const Duration end = loop.elapsed() + duration; loop.elapsed() < end;) {
      if (wanted) loop.publish(*wanted);
      loop.pass(100ms);
      if (loop.elapsed() % std::chrono::seconds{1} == Duration{0}) examine();
    }
  }

  /// The layers that complained since `from`, each once.
  std::vector<std::string> complaining(Duration from) const {
    std::vector<std::string> layers;
    for (const Complaint& complaint : complaints) {
      const bool known = std::find(layers.begin(), layers.end(), complaint.layer) != layers.end();
      if (complaint.at > from && !known) layers.push_back(complaint.layer);
    }
    return layers;
  }

  const ros_layer::Diagnosis& of(const std::string& layer) const {
    std::size_t i = 0;
    while (layer != ros_layer::kLayers[i].name) ++i;
    return latest[i];
  }

  ClosedLoop loop;
  ros_layer::Diagnoses latest;
  std::vector<Complaint> complaints;  ///< one for each second
  std::vector<ros_layer::TransitionLog::Line> log;

 private:
  void examine() {
    const vehicle::Now now = guarded(loop.now());
    latest = diagnose(monitor_.take(now, loop.builder(), loop.builder().takeHeldBack()));
    for (std::size_t i = 0; i < latest.size(); ++i) {
      if (latest[i].level == Level::Ok) continue;
      complaints.push_back(
          {loop.elapsed(), ros_layer::kLayers[i].name, latest[i].level, latest[i].message});
    }
    for (auto& line : transitions_.take(latest, now.steady)) log.push_back(std::move(line));
  }

  // As HostClocks does it.
  vehicle::Now guarded(vehicle::Now now) {
    newest_stamp_ = std::max(newest_stamp_, now.stamp);
    now.stamp = newest_stamp_;
    return now;
  }

  ros_layer::HealthMonitor monitor_;
  ros_layer::TransitionLog transitions_;
  vehicle::UtcTime newest_stamp_{};
};

inline void PrintTo(const Examined::Complaint& complaint, std::ostream* out) {
  *out << std::chrono::duration<double>(complaint.at).count() << " s " << complaint.layer << ": "
       << complaint.message;
}

}  // namespace frontseat_driver::closed_loop
