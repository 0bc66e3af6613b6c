// Messages that came after the document's revision.
#include <algorithm>
#include <cmath>

#include "telemetry_kinds.h"

namespace frontseat_driver::sim {
namespace {

bool performance(BlueyeCore& core, bp::SystemPerformanceInfoTel& message) {
  bp::SystemPerformanceInfo& out = *message.mutable_system_performance_info();
  for (std::uint32_t index = 0; index < 4; ++index) {
    bp::CpuCoreLoad* cpu = out.add_cpu_cores();
    cpu->set_core_index(index);
    cpu->set_load(toFloat(std::clamp(0.35 + noise(core, 0.05), 0.0, 1.0)));
    cpu->set_frequency_mhz(1400.0F);
  }
  out.set_cpu_utilization(0.35F);
  out.mutable_memory()->set_total_bytes(4000000000);
  out.mutable_memory()->set_used_bytes(1500000000);
  bp::ThermalZone* zone = out.add_thermal_zones();
  zone->set_zone(bp::THERMAL_ZONE_ID_CPU);
  zone->set_temperature(toFloat(48.0 + noise(core, 0.3)));
  out.set_main_queue_load(0.1F);
  out.set_guestport_queue_load(0.1F);
  out.set_comm_queue_load(0.1F);
  return true;
}

bool surfaceUnit(BlueyeCore&, bp::SurfaceUnitTel& message) {
  auto& battery = *message.mutable_battery_info();
  battery.set_status(bp::SurfaceUnitBatteryInfo::CHARGE_STATUS_DISCHARGE);
  battery.set_level(0.8F);
  message.mutable_version_info()->set_version("3.0-simulated");
  return true;
}

bool logEntry(BlueyeCore& core, bp::LogEntryTel& message) {
  if (!core.computer.settings.log_streaming) return false;
  bp::LogEntry& out = *message.mutable_blunux();
  *out.mutable_timestamp() = toTimestamp(core.clock());
  out.set_process_name("simulator");
  out.set_process_id(1);
  out.set_thread_id(1);
  out.set_source("blueye_simulator");
  out.set_level(bp::LogEntry::LOG_LEVEL_INFO);
  out.set_message("depth " + std::to_string(core.depth()) + " m");
  return true;
}

/// An empty sea: models run, and find nothing.
bool detections(BlueyeCore&, bp::ObjectDetectionsTel& message) {
  bp::ModelDetections* model = message.add_model_detections();
  model->set_camera(bp::CAMERA_MAIN);
  model->set_image_width(1920);
  model->set_image_height(1080);
  model->set_model_name("simulated");
  return true;
}

}  // namespace

void addLaterTelemetry(std::vector<BlueyeTelemetry>& all) {
  all.push_back(telemetry<bp::SystemPerformanceInfoTel>(0.5, performance));
  all.push_back(telemetry<bp::SurfaceUnitTel>(0.2, surfaceUnit));
  all.push_back(telemetry<bp::LogEntryTel>(1.0, logEntry));
  all.push_back(telemetry<bp::ObjectDetectionsTel>(0.0, detections));
  all.push_back(
      telemetry<bp::TurbidityFilterTel>(0.5, [](BlueyeCore& core, bp::TurbidityFilterTel& m) {
        *m.mutable_turbidity_filter() = core.computer.settings.turbidity;
        return true;
      }));
  all.push_back(
      telemetry<bp::ColorCorrectionTel>(0.5, [](BlueyeCore& core, bp::ColorCorrectionTel& m) {
        *m.mutable_color_correction_filter() = core.computer.settings.color;
        return true;
      }));
  all.push_back(
      telemetry<bp::CameraPanTiltZoomTel>(0.5, [](BlueyeCore& core, bp::CameraPanTiltZoomTel& m) {
        *m.mutable_camera_pan_tilt_zoom() = core.computer.settings.pan_tilt_zoom;
        return true;
      }));
  all.push_back(telemetry<bp::SotStateTel>(0.5, [](BlueyeCore& core, bp::SotStateTel& m) {
    *m.mutable_sot_state() = core.computer.settings.tracking;
    return true;
  }));
  all.push_back(telemetry<bp::AnnotationTel>(0.0, [](BlueyeCore& core, bp::AnnotationTel& m) {
    if (!core.computer.last_annotation) return false;
    *m.mutable_annotation() = *core.computer.last_annotation;
    return true;
  }));
}

}  // namespace frontseat_driver::sim
