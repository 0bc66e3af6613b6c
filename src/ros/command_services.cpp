#include "command_services.h"

#include <future>
#include <memory>
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
// How soon a waiting call notices that the driver is stopping.
constexpr auto kLook = 20ms;

constexpr const char* kStopping = "the driver is stopping";
constexpr const char* kHeldUp = "the driver is held up; it is done as soon as that goes on";

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
      post_(std::move(post)) {
  advertise<Abort>(node, topics::kAbort, urgent_, [this](AbortRequest& abort) {
    return request(session::AbortRequest{abort.reason, abort.with_errors != 0});
  });
  advertise<ModifyBehavior>(
      node, topics::kModifyBehavior, threads_,
      [this](ModifyBehaviorRequest& modify) { return modifyBehavior(modify.behavior); });
  advertise<SetLogging>(node, topics::kSetLogging, threads_, [this](SetLoggingRequest& log) {
    return request(session::LogSwitch{log.sentence, log.enable != 0});
  });
  advertise<SetDatum>(node, topics::kSetDatum, threads_,
                      [this](SetDatumRequest& datum) { return setDatum(datum); });
  advertise<std_srvs::SetBool>(
      node, topics::kEnableCommands, urgent_, [this](std_srvs::SetBoolRequest& gate) {
        const bool open = gate.data != 0;
        return ask(
            [this, open](const auto& now, auto& out, const auto& respond) {
              session_.setCommandsEnabled(now, open, out);
              respond(done(open ? "the command gate is open" : "the command gate is closed"));
            },
            open ? WhenLate::Drop : WhenLate::DoAnyway);
      });
  advertise<std_srvs::Trigger>(node, topics::kStop, urgent_, [this](std_srvs::TriggerRequest&) {
    return ask(
        [this](const auto& now, auto& out, const auto& respond) {
          session_.stop(now, out);
          respond(done("commanding has ended"));
        },
        WhenLate::DoAnyway);
  });
  if (!parameters.allow_raw_sentences) return;
  advertise<SendSentence>(node, topics::kSendSentence, threads_, [this](SendSentenceRequest& raw) {
    return request(session::RawSentence{raw.sentence});
  });
}

void CommandServices::close() {
  closing_ = true;
  threads_.close();
  urgent_.close();
  servers_.clear();
}

template <class Service>
void CommandServices::advertise(ros::NodeHandle& node, const char* name, ServiceThreads& threads,
                                std::function<Answer(typename Service::Request&)> serve) {
  ros::AdvertiseServiceOptions options = ros::AdvertiseServiceOptions::create<Service>(
      name,
      [serve = std::move(serve)](typename Service::Request& request,
                                 typename Service::Response& response) {
        const Answer answer = serve(request);
        response.success = answer.success;
        response.message = answer.message;
        return true;
      },
      ros::VoidConstPtr{}, &threads);
  servers_.push_back(node.advertiseService(options));
}

Answer CommandServices::ask(Ask task, WhenLate when_late) const {
  // Shared with the task, which may come to run after the wait has ended.
  const auto promise = std::make_shared<std::promise<Answer>>();
  std::future<Answer> answer = promise->get_future();
  const auto called = std::chrono::steady_clock::now();
  const auto deadline = called + timeout_ + kGrace;
  // What the caller has been told is late must not be done after all.
  const auto expiry = called + timeout_;
  post_([task = std::move(task), promise, expiry, when_late](const vehicle::Now& now,
                                                             session::Output& out) {
    if (when_late == WhenLate::Drop && std::chrono::steady_clock::now() >= expiry) {
      return promise->set_value({false, "the driver was held up; nothing was done"});
    }
    task(now, out, [promise](const Answer& given) { promise->set_value(given); });
  });
  while (answer.wait_for(kLook) != std::future_status::ready) {
    if (closing_) return {false, kStopping};
    if (std::chrono::steady_clock::now() < deadline) continue;
    return {false, when_late == WhenLate::Drop ? "the driver did not answer" : kHeldUp};
  }
  try {
    return answer.get();
  } catch (const std::future_error&) {  // the task went with the driver's thread
    return {false, kStopping};
  }
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
