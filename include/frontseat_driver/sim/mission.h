#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/sim/autopilot.h"
#include "frontseat_driver/sim/guidance.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::sim {

/// One line of a dive file: to a point, at a depth or an altitude, at a speed.
struct Leg {
  PlanePoint to;
  double vertical_m = 0.0;
  Setpoint::VerticalMode vertical_mode = Setpoint::VerticalMode::Depth;
  double speed_m_s = 1.5;
};

/// A lawn-mower pattern: parallel lines below the surface, each reached on the surface.
struct Survey {
  int lines = 4;
  double length_m = 60.0;
  double spacing_m = 12.0;
  double depth_m = 4.0;
  double speed_m_s = 1.5;
};
std::vector<Leg> lawnMower(const Survey& survey);

/// What a vehicle runs by itself, and when.
struct MissionPlan {
  std::string dive_file = "survey.dive";
  std::vector<Leg> legs = lawnMower(Survey{});
  double ready_s = 5.0;       ///< from Ready to Running
  double completed_s = 10.0;  ///< from Completed to Ready, if it starts over
  bool loop = true;           ///< starts over when completed; never after an abort
};

/// A mission and its states (SPI 0.1, section 6.3): Ready, Running, WrappingUp, Completed; by an
/// abort Aborting, which is a powered ascent, and Aborted.
class Mission {
 public:
  using State = vehicle::MissionStatus::State;

  explicit Mission(MissionPlan plan);

  /// Moves on by `dt_s`. `held`: the payload steers, so that the legs wait.
  void step(double dt_s, const VehicleState& state, bool held);

  /// What the mission wants the vehicle to do now.
  Setpoint setpoint(const VehicleState& state) const;

  /// Ends it with an ascent; does nothing once aborted. `details` is for people.
  void abort(std::string details);

  /// Makes a completed or aborted mission ready again.
  void restart();

  State state() const { return state_; }
  std::string status() const;  ///< as BFMIS has it; of a running one with the log directory
  const std::string& details() const { return details_; }
  const MissionPlan& plan() const { return plan_; }

  /// Number of the leg that is being run, from 0; the number of legs when there is none.
  std::size_t leg() const { return leg_; }

 private:
  void enter(State state, std::string details = {});
  void run(const VehicleState& state);

  MissionPlan plan_;
  State state_ = State::Ready;
  double in_state_s_ = 0.0;
  int runs_ = 0;
  std::size_t leg_;
  Line line_;
  std::string details_;
};

}  // namespace frontseat_driver::sim
