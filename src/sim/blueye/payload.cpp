#include "payload.h"

#include <algorithm>
#include <cmath>

namespace frontseat_driver::sim {
namespace {

constexpr double kTilt_deg_s = 20.0;
constexpr double kServo_s = 2.0;  // end to end
constexpr double kMultibeam_deg_s = 15.0;
constexpr double kGrip_s = 3.0;
constexpr double kCalibrateAxis_s = 3.0;
constexpr double kLightsPower_w = 90.0;
constexpr double kGuestPortLightsPower_w = 30.0;

double approach(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

struct Axis {
  bp::CalibrationState::Status status;
  float (bp::CalibrationState::*progress)() const;
  void (bp::CalibrationState::*set)(float);
};

using State = bp::CalibrationState;
const Axis kAxes[] = {
    {State::STATUS_CALIBRATING_X_POSITIVE, &State::progress_x_positive,
     &State::set_progress_x_positive},
    {State::STATUS_CALIBRATING_X_NEGATIVE, &State::progress_x_negative,
     &State::set_progress_x_negative},
    {State::STATUS_CALIBRATING_Y_POSITIVE, &State::progress_y_positive,
     &State::set_progress_y_positive},
    {State::STATUS_CALIBRATING_Y_NEGATIVE, &State::progress_y_negative,
     &State::set_progress_y_negative},
    {State::STATUS_CALIBRATING_Z_POSITIVE, &State::progress_z_positive,
     &State::set_progress_z_positive},
    {State::STATUS_CALIBRATING_Z_NEGATIVE, &State::progress_z_negative,
     &State::set_progress_z_negative},
    {State::STATUS_CALIBRATING_THRUSTER, &State::progress_thruster, &State::set_progress_thruster}};

}  // namespace

BlueyePayload::BlueyePayload() { calibration.set_status(State::STATUS_NOT_CALIBRATING); }

void BlueyePayload::step(double dt_s, double moved_m) {
  const double tilted = tilt_deg + kTilt_deg_s * tilt_velocity * dt_s;
  tilt_deg = std::clamp(tilted, -kTiltLimit_deg, kTiltLimit_deg);
  servo = approach(servo, servo_target, dt_s / kServo_s);
  multibeam_servo_deg =
      approach(multibeam_servo_deg, multibeam_servo_target_deg, kMultibeam_deg_s * dt_s);
  grip_opening = std::clamp(grip_opening + grip_velocity * dt_s / kGrip_s, 0.0, 1.0);
  for (BlueyeRecorder* recorder : {&main, &guest_port, &multibeam}) {
    if (!recorder->on) continue;
    recorder->seconds += dt_s;
    video_used_bytes += kRecordBytes_s * dt_s;
  }
  if (time_lapse.running()) {
    time_lapse.since_last += time_lapse.type == bp::INTERVAL_TYPE_TIME ? dt_s : moved_m;
    if (time_lapse.since_last >= time_lapse.interval) {
      time_lapse.since_last -= time_lapse.interval;
      ++time_lapse.taken;
      takePicture();
    }
  }
  formatting_s = std::max(0.0, formatting_s - dt_s);
  video_used_bytes = std::min(video_used_bytes, kVideoBytes);
  calibrate(dt_s);
}

void BlueyePayload::takePicture() {
  ++pictures;
  video_used_bytes += kPictureBytes;
}

bool BlueyePayload::tiltTo(double angle_deg, double dt_s) {
  const double target = std::clamp(angle_deg, -kTiltLimit_deg, kTiltLimit_deg);
  tilt_deg = approach(tilt_deg, target, kTilt_deg_s * dt_s);
  return std::abs(tilt_deg - target) < 1e-6;
}

void BlueyePayload::startCalibration() {
  calibration.Clear();
  calibration.set_status(State::STATUS_CALIBRATING_NO_AXIS);
}

void BlueyePayload::endCalibration() { calibration.set_status(State::STATUS_NOT_CALIBRATING); }

void BlueyePayload::calibrate(double dt_s) {
  if (calibration.status() == State::STATUS_NOT_CALIBRATING) return;
  for (const Axis& axis : kAxes) {
    const float progress = (calibration.*axis.progress)();
    if (progress >= 1.0F) continue;
    calibration.set_status(axis.status);
    (calibration.*axis.set)(std::min(1.0F, progress + static_cast<float>(dt_s / kCalibrateAxis_s)));
    return;
  }
  calibration.set_status(State::STATUS_CALIBRATING_NO_AXIS);
}

double BlueyePayload::power() const {
  return kLightsPower_w * lights + kGuestPortLightsPower_w * guest_port_lights;
}

}  // namespace frontseat_driver::sim
