#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core.h"

namespace frontseat_driver::sim {

/// A telemetry message the drone can send.
struct BlueyeTelemetry {
  std::string name;  ///< without package
  double hz;         ///< unless told otherwise; 0: on request or on events only
  /// The message as it is now, serialized; empty if there is none, as of a device that is not
  /// fitted.
  std::function<std::optional<std::string>(BlueyeCore&)> build;
};

/// All of them; nothing else lists them.
const std::vector<BlueyeTelemetry>& blueyeTelemetry();

/// The one of that name; null if there is none.
const BlueyeTelemetry* findBlueyeTelemetry(const std::string& name);

bp::Battery batteryOf(BlueyeCore& core);

}  // namespace frontseat_driver::sim
