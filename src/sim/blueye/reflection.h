#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "messages.h"

namespace frontseat_driver::sim {

/// Whether `data` is a message of that name (without package) in which every number is finite: no
/// NaN and no infinity, at any depth. False for a name that is no message.
bool isFinite(const std::string& name, std::string_view data);

/// Sets a field of ErrorFlags by its name; false if there is none.
bool setFlag(bp::ErrorFlags& flags, const std::string& field, bool value);

/// Names, without package, of all messages of the protocol that end in `ending`.
std::vector<std::string> messagesEndingIn(std::string_view ending);

}  // namespace frontseat_driver::sim
