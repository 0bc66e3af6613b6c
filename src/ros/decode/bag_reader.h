#pragma once

#include <memory>
#include <string>

#include "frontseat_driver/capture/reader.h"

namespace frontseat_driver::decode {

/// The sentences of one vehicle in a bag: every topic that ends with `nmea/rx` or `nmea/tx` and is
/// of the package's own type. `vehicle` is the namespace, which may be empty where there is only
/// one. Throws std::runtime_error with one line: no bag, an unindexed one, no such topics, several
/// vehicles (which it names). The index of the bag is in memory while it is read.
std::unique_ptr<capture::Reader> openBag(const std::string& path, const std::string& vehicle);

}  // namespace frontseat_driver::decode
