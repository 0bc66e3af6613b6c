#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <frontseat_driver/BlueyeMessage.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "blueye/health.h"
#include "blueye/input.h"
#include "blueye/parameters.h"
#include "blueye/publisher.h"
#include "blueye/services.h"
#include "expected_subscribers.h"
#include "frontseat_driver/driver/blueye_driver.h"
#include "host_clocks.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// One Blueye drone on ROS: a session with the drone, run by a driver or by a record, and the
/// topics and services it feeds. Logs what changes.
///
/// Everything but the construction and the destruction happens on one thread at a time: the
/// driver's, or with a record whichever holds the lock.
class Bridge : private driver::BlueyeLinkListener, private session::BlueyeListener {
 public:
  /// Connects, or begins to listen to the record. `name` stands before every log line.
  Bridge(ros::NodeHandle node, ros::NodeHandle private_node, std::string name,
         const Parameters& parameters);

  /// Zero motion, goodbye, and the end of the connections; takes at most 200 ms.
  ~Bridge() override;

 private:
  void onConnected(const vehicle::Now& now, const std::string& endpoint) override;
  void onDisconnected(const vehicle::Now& now, const std::string& reason) override;
  void onConnectFailed(const vehicle::Now& now, const std::string& reason) override;
  void onControlSent(const vehicle::Now& now, std::string_view type,
                     std::string_view payload) override;
  void onRequestSent(const vehicle::Now& now, std::string_view type,
                     std::string_view payload) override;
  void onTick(const vehicle::Now& now) override;

  void telemetry(const vehicle::Now& now, std::string_view type, std::string_view payload) override;
  void event(const vehicle::Now& now, const vehicle::Event& event) override;
  void clients(const vehicle::Now& now) override;
  void note(const std::string& text) override;

  void post(Task task);
  void replay(const BlueyeMessage::ConstPtr& message);
  void publishLink(const vehicle::Now& now);
  void takeHealth(const vehicle::Now& now);
  void addDiagnostics(ros::NodeHandle node, ros::NodeHandle private_node);
  void updateDiagnostics();

  const std::string name_;
  const Parameters parameters_;
  const protocol::BlueyeCatalogue catalogue_;
  HostClocks clocks_;
  session::BlueyeSession session_;
  Publisher publisher_;
  ros::Publisher link_;
  ros::Publisher control_;
  ros::Publisher clients_;
  ros::Publisher mission_;

  bool connected_ = false;
  bool failure_logged_ = false;  ///< since the last connection
  std::string endpoint_;
  const std::string configured_endpoint_;  ///< before the driver has told any
  std::string last_failure_;
  std::uint32_t connects_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t sent_bytes_ = 0;
  std::uint64_t unknown_ = 0;
  std::uint64_t unreadable_ = 0;
  std::optional<vehicle::SteadyTime> heard_;

  bool commanding_ = false;
  std::uint64_t refused_ = 0;
  std::optional<vehicle::SteadyTime> refused_at_;

  std::mutex health_mutex_;
  Health health_;
  Health told_health_;                 ///< the timer's own
  vehicle::SteadyTime next_health_{};  ///< of a record
  std::optional<vehicle::UtcTime> recorded_at_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer diagnostics_timer_;
  std::mutex replay_mutex_;
  ros::Subscriber replay_;
  std::unique_ptr<driver::BlueyeDriver> driver_;  ///< empty while a record is played
  std::unique_ptr<Input> input_;
  std::unique_ptr<Services> services_;
  std::unique_ptr<ExpectedSubscribers> expected_;  ///< whom the drone's first words wait for
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
