#include <algorithm>
#include <cmath>

#include "telemetry_kinds.h"

namespace frontseat_driver::sim {

bp::Battery batteryOf(BlueyeCore& core) {
  bp::Battery battery;
  battery.set_voltage(toFloat(core.rov.state().stack_v));
  battery.set_level(toFloat(core.rov.batteryFraction()));
  battery.set_temperature(
      toFloat(core.config.water_temperature_c + 8.0 + 0.02 * core.rov.drawnPower()));
  return battery;
}

namespace {

constexpr double kCellsInSeries = 4.0;

bool battery(BlueyeCore& core, bp::BatteryTel& message) {
  *message.mutable_battery() = batteryOf(core);
  return true;
}

bool batteryDetails(BlueyeCore& core, bp::BatteryBQ40Z50Tel& message) {
  const bp::Battery pack = batteryOf(core);
  const double capacity_ah = core.config.battery.capacity_wh / core.config.battery.full_v;
  const double current_a = -core.rov.drawnPower() / std::max(1.0F, pack.voltage());
  const auto cell = toFloat(pack.voltage() / kCellsInSeries);
  bp::BatteryBQ40Z50& out = *message.mutable_battery();
  auto& voltage = *out.mutable_voltage();
  voltage.set_total(pack.voltage());
  voltage.set_cell_1(cell);
  voltage.set_cell_2(cell + 0.002F);
  voltage.set_cell_3(cell - 0.002F);
  voltage.set_cell_4(cell);
  auto& temperature = *out.mutable_temperature();
  temperature.set_average(pack.temperature());
  temperature.set_cell_1(pack.temperature());
  temperature.set_cell_2(pack.temperature() + 0.2F);
  temperature.set_cell_3(pack.temperature() - 0.2F);
  temperature.set_cell_4(pack.temperature());
  auto& status = *out.mutable_status();
  status.set_discharging_or_relax(true);
  status.set_fully_charged(pack.level() > 0.99F);
  status.set_fully_discharged(pack.level() <= 0.0F);
  status.set_remaining_capacity_alarm(pack.level() < 0.1F);
  status.set_error(bp::BatteryBQ40Z50::BatteryStatus::BATTERY_ERROR_OK);
  out.set_current(toFloat(current_a));
  out.set_average_current(toFloat(current_a));
  out.set_relative_state_of_charge(pack.level());
  out.set_absolute_state_of_charge(pack.level());
  out.set_calculated_state_of_charge(pack.level());
  const double remaining_ah = pack.level() * capacity_ah;
  out.set_remaining_capacity(toFloat(remaining_ah));
  out.set_full_charge_capacity(toFloat(capacity_ah));
  out.set_design_capacity(toFloat(capacity_ah));
  const double empty_s = current_a < 0.0 ? 3600.0 * remaining_ah / -current_a : 0.0;
  out.set_runtime_to_empty(static_cast<std::uint32_t>(empty_s));
  out.set_average_time_to_empty(static_cast<std::uint32_t>(empty_s));
  out.set_cycle_count(12);
  out.set_serial_number(4711);
  out.set_manufacturer_name("simulated");
  out.set_device_name("BQ40Z50");
  out.set_device_chemistry("LION");
  return true;
}

bool droneTime(BlueyeCore& core, bp::DroneTimeTel& message) {
  *message.mutable_real_time_clock()->mutable_unix_timestamp() = toTimestamp(core.clock());
  *message.mutable_monotonic_clock()->mutable_unix_timestamp() =
      toTimestamp(core.now - core.computer.booted);
  return true;
}

bool connectedClients(BlueyeCore& core, bp::ConnectedClientsTel& message) {
  message.set_client_id_in_control(core.computer.clients.inControl());
  for (const auto& client : core.computer.clients.list()) {
    *message.add_connected_clients() = client;
  }
  return true;
}

struct DeviceKind {
  BlueyeDevice device;
  bp::GuestPortDeviceID id;
  const char* manufacturer;
  const char* name;
  float depth_rating_m;
  int port;
};

const DeviceKind kDevices[] = {
    {BlueyeDevice::Dvl, bp::GUEST_PORT_DEVICE_ID_WATERLINKED_DVL_A50, "Water Linked", "DVL A50",
     300.0F, 1},
    {BlueyeDevice::Gnss, bp::GUEST_PORT_DEVICE_ID_BLUEYE_GNSS_DEVICE, "Blueye", "GNSS", 300.0F, 1},
    {BlueyeDevice::Light, bp::GUEST_PORT_DEVICE_ID_BLUEYE_LIGHT_PAIR, "Blueye", "Light pair",
     305.0F, 2},
    {BlueyeDevice::Camera, bp::GUEST_PORT_DEVICE_ID_BLUEYE_CAM, "Blueye", "Camera", 305.0F, 2},
    {BlueyeDevice::Gripper, bp::GUEST_PORT_DEVICE_ID_BLUEPRINT_LAB_REACH_ALPHA, "Blueprint Lab",
     "Reach Alpha", 300.0F, 2},
    {BlueyeDevice::Laser, bp::GUEST_PORT_DEVICE_ID_SPOT_X_LASER_SCALERS, "Spot X", "Laser scalers",
     500.0F, 2},
    {BlueyeDevice::Servo, bp::GUEST_PORT_DEVICE_ID_BLUEYE_GENERIC_SERVO, "Blueye", "Servo", 305.0F,
     3},
    {BlueyeDevice::Multibeam, bp::GUEST_PORT_DEVICE_ID_BLUEPRINT_SUBSEA_OCULUS_M750D,
     "Blueprint Subsea", "Oculus M750d", 500.0F, 3},
    {BlueyeDevice::MultibeamServo, bp::GUEST_PORT_DEVICE_ID_BLUEYE_MULTIBEAM_SERVO, "Blueye",
     "Multibeam servo", 305.0F, 3},
    {BlueyeDevice::Pinger, bp::GUEST_PORT_DEVICE_ID_BLUE_ROBOTICS_PING_SONAR, "Blue Robotics",
     "Ping sonar", 300.0F, 1},
    {BlueyeDevice::ThicknessGauge, bp::GUEST_PORT_DEVICE_ID_CYGNUS_MINI_ROV_THICKNESS_GAUGE,
     "Cygnus", "Mini ROV thickness gauge", 500.0F, 2},
    {BlueyeDevice::CpProbe, bp::GUEST_PORT_DEVICE_ID_OCEAN_TOOLS_DIGICP, "OceanTools", "digiCP",
     300.0F, 2},
    {BlueyeDevice::AquaTroll, bp::GUEST_PORT_DEVICE_ID_INSITU_AQUA_TROLL_500, "In-Situ",
     "Aqua TROLL 500", 200.0F, 3},
    {BlueyeDevice::Medusa, bp::GUEST_PORT_DEVICE_ID_MEDUSA_RADIOMETRICS_MS100,
     "Medusa Radiometrics", "MS-100", 300.0F, 3}};

void fillPort(BlueyeCore& core, int number, bp::GuestPortConnectorInfo& port) {
  port.set_guest_port_number(static_cast<bp::GuestPortNumber>(number));
  for (const DeviceKind& kind : kDevices) {
    if (kind.port != number || !core.has(kind.device)) continue;
    bp::GuestPortDevice* device = port.mutable_device_list()->add_devices();
    device->set_device_id(kind.id);
    device->set_manufacturer(kind.manufacturer);
    device->set_name(kind.name);
    device->set_serial_number("SIM" + std::to_string(1000 + static_cast<int>(kind.id)));
    device->set_depth_rating(kind.depth_rating_m);
    device->set_required_blunux_version("3.2.0");
    device->set_detach_status(bp::GUEST_PORT_DETACH_STATUS_ATTACHED);
  }
  if (!port.has_device_list()) port.set_error(bp::GUEST_PORT_ERROR_NOT_CONNECTED);
}

bool droneInfo(BlueyeCore& core, bp::DroneInfoTel& message) {
  bp::DroneInfo& out = *message.mutable_drone_info();
  out.set_blunux_version(core.config.software_version);
  out.set_serial_number(core.config.serial_number);
  out.set_hardware_id("sim-" + core.config.serial_number);
  out.set_model(bp::MODEL_X3);
  out.set_mb_serial("SIMMB0001");
  out.set_bb_serial("SIMBB0001");
  out.set_ds_serial("SIMDS0001");
  out.set_depth_sensor(bp::PRESSURE_SENSOR_TYPE_KELLER_PA7LD);
  out.set_power_source(bp::POWER_SOURCE_SINGLE_BATTERY);
  fillPort(core, 1, *out.mutable_gp()->mutable_gp1());
  fillPort(core, 2, *out.mutable_gp()->mutable_gp2());
  fillPort(core, 3, *out.mutable_gp()->mutable_gp3());
  return true;
}

bool guestPortCurrent(BlueyeCore& core, bp::GuestPortCurrentTel& message) {
  double amperes[3] = {0.0, 0.0, 0.0};
  for (const DeviceKind& kind : kDevices) {
    if (core.has(kind.device)) amperes[kind.port - 1] += 0.08;
  }
  bp::GuestPortCurrent& out = *message.mutable_current();
  out.set_gp1_bat(amperes[0]);
  out.set_gp2_bat(amperes[1]);
  out.set_gp3_bat(amperes[2]);
  return true;
}

bool notification(BlueyeCore& core, bp::NotificationTel& message) {
  if (!core.computer.last_notification) return false;
  *message.mutable_notification() = *core.computer.last_notification;
  return true;
}

bool declination(BlueyeCore& core, bp::MagneticDeclinationTel& message) {
  *message.mutable_magnetic_declination() = core.computer.settings.declination;
  return true;
}

bool videoSpace(BlueyeCore& core, bp::VideoStorageSpaceTel& message) {
  bp::StorageSpace& out = *message.mutable_storage_space();
  out.set_total_space(static_cast<std::int64_t>(BlueyePayload::kVideoBytes));
  out.set_free_space(static_cast<std::int64_t>(BlueyePayload::kVideoBytes -
                                               core.computer.payload.video_used_bytes));
  return true;
}

bool dataSpace(BlueyeCore&, bp::DataStorageSpaceTel& message) {
  message.mutable_storage_space()->set_total_space(8000000000);
  message.mutable_storage_space()->set_free_space(6500000000);
  return true;
}

bool removableStorage(BlueyeCore& core, bp::RemovableStorageTel& message) {
  bp::RemovableStorageDevice& out = *message.mutable_storage_device();
  out.set_vendor_name("simulated");
  out.set_model_name("USB drive");
  out.set_device_path("/dev/sda");
  const bool formatting = core.computer.payload.formatting_s > 0.0;
  out.set_status(formatting ? bp::RemovableStorageDevice::STATUS_FORMATTING
                            : bp::RemovableStorageDevice::STATUS_READY);
  if (formatting) return true;
  bp::StoragePartition* partition = out.add_partitions();
  partition->mutable_storage_space()->set_total_space(64000000000);
  partition->mutable_storage_space()->set_free_space(60000000000);
  partition->set_file_system_type("exfat");
  partition->set_device_path("/dev/sda1");
  partition->set_mount_path("/media/usb");
  return true;
}

bool errorFlags(BlueyeCore& core, bp::ErrorFlagsTel& message) {
  *message.mutable_error_flags() = core.error_flags;
  return true;
}

bool cpuInfo(BlueyeCore& core, bp::CPUInfoTel& message) {
  bp::CPUInfo& out = *message.mutable_cpu_info();
  out.set_cpu_load(toFloat(0.35 + std::abs(noise(core, 0.05))));
  out.set_memory_bus_load(0.4F);
  out.set_main_queue_load(0.1F);
  out.set_guestport_queue_load(0.1F);
  out.set_comm_queue_load(0.1F);
  return true;
}

double inside(BlueyeCore& core) { return 24.0 + 0.5 * core.config.water_temperature_c; }

}  // namespace

void addStatusTelemetry(std::vector<BlueyeTelemetry>& all) {
  all.push_back(telemetry<bp::BatteryTel>(1.0, battery));
  all.push_back(telemetry<bp::BatteryBQ40Z50Tel>(0.5, batteryDetails));
  all.push_back(telemetry<bp::DroneTimeTel>(1.0, droneTime));
  all.push_back(telemetry<bp::ConnectedClientsTel>(1.0, connectedClients));
  all.push_back(telemetry<bp::DroneInfoTel>(1.0, droneInfo));
  all.push_back(telemetry<bp::GuestPortCurrentTel>(1.0, guestPortCurrent));
  all.push_back(telemetry<bp::ErrorFlagsTel>(1.0, errorFlags));
  all.push_back(telemetry<bp::NotificationTel>(0.0, notification));
  all.push_back(telemetry<bp::MagneticDeclinationTel>(1.0, declination));
  all.push_back(telemetry<bp::VideoStorageSpaceTel>(0.5, videoSpace));
  all.push_back(telemetry<bp::DataStorageSpaceTel>(0.5, dataSpace));
  all.push_back(telemetry<bp::RemovableStorageTel>(0.0, removableStorage));
  all.push_back(telemetry<bp::CPUInfoTel>(1.0, cpuInfo));
  all.push_back(telemetry<bp::MissionStatusTel>(2.0, [](BlueyeCore& core, bp::MissionStatusTel& m) {
    *m.mutable_mission_status() = core.computer.mission.status(core);
    return true;
  }));
  all.push_back(telemetry<bp::DiveTimeTel>(1.0, [](BlueyeCore& core, bp::DiveTimeTel& m) {
    m.mutable_dive_time()->set_value(static_cast<std::int32_t>(core.computer.dive_s));
    return true;
  }));
  all.push_back(
      telemetry<bp::WaterTemperatureTel>(1.0, [](BlueyeCore& core, bp::WaterTemperatureTel& m) {
        // Colder further down.
        const double there = core.config.water_temperature_c - 0.05 * core.rov.state().depth_m;
        m.mutable_temperature()->set_value(toFloat(there + noise(core, 0.02)));
        return true;
      }));
  all.push_back(
      telemetry<bp::CPUTemperatureTel>(1.0, [](BlueyeCore& core, bp::CPUTemperatureTel& m) {
        m.mutable_temperature()->set_value(toFloat(inside(core) + 20.0 + noise(core, 0.3)));
        return true;
      }));
  all.push_back(telemetry<bp::CanisterBottomTemperatureTel>(
      1.0, [](BlueyeCore& core, bp::CanisterBottomTemperatureTel& m) {
        m.mutable_temperature()->set_temperature(toFloat(inside(core) + noise(core, 0.1)));
        return true;
      }));
  all.push_back(telemetry<bp::CanisterBottomHumidityTel>(
      1.0, [](BlueyeCore& core, bp::CanisterBottomHumidityTel& m) {
        m.mutable_humidity()->set_humidity(toFloat(12.0 + noise(core, 0.2)));
        return true;
      }));
  all.push_back(telemetry<bp::IperfTel>(0.5, [](BlueyeCore& core, bp::IperfTel& m) {
    if (!core.computer.settings.iperf) return false;
    m.mutable_status()->set_sent(toFloat(72.0 + noise(core, 2.0)));
    m.mutable_status()->set_received(toFloat(68.0 + noise(core, 2.0)));
    return true;
  }));
}

}  // namespace frontseat_driver::sim
