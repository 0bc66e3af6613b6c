#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::ros_layer {

/// Turns diagnoses into log lines: one when a layer begins to complain of something, one when it is
/// well again; nothing while that lasts, and at most one in kAtMostEvery for each layer.
class TransitionLog {
 public:
  static constexpr std::chrono::seconds kAtMostEvery{5};

  struct Line {
    Diagnosis::Level level = Diagnosis::Level::Ok;
    std::string text;
  };

  std::vector<Line> take(const Diagnoses& diagnoses, vehicle::SteadyTime now);

 private:
  struct Told {
    std::string complaint;  ///< without its figures, which change all the time; empty: all well
    std::optional<vehicle::SteadyTime> at;
  };

  std::array<Told, kLayers.size()> told_;
};

}  // namespace frontseat_driver::ros_layer
