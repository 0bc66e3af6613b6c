#pragma once

namespace frontseat_driver::ros_layer::blueye_layer {

/// Lets protobuf complain of texts that are no UTF-8 only once in ten seconds: it writes a line for
/// each, so that a drone could fill the disk with them. The message is counted as malformed anyway.
/// All other lines stay as they are. For the whole process, and once.
void throttleProtobufLog();

}  // namespace frontseat_driver::ros_layer::blueye_layer
