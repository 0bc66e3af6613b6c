#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/health.h"

namespace frontseat_driver::ros_layer {

/// What one layer says of itself.
struct Diagnosis {
  enum class Level : std::uint8_t { Ok, Warn, Error };  ///< numbered as DiagnosticStatus
  Level level = Level::Ok;
  std::string message;  ///< what is so; if it is not Ok, also what to do
  std::vector<std::pair<std::string, std::string>> values;
  bool known = true;  ///< false: a layer below is in the way, so nothing can be told
};

/// @{ Each layer judges only what it can see if the layers before it work, so the first one that is
/// not Ok is the cause. What is normal, idle or turned off is Ok.
Diagnosis diagnoseLink(const Health& health);
Diagnosis diagnoseData(const Health& health);      ///< what comes in, before it is decoded
Diagnosis diagnoseDecoding(const Health& health);  ///< whether it can be read
Diagnosis diagnoseClock(const Health& health);
Diagnosis diagnoseControl(const Health& health);   ///< permission to command
Diagnosis diagnoseCommands(const Health& health);  ///< and their effect
Diagnosis diagnoseBattery(const Health& health);
/// @}

struct Layer {
  const char* name;
  Diagnosis (*diagnose)(const Health& health);
  bool logged;  ///< false: whoever notices logs it, with more to say
};

/// From the wire up.
inline constexpr std::array<Layer, 7> kLayers = {{
    {"link", diagnoseLink, false},
    {"data", diagnoseData, true},
    {"decoding", diagnoseDecoding, true},
    {"clock", diagnoseClock, true},
    {"control", diagnoseControl, false},
    {"commands", diagnoseCommands, true},
    {"battery", diagnoseBattery, true},
}};

using Diagnoses = std::array<Diagnosis, kLayers.size()>;

/// Of every layer. Without a link, nothing is known of the others, and they are not to blame.
Diagnoses diagnose(const Health& health);

/// What to do about a link that fails for `reason`, which is as link::TcpClient tells it; empty if
/// there is nothing to add.
std::string linkAdvice(const std::string& reason);

/// As std::printf has it.
std::string printed(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace frontseat_driver::ros_layer
