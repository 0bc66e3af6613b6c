#pragma once

#include <frontseat_driver/Abort.h>
#include <frontseat_driver/ModifyBehavior.h>
#include <frontseat_driver/SendSentence.h>
#include <frontseat_driver/SetDatum.h>
#include <frontseat_driver/SetLogging.h>
#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <chrono>

#include "command_input.h"
#include "frontseat_driver/session/nmea_session.h"
#include "parameters.h"
#include "vehicle_publisher.h"
#include "waiting_services.h"

namespace frontseat_driver::ros_layer {

/// The services. A call waits on a thread of its own for the session's answer, no longer than
/// ack_timeout, so that it holds nothing else up.
class CommandServices {
 public:
  /// Session and publisher must outlive every posted task.
  CommandServices(ros::NodeHandle node, const Parameters& parameters, session::NmeaSession& session,
                  VehiclePublisher& publisher, PostTask post);

  /// Answers the calls under way at once and takes no more. Tasks posted before may still run.
  void close() { services_.close(); }

 private:
  using Answer = session::Answer;
  using Services = WaitingServices<Answer, session::Output>;

  Answer ask(Services::Ask work, WhenLate when_late = WhenLate::Drop) const;
  Answer request(session::Request wanted) const;
  Answer modifyBehavior(const Behavior& behavior) const;
  Answer setDatum(const SetDatumRequest& datum) const;

  const std::chrono::nanoseconds timeout_;
  const std::chrono::nanoseconds max_command_age_;
  session::NmeaSession& session_;
  VehiclePublisher& publisher_;
  Services services_;
};

}  // namespace frontseat_driver::ros_layer
