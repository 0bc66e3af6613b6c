#include "blueye/service_requests.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "blueye/messages.h"
#include "check.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

constexpr double kMultibeamLimit_deg = 28.0;  // of the servo, though the document says 30

/// Of `guest_port_<n>_servo`, as joint_states names it.
std::optional<int> guestPortOf(const std::string& joint) {
  for (int port = 1; port <= 6; ++port) {
    if (joint == "guest_port_" + std::to_string(port) + "_servo") return port;
  }
  return std::nullopt;
}

}  // namespace

ConvertedReset toReset(const ResetPositionRequest& wanted) {
  Check check;
  check.oneOf("heading_source", wanted.heading_source, 1, 2, "1 (COMPASS) or 2 (MANUAL)");
  check.angle_rad("yaw", wanted.yaw);
  check.oneOf("coordinate_source", wanted.coordinate_source, 1, 3,
              "1 (DEVICE_GPS), 2 (MANUAL) or 3 (BLUEYE_GNSS)");
  check.within("latitude", wanted.latitude, -90.0, 90.0);
  check.within("longitude", wanted.longitude, -180.0, 180.0);
  check.oneOf("heading_mode", wanted.heading_mode, 1, 2, "1 (COMPASS) or 2 (GYRO)");
  if (!check.refusal().empty()) return check.refusal();
  pb::ResetPositionCtrl message;
  pb::ResetPositionSettings& settings = *message.mutable_settings();
  settings.set_heading_source_during_reset(static_cast<pb::HeadingSource>(wanted.heading_source));
  const auto heading_deg = static_cast<float>(headingOf_deg(wanted.yaw));
  settings.set_manual_heading(heading_deg < 360.0F ? heading_deg : 0.0F);  // a float may round up
  settings.set_reset_coordinate_source(
      static_cast<pb::ResetCoordinateSource>(wanted.coordinate_source));
  settings.mutable_reset_coordinate()->set_latitude(wanted.latitude);
  settings.mutable_reset_coordinate()->set_longitude(wanted.longitude);
  settings.set_heading_mode(static_cast<pb::HeadingMode>(wanted.heading_mode));
  return message;
}

ConvertedRecord toRecord(const RecordRequest& wanted,
                         const std::optional<pb::RecordState>& present) {
  constexpr const char* kAccepted = "0 (KEEP), 1 (START) or 2 (STOP)";
  Check check;
  check.oneOf("main", wanted.main, 0, 2, kAccepted);
  check.oneOf("guestport", wanted.guestport, 0, 2, kAccepted);
  check.oneOf("multibeam", wanted.multibeam, 0, 2, kAccepted);
  if (!check.refusal().empty()) return check.refusal();
  const bool keeps = wanted.main == RecordRequest::KEEP ||
                     wanted.guestport == RecordRequest::KEEP ||
                     wanted.multibeam == RecordRequest::KEEP;
  if (!present && keeps) return "the drone has not told yet what it records; nothing can be kept";
  const auto on = [](std::uint8_t choice, bool recorded) {
    return choice == RecordRequest::KEEP ? recorded : choice == RecordRequest::START;
  };
  const pb::RecordState state = present.value_or(pb::RecordState{});
  pb::RecordCtrl message;
  message.mutable_record_on()->set_main(on(wanted.main, state.main_is_recording()));
  message.mutable_record_on()->set_guestport(on(wanted.guestport, state.guestport_is_recording()));
  message.mutable_record_on()->set_multibeam(on(wanted.multibeam, state.multibeam_is_recording()));
  return message;
}

ConvertedJoint toJointControl(const std::string& joint, double position_rad,
                              const Conventions& how) {
  const bool is_sonar = joint == "multibeam_tilt";
  const auto port = guestPortOf(joint);
  if (!is_sonar && !port) {
    return "joint is '" + joint + "'; multibeam_tilt and guest_port_1_servo to 6 are accepted";
  }
  Check check;
  check.within("position", position_rad, is_sonar ? -M_PI_2 : how.servo_min_rad,
               is_sonar ? M_PI_2 : how.servo_max_rad);
  if (!check.refusal().empty()) return check.refusal();
  if (is_sonar) {
    const double angle_deg = (how.multibeam_tilt_up ? -1.0 : 1.0) * position_rad * 180.0 / M_PI;
    pb::MultibeamServoCtrl message;
    message.mutable_servo()->set_angle(
        static_cast<float>(std::clamp(angle_deg, -kMultibeamLimit_deg, kMultibeamLimit_deg)));
    return message;
  }
  pb::GenericServoCtrl message;
  message.mutable_servo()->set_value(static_cast<float>((position_rad - how.servo_min_rad) /
                                                        (how.servo_max_rad - how.servo_min_rad)));
  message.mutable_servo()->set_guest_port_number(static_cast<pb::GuestPortNumber>(*port));
  return message;
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
