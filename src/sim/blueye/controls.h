#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core.h"

namespace frontseat_driver::sim {

enum class BlueyeTaken { Obeyed, Malformed, Refused };

/// A control message the drone obeys.
struct BlueyeControl {
  std::string name;  ///< without package
  std::function<BlueyeTaken(BlueyeCore&, std::string_view data)> obey;
};

/// All of them; nothing else lists them.
const std::vector<BlueyeControl>& blueyeControls();

/// The one of that name; null if there is none.
const BlueyeControl* findBlueyeControl(const std::string& name);

}  // namespace frontseat_driver::sim
