#pragma once

#include <functional>

#include "frontseat_driver/session/blueye_session.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// A piece of work for the thread that the session lives on, and the way there.
using Task = std::function<void(const vehicle::Now& now, session::BlueyeOutput& out)>;
using Post = std::function<void(Task)>;

}  // namespace frontseat_driver::ros_layer::blueye_layer
