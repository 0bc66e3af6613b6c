#include "blueye/services.h"

#include <blueye/control.pb.h>
#include <blueye/req_rep.pb.h>
#include <frontseat_driver/Abort.h>
#include <frontseat_driver/BlueyeControl.h>
#include <frontseat_driver/BlueyeRequest.h>
#include <frontseat_driver/GetMission.h>
#include <frontseat_driver/LoadMission.h>
#include <frontseat_driver/Record.h>
#include <frontseat_driver/ResetPosition.h>
#include <frontseat_driver/SetFloat.h>
#include <frontseat_driver/SetHeadingMode.h>
#include <frontseat_driver/SetRate.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <utility>

#include "blueye/mission_json.h"
#include "blueye/service_requests.h"
#include "blueye/topics.h"
#include "check.h"
#include "frontseat_driver/protocol/blueye_parse.h"

namespace frontseat_driver::ros_layer::blueye_layer {

namespace {

using namespace std::chrono_literals;
using protocol::parse;
using session::BlueyeOutput;

// The session answers by its deadlines; this is for its thread being held up.
constexpr auto kGrace = 200ms;
constexpr auto kControlShown = 2s;

std::string nameOf(const std::string& type) { return protocol::BlueyeCatalogue::fullName(type); }

std::function<bool(std::string_view)> missionIs(pb::MissionState state) {
  return [state](std::string_view payload) {
    pb::MissionStatusTel told;
    return parse(payload, told) && told.mission_status().state() == state;
  };
}

std::function<bool(std::string_view)> calibrating(bool wanted) {
  return [wanted](std::string_view payload) {
    pb::CalibrationStateTel told;
    if (!parse(payload, told) || !told.has_calibration_state()) return false;
    const bool resting =
        told.calibration_state().status() == pb::CalibrationState::STATUS_NOT_CALIBRATING;
    return resting != wanted;
  };
}

}  // namespace

Services::Services(ros::NodeHandle node, const Parameters& parameters,
                   session::BlueyeSession& session, const Publisher& publisher,
                   const protocol::BlueyeCatalogue& catalogue, Post post)
    : node_(node),
      timeout_(parameters.session.request_timeout),
      control_timeout_(parameters.session.control_timeout),
      session_(session),
      publisher_(publisher),
      catalogue_(catalogue),
      services_(std::move(post)) {
  addAuthority();
  addControllers();
  addTriggers();
  addMissions();
  addSettings();
  addPassthrough();
}

template <class Service>
void Services::advertise(const char* name, std::function<Answer(typename Service::Request&)> serve,
                         Urgency urgency, Waiting::Fill<Service> fill) {
  services_.advertise<Service>(node_, name, urgency, std::move(serve), fill);
}

Services::Answer Services::ask(Waiting::Ask work) const { return ask(std::move(work), timeout_); }

Services::Answer Services::ask(Waiting::Ask work, std::chrono::milliseconds timeout,
                               WhenLate when_late) const {
  // Requests wait for those before them, so the drone may have several time limits to keep.
  return services_.ask(std::move(work), {timeout, 2 * timeout + kGrace,
                                         "the drone did not answer in time", when_late});
}

// --- Who commands ---

void Services::addAuthority() {
  advertise<std_srvs::Trigger>(
      topics::kStop,
      [this](auto&) {
        return ask(
            [this](const auto& now, auto& out, const Respond& respond) {
              const auto done = session_.stop(now, out);
              respond({done.success, done.message, {}, {}});
            },
            timeout_, WhenLate::DoAnyway);
      },
      Urgency::Urgent);
  advertise<Abort>(
      topics::kAbort,
      [this](auto&) {
        return ask([this](const auto& now, auto& out, const Respond& respond) {
          const auto done = session_.abort(now, out);
          respond({done.success, done.message, {}, {}});
        });
      },
      Urgency::Urgent);
  advertise<std_srvs::SetBool>(
      topics::kEnableCommands,
      [this](std_srvs::SetBoolRequest& gate) {
        const bool open = gate.data != 0;
        return ask(
            [this, open](const auto& now, auto&, const Respond& respond) {
              session_.setCommandsEnabled(now, open);
              const char* const told =
                  open ? "the command gate is open" : "the command gate is closed";
              respond({true, told, {}, {}});
            },
            timeout_, open ? WhenLate::Drop : WhenLate::DoAnyway);
      },
      Urgency::Urgent);
  const auto relay = [](const Respond& respond) {
    return [respond](const session::BlueyeSession::Answer& given) {
      respond({given.success, given.message, {}, {}});
    };
  };
  advertise<std_srvs::Trigger>(topics::kTakeControl, [this, relay](auto&) {
    return ask(
        [this, relay](const auto& now, auto& out, const Respond& respond) {
          session_.takeControl(now, relay(respond), out);
        },
        control_timeout_ + timeout_);
  });
  advertise<std_srvs::Trigger>(topics::kReleaseControl, [this, relay](auto&) {
    return ask([this, relay](const auto& now, auto& out, const Respond& respond) {
      session_.releaseControl(now, relay(respond), out);
    });
  });
  advertise<std_srvs::Trigger>(topics::kPing, [this](auto&) {
    const auto asked = std::chrono::steady_clock::now();
    Answer answer = request(nameOf("PingReq"), {}, timeout_);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - asked;
    if (answer.success) answer.message = std::to_string(taken.count()) + " ms";
    return answer;
  });
}

// --- What the drone does by itself ---

Services::Answer Services::control(const std::string& type, std::string payload,
                                   const char* confirmed_by, Shows shows, bool repeat) const {
  return ask(
      [this, type = nameOf(type), payload = std::move(payload), confirmed_by,
       shows = std::move(shows), repeat](const auto& now, auto& out, const Respond& respond) {
        session::ConfirmedControls::Control wanted;
        wanted.type = type;
        wanted.payload = payload;
        wanted.repeat = repeat;
        if (confirmed_by != nullptr) wanted.confirmed_by = nameOf(confirmed_by);
        wanted.shows = shows;
        wanted.timeout = kControlShown;
        const bool shown = confirmed_by != nullptr;
        wanted.respond = [respond, shown](const std::string& refusal) {
          const bool good = refusal.empty();
          respond({good, good ? (shown ? "the drone shows it" : "sent") : refusal, {}, {}});
        };
        session_.control(now, std::move(wanted), out);
      },
      kControlShown);
}

template <class Control>
void Services::addSwitch(const char* name, bool (pb::ControlMode::*state)() const) {
  advertise<std_srvs::SetBool>(name, [this, state](std_srvs::SetBoolRequest& wanted) {
    const bool on = wanted.data != 0;
    Control message;
    message.mutable_state()->set_enabled(on);
    const auto shows = [state, on](std::string_view payload) {
      pb::ControlModeTel told;
      return parse(payload, told) && told.has_state() && (told.state().*state)() == on;
    };
    return control(message.GetTypeName(), message.SerializeAsString(), "ControlModeTel", shows,
                   true);
  });
}

void Services::addControllers() {
  addSwitch<pb::AutoDepthCtrl>(topics::kAutoDepth, &pb::ControlMode::auto_depth);
  addSwitch<pb::AutoHeadingCtrl>(topics::kAutoHeading, &pb::ControlMode::auto_heading);
  addSwitch<pb::AutoAltitudeCtrl>(topics::kAutoAltitude, &pb::ControlMode::auto_altitude);
  addSwitch<pb::StationKeepingCtrl>(topics::kStationKeeping, &pb::ControlMode::station_keeping);
  addSwitch<pb::WeatherVaningCtrl>(topics::kWeatherVaning, &pb::ControlMode::weather_vaning);
  addSwitch<pb::AutoPilotSurgeYawCtrl>(topics::kAutoPilotSurgeYaw,
                                       &pb::ControlMode::auto_pilot_surge_yaw);
  addSwitch<pb::AutoPilotHeaveCtrl>(topics::kAutoPilotHeave, &pb::ControlMode::auto_pilot_heave);
  advertise<std_srvs::SetBool>(
      topics::kSetTiltStabilization, [this](std_srvs::SetBoolRequest& wanted) {
        const bool on = wanted.data != 0;
        pb::TiltStabilizationCtrl message;
        message.mutable_state()->set_enabled(on);
        const auto shows = [on](std::string_view payload) {
          pb::TiltStabilizationTel told;
          return parse(payload, told) && told.has_state() && told.state().enabled() == on;
        };
        return control(message.GetTypeName(), message.SerializeAsString(), "TiltStabilizationTel",
                       shows, true);
      });
  advertise<std_srvs::SetBool>(topics::kGuestPorts, [this](std_srvs::SetBoolRequest& wanted) {
    const bool on = wanted.data != 0;
    return control(on ? "ActivateGuestPortsCtrl" : "DeactivateGuestPortsCtrl", {}, nullptr, {},
                   false);
  });
}

// Sent once: twice might be once too often.
void Services::addTrigger(const char* name, const char* type, const char* confirmed_by,
                          Shows shows) {
  advertise<std_srvs::Trigger>(name, [this, type, confirmed_by, shows = std::move(shows)](auto&) {
    return control(type, {}, confirmed_by, shows, false);
  });
}

void Services::addTriggers() {
  addTrigger(topics::kResetOdometer, "ResetOdometerCtrl", nullptr, {});
  addTrigger(topics::kCalibrateDvlGyro, "CalibrateDvlGyroCtrl", nullptr, {});
  addTrigger(topics::kTakePicture, "TakePictureCtrl", nullptr, {});
  addTrigger(topics::kCalibrationStart, "StartCalibrationCtrl", "CalibrationStateTel",
             calibrating(true));
  addTrigger(topics::kCalibrationCancel, "CancelCalibrationCtrl", "CalibrationStateTel",
             calibrating(false));
  addTrigger(topics::kCalibrationFinish, "FinishCalibrationCtrl", "CalibrationStateTel",
             calibrating(false));
  addTrigger(topics::kMissionRun, "RunMissionCtrl", "MissionStatusTel",
             missionIs(pb::MISSION_STATE_RUNNING));
  addTrigger(topics::kMissionPause, "PauseMissionCtrl", "MissionStatusTel",
             missionIs(pb::MISSION_STATE_PAUSED));
  addTrigger(topics::kMissionClear, "ClearMissionCtrl", "MissionStatusTel",
             missionIs(pb::MISSION_STATE_INACTIVE));
}

// --- Missions ---

void Services::addMissions() {
  advertise<LoadMission>(topics::kMissionLoad,
                         [this](LoadMissionRequest& wanted) { return loadMission(wanted.json); });
  advertise<GetMission>(
      topics::kMissionGet,
      [this](auto&) {
        Answer answer = request(nameOf("GetMissionReq"), {}, timeout_);
        if (!answer.success) return answer;
        pb::GetMissionRep reply;
        if (!parse(answer.json, reply)) return Answer{false, "the reply cannot be read", {}, {}};
        answer.json = catalogue_.toJson("Mission", reply.mission().SerializeAsString()).text;
        return answer;
      },
      Urgency::Usual, [](auto& response, const Answer& answer) { response.json = answer.json; });
}

Services::Answer Services::loadMission(const std::string& text) const {
  const MissionRequest wanted = toMissionRequest(catalogue_, text);
  if (const auto* refusal = std::get_if<std::string>(&wanted)) return {false, *refusal, {}, {}};
  const auto& mission = std::get<pb::SetMissionReq>(wanted);
  return ask([this, payload = mission.SerializeAsString(), id = mission.mission().id()](
                 const auto& now, auto& out, const Respond& respond) {
    const std::string refusal = session_.refusal();
    if (!refusal.empty()) return respond({false, refusal, {}, {}});
    const auto verdict = std::make_shared<MissionVerdict>(id);
    const auto shows = [verdict](std::string_view told) { return verdict->shownBy(told); };
    const auto told = [verdict, respond](const std::string& late) {
      respond({late.empty() && verdict->ready(), verdict->message(late), {}, {}});
    };
    BlueyeOutput* const output = &out;
    const vehicle::Now sent = now;
    session_.request(
        now, nameOf("SetMissionReq"), payload, timeout_,
        [this, shows, told, respond, output, sent](const session::BlueyeReply& reply) {
          if (!reply.received) return respond({false, reply.reason, {}, {}});
          session_.await(sent, nameOf("MissionStatusTel"), shows, told, *output);
        },
        out);
  });
}

// --- Settings ---

void Services::addSettings() {
  advertise<SetFloat>(topics::kSetWaterDensity, [this](SetFloatRequest& wanted) {
    const double density_kg_m3 = wanted.data;
    const std::string refusal =
        outside("data", density_kg_m3, kLightestWater_kg_m3, kHeaviestWater_kg_m3);
    if (!refusal.empty()) return Answer{false, refusal, {}, {}};
    pb::WaterDensityCtrl message;
    message.mutable_density()->set_value(static_cast<float>(density_kg_m3));
    Answer answer = control(message.GetTypeName(), message.SerializeAsString(), nullptr, {}, false);
    if (!answer.success) return answer;
    return ask([this, density_kg_m3](const auto&, auto&, const Respond& respond) {
      session_.setWaterDensity(density_kg_m3);
      respond({true, "sent, and sent again whenever control is gained", {}, {}});
    });
  });
  advertise<SetHeadingMode>(topics::kSetHeadingMode, [this](SetHeadingModeRequest& wanted) {
    Check check;
    check.oneOf("heading_mode", wanted.heading_mode, 1, 2, "1 (COMPASS) or 2 (GYRO)");
    if (!check.refusal().empty()) return Answer{false, check.refusal(), {}, {}};
    pb::SetHeadingModeReq message;
    message.set_heading_mode(static_cast<pb::HeadingMode>(wanted.heading_mode));
    return request(message.GetTypeName(), message.SerializeAsString(), timeout_);
  });
  advertise<SetRate>(topics::kSetRate, [this](SetRateRequest& wanted) {
    return ask([this, wanted](const auto& now, auto& out, const Respond& respond) {
      session_.setRate(
          now, wanted.type, wanted.rate,
          [respond](const auto& given) {
            respond({given.success, given.message, {}, {}});
          },
          out);
    });
  });
  advertise<ResetPosition>(topics::kResetPosition, [this](ResetPositionRequest& wanted) {
    const ConvertedReset converted = toReset(wanted);
    if (const auto* refusal = std::get_if<std::string>(&converted)) {
      return Answer{false, *refusal, {}, {}};
    }
    const auto& message = std::get<pb::ResetPositionCtrl>(converted);
    constexpr int kJustReset_s = 3;
    const auto shows = [](std::string_view payload) {
      pb::PositionEstimateTel told;
      return parse(payload, told) && told.has_position_estimate() &&
             told.position_estimate().time_since_reset_sec() <= kJustReset_s;
    };
    return control(message.GetTypeName(), message.SerializeAsString(), "PositionEstimateTel", shows,
                   false);
  });
  advertise<Record>(topics::kRecord, [this](RecordRequest& wanted) {
    return ask([this, wanted](const auto& now, auto& out, const Respond& respond) {
      const ConvertedRecord converted = toRecord(wanted, publisher_.recordState());
      if (const auto* refusal = std::get_if<std::string>(&converted)) {
        return respond({false, *refusal, {}, {}});
      }
      const auto& message = std::get<pb::RecordCtrl>(converted);
      session::ConfirmedControls::Control record;
      record.type = message.GetTypeName();
      record.payload = message.SerializeAsString();
      record.confirmed_by = nameOf("RecordStateTel");
      record.shows = [target = message.record_on()](std::string_view payload) {
        pb::RecordStateTel told;
        return parse(payload, told) && told.has_record_state() &&
               told.record_state().main_is_recording() == target.main() &&
               told.record_state().guestport_is_recording() == target.guestport() &&
               told.record_state().multibeam_is_recording() == target.multibeam();
      };
      record.respond = [respond](const std::string& refusal) {
        respond({refusal.empty(), refusal.empty() ? "the drone shows it" : refusal, {}, {}});
      };
      session_.control(now, std::move(record), out);
    });
  });
}

// --- Everything else ---

Services::Answer Services::request(const std::string& type, const std::string& payload,
                                   std::chrono::milliseconds timeout) const {
  return ask(
      [this, type, payload, timeout](const auto& now, auto& out, const Respond& respond) {
        session_.request(
            now, type, payload, timeout,
            [respond](const session::BlueyeReply& reply) {
              if (!reply.received) return respond({false, reply.reason, {}, {}});
              // The bytes, for the caller to read.
              respond({true, "done", std::string{reply.type}, std::string{reply.payload}});
            },
            out);
      },
      timeout);
}

Services::Answer Services::json(Answer reply) const {
  if (!reply.success) return reply;
  const auto text = catalogue_.toJson(reply.type, reply.json);
  reply.json = text.text;
  if (text.ok) return reply;
  return {false, "answered, but " + text.text, reply.type, {}};
}

void Services::addPassthrough() {
  advertise<BlueyeRequest>(
      topics::kRequest,
      [this](BlueyeRequestRequest& wanted) {
        const auto bytes = catalogue_.fromJson(wanted.type, wanted.json);
        if (!bytes.ok) return Answer{false, bytes.text, {}, {}};
        const std::string refusal = outside("timeout", wanted.timeout, 0.0, 60.0);
        if (!refusal.empty()) return Answer{false, refusal, {}, {}};
        const auto given = std::chrono::milliseconds{static_cast<int>(wanted.timeout * 1000.0)};
        return json(request(nameOf(wanted.type), bytes.text, given > 0ms ? given : timeout_));
      },
      Urgency::Usual,
      [](auto& response, const Answer& answer) {
        response.type = answer.type;
        response.json = answer.json;
      });
  advertise<BlueyeControl>(topics::kSendControl, [this](BlueyeControlRequest& wanted) {
    const auto bytes = catalogue_.fromJson(wanted.type, wanted.json);
    if (!bytes.ok) return Answer{false, bytes.text, {}, {}};
    return control(wanted.type, bytes.text, nullptr, {}, false);
  });
}

}  // namespace frontseat_driver::ros_layer::blueye_layer
