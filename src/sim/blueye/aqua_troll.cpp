#include "aqua_troll.h"

#include <algorithm>
#include <vector>

namespace frontseat_driver::sim {
namespace {

constexpr double kGravity = 9.80665;

struct Unit {
  bp::AquaTrollUnit unit;
  double factor;  ///< from the first unit of the list
};

struct Parameter {
  bp::AquaTrollSensor sensor;
  bp::AquaTrollParameter parameter;
  std::vector<Unit> units;
  double (*value)(const BlueyeWater&);
};

double conductivity(const BlueyeWater& water) {  // mS/cm of sea water, near enough
  return water.density_g_l < 1005.0 ? 0.3 : 30.0 + 0.9 * water.temperature_c;
}

constexpr auto kTemperatureSensor = bp::AQUA_TROLL_SENSOR_TEMPERATURE;
constexpr auto kPressureSensor =
    bp::AQUA_TROLL_SENSOR_S300_PSI_FULL_SCALE_GAUGE_PRESSURE_WITH_LEVEL_AND_TEMPERATURE;

const std::vector<Parameter>& allParameters() {
  static const std::vector<Parameter> kAll{
      {kTemperatureSensor,
       bp::AQUA_TROLL_PARAMETER_TEMPERATURE,
       {{bp::AQUA_TROLL_UNIT_TEMP_CELSIUS, 1.0}},
       [](const BlueyeWater& water) { return water.temperature_c; }},
      {kPressureSensor,
       bp::AQUA_TROLL_PARAMETER_PRESSURE,
       {{bp::AQUA_TROLL_UNIT_KILOPASCALS, 1.0},
        {bp::AQUA_TROLL_UNIT_CENTIMETERS_OF_WATER, 10.19716}},
       [](const BlueyeWater& water) {
         return water.depth_m * water.density_g_l * kGravity / 1000.0;
       }},
      {kPressureSensor,
       bp::AQUA_TROLL_PARAMETER_DEPTH,
       {{bp::AQUA_TROLL_UNIT_METERS, 1.0},
        {bp::AQUA_TROLL_UNIT_CENTIMETERS, 100.0},
        {bp::AQUA_TROLL_UNIT_FEET, 1.0 / 0.3048}},
       [](const BlueyeWater& water) { return water.depth_m; }},
      {kTemperatureSensor,
       bp::AQUA_TROLL_PARAMETER_ACTUAL_CONDUCTIVITY,
       {{bp::AQUA_TROLL_UNIT_MILLISIEMENS_PER_CENTIMETER, 1.0},
        {bp::AQUA_TROLL_UNIT_MICROSIEMENS_PER_CENTIMETER, 1000.0}},
       conductivity}};
  return kAll;
}

constexpr bp::AquaTrollSensor kSensors[] = {kTemperatureSensor, kPressureSensor};

}  // namespace

bool BlueyeAquaTroll::setUnit(const bp::SetAquaTrollParameterUnit& wanted) {
  for (const Parameter& row : allParameters()) {
    if (row.sensor != wanted.sensor_id() || row.parameter != wanted.parameter_id()) continue;
    const bool offered = std::any_of(row.units.begin(), row.units.end(), [&](const Unit& unit) {
      return unit.unit == wanted.unit_id();
    });
    if (offered) units_[{row.sensor, row.parameter}] = wanted.unit_id();
    return offered;
  }
  return false;
}

template <class Sensor>
void BlueyeAquaTroll::addBlocks(Sensor& sensor, const BlueyeWater& water) const {
  for (const Parameter& row : allParameters()) {
    if (row.sensor != sensor.sensor_id()) continue;
    const auto chosen = units_.find({row.sensor, row.parameter});
    const bp::AquaTrollUnit id = chosen == units_.end() ? row.units.front().unit : chosen->second;
    bp::AquaTrollParameterBlock* block = sensor.add_parameter_blocks();
    block->set_parameter_id(row.parameter);
    block->set_units_id(id);
    for (const Unit& unit : row.units) {
      block->add_available_units(unit.unit);
      if (unit.unit != id) continue;
      block->set_measured_value(static_cast<float>(row.value(water) * unit.factor));
    }
    block->add_data_quality_ids(bp::AQUA_TROLL_QUALITY_NORMAL);
    block->set_off_line_sentinel_value(-999.0F);
  }
}

bp::AquaTrollProbeMetadata BlueyeAquaTroll::probe(const google::protobuf::Timestamp& clock) const {
  bp::AquaTrollProbeMetadata probe;
  *probe.mutable_timestamp() = clock;
  probe.set_status(connected_);
  probe.set_device_id(bp::AQUA_TROLL_DEVICE_AQUA_TROLL_500);
  probe.set_device_serial_number(500001);
  probe.set_firmware_version(211);
  probe.set_device_name("Aqua TROLL 500");
  probe.set_site_name("simulated");
  *probe.mutable_current_time_utc() = clock;
  for (const auto sensor : kSensors) probe.add_sensors(sensor);
  return probe;
}

bp::AquaTrollSensorMetadataArray BlueyeAquaTroll::sensors(const google::protobuf::Timestamp& clock,
                                                          const BlueyeWater& water) const {
  bp::AquaTrollSensorMetadataArray all;
  *all.mutable_timestamp() = clock;
  for (const auto id : kSensors) {
    bp::AquaTrollSensorMetadata* sensor = all.add_sensors();
    *sensor->mutable_timestamp() = clock;
    sensor->set_sensor_id(id);
    sensor->set_sensor_serial_number(600000U + static_cast<std::uint32_t>(id));
    sensor->set_warm_up_time_in_milliseconds(1000);
    sensor->set_fast_sample_rate_in_milliseconds(500);
    addBlocks(*sensor, water);
    sensor->set_number_of_sensor_parameters(
        static_cast<std::uint32_t>(sensor->parameter_blocks_size()));
  }
  return all;
}

bp::AquaTrollSensorParametersArray BlueyeAquaTroll::parameters(
    const google::protobuf::Timestamp& clock, const BlueyeWater& water) const {
  bp::AquaTrollSensorParametersArray all;
  *all.mutable_timestamp() = clock;
  for (const auto id : kSensors) {
    bp::AquaTrollSensorParameters* sensor = all.add_sensors();
    sensor->set_sensor_id(id);
    addBlocks(*sensor, water);
  }
  return all;
}

}  // namespace frontseat_driver::sim
