#include "requests.h"

#include <chrono>
#include <functional>

#include "reflection.h"
#include "telemetry.h"

namespace frontseat_driver::sim {
namespace {

constexpr double kFastest_hz = 100.0;

/// Reads a request, which `act` then answers in `reply`; none if it cannot be read.
std::optional<std::string> answer(BlueyeCore& core, std::string_view data,
                                  google::protobuf::MessageLite& request,
                                  const google::protobuf::MessageLite& reply,
                                  const std::function<void()>& act) {
  if (!request.ParseFromArray(data.data(), static_cast<int>(data.size()))) return std::nullopt;
  if (isFinite(nameOf(request), data)) {
    act();
  } else {
    ++core.counts.refused;
  }
  return reply.SerializeAsString();
}

/// A row of the table: `act` fills the answer.
template <class Request, class Reply>
BlueyeRequest request(void (*act)(BlueyeCore&, const Request&, Reply&)) {
  return {nameOf<Request>(), nameOf<Reply>(), [act](BlueyeCore& core, std::string_view data) {
            Request message;
            Reply reply;
            return answer(core, data, message, reply, [&] { act(core, message, reply); });
          }};
}

template <class Reply>
void addClients(BlueyeCore& core, Reply& reply) {
  reply.set_client_id_in_control(core.computer.clients.inControl());
  for (const auto& client : core.computer.clients.list()) *reply.add_connected_clients() = client;
}

void connectClient(BlueyeCore& core, const bp::ConnectClientReq& request,
                   bp::ConnectClientRep& reply) {
  reply.set_client_id(core.computer.clients.connect(request.client_info(), core.now));
  addClients(core, reply);
  core.clientsChanged();
}

void disconnectClient(BlueyeCore& core, const bp::DisconnectClientReq& request,
                      bp::DisconnectClientRep& reply) {
  if (core.computer.clients.disconnect(request.client_id(), core.now)) core.clientsChanged();
  addClients(core, reply);
}

void syncTime(BlueyeCore& core, const bp::SyncTimeReq& request, bp::SyncTimeRep& reply) {
  const auto time = toUtc(request.time().unix_timestamp());
  if (!time) return;
  core.computer.clock_offset = *time - core.now;
  core.announce("DroneTimeTel");
  reply.set_success(true);
}

void setPubFrequency(BlueyeCore& core, const bp::SetPubFrequencyReq& request,
                     bp::SetPubFrequencyRep& reply) {
  const BlueyeTelemetry* known = findBlueyeTelemetry(request.message_type());
  if (known == nullptr || request.frequency() < 0.0F || request.frequency() > kFastest_hz) return;
  core.computer.rates[known->name] = request.frequency();
  core.computer.due.erase(known->name);
  reply.set_success(true);
}

void setLogFrequency(BlueyeCore&, const bp::SetLogFrequencyReq& request,
                     bp::SetLogFrequencyRep& reply) {
  const bool known = findBlueyeTelemetry(request.message_type()) != nullptr;
  reply.set_success(known && request.frequency() >= 0.0F && request.frequency() <= kFastest_hz);
}

void getTelemetry(BlueyeCore& core, const bp::GetTelemetryReq& request,
                  bp::GetTelemetryRep& reply) {
  const BlueyeTelemetry* known = findBlueyeTelemetry(request.message_type());
  if (known == nullptr) return;
  const auto data = known->build(core);
  if (!data) return;
  reply.mutable_payload()->set_type_url("type.googleapis.com/" + (kBlueyePackage + known->name));
  reply.mutable_payload()->set_value(*data);
}

void getCamera(BlueyeCore& core, const bp::GetCameraParametersReq& request,
               bp::GetCameraParametersRep& reply) {
  const auto found = core.computer.settings.cameras.find(request.camera());
  if (found != core.computer.settings.cameras.end()) {
    *reply.mutable_camera_parameters() = found->second;
  }
}

void setCamera(BlueyeCore& core, const bp::SetCameraParametersReq& request,
               bp::SetCameraParametersRep&) {
  const auto found = core.computer.settings.cameras.find(request.camera_parameters().camera());
  if (found != core.computer.settings.cameras.end()) found->second = request.camera_parameters();
}

void add(std::vector<BlueyeRequest>& all) {
  all.push_back(request<bp::PingReq, bp::PingRep>([](BlueyeCore&, const auto&, auto&) {}));
  all.push_back(request<bp::ConnectClientReq, bp::ConnectClientRep>(connectClient));
  all.push_back(request<bp::DisconnectClientReq, bp::DisconnectClientRep>(disconnectClient));
  all.push_back(request<bp::SyncTimeReq, bp::SyncTimeRep>(syncTime));
  all.push_back(request<bp::GetBatteryReq, bp::GetBatteryRep>(
      [](BlueyeCore& core, const bp::GetBatteryReq&, bp::GetBatteryRep& reply) {
        *reply.mutable_battery() = batteryOf(core);
      }));
  all.push_back(request<bp::SetPubFrequencyReq, bp::SetPubFrequencyRep>(setPubFrequency));
  all.push_back(request<bp::SetLogFrequencyReq, bp::SetLogFrequencyRep>(setLogFrequency));
  all.push_back(request<bp::GetTelemetryReq, bp::GetTelemetryRep>(getTelemetry));
  all.push_back(request<bp::GetCameraParametersReq, bp::GetCameraParametersRep>(getCamera));
  all.push_back(request<bp::SetCameraParametersReq, bp::SetCameraParametersRep>(setCamera));
  all.push_back(request<bp::GetOverlayParametersReq, bp::GetOverlayParametersRep>(
      [](BlueyeCore& core, const bp::GetOverlayParametersReq&, bp::GetOverlayParametersRep& reply) {
        *reply.mutable_overlay_parameters() = core.computer.settings.overlay;
      }));
  all.push_back(request<bp::SetOverlayParametersReq, bp::SetOverlayParametersRep>(
      [](BlueyeCore& core, const bp::SetOverlayParametersReq& request,
         bp::SetOverlayParametersRep&) {
        core.computer.settings.overlay = request.overlay_parameters();
      }));
  all.push_back(request<bp::SetThicknessGaugeParametersReq, bp::SetThicknessGaugeParametersRep>(
      [](BlueyeCore& core, const bp::SetThicknessGaugeParametersReq& request,
         bp::SetThicknessGaugeParametersRep&) {
        core.computer.settings.sound_velocity_m_s = request.sound_velocity();
      }));
  all.push_back(request<bp::SetHeadingModeReq, bp::SetHeadingModeRep>(
      [](BlueyeCore& core, const bp::SetHeadingModeReq& request, bp::SetHeadingModeRep&) {
        core.computer.navigation.setGyroOnly(request.heading_mode() == bp::HEADING_MODE_GYRO_ONLY);
      }));
}

void addMissions(std::vector<BlueyeRequest>& all) {
  all.push_back(request<bp::SetMissionReq, bp::SetMissionRep>(
      [](BlueyeCore& core, const bp::SetMissionReq& request, bp::SetMissionRep&) {
        core.computer.mission.load(request.mission(), core);
      }));
  all.push_back(request<bp::GetMissionReq, bp::GetMissionRep>(
      [](BlueyeCore& core, const bp::GetMissionReq&, bp::GetMissionRep& reply) {
        *reply.mutable_mission() = core.computer.mission.mission();
      }));
  all.push_back(request<bp::SetInstructionUpdateReq, bp::SetInstructionUpdateRep>(
      [](BlueyeCore& core, const bp::SetInstructionUpdateReq& request,
         bp::SetInstructionUpdateRep&) {
        if (!core.computer.mission.update(request.instruction(), core)) ++core.counts.refused;
      }));
}

void addMaintenance(std::vector<BlueyeRequest>& all) {
  all.push_back(request<bp::GetPersistentStorageSettingsReq, bp::GetPersistentStorageSettingsRep>(
      [](BlueyeCore& core, const bp::GetPersistentStorageSettingsReq&,
         bp::GetPersistentStorageSettingsRep& reply) {
        *reply.mutable_persistent_storage_settings() = core.computer.settings.storage;
      }));
  all.push_back(request<bp::SetPersistentStorageSettingsReq, bp::SetPersistentStorageSettingsRep>(
      [](BlueyeCore& core, const bp::SetPersistentStorageSettingsReq& request,
         bp::SetPersistentStorageSettingsRep& reply) {
        core.computer.settings.storage = request.persistent_storage_settings();
        reply.set_success(true);
      }));
  all.push_back(request<bp::FlashEscSettingsReq, bp::FlashEscSettingsRep>(
      [](BlueyeCore& core, const bp::FlashEscSettingsReq&, bp::FlashEscSettingsRep& reply) {
        reply.set_success(!core.armed());  // not while thrusters may turn
      }));
  all.push_back(request<bp::SetIperfStatusReq, bp::SetIperfStatusRep>(
      [](BlueyeCore& core, const bp::SetIperfStatusReq& request, bp::SetIperfStatusRep& reply) {
        core.computer.settings.iperf = request.enabled();
        reply.set_enabled(request.enabled());
      }));
  all.push_back(request<bp::GetIperfStatusReq, bp::GetIperfStatusRep>(
      [](BlueyeCore& core, const bp::GetIperfStatusReq&, bp::GetIperfStatusRep& reply) {
        reply.set_enabled(core.computer.settings.iperf);
      }));
  all.push_back(request<bp::GetLogStreamingStatusReq, bp::GetLogStreamingStatusRep>(
      [](BlueyeCore& core, const bp::GetLogStreamingStatusReq&,
         bp::GetLogStreamingStatusRep& reply) {
        reply.set_enabled(core.computer.settings.log_streaming);
      }));
}

}  // namespace

const std::vector<BlueyeRequest>& blueyeRequests() {
  static const std::vector<BlueyeRequest> kAll = [] {
    std::vector<BlueyeRequest> all;
    add(all);
    addMissions(all);
    addMaintenance(all);
    return all;
  }();
  return kAll;
}

const BlueyeRequest* findBlueyeRequest(const std::string& name) {
  for (const BlueyeRequest& row : blueyeRequests()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace frontseat_driver::sim
