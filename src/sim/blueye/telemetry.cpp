#include "telemetry.h"

#include "telemetry_kinds.h"

namespace frontseat_driver::sim {

const std::vector<BlueyeTelemetry>& blueyeTelemetry() {
  static const std::vector<BlueyeTelemetry> kAll = [] {
    std::vector<BlueyeTelemetry> all;
    addMotionTelemetry(all);
    addStatusTelemetry(all);
    addPayloadTelemetry(all);
    addLaterTelemetry(all);
    return all;
  }();
  return kAll;
}

const BlueyeTelemetry* findBlueyeTelemetry(const std::string& name) {
  for (const BlueyeTelemetry& row : blueyeTelemetry()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace frontseat_driver::sim
