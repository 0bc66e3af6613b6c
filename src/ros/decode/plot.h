#pragma once

#include "options.h"

namespace frontseat_driver::decode {

/// Becomes the program nmea_plot, which stands beside this one: `nmea_plot INPUT PICTURE`, with
/// `--namespace=NAME` for one vehicle of a bag. Throws std::system_error if it cannot be started.
[[noreturn]] void runPlot(const Options& options);

}  // namespace frontseat_driver::decode
