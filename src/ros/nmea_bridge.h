#pragma once

#include <frontseat_driver/LinkStatus.h>
#include <ros/node_handle.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "command_input.h"
#include "command_services.h"
#include "compass_check.h"
#include "diagnosis/health_monitor.h"
#include "diagnosis/transition_log.h"
#include "diagnostics.h"
#include "expected_subscribers.h"
#include "frontseat_driver/driver/driver.h"
#include "frontseat_driver/session/nmea_session.h"
#include "host_clocks.h"
#include "parameters.h"
#include "replay.h"
#include "throttle.h"
#include "vehicle_publisher.h"

namespace frontseat_driver::ros_layer {

/// One NMEA vehicle on ROS: a session with the vehicle, run by a driver or by a record, and the
/// topics it feeds. Logs what changes.
///
/// Everything but the construction and the destruction happens on one thread at a time: the
/// driver's, or with a record whichever holds its lock.
class NmeaBridge : private driver::Listener {
 public:
  /// Connects, or begins to listen to the record. `name` stands before every log line.
  NmeaBridge(ros::NodeHandle node, ros::NodeHandle private_node, std::string name,
             const Parameters& parameters);

  /// Closes the connection in order; takes at most 100 ms.
  ~NmeaBridge() override;

 private:
  void onConnected(const vehicle::Now& now, const std::string& endpoint) override;
  void onDisconnected(const vehicle::Now& now, const std::string& reason) override;
  void onConnectFailed(const vehicle::Now& now, const std::string& reason,
                       std::chrono::milliseconds retry_in) override;
  void onHeard(const vehicle::Now& now, std::string_view line) override;
  void onSent(const vehicle::Now& now, std::string_view line) override;
  void onEvent(const vehicle::Now& now, const vehicle::Event& event) override;
  void onTick(const vehicle::Now& now) override;

  void post(SessionTask task);
  void startRecordAgain(Restart what);
  const std::string& connection() const;
  void followDialect();
  void watchCompass(const vehicle::Now& now, const vehicle::Event& event);
  void warnOfJumps(const vehicle::Now& now);
  void publishLink(const vehicle::Now& now);
  Health reportHealth(const vehicle::Now& now);

  HostClocks clocks_;
  const vehicle::UtcTime started_ = clocks_.read().utc;
  const std::string name_;
  session::NmeaSession session_;
  VehiclePublisher publisher_;
  Diagnostics diagnostics_;
  HealthMonitor monitor_;
  TransitionLog transitions_;
  CompassCheck compass_check_;

  std::optional<protocol::Dialect> followed_dialect_;
  bool connected_ = false;
  std::uint32_t connects_ = 0;
  std::string connection_;      ///< the present or last one, as `nmea/rx` names it
  std::string logged_failure_;  ///< to connect, since the last connection
  Throttle connect_log_;
  Throttle disconnect_log_;
  Throttle failure_log_;
  Throttle jump_log_;
  std::optional<vehicle::SteadyTime> last_heard_;
  std::uint64_t jumps_warned_ = 0;

  std::unique_ptr<driver::Driver> driver_;  ///< one of the two
  std::unique_ptr<Replay> replay_;
  std::unique_ptr<ExpectedSubscribers> subscribers_;
  std::unique_ptr<CommandInput> input_;
  std::unique_ptr<CommandServices> services_;
};

}  // namespace frontseat_driver::ros_layer
