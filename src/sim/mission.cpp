#include "frontseat_driver/sim/mission.h"

#include <array>
#include <cstdio>
#include <utility>

namespace frontseat_driver::sim {
namespace {

constexpr double kReached_m = 3.0;
constexpr double kLineLookahead_m = 8.0;
constexpr double kSurfaced_m = 0.3;
constexpr double kTransitSpeed_m_s = 1.2;
constexpr double kAscentPitch_deg = 25.0;
constexpr double kShortestAscent_s = 1.0;   // so that Aborting is told even at the surface
constexpr double kLongestWrapUp_s = 600.0;  // against a current that no torpedo overcomes

/// Words of SPI 0.1, section 6.3.
const char* words(Mission::State state) {
  using State = Mission::State;
  switch (state) {
    case State::Offline:
      return "Offline";
    case State::Waiting:
      return "Waiting";
    case State::InvalidDiveFile:
      return "Invalid Dive File";
    case State::InvalidWrapupFile:
      return "Invalid Wrapup File";
    case State::Ready:
      return "Ready";
    case State::Running:
      return "Running";
    case State::WrappingUp:
      return "WrappingUp";
    case State::Aborting:
      return "Aborting";
    case State::Completed:
      return "Completed";
    case State::Aborted:
      return "Aborted";
    case State::Stopped:
      return "Stopped";
    case State::Unknown:
      break;
  }
  return "";
}

Setpoint along(const Line& line, const VehicleState& state) {
  Setpoint setpoint;
  setpoint.horizontal_mode = Setpoint::HorizontalMode::Heading;
  setpoint.horizontal_deg = headingAlong(line, state, kLineLookahead_m);
  setpoint.vertical_mode = Setpoint::VerticalMode::Depth;
  setpoint.speed_mode = Setpoint::SpeedMode::Speed;
  setpoint.speed = kTransitSpeed_m_s;
  return setpoint;
}

}  // namespace

std::vector<Leg> lawnMower(const Survey& survey) {
  using Mode = Setpoint::VerticalMode;
  std::vector<Leg> legs;
  for (int i = 0; i < survey.lines; ++i) {
    const double east_m = 15.0 + i * survey.spacing_m;
    const double south_m = -survey.length_m / 2.0;
    const double north_m = survey.length_m / 2.0;
    const bool northwards = i % 2 == 0;
    legs.push_back({{east_m, northwards ? south_m : north_m}, 0.0, Mode::Depth, survey.speed_m_s});
    legs.push_back(
        {{east_m, northwards ? north_m : south_m}, survey.depth_m, Mode::Depth, survey.speed_m_s});
  }
  return legs;
}

Mission::Mission(MissionPlan plan) : plan_(std::move(plan)), leg_(plan_.legs.size()) {}

void Mission::step(double dt_s, const VehicleState& state, bool held) {
  in_state_s_ += dt_s;
  const bool surfaced = state.depth_m < kSurfaced_m;
  switch (state_) {
    case State::Ready:
      if (in_state_s_ < plan_.ready_s) return;
      leg_ = 0;
      ++runs_;
      line_ = {{state.east_m, state.north_m}, {state.east_m, state.north_m}};
      if (!plan_.legs.empty()) line_.to = plan_.legs.front().to;
      return enter(State::Running);
    case State::Running:
      if (!held) run(state);
      return;
    case State::WrappingUp:
      if ((surfaced && atEnd(line_, state, kReached_m)) || in_state_s_ > kLongestWrapUp_s) {
        enter(State::Completed);
      }
      return;
    case State::Aborting:
      if (surfaced && in_state_s_ >= kShortestAscent_s) enter(State::Aborted, details_);
      return;
    case State::Completed:
      if (plan_.loop && in_state_s_ >= plan_.completed_s) enter(State::Ready);
      return;
    default:
      return;
  }
}

void Mission::run(const VehicleState& state) {
  const bool at_end = leg_ < plan_.legs.size() && atEnd(line_, state, kReached_m);
  if (at_end) ++leg_;
  if (leg_ < plan_.legs.size()) {
    if (at_end) line_ = {line_.to, plan_.legs[leg_].to};
    return;
  }
  line_ = {{state.east_m, state.north_m}, PlanePoint{}};
  enter(State::WrappingUp);
}

Setpoint Mission::setpoint(const VehicleState& state) const {
  if (state_ == State::Running && leg_ < plan_.legs.size()) {
    Setpoint setpoint = along(line_, state);
    setpoint.vertical = plan_.legs[leg_].vertical_m;
    setpoint.vertical_mode = plan_.legs[leg_].vertical_mode;
    setpoint.speed = plan_.legs[leg_].speed_m_s;
    return setpoint;
  }
  if (state_ == State::WrappingUp) return along(line_, state);
  Setpoint setpoint;
  if (state_ == State::Aborting) {
    setpoint.vertical_mode = Setpoint::VerticalMode::Pitch;
    setpoint.vertical = kAscentPitch_deg;
    setpoint.speed_mode = Setpoint::SpeedMode::Speed;
    setpoint.speed = kTransitSpeed_m_s;
  }
  return setpoint;
}

void Mission::abort(std::string details) {
  if (state_ == State::Aborting || state_ == State::Aborted) return;
  enter(State::Aborting, std::move(details));
}

void Mission::restart() {
  if (state_ == State::Completed || state_ == State::Aborted) enter(State::Ready);
}

std::string Mission::status() const {
  if (state_ != State::Running) return words(state_);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "Running /logs/dive_%04d", runs_);
  return text.data();
}

void Mission::enter(State state, std::string details) {
  state_ = state;
  in_state_s_ = 0.0;
  details_ = std::move(details);
  if (state != State::Running) leg_ = plan_.legs.size();
}

}  // namespace frontseat_driver::sim
