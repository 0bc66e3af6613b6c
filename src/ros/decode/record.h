#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "frontseat_driver/capture/reader.h"
#include "options.h"

namespace frontseat_driver::decode {

/// The user's input, opened.
struct Record {
  std::unique_ptr<capture::Reader> reader;
  std::optional<std::uint64_t> size;  ///< bytes that counters().bytes goes up to
  bool live = false;                  ///< comes as it happens
};

/// Tells by the first bytes what the input is. Throws std::exception with a line that names it and
/// says what is wrong.
Record openRecord(const Options& options);

}  // namespace frontseat_driver::decode
