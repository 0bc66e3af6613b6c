#pragma once

#include <string>

#include "frontseat_driver/vehicle/command.h"

namespace frontseat_driver::ros_layer {

/// A command for people, as the vehicle gets it: "heading 90.0 deg, depth 5.0 m, speed 1.50 m/s".
std::string toWords(const vehicle::Command& command);

}  // namespace frontseat_driver::ros_layer
