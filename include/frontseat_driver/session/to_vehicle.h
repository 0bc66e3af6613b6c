#pragma once

#include <optional>

#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

/// What a sentence from the vehicle says in the words that all vehicles share; nothing for a
/// sentence that has its place only in the conversation (BFCTL) or only in the record (BFDVL, VTG).
/// Texts are views into the sentence.
std::optional<vehicle::Event> toVehicle(const protocol::Message& message);

/// The time at which the vehicle made a sentence, where it has one: not that of the data in it.
std::optional<vehicle::TimeOfDay> sentAt(const protocol::Message& message);

/// The state a BFMIS status names, the log directory that may follow "Running" taken off. SPI 0.1,
/// section 6.3.
vehicle::MissionStatus toVehicle(const protocol::bluefin::MissionStatus& mission);

/// The command a BFACK is for, without its talker: field vehicles send "RMB", the document "BPRMB".
std::string_view commandFormatter(std::string_view name);

}  // namespace frontseat_driver::session
