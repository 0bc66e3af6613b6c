#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "messages.h"
#include "pilot.h"

namespace frontseat_driver::sim {

class BlueyeCore;

/// The mission a drone has loaded, and how far it is in it.
///
/// States as the protocol names them: inactive, load, ready or failed, run, running, paused,
/// completed or aborted; clear leads back to inactive from each.
class BlueyeMission {
 public:
  static constexpr int kMostInstructions = 50;
  static constexpr double kFarthest_m = 2000.0;  ///< to a waypoint
  static constexpr double kDeepest_m = 300.0;
  static constexpr double kLongest_s = 4 * 3600.0;
  static constexpr double kSeabedHeight_m = 0.5;  ///< where "go to seabed" ends
  static constexpr double kStuck_s = 60.0;        ///< without half a metre of progress

  void load(const bp::Mission& mission, BlueyeCore& core);
  void run(BlueyeCore& core);
  void pause(BlueyeCore& core);
  void clear(BlueyeCore& core);
  /// Ends a running or paused one, if there is one.
  void abort(BlueyeCore& core);
  /// Replaces the instruction with the same id; false if there is none, or it is being executed.
  bool update(const bp::Instruction& instruction, BlueyeCore& core);

  void step(BlueyeCore& core, double dt_s);

  const bp::Mission& mission() const { return mission_; }
  bp::MissionState state() const { return state_; }
  bp::MissionStatus status(const BlueyeCore& core) const;
  bp::ReferenceAutoPilot reference(const BlueyeCore& core) const;

 private:
  /// A place to pass, in the position estimate's frame.
  struct Leg {
    PlanePoint target;
    double speed_m_s = 0.0;
    double reached_m = 0.0;
  };
  enum class Begun { Yes, Skipped };

  std::optional<bp::NotificationType> findFault(const bp::Mission& mission,
                                                const BlueyeCore& core) const;
  void planPath(const BlueyeCore& core);
  void fail(bp::MissionState state, bp::NotificationType reason, BlueyeCore& core);
  Begun begin(BlueyeCore& core);
  Begun beginWaypoint(const bp::Waypoint& waypoint, BlueyeCore& core);
  Begun beginDepth(const bp::DepthSetPoint& set_point, BlueyeCore& core);
  Begun beginCamera(const bp::CameraCommand& command, BlueyeCore& core);
  Begun beginModes(const bp::ControlModeCommand& command, BlueyeCore& core);
  Begun beginSurvey(const bp::SurveyCommand& command, BlueyeCore& core);
  void setDepth(const bp::DepthSetPoint& set_point, const BlueyeCore& core);
  bool finished(BlueyeCore& core, double dt_s);
  bool verticalReached(const BlueyeCore& core) const;
  bool legsPassed(const BlueyeCore& core);
  void complete(BlueyeCore& core);
  void next(BlueyeCore& core);
  void end(bp::MissionState state, BlueyeCore& core);
  bool stuck(const BlueyeCore& core, double dt_s);
  double toGo(const BlueyeCore& core) const;
  double horizontalToGo(const BlueyeCore& core) const;
  double verticalToGo(const BlueyeCore& core) const;
  double surgeSpeed() const;
  double heaveSpeed() const;
  const bp::Instruction& current() const { return mission_.instructions(index_); }

  bp::MissionState state_ = bp::MISSION_STATE_INACTIVE;
  bp::Mission mission_;
  int index_ = 0;
  bool begun_ = false;
  BlueyeGuidance guidance_;
  std::vector<Leg> legs_;
  std::size_t leg_ = 0;
  double elapsed_s_ = 0.0;
  double waited_s_ = 0.0;
  double nearest_m_ = 0.0;
  double without_progress_s_ = 0.0;
  std::vector<std::uint32_t> completed_;
  std::vector<std::uint32_t> passed_segments_;
  std::optional<BlueyeModes> wanted_modes_;  ///< what a ControlModeCommand asked for
};

}  // namespace frontseat_driver::sim
