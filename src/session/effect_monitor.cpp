#include "frontseat_driver/session/effect_monitor.h"

#include <cmath>
#include <cstdio>

namespace frontseat_driver::session {

namespace {

using vehicle::BehaviorCommand;

// Near enough to call it reached, and how much nearer counts as an answer.
constexpr double kHeadingReached_deg = 15.0;
constexpr double kHeadingNearer_deg = 5.0;
constexpr double kDepthReached_m = 1.0;
constexpr double kDepthNearer_m = 0.5;
constexpr double kSpeedReached_m_s = 0.3;
constexpr double kSpeedNearer_m_s = 0.15;
// Thrust that moves a boat against friction, and the speed that shows that it does.
constexpr double kMovingThrust = 0.2;
constexpr double kMoving_m_s = 0.1;

double headingError_deg(double commanded_deg, double measured_deg) {
  return std::abs(std::remainder(commanded_deg - measured_deg, 360.0));
}

std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return std::nullopt;
  return std::abs(*a - *b);
}

bool within(const std::optional<double>& error, double limit) { return !error || *error <= limit; }

bool reduced(const std::optional<double>& now, const std::optional<double>& before, double by) {
  return now && before && *before - *now >= by;
}

std::string figure(const char* what, const std::optional<double>& commanded,
                   const std::optional<double>& measured, const char* unit) {
  if (!commanded || !measured) return {};
  char text[96];
  std::snprintf(text, sizeof text, "%s %.1f %s commanded, %.1f %s measured; ", what, *commanded,
                unit, *measured, unit);
  return text;
}

}  // namespace

EffectMonitor::Target EffectMonitor::targetOf(const vehicle::Command& command) {
  Target target;
  if (const auto* behavior = std::get_if<BehaviorCommand>(&command)) {
    if (behavior->horizontal && behavior->horizontal->mode == BehaviorCommand::Horizontal::Heading)
      target.heading_deg = behavior->horizontal->value;
    if (behavior->vertical && behavior->vertical->mode == BehaviorCommand::Vertical::Depth)
      target.depth_m = behavior->vertical->value;
    if (behavior->speed && behavior->speed->mode == BehaviorCommand::Speed::MetresPerSecond)
      target.speed_m_s = behavior->speed->value;
  } else if (const auto* course = std::get_if<vehicle::CourseCommand>(&command)) {
    // A boat that does not move need not turn to its course.
    if (course->speed_m_s > kMoving_m_s) target.heading_deg = course->heading_deg;
    target.speed_m_s = course->speed_m_s;
    target.must_move = course->speed_m_s > kSpeedReached_m_s;
  } else if (const auto* drive = std::get_if<vehicle::DriveCommand>(&command)) {
    target.must_move = std::abs(drive->port + drive->starboard) / 2.0 > kMovingThrust;
  } else if (const auto* helm = std::get_if<vehicle::HelmCommand>(&command)) {
    target.must_move = std::abs(helm->thrust) > kMovingThrust;
  }
  return target;
}

bool EffectMonitor::same(const Target& a, const Target& b) {
  return a.heading_deg.has_value() == b.heading_deg.has_value() &&
         (!a.heading_deg ||
          headingError_deg(*a.heading_deg, *b.heading_deg) < kHeadingNearer_deg) &&
         a.depth_m.has_value() == b.depth_m.has_value() &&
         within(difference(a.depth_m, b.depth_m), kDepthNearer_m) &&
         a.speed_m_s.has_value() == b.speed_m_s.has_value() &&
         within(difference(a.speed_m_s, b.speed_m_s), kSpeedNearer_m_s) &&
         a.must_move == b.must_move;
}

void EffectMonitor::commanded(const vehicle::Command& command, const PresentState& present,
                              SteadyTime now) {
  const Target target = targetOf(command);
  if (target_ && same(*target_, target)) return;
  // A target that keeps moving gives a vehicle that answers nothing no more time.
  if (!target_) answered_at_ = now;
  target_ = target;
  baseline_ = errors(present);
}

void EffectMonitor::clear() {
  target_.reset();
  complaint_.clear();
}

EffectMonitor::Errors EffectMonitor::errors(const PresentState& present) const {
  Errors errors;
  if (target_->heading_deg && present.heading_deg) {
    errors.heading_deg = headingError_deg(*target_->heading_deg, *present.heading_deg);
  }
  errors.depth_m = difference(target_->depth_m, present.depth_m);
  errors.speed_m_s = difference(target_->speed_m_s, present.speed_m_s);
  // A Heron that stands still tells no velocity.
  if (target_->must_move && present.speed_m_s.value_or(0.0) < kMoving_m_s) {
    errors.speed_m_s = kSpeedReached_m_s + kSpeedNearer_m_s;  // not reached until it moves
  }
  return errors;
}

bool EffectMonitor::reached(const Errors& errors) {
  return within(errors.heading_deg, kHeadingReached_deg) &&
         within(errors.depth_m, kDepthReached_m) && within(errors.speed_m_s, kSpeedReached_m_s);
}

bool EffectMonitor::nearer(const Errors& now, const Errors& before) {
  return reduced(now.heading_deg, before.heading_deg, kHeadingNearer_deg) ||
         reduced(now.depth_m, before.depth_m, kDepthNearer_m) ||
         reduced(now.speed_m_s, before.speed_m_s, kSpeedNearer_m_s);
}

void EffectMonitor::measured(const PresentState& present, SteadyTime now) {
  if (!target_) return;
  const Errors current = errors(present);
  if (reached(current) || nearer(current, baseline_)) {
    baseline_ = current;
    answered_at_ = now;
    complaint_.clear();
  } else if (now - answered_at_ >= timeout_) {
    complaint_ = describe(present, now - answered_at_);
  }
}

std::string EffectMonitor::describe(const PresentState& present,
                                    std::chrono::nanoseconds since) const {
  std::string text = figure("heading", target_->heading_deg, present.heading_deg, "deg") +
                     figure("depth", target_->depth_m, present.depth_m, "m") +
                     figure("speed", target_->speed_m_s, present.speed_m_s, "m/s");
  if (target_->must_move) text += "thrust commanded, the vehicle does not move; ";
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since).count();
  return text + "no answer for " + std::to_string(seconds) + " s";
}

}  // namespace frontseat_driver::session
