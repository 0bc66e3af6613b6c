#include "diagnostics.h"

#include <cstddef>

namespace frontseat_driver::ros_layer {

Diagnostics::Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node,
                         const std::string& name)
    : updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    updater_.add(kLayers[i].name, [this, i](diagnostic_updater::DiagnosticStatusWrapper& status) {
      const Diagnosis& diagnosis = diagnoses_[i];
      status.summary(static_cast<unsigned char>(diagnosis.level), diagnosis.message);
      for (const auto& [key, value] : diagnosis.values) status.add(key, value);
    });
  }
  timer_ = node.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { update(); });
}

void Diagnostics::set(const Health& health, vehicle::SteadyTime now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = health;
  newest_at_ = now;
}

void Diagnostics::update() {
  Health health;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    health = newest_;
    health.link.unreported_s = inSeconds(std::chrono::steady_clock::now() - newest_at_);
  }
  diagnoses_ = diagnose(health);
  updater_.setHardwareID(health.link.endpoint.empty() ? "none" : health.link.endpoint);
  updater_.force_update();
}

}  // namespace frontseat_driver::ros_layer
