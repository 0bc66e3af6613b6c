#pragma once

#include <map>
#include <utility>

#include "messages.h"

namespace frontseat_driver::sim {

/// What the water around a probe is like.
struct BlueyeWater {
  double temperature_c = 9.0;
  double depth_m = 0.0;
  double density_g_l = 1025.0;
};

/// An Aqua TROLL 500 with sensors for temperature, pressure and depth, and conductivity.
class BlueyeAquaTroll {
 public:
  void connect(bool connected) { connected_ = connected; }
  bool connected() const { return connected_; }

  /// False if the probe has no such parameter, or the parameter no such unit.
  bool setUnit(const bp::SetAquaTrollParameterUnit& wanted);

  bp::AquaTrollProbeMetadata probe(const google::protobuf::Timestamp& clock) const;
  bp::AquaTrollSensorMetadataArray sensors(const google::protobuf::Timestamp& clock,
                                           const BlueyeWater& water) const;
  bp::AquaTrollSensorParametersArray parameters(const google::protobuf::Timestamp& clock,
                                                const BlueyeWater& water) const;

 private:
  template <class Sensor>
  void addBlocks(Sensor& sensor, const BlueyeWater& water) const;

  bool connected_ = true;
  std::map<std::pair<int, int>, bp::AquaTrollUnit> units_;  ///< by sensor and parameter
};

}  // namespace frontseat_driver::sim
