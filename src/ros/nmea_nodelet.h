#pragma once

#include <nodelet/nodelet.h>

#include <memory>

#include "nmea_bridge.h"

namespace frontseat_driver::ros_layer {

/// The driver for both NMEA dialects as a nodelet. A parameter that cannot be used is said in one
/// line and leaves this nodelet, and only this one, down.
class NmeaNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;

  std::unique_ptr<NmeaBridge> bridge_;
};

}  // namespace frontseat_driver::ros_layer
