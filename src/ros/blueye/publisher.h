#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include "blueye/navigation.h"
#include "blueye/repeats.h"
#include "frontseat_driver/protocol/blueye_catalogue.h"
#include "stamper.h"

namespace frontseat_driver::ros_layer::blueye_layer {

/// Puts what the drone tells on its topics, by one table from the type of a message to what is done
/// with it. Every message, known or not, goes out on `blueye/telemetry` first. A message nobody
/// subscribes to is not even decoded, except what others are made of. One thread tells it all.
class Publisher {
 public:
  /// Lines for the log: a warning, or the drone's own notification with its level.
  using Warn = std::function<void(const std::string&)>;
  using Notify = std::function<void(const BlueyeNotification&)>;

  struct Options {
    NavigationOptions navigation;
    bool publish_tf = true;
    bool publish_map_tf = true;
    bool publish_frd_frames = true;
  };

  Publisher(ros::NodeHandle node, const Options& options,
            const protocol::BlueyeCatalogue& catalogue, Warn warn, Notify notify);

  /// False if the bytes are not of the type.
  bool publish(const vehicle::Now& now, std::string_view type, std::string_view payload);

  /// Something was sent. A density of water is what the drone computes its depth with from then on.
  void publishControl(const vehicle::Now& now, std::string_view type, std::string_view payload);

  /// The link was lost.
  void forget() { navigation_.forget(); }

  /// A record begins anew: what was told of it counts no more, nor do its stamps.
  void beginAnew();

  /// A table of a message that is for diagnostics alone, by its path and value; newest.
  using Values = std::vector<std::pair<std::string, std::string>>;
  const std::map<std::string, Values>& diagnostics() const { return diagnostics_; }

  /// All flags of ErrorFlagsTel that are set.
  const std::vector<std::string>& errorFlags() const { return error_flags_; }

  /// The state of recording, as last told; empty if it was not.
  const std::optional<pb::RecordState>& recordState() const { return record_state_; }
  const std::optional<pb::ControlMode>& controlMode() const { return control_mode_; }
  const std::optional<pb::Battery>& battery() const { return battery_; }
  const Navigation& navigation() const { return navigation_; }

  /// The table has an entry for the type, given with the package.
  bool handles(std::string_view type) const { return table_.count(std::string{type}) != 0; }

  /// Every type that has an entry, with the package.
  std::vector<std::string> types() const;

 private:
  using Take = std::function<bool(const vehicle::Now&, std::string_view)>;

  template <class Telemetry, class Function>
  void on(Function take);
  template <class Telemetry, class Message>
  void topic(const char* name, std::optional<Message> (*convert)(const Telemetry&, const Context&),
             bool latched = false);
  template <class Message>
  ros::Publisher& advertise(const char* name, bool latched = false);
  template <class Message>
  void send(const ros::Publisher& publisher, Message message);
  void diagnose(const char* type);
  void addNavigation();
  void addSensors();
  void addVehicle();
  void addImu(const std::string& type, const char* data, const char* field);
  void publishOdometry(const vehicle::Now& now);
  void takeNotification(const vehicle::Now& now, const pb::Notification& told);
  ros::Time stampOf(const vehicle::Now& now) const;
  Context context(const vehicle::Now& now) const { return navigation_.context(stampOf(now)); }

  ros::NodeHandle node_;
  const Options options_;
  const protocol::BlueyeCatalogue& catalogue_;
  const Warn warn_;
  const Notify notify_;
  Navigation navigation_;
  std::unordered_map<std::string, std::vector<Take>> table_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher telemetry_;
  ros::Publisher control_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  StampGuard transform_stamps_;
  std::map<std::string, Values> diagnostics_;
  std::vector<std::string> error_flags_;
  std::optional<pb::RecordState> record_state_;
  std::optional<pb::ControlMode> control_mode_;
  std::optional<pb::Battery> battery_;
  /// When the details of each battery held a voltage last.
  std::array<std::optional<vehicle::SteadyTime>, 2> battery_details_at_;
  Repeats notified_;
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
