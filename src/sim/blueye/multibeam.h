#pragma once

#include <string>

#include "frontseat_driver/sim/blueye/config.h"
#include "frontseat_driver/sim/random.h"
#include "messages.h"

namespace frontseat_driver::sim {

/// A multibeam sonar that looks ahead: what it is told, and the images it makes.
class BlueyeMultibeam {
 public:
  BlueyeMultibeam(const MultibeamSize& size, Random random);

  void configure(const bp::MultibeamConfig& config);
  void activate(bool on) { active_ = on; }

  const bp::MultibeamConfig& config() const { return config_; }
  bool active() const { return active_; }
  double rateHz() const;  ///< as configured; 0 while it is not active

  /// The image of a level bottom `altitude_m` below, seen at `pitch_rad` (bow up).
  bp::MultibeamPing ping(vehicle::UtcTime clock, double altitude_m, double pitch_rad,
                         bool bearings_in_degrees);

 private:
  std::uint32_t beams() const;

  MultibeamSize size_;
  Random random_;
  bp::MultibeamConfig config_;
  bool active_;
  std::string speckle_;  ///< a bottom far longer than an image, read from anywhere
};

}  // namespace frontseat_driver::sim
