#include "mission.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core.h"
#include "frontseat_driver/sim/angles.h"
#include "survey_lines.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kDefaultSpeed = 0.6;       // m/s
constexpr double kDefaultHeaveSpeed = 0.3;  // m/s
constexpr double kDefaultAcceptance_m = 1.0;
constexpr double kDepthReached_m = 0.2;
constexpr double kProgress_m = 0.5;
constexpr std::uint32_t kNoSegment = 4294967295U;

double distance(const PlanePoint& a, const PlanePoint& b) {
  return std::hypot(a.north_m - b.north_m, a.east_m - b.east_m);
}

double orDefault(double value, double otherwise) { return value > 0.0 ? value : otherwise; }

/// Rounded; as many as the field can tell.
std::uint32_t toCount(double value) {
  return static_cast<std::uint32_t>(std::clamp(std::round(value), 0.0, 4294967295.0));
}

nmea::LatLon toLatLon(const bp::LatLongPosition& position) {
  return {position.latitude(), position.longitude()};
}

bool onEarth(const bp::LatLongPosition& position) {
  return std::abs(position.latitude()) <= 90.0 && std::abs(position.longitude()) <= 180.0;
}

bool onEarth(const bp::SurveyCommand& survey) {
  const auto& waypoints = survey.waypoints();
  const auto& vertices = survey.vertices();
  return std::all_of(waypoints.begin(), waypoints.end(),
                     [](const bp::Waypoint& one) { return onEarth(one.global_position()); }) &&
         std::all_of(vertices.begin(), vertices.end(),
                     [](const bp::LatLongPosition& one) { return onEarth(one); });
}

const bp::DepthSetPoint* depthOf(const bp::Instruction& instruction) {
  if (instruction.has_depth_set_point_command()) {
    return &instruction.depth_set_point_command().depth_set_point();
  }
  if (instruction.has_waypoint_command() &&
      instruction.waypoint_command().waypoint().has_depth_set_point()) {
    return &instruction.waypoint_command().waypoint().depth_set_point();
  }
  return nullptr;
}

bool needsPosition(const bp::Instruction& instruction) {
  return instruction.has_waypoint_command() || instruction.has_survey_command();
}

bp::InstructionType typeOf(const bp::Instruction& instruction) {
  switch (instruction.command_case()) {
    case bp::Instruction::kWaypointCommand:
      return depthOf(instruction) ? bp::INSTRUCTION_TYPE_GO_TO_WAYPOINT_WITH_DEPTH_SET_POINT
                                  : bp::INSTRUCTION_TYPE_GO_TO_WAYPOINT;
    case bp::Instruction::kDepthSetPointCommand:
      return bp::INSTRUCTION_TYPE_GO_TO_DEPTH_SET_POINT;
    case bp::Instruction::kCameraCommand:
      return bp::INSTRUCTION_TYPE_SET_CAMERA_ACTION;
    case bp::Instruction::kControlModeCommand:
      return bp::INSTRUCTION_TYPE_SET_CONTROL_MODE;
    case bp::Instruction::kTiltMainCameraCommand:
      return bp::INSTRUCTION_TYPE_SET_TILT_MAIN_CAMERA;
    case bp::Instruction::kTiltMultibeamCommand:
      return bp::INSTRUCTION_TYPE_SET_TILT_SERVO;
    case bp::Instruction::kWaitForCommand:
      return bp::INSTRUCTION_TYPE_WAIT_FOR_SEC;
    case bp::Instruction::kGoToSurfaceCommand:
      return bp::INSTRUCTION_TYPE_GO_TO_SURFACE;
    case bp::Instruction::kGoToSeabedCommand:
      return bp::INSTRUCTION_TYPE_GO_TO_SEABED;
    case bp::Instruction::kGoToHomeCommand:
      return bp::INSTRUCTION_TYPE_GO_TO_HOME;
    case bp::Instruction::kSurveyCommand:
      return bp::INSTRUCTION_TYPE_SURVEY;
    case bp::Instruction::COMMAND_NOT_SET:
      break;
  }
  return bp::INSTRUCTION_TYPE_NONE;
}

}  // namespace

double BlueyeMission::surgeSpeed() const {
  return orDefault(mission_.default_surge_speed(), kDefaultSpeed);
}

double BlueyeMission::heaveSpeed() const {
  return orDefault(mission_.default_heave_speed(), kDefaultHeaveSpeed);
}

void BlueyeMission::load(const bp::Mission& mission, BlueyeCore& core) {
  if (state_ == bp::MISSION_STATE_RUNNING || state_ == bp::MISSION_STATE_PAUSED) {
    core.notify(bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION, bp::NOTIFICATION_LEVEL_WARNING);
    return;
  }
  *this = {};
  if (const auto fault = findFault(mission, core)) {
    fail(bp::MISSION_STATE_FAILED_TO_LOAD_MISSION, *fault, core);
    return;
  }
  mission_ = mission;
  planPath(core);
  if (mission_.total_duration_time() > kLongest_s) {
    mission_.Clear();
    fail(bp::MISSION_STATE_FAILED_TO_LOAD_MISSION,
         bp::NOTIFICATION_TYPE_TIME_TO_COMPLETE_IS_TOO_LONG, core);
    return;
  }
  state_ = bp::MISSION_STATE_READY;
  core.notify(bp::NOTIFICATION_TYPE_MISSION_LOADED);
  core.announce("MissionStatusTel");
}

std::optional<bp::NotificationType> BlueyeMission::findFault(const bp::Mission& mission,
                                                             const BlueyeCore& core) const {
  constexpr auto kBad = bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION;
  if (mission.instructions().empty() || mission.instructions_size() > kMostInstructions) {
    return kBad;
  }
  std::set<std::uint32_t> ids;
  for (const bp::Instruction& instruction : mission.instructions()) {
    if (!ids.insert(instruction.id()).second) return kBad;
    if (const bp::DepthSetPoint* set_point = depthOf(instruction)) {
      if (!std::isfinite(set_point->depth()) || set_point->depth() < 0.0F) return kBad;
      if (set_point->depth() > kDeepest_m) {
        return bp::NOTIFICATION_TYPE_DEPTH_SET_POINT_IS_TOO_FAR_AWAY;
      }
    }
    if (!onEarth(instruction.survey_command())) return kBad;
    if (!instruction.has_waypoint_command()) continue;
    const auto& position = instruction.waypoint_command().waypoint().global_position();
    if (!onEarth(position)) return kBad;
    const auto here = core.computer.navigation.position();
    if (!here) return bp::NOTIFICATION_TYPE_DRONE_POSITION_IS_UNKNOWN;
    const PlanePoint offset = toPlane(*here, toLatLon(position));
    if (std::hypot(offset.north_m, offset.east_m) > kFarthest_m) {
      return bp::NOTIFICATION_TYPE_WAYPOINT_IS_TOO_FAR_AWAY;
    }
  }
  return std::nullopt;
}

void BlueyeMission::planPath(const BlueyeCore& core) {
  mission_.clear_path_segments();
  PlanePoint from = core.computer.navigation.place();
  double depth = core.rov.state().depth_m;
  std::uint32_t from_id = 0;
  double length = 0.0;
  double duration = 0.0;
  for (const bp::Instruction& instruction : mission_.instructions()) {
    double vertical = 0.0;
    double vertical_speed = heaveSpeed();
    if (const bp::DepthSetPoint* set_point = depthOf(instruction)) {
      const bool seabed = set_point->depth_zero_reference() == bp::DEPTH_ZERO_REFERENCE_SEABED;
      const double bottom = core.rov.environment().bottom_depth_m;
      const double to = seabed ? bottom - set_point->depth() : set_point->depth();
      vertical = std::abs(to - depth);
      vertical_speed = orDefault(set_point->speed_to_depth(), vertical_speed);
      depth = to;
    }
    double time = vertical / vertical_speed;
    if (instruction.has_wait_for_command()) {
      time += std::max(0.0F, instruction.wait_for_command().wait_for_seconds());
    }
    if (instruction.has_waypoint_command() && core.computer.navigation.origin()) {
      const bp::Waypoint& waypoint = instruction.waypoint_command().waypoint();
      const PlanePoint to =
          toPlane(*core.computer.navigation.origin(), toLatLon(waypoint.global_position()));
      const double horizontal = distance(from, to);
      const double speed = orDefault(waypoint.speed_to_target(), surgeSpeed());
      bp::PathSegment* segment = mission_.add_path_segments();
      segment->set_id(static_cast<std::uint32_t>(mission_.path_segments_size() - 1));
      segment->set_speed_to_target(static_cast<float>(speed));
      segment->set_course_to_target(
          static_cast<float>(std::atan2(to.east_m - from.east_m, to.north_m - from.north_m)));
      segment->set_depth_speed(static_cast<float>(vertical_speed));
      segment->set_horizontal_length(static_cast<float>(horizontal));
      segment->set_vertical_length(static_cast<float>(vertical));
      segment->set_from_wp_id(from_id);
      segment->set_to_wp_id(waypoint.id());
      time = std::max(time, horizontal / speed);
      segment->set_duration_time(static_cast<float>(time));
      length += horizontal;
      from = to;
      from_id = waypoint.id();
    }
    duration += time;
  }
  mission_.set_total_distance(toCount(length));
  mission_.set_total_duration_time(toCount(duration));
}

void BlueyeMission::fail(bp::MissionState state, bp::NotificationType reason, BlueyeCore& core) {
  state_ = state;
  const bool loading = state == bp::MISSION_STATE_FAILED_TO_LOAD_MISSION;
  if (reason != bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION) {
    core.notify(reason, bp::NOTIFICATION_LEVEL_WARNING);
  }
  if (loading) {
    core.notify(bp::NOTIFICATION_TYPE_FAILED_TO_LOAD_MISSION, bp::NOTIFICATION_LEVEL_ERROR);
  }
  core.announce("MissionStatusTel");
}

void BlueyeMission::run(BlueyeCore& core) {
  const bool resumed = state_ == bp::MISSION_STATE_PAUSED;
  if (!resumed && state_ != bp::MISSION_STATE_READY) {
    if (state_ != bp::MISSION_STATE_RUNNING) {
      core.notify(bp::NOTIFICATION_TYPE_NO_MISSION_LOADED, bp::NOTIFICATION_LEVEL_WARNING);
    }
    return;
  }
  const auto& all = mission_.instructions();
  const bool lost = !core.computer.navigation.valid() || !core.computer.navigation.origin();
  if (lost && std::any_of(all.begin(), all.end(), needsPosition)) {
    fail(bp::MISSION_STATE_FAILED_TO_START_MISSION, bp::NOTIFICATION_TYPE_DRONE_POSITION_IS_UNKNOWN,
         core);
    return;
  }
  state_ = bp::MISSION_STATE_RUNNING;
  BlueyeModes modes;
  modes.auto_pilot_surge_yaw = true;
  modes.auto_pilot_heave = true;
  core.setModes(modes);
  core.zeroMotion();
  if (!guidance_.depth_m && !guidance_.altitude_m) guidance_.depth_m = core.rov.state().depth_m;
  without_progress_s_ = 0.0;
  nearest_m_ = toGo(core);
  core.notify(resumed ? bp::NOTIFICATION_TYPE_MISSION_RESUMED
                      : bp::NOTIFICATION_TYPE_MISSION_STARTED);
  core.announce("MissionStatusTel");
}

void BlueyeMission::pause(BlueyeCore& core) {
  if (state_ != bp::MISSION_STATE_RUNNING) return;
  core.notify(bp::NOTIFICATION_TYPE_MISSION_PAUSED);
  end(bp::MISSION_STATE_PAUSED, core);
}

void BlueyeMission::clear(BlueyeCore& core) {
  if (state_ == bp::MISSION_STATE_RUNNING) end(bp::MISSION_STATE_ABORTED, core);
  *this = {};
  core.announce("MissionStatusTel");
}

void BlueyeMission::abort(BlueyeCore& core) {
  if (state_ != bp::MISSION_STATE_RUNNING && state_ != bp::MISSION_STATE_PAUSED) return;
  core.notify(bp::NOTIFICATION_TYPE_MISSION_ABORTED, bp::NOTIFICATION_LEVEL_WARNING);
  if (state_ == bp::MISSION_STATE_RUNNING) {
    end(bp::MISSION_STATE_ABORTED, core);
  } else {
    state_ = bp::MISSION_STATE_ABORTED;
    core.announce("MissionStatusTel");
  }
}

/// Stops steering and leaves the drone where it is: depth, heading and, if it can, place.
void BlueyeMission::end(bp::MissionState state, BlueyeCore& core) {
  state_ = state;
  core.computer.pilot.guidance.reset();
  BlueyeModes modes;
  modes.auto_depth = true;
  modes.auto_heading = true;
  modes.station_keeping = core.computer.navigation.valid();
  if (state != bp::MISSION_STATE_PAUSED && wanted_modes_) modes = *wanted_modes_;
  core.setModes(modes);
  core.announce("MissionStatusTel");
}

bool BlueyeMission::update(const bp::Instruction& instruction, BlueyeCore& core) {
  for (int i = 0; i < mission_.instructions_size(); ++i) {
    if (mission_.instructions(i).id() != instruction.id()) continue;
    if (i < index_ || (i == index_ && begun_)) return false;
    bp::Mission changed = mission_;
    *changed.mutable_instructions(i) = instruction;
    if (findFault(changed, core)) return false;
    mission_ = changed;
    planPath(core);
    return true;
  }
  return false;
}

void BlueyeMission::step(BlueyeCore& core, double dt_s) {
  if (state_ != bp::MISSION_STATE_RUNNING) return;
  const BlueyeModes& modes = core.computer.pilot.modes();
  if (!modes.auto_pilot_surge_yaw || !modes.auto_pilot_heave) {  // the operator took over
    core.notify(bp::NOTIFICATION_TYPE_MISSION_PAUSED);
    state_ = bp::MISSION_STATE_PAUSED;
    core.computer.pilot.guidance.reset();
    core.announce("MissionStatusTel");
    return;
  }
  elapsed_s_ += dt_s;
  if (!begun_) {
    legs_.clear();
    leg_ = 0;
    waited_s_ = 0.0;
    guidance_.target.reset();
    guidance_.hold_heading = false;
    if (begin(core) == Begun::Skipped) {
      core.notify(bp::NOTIFICATION_TYPE_INSTRUCTION_SKIPPED, bp::NOTIFICATION_LEVEL_WARNING,
                  static_cast<std::int32_t>(current().id()));
      next(core);
      return;
    }
    begun_ = true;
    nearest_m_ = toGo(core);
    without_progress_s_ = 0.0;
    core.announce("MissionStatusTel");
  }
  const bool done = finished(core, dt_s);
  core.computer.pilot.guidance = guidance_;
  if (done) {
    complete(core);
  } else if (stuck(core, dt_s)) {
    core.notify(bp::NOTIFICATION_TYPE_DRONE_IS_STUCK, bp::NOTIFICATION_LEVEL_ERROR);
    abort(core);
  }
}

BlueyeMission::Begun BlueyeMission::begin(BlueyeCore& core) {
  const bp::Instruction& instruction = current();
  switch (instruction.command_case()) {
    case bp::Instruction::kWaypointCommand:
      return beginWaypoint(instruction.waypoint_command().waypoint(), core);
    case bp::Instruction::kDepthSetPointCommand:
      return beginDepth(instruction.depth_set_point_command().depth_set_point(), core);
    case bp::Instruction::kCameraCommand:
      return beginCamera(instruction.camera_command(), core);
    case bp::Instruction::kControlModeCommand:
      return beginModes(instruction.control_mode_command(), core);
    case bp::Instruction::kTiltMainCameraCommand:
      core.notify(bp::NOTIFICATION_TYPE_SET_TILT_MAIN_CAMERA);
      return Begun::Yes;
    case bp::Instruction::kTiltMultibeamCommand:
      if (!core.has(BlueyeDevice::MultibeamServo)) return Begun::Skipped;
      core.notify(bp::NOTIFICATION_TYPE_SET_TILT_MULTIBEAM);
      core.computer.payload.multibeam_servo_target_deg = std::clamp<double>(
          instruction.tilt_multibeam_command().multibeam_servo().angle(),
          -BlueyePayload::kMultibeamLimit_deg, BlueyePayload::kMultibeamLimit_deg);
      return Begun::Yes;
    case bp::Instruction::kWaitForCommand:
      core.notify(bp::NOTIFICATION_TYPE_WAIT_FOR);
      return Begun::Yes;
    case bp::Instruction::kGoToSurfaceCommand:
      core.notify(bp::NOTIFICATION_TYPE_GO_TO_SURFACE);
      guidance_.altitude_m.reset();
      guidance_.depth_m = 0.0;
      guidance_.vertical_speed_m_s =
          orDefault(instruction.go_to_surface_command().desired_speed(), heaveSpeed());
      return Begun::Yes;
    case bp::Instruction::kGoToSeabedCommand:
      if (!core.altitudeValid()) return Begun::Skipped;
      core.notify(bp::NOTIFICATION_TYPE_GO_TO_SEABED);
      guidance_.depth_m.reset();
      guidance_.altitude_m = kSeabedHeight_m;
      guidance_.vertical_speed_m_s =
          orDefault(instruction.go_to_seabed_command().desired_speed(), heaveSpeed());
      return Begun::Yes;
    case bp::Instruction::kGoToHomeCommand:
      if (!core.computer.navigation.valid()) return Begun::Skipped;
      core.notify(bp::NOTIFICATION_TYPE_RETURNING_TO_HOME);
      // Home is where the position estimate was started: where the drone was let into the water.
      legs_.push_back({{},
                       orDefault(instruction.go_to_home_command().desired_speed(), surgeSpeed()),
                       orDefault(mission_.default_circle_of_acceptance(), kDefaultAcceptance_m)});
      return Begun::Yes;
    case bp::Instruction::kSurveyCommand:
      return beginSurvey(instruction.survey_command(), core);
    case bp::Instruction::COMMAND_NOT_SET:
      break;
  }
  return Begun::Skipped;
}

void BlueyeMission::setDepth(const bp::DepthSetPoint& set_point, const BlueyeCore& core) {
  const bool seabed = set_point.depth_zero_reference() == bp::DEPTH_ZERO_REFERENCE_SEABED;
  guidance_.depth_m.reset();
  guidance_.altitude_m.reset();
  if (seabed) {
    guidance_.altitude_m = set_point.depth();
  } else {
    guidance_.depth_m = std::min<double>(set_point.depth(), core.rov.environment().bottom_depth_m);
  }
  guidance_.vertical_speed_m_s = orDefault(set_point.speed_to_depth(), heaveSpeed());
}

BlueyeMission::Begun BlueyeMission::beginWaypoint(const bp::Waypoint& waypoint, BlueyeCore& core) {
  const auto origin = core.computer.navigation.origin();
  if (!origin) return Begun::Skipped;
  if (waypoint.has_depth_set_point()) {
    const bool seabed =
        waypoint.depth_set_point().depth_zero_reference() == bp::DEPTH_ZERO_REFERENCE_SEABED;
    if (seabed && !core.altitudeValid()) return Begun::Skipped;
    setDepth(waypoint.depth_set_point(), core);
    core.notify(bp::NOTIFICATION_TYPE_GO_TO_WAYPOINT_WITH_DEPTH_SET_POINT);
  } else {
    core.notify(bp::NOTIFICATION_TYPE_GO_TO_WAYPOINT);
  }
  legs_.push_back(
      {toPlane(*origin, toLatLon(waypoint.global_position())),
       orDefault(waypoint.speed_to_target(), surgeSpeed()),
       orDefault(waypoint.circle_of_acceptance(),
                 orDefault(mission_.default_circle_of_acceptance(), kDefaultAcceptance_m))});
  return Begun::Yes;
}

BlueyeMission::Begun BlueyeMission::beginDepth(const bp::DepthSetPoint& set_point,
                                               BlueyeCore& core) {
  const bool seabed = set_point.depth_zero_reference() == bp::DEPTH_ZERO_REFERENCE_SEABED;
  if (seabed && !core.altitudeValid()) return Begun::Skipped;
  core.notify(bp::NOTIFICATION_TYPE_GO_TO_DEPTH_SET_POINT);
  setDepth(set_point, core);
  return Begun::Yes;
}

BlueyeMission::Begun BlueyeMission::beginCamera(const bp::CameraCommand& command,
                                                BlueyeCore& core) {
  BlueyePayload& payload = core.computer.payload;
  const bool series = command.camera_action() == bp::CAMERA_ACTION_TAKE_PHOTOS_TIME ||
                      command.camera_action() == bp::CAMERA_ACTION_TAKE_PHOTOS_DISTANCE;
  if (series && !(command.action_param() > 0.0F)) return Begun::Skipped;
  switch (command.camera_action()) {
    case bp::CAMERA_ACTION_TAKE_PHOTO:
      payload.takePicture();
      break;
    case bp::CAMERA_ACTION_TAKE_PHOTOS_TIME:
    case bp::CAMERA_ACTION_TAKE_PHOTOS_DISTANCE:
      payload.time_lapse = {};
      payload.time_lapse.type = command.camera_action() == bp::CAMERA_ACTION_TAKE_PHOTOS_TIME
                                    ? bp::INTERVAL_TYPE_TIME
                                    : bp::INTERVAL_TYPE_DISTANCE;
      payload.time_lapse.interval = command.action_param();
      break;
    case bp::CAMERA_ACTION_STOP_TAKING_PHOTOS:
      payload.time_lapse.type = bp::INTERVAL_TYPE_UNSPECIFIED;
      break;
    case bp::CAMERA_ACTION_START_RECORDING:
      payload.main.set(true);
      break;
    case bp::CAMERA_ACTION_STOP_RECORDING:
      payload.main.set(false);
      break;
    default:
      return Begun::Skipped;
  }
  core.announce("TimeLapseStateTel");
  core.announce("RecordStateTel");
  core.notify(bp::NOTIFICATION_TYPE_CAMERA_ACTION);
  return Begun::Yes;
}

BlueyeMission::Begun BlueyeMission::beginModes(const bp::ControlModeCommand& command,
                                               BlueyeCore& core) {
  BlueyeModes modes;
  const auto vertical = command.control_mode_vertical();
  const auto horizontal = command.control_mode_horizontal();
  if (vertical == bp::CONTROL_MODE_VERTICAL_AUTO_ALTITUDE && !core.altitudeValid()) {
    return Begun::Skipped;
  }
  modes.auto_depth = vertical == bp::CONTROL_MODE_VERTICAL_AUTO_DEPTH;
  modes.auto_altitude = vertical == bp::CONTROL_MODE_VERTICAL_AUTO_ALTITUDE;
  modes.auto_heading = horizontal == bp::CONTROL_MODE_HORIZONTAL_AUTO_HEADING;
  modes.station_keeping = horizontal == bp::CONTROL_MODE_HORIZONTAL_STATION_KEEPING;
  wanted_modes_ = modes;
  return Begun::Yes;
}

BlueyeMission::Begun BlueyeMission::beginSurvey(const bp::SurveyCommand& command,
                                                BlueyeCore& core) {
  const auto origin = core.computer.navigation.origin();
  if (!origin) return Begun::Skipped;
  std::vector<PlanePoint> points;
  for (const bp::Waypoint& waypoint : command.waypoints()) {
    points.push_back(toPlane(*origin, toLatLon(waypoint.global_position())));
  }
  if (points.empty()) {
    std::vector<PlanePoint> polygon;
    for (const auto& vertex : command.vertices()) {
      polygon.push_back(toPlane(*origin, toLatLon(vertex)));
    }
    points = surveyLines(polygon, radians(command.survey_line_heading()), command.lane_spacing(),
                         command.turnaround_distance(), command.reverse());
  }
  if (points.empty()) return Begun::Skipped;
  if (command.has_depth_set_point()) setDepth(command.depth_set_point(), core);
  for (const PlanePoint& point : points) {
    legs_.push_back({point, orDefault(command.cruise_speed(), surgeSpeed()),
                     orDefault(command.circle_of_acceptance(), kDefaultAcceptance_m)});
  }
  core.notify(bp::NOTIFICATION_TYPE_GO_TO_WAYPOINT);
  return Begun::Yes;
}

bool BlueyeMission::finished(BlueyeCore& core, double dt_s) {
  const bp::Instruction& instruction = current();
  switch (instruction.command_case()) {
    case bp::Instruction::kWaypointCommand:
    case bp::Instruction::kSurveyCommand:
    case bp::Instruction::kGoToHomeCommand: {
      const bool arrived = legsPassed(core);
      return arrived && (instruction.has_go_to_home_command() || verticalReached(core));
    }
    case bp::Instruction::kDepthSetPointCommand:
    case bp::Instruction::kGoToSurfaceCommand:
    case bp::Instruction::kGoToSeabedCommand:
      return verticalReached(core);
    case bp::Instruction::kTiltMainCameraCommand:
      return core.computer.payload.tiltTo(
          instruction.tilt_main_camera_command().tilt_angle().value(), dt_s);
    case bp::Instruction::kTiltMultibeamCommand: {
      const BlueyePayload& payload = core.computer.payload;
      return payload.multibeam_servo_deg == payload.multibeam_servo_target_deg;
    }
    case bp::Instruction::kWaitForCommand:
      waited_s_ += dt_s;
      return waited_s_ >= instruction.wait_for_command().wait_for_seconds();
    default:
      return true;
  }
}

double BlueyeMission::verticalToGo(const BlueyeCore& core) const {
  const VehicleState& now = core.rov.state();
  if (guidance_.depth_m) return std::abs(*guidance_.depth_m - now.depth_m);
  if (guidance_.altitude_m) return std::abs(*guidance_.altitude_m - now.altitude_m);
  return 0.0;
}

bool BlueyeMission::verticalReached(const BlueyeCore& core) const {
  return verticalToGo(core) < kDepthReached_m;
}

double BlueyeMission::horizontalToGo(const BlueyeCore& core) const {
  double sum = 0.0;
  PlanePoint from = core.computer.navigation.place();
  for (std::size_t i = leg_; i < legs_.size(); ++i) {
    sum += distance(from, legs_[i].target);
    from = legs_[i].target;
  }
  return sum;
}

double BlueyeMission::toGo(const BlueyeCore& core) const {
  return horizontalToGo(core) + verticalToGo(core);
}

bool BlueyeMission::legsPassed(const BlueyeCore& core) {
  const PlanePoint here = core.computer.navigation.place();
  while (leg_ + 1 < legs_.size() && distance(here, legs_[leg_].target) <= legs_[leg_].reached_m) {
    ++leg_;
  }
  const Leg& leg = legs_[leg_];
  guidance_.target = leg.target;
  guidance_.speed_m_s = leg.speed_m_s;
  return leg_ + 1 == legs_.size() && distance(here, leg.target) <= leg.reached_m;
}

bool BlueyeMission::stuck(const BlueyeCore& core, double dt_s) {
  if (legs_.empty() && verticalToGo(core) < kDepthReached_m) return false;
  const double rest = toGo(core);
  without_progress_s_ += dt_s;
  if (rest < nearest_m_ - kProgress_m) {
    nearest_m_ = rest;
    without_progress_s_ = 0.0;
  }
  return without_progress_s_ > kStuck_s;
}

void BlueyeMission::complete(BlueyeCore& core) {
  const bp::Instruction& instruction = current();
  const auto id = static_cast<std::int32_t>(instruction.id());
  if (instruction.has_waypoint_command()) {
    core.notify(bp::NOTIFICATION_TYPE_WAYPOINT_REACHED, bp::NOTIFICATION_LEVEL_INFO,
                static_cast<std::int32_t>(instruction.waypoint_command().waypoint().id()));
    std::uint32_t segment = 0;
    for (int i = 0; i < index_; ++i) {
      if (mission_.instructions(i).has_waypoint_command()) ++segment;
    }
    passed_segments_.push_back(segment);
  } else if (instruction.has_depth_set_point_command()) {
    core.notify(guidance_.altitude_m ? bp::NOTIFICATION_TYPE_ALTITUDE_TARGET_REACHED
                                     : bp::NOTIFICATION_TYPE_DEPTH_TARGET_REACHED);
  }
  core.notify(bp::NOTIFICATION_TYPE_INSTRUCTION_COMPLETE, bp::NOTIFICATION_LEVEL_INFO, id);
  completed_.push_back(instruction.id());
  const bool pauses = core.config.conventions.pause_instructions && !instruction.auto_continue();
  next(core);
  if (pauses && state_ == bp::MISSION_STATE_RUNNING) pause(core);
}

void BlueyeMission::next(BlueyeCore& core) {
  begun_ = false;
  ++index_;
  core.announce("MissionStatusTel");
  if (index_ < mission_.instructions_size()) return;
  core.notify(bp::NOTIFICATION_TYPE_MISSION_COMPLETE);
  end(bp::MISSION_STATE_COMPLETED, core);
}

bp::MissionStatus BlueyeMission::status(const BlueyeCore& core) const {
  bp::MissionStatus status;
  status.set_state(state_);
  status.set_id(mission_.id());
  status.set_time_elapsed(static_cast<std::uint32_t>(elapsed_s_));
  status.set_total_number_of_instructions(static_cast<std::uint32_t>(mission_.instructions_size()));
  status.set_total_number_of_path_segments(
      static_cast<std::uint32_t>(mission_.path_segments_size()));
  for (const std::uint32_t id : completed_) status.add_completed_instruction_ids(id);
  for (const std::uint32_t id : passed_segments_) status.add_completed_path_segment_ids(id);
  if (index_ >= mission_.instructions_size()) return status;
  double rest = begun_ ? horizontalToGo(core) : 0.0;
  double seconds = begun_ ? rest / surgeSpeed() + verticalToGo(core) / heaveSpeed() : 0.0;
  std::size_t passed = passed_segments_.size();
  if (begun_ && current().has_waypoint_command()) ++passed;
  for (auto i = static_cast<int>(passed); i < mission_.path_segments_size(); ++i) {
    rest += mission_.path_segments(i).horizontal_length();
    seconds += mission_.path_segments(i).duration_time();
  }
  status.set_distance_to_complete(toCount(rest));
  status.set_estimated_time_to_complete(toCount(seconds));
  return status;
}

bp::ReferenceAutoPilot BlueyeMission::reference(const BlueyeCore& core) const {
  bp::ReferenceAutoPilot reference;
  reference.set_active_path_segment_id(kNoSegment);
  reference.set_instruction_type(bp::INSTRUCTION_TYPE_NONE);
  if (!begun_ || index_ >= mission_.instructions_size()) return reference;
  reference.set_instruction_type(typeOf(current()));
  reference.set_active_instruction_id(current().id());
  if (current().has_waypoint_command()) {
    reference.set_active_path_segment_id(static_cast<std::uint32_t>(passed_segments_.size()));
  }
  if (!legs_.empty()) {
    const PlanePoint here = core.computer.navigation.place();
    const Leg& leg = legs_[leg_];
    reference.set_course_to_target(static_cast<float>(
        std::atan2(leg.target.east_m - here.east_m, leg.target.north_m - here.north_m)));
    reference.set_speed_over_ground(static_cast<float>(leg.speed_m_s));
    reference.set_horizontal_distance_to_target(static_cast<float>(distance(here, leg.target)));
    reference.set_circle_of_acceptance(static_cast<float>(leg.reached_m));
  }
  reference.set_depth_set_point(
      static_cast<float>(guidance_.depth_m.value_or(guidance_.altitude_m.value_or(0.0))));
  reference.set_depth_zero_reference(guidance_.altitude_m ? bp::DEPTH_ZERO_REFERENCE_SEABED
                                                          : bp::DEPTH_ZERO_REFERENCE_SURFACE);
  const bool down = guidance_.depth_m
                        ? *guidance_.depth_m > core.rov.state().depth_m
                        : guidance_.altitude_m.value_or(0.0) < core.rov.state().altitude_m;
  const double vertical = verticalToGo(core);
  if (vertical >= kDepthReached_m) {
    reference.set_heave_velocity(
        static_cast<float>(down ? guidance_.vertical_speed_m_s : -guidance_.vertical_speed_m_s));
  }
  reference.set_vertical_distance_to_target(static_cast<float>(vertical));
  reference.set_time_to_complete(static_cast<float>(horizontalToGo(core) / surgeSpeed() +
                                                    vertical / guidance_.vertical_speed_m_s));
  return reference;
}

}  // namespace frontseat_driver::sim
