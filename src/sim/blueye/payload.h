#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "frontseat_driver/sim/geography.h"
#include "messages.h"

namespace frontseat_driver::sim {

/// A series of photographs, one every so many seconds or metres.
struct BlueyeTimeLapse {
  bp::IntervalType type = bp::INTERVAL_TYPE_UNSPECIFIED;
  double interval = 0.0;  ///< s or m
  std::int32_t taken = 0;
  double since_last = 0.0;

  bool running() const { return type != bp::INTERVAL_TYPE_UNSPECIFIED; }
};

/// One camera that records, and for how long.
struct BlueyeRecorder {
  bool on = false;
  double seconds = 0.0;

  void set(bool wanted) {
    if (wanted && !on) seconds = 0.0;
    on = wanted;
  }
};

/// What a drone carries that neither moves nor navigates it.
struct BlueyePayload {
  static constexpr double kTiltLimit_deg = 30.0;
  static constexpr double kMultibeamLimit_deg = 30.0;
  static constexpr double kPictureBytes = 4e6;
  static constexpr double kRecordBytes_s = 2e6;
  static constexpr double kVideoBytes = 200e9;

  double lights = 0.0;
  double guest_port_lights = 0.0;
  bp::Laser laser;
  double tilt_velocity = 0.0;  ///< -1..1, up
  double tilt_deg = 0.0;       ///< of the camera against the horizon or the hull, up
  bool tilt_stabilized = false;
  double grip_velocity = 0.0;
  double rotate_velocity = 0.0;
  double grip_opening = 0.0;  ///< 0 closed, 1 open
  double servo = 0.5;         ///< 0..1
  double servo_target = 0.5;
  double multibeam_servo_deg = 0.0;
  double multibeam_servo_target_deg = 0.0;
  BlueyeRecorder main, guest_port, multibeam;
  std::array<bp::StorageLocation, 3> locations{
      bp::STORAGE_LOCATION_INTERNAL, bp::STORAGE_LOCATION_INTERNAL, bp::STORAGE_LOCATION_INTERNAL};
  BlueyeTimeLapse time_lapse;
  std::uint32_t pictures = 0;
  double video_used_bytes = 1e9;
  bp::CalibrationState calibration;
  double formatting_s = 0.0;  ///< until the removable drive is empty

  BlueyePayload();

  void step(double dt_s, double moved_m);
  void takePicture();
  /// Moves the camera towards an angle; true when it is there.
  bool tiltTo(double angle_deg, double dt_s);
  void startCalibration();
  void endCalibration();
  double power() const;  ///< W

 private:
  void calibrate(double dt_s);
};

}  // namespace frontseat_driver::sim
