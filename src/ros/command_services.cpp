#include "command_services.h"

#include <string>
#include <utility>

#include "command_convert.h"
#include "topics.h"

namespace frontseat_driver::ros_layer {

namespace {

using namespace std::chrono_literals;
using session::Answer;

// The session answers by its deadline; this is for its thread being held up.
constexpr auto kGrace = 50ms;

Answer done(const char* message) { return {true, message}; }

bool isLatitude(double degrees) { return degrees >= -90.0 && degrees <= 90.0; }
bool isLongitude(double degrees) { return degrees >= -180.0 && degrees <= 180.0; }

}  // namespace

CommandServices::CommandServices(ros::NodeHandle node, const Parameters& parameters,
                                 session::NmeaSession& session, VehiclePublisher& publisher,
                                 PostTask post)
    : timeout_(parameters.ack_timeout),
      max_command_age_(parameters.max_command_age),
      session_(session),
      publisher_(publisher),
      services_(std::move(post)) {
  services_.advertise<Abort>(node, topics::kAbort, Urgency::Urgent, [this](AbortRequest& abort) {
    return request(session::AbortRequest{abort.reason, abort.with_errors != 0});
  });
  services_.advertise<ModifyBehavior>(
      node, topics::kModifyBehavior, Urgency::Usual,
      [this](ModifyBehaviorRequest& modify) { return modifyBehavior(modify.behavior); });
  services_.advertise<SetLogging>(
      node, topics::kSetLogging, Urgency::Usual, [this](SetLoggingRequest& log) {
        return request(session::LogSwitch{log.sentence, log.enable != 0});
      });
  services_.advertise<SetDatum>(node, topics::kSetDatum, Urgency::Usual,
                                [this](SetDatumRequest& datum) { return setDatum(datum); });
  services_.advertise<std_srvs::SetBool>(
      node, topics::kEnableCommands, Urgency::Urgent, [this](std_srvs::SetBoolRequest& gate) {
        const bool open = gate.data != 0;
        return ask(
            [this, open](const auto& now, auto& out, const auto& respond) {
              session_.setCommandsEnabled(now, open, out);
              respond(done(open ? "the command gate is open" : "the command gate is closed"));
            },
            open ? WhenLate::Drop : WhenLate::DoAnyway);
      });
  services_.advertise<std_srvs::Trigger>(
      node, topics::kStop, Urgency::Urgent, [this](std_srvs::TriggerRequest&) {
        return ask(
            [this](const auto& now, auto& out, const auto& respond) {
              session_.stop(now, out);
              respond(done("commanding has ended"));
            },
            WhenLate::DoAnyway);
      });
  if (!parameters.allow_raw_sentences) return;
  services_.advertise<SendSentence>(
      node, topics::kSendSentence, Urgency::Usual,
      [this](SendSentenceRequest& raw) { return request(session::RawSentence{raw.sentence}); });
}

Answer CommandServices::ask(Services::Ask work, WhenLate when_late) const {
  return services_.ask(std::move(work),
                       {timeout_, timeout_ + kGrace, "the driver did not answer", when_late});
}

Answer CommandServices::request(session::Request wanted) const {
  return ask([this, wanted = std::move(wanted)](const auto& now, auto& out, const auto& respond) {
    session_.request(now, wanted, respond, out);
  });
}

Answer CommandServices::modifyBehavior(const Behavior& behavior) const {
  const std::string too_old = tooOld(behavior, ros::Time::now(), max_command_age_);
  if (!too_old.empty()) return {false, too_old};
  return ask([this, behavior](const auto& now, auto& out, const auto& respond) {
    const Converted converted = toCommand(behavior, publisher_.builder().northOffset_deg());
    if (const auto* refusal = std::get_if<std::string>(&converted)) {
      return respond({false, *refusal});
    }
    const auto& command = std::get<vehicle::Command>(converted);
    session_.request(now, std::get<vehicle::BehaviorCommand>(command), respond, out);
  });
}

Answer CommandServices::setDatum(const SetDatumRequest& datum) const {
  if (!isLatitude(datum.latitude) || !isLongitude(datum.longitude)) {
    return {false, "datum is " + std::to_string(datum.latitude) + ", " +
                       std::to_string(datum.longitude) +
                       "; latitude -90..90 and longitude -180..180 degrees are accepted"};
  }
  return ask([this, datum](const auto&, auto&, const auto& respond) {
    publisher_.setDatum({datum.latitude, datum.longitude});
    respond(done("the origin of the odometry frame has moved"));
  });
}

}  // namespace frontseat_driver::ros_layer
