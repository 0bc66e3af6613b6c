#pragma once

#include <frontseat_driver/Abort.h>
#include <frontseat_driver/ModifyBehavior.h>
#include <frontseat_driver/SendSentence.h>
#include <frontseat_driver/SetDatum.h>
#include <frontseat_driver/SetLogging.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <vector>

#include "command_input.h"
#include "frontseat_driver/session/nmea_session.h"
#include "parameters.h"
#include "service_threads.h"
#include "vehicle_publisher.h"

namespace frontseat_driver::ros_layer {

/// The services. A call waits on a thread of its own for the session's answer, no longer than
/// ack_timeout, so that it holds nothing else up.
class CommandServices {
 public:
  /// Session and publisher must outlive every posted task.
  CommandServices(ros::NodeHandle node, const Parameters& parameters, session::NmeaSession& session,
                  VehiclePublisher& publisher, PostTask post);

  /// Answers the calls under way at once and takes no more. Tasks posted before may still run.
  void close();

 private:
  using Answer = session::Answer;

  /// Hands a task its way to answer.
  using Ask = std::function<void(const vehicle::Now&, session::Output&, session::Respond)>;

  template <class Service>
  void advertise(ros::NodeHandle& node, const char* name, ServiceThreads& threads,
                 std::function<Answer(typename Service::Request&)> serve);

  Answer ask(Ask task, WhenLate when_late = WhenLate::Drop) const;
  Answer request(session::Request wanted) const;
  Answer modifyBehavior(const Behavior& behavior) const;
  Answer setDatum(const SetDatumRequest& datum) const;

  const std::chrono::nanoseconds timeout_;
  const std::chrono::nanoseconds max_command_age_;
  session::NmeaSession& session_;
  VehiclePublisher& publisher_;
  const PostTask post_;
  std::atomic<bool> closing_{false};
  ServiceThreads threads_;
  ServiceThreads urgent_;  ///< a stop does not wait for calls that wait for the vehicle
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace frontseat_driver::ros_layer
