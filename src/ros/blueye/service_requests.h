#pragma once

#include <blueye/control.pb.h>
#include <frontseat_driver/RecordRequest.h>
#include <frontseat_driver/ResetPositionRequest.h>

#include <optional>
#include <string>
#include <variant>

#include "blueye/conventions.h"

/// What services and cmd_joint ask for as control messages. What is out of range is refused whole,
/// in words that name field, value and range.
namespace frontseat_driver::ros_layer::blueye_layer {

/// The control message, or why there is none.
using ConvertedReset = std::variant<blueye::protocol::ResetPositionCtrl, std::string>;
using ConvertedRecord = std::variant<blueye::protocol::RecordCtrl, std::string>;
using ConvertedJoint = std::variant<blueye::protocol::GenericServoCtrl,
                                    blueye::protocol::MultibeamServoCtrl, std::string>;

/// The manual heading counts clockwise from north, in degrees from 0 to below 360.
ConvertedReset toReset(const ResetPositionRequest& wanted);

/// Cameras that keep what they do go on as in `present`, which the drone told last.
ConvertedRecord toRecord(const RecordRequest& wanted,
                         const std::optional<blueye::protocol::RecordState>& present);

/// A joint as joint_states names it, in rad: guest_port_1_servo to 6, from servo_min to servo_max,
/// and multibeam_tilt, a turn about the axis to port, to the servo's limit of 28 degrees.
ConvertedJoint toJointControl(const std::string& joint, double position_rad,
                              const Conventions& how);

}  // namespace frontseat_driver::ros_layer::blueye_layer
