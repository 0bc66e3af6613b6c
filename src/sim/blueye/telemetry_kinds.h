#pragma once

#include <optional>
#include <string>
#include <vector>

#include "telemetry.h"

namespace frontseat_driver::sim {

/// A row of the table: `build` fills the message, or says that there is none.
template <class Message>
BlueyeTelemetry telemetry(double hz, bool (*build)(BlueyeCore&, Message&)) {
  return {nameOf<Message>(), hz, [build](BlueyeCore& core) -> std::optional<std::string> {
            Message message;
            if (!build(core, message)) return std::nullopt;
            return message.SerializeAsString();
          }};
}

inline float toFloat(double value) { return static_cast<float>(value); }

// The table's parts.
void addMotionTelemetry(std::vector<BlueyeTelemetry>& all);
void addStatusTelemetry(std::vector<BlueyeTelemetry>& all);
void addPayloadTelemetry(std::vector<BlueyeTelemetry>& all);
void addLaterTelemetry(std::vector<BlueyeTelemetry>& all);

}  // namespace frontseat_driver::sim
