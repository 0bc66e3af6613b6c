#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core.h"

namespace frontseat_driver::sim {

/// A request the drone answers.
struct BlueyeRequest {
  std::string name;   ///< without package
  std::string reply;  ///< of its answer
  /// The answer, serialized; empty if `data` is not that request.
  std::function<std::optional<std::string>(BlueyeCore&, std::string_view data)> answer;
};

/// All of them; nothing else lists them.
const std::vector<BlueyeRequest>& blueyeRequests();

/// The one of that name; null if there is none.
const BlueyeRequest* findBlueyeRequest(const std::string& name);

}  // namespace frontseat_driver::sim
