#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <chrono>
#include <optional>

#include "blueye/messages.h"
#include "blueye/senses.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::ros_layer::blueye_layer {

struct NavigationOptions {
  Conventions conventions;
  Deviations deviations;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  std::optional<vehicle::Position> datum;  ///< of the map frame; empty: the first global position
  double max_speed_m_s = 5.0;              ///< a faster step of the position is a reset
  std::chrono::nanoseconds max_data_age{std::chrono::seconds(2)};
};

/// Puts together what several messages of the drone tell: `odom`, `imu/data`, and the transforms.
/// take() each message once when it arrives, then ask.
///
/// `odom` never jumps: when the drone's estimate starts afresh, its new origin is taken to lie
/// where the drone is, and the jump goes into `map` -> `odom`.
class Navigation {
 public:
  explicit Navigation(NavigationOptions options);

  void take(const pb::AttitudeTel& told, const vehicle::Now& now);
  void take(const pb::DepthTel& told, const vehicle::Now& now);
  void take(const pb::CalibratedImuTel& told, const vehicle::Now& now);
  void take(const pb::DvlVelocityTel& told, const vehicle::Now& now);
  /// False if the message says nothing; then there is no new odometry().
  bool take(const pb::PositionEstimateTel& told, const vehicle::Now& now);

  /// The link was lost: nothing is fresh any more.
  void forget();

  /// `odom`, from the latest position estimate. One that is not valid gives x = y = 0 with unknown
  /// variance.
  std::optional<nav_msgs::Odometry> odometry(const vehicle::Now& now, const ros::Time& stamp) const;

  /// Empty unless the latest position estimate is valid.
  std::optional<geometry_msgs::TransformStamped> transform(
      const nav_msgs::Odometry& odometry) const;

  /// `map` -> `odom`; empty before the first global position.
  std::optional<geometry_msgs::TransformStamped> mapTransform(const ros::Time& stamp) const;

  /// True once after mapTransform() has changed.
  bool mapMoved();

  /// `imu/data`: the latest calibrated IMU with a fresh attitude.
  sensor_msgs::Imu imu(const vehicle::Now& now, const ros::Time& stamp) const;

  /// An IMU has been heard of lately, so that the attitude need not be published alone.
  bool hasImu(const vehicle::Now& now) const { return fresh(imu_, now) != nullptr; }

  /// What turns readings of accelerometers into specific force, as far as known.
  std::optional<double> accelerometerFactor() const { return accelerometer_.factor(); }

  std::optional<double> depth_m(const vehicle::Now& now) const;

  /// True once, when DVL and position estimate keep disagreeing about port and starboard.
  bool dvlDisagrees();

  /// The drone computes its depth with another density of water from now on.
  void setWaterDensity(double density_kg_m3) {
    options_.conventions.water_density_kg_m3 = density_kg_m3;
  }

  Context context(const ros::Time& stamp) const;

 private:
  template <class Message>
  struct Latest {
    Message message;
    vehicle::SteadyTime at;
  };
  template <class Message>
  const Message* fresh(const std::optional<Latest<Message>>& latest,
                       const vehicle::Now& now) const {
    const bool is_fresh = latest && now.steady - latest->at <= options_.max_data_age;
    return is_fresh ? &latest->message : nullptr;
  }

  void followReset(const pb::PositionEstimate& estimate, const vehicle::Now& now);
  void followMap(const pb::PositionEstimate& estimate);
  void fillPose(nav_msgs::Odometry& out, const vehicle::Now& now) const;
  void fillTwist(nav_msgs::Odometry& out, const vehicle::Now& now) const;
  std::optional<double> up_m_s(const vehicle::Now& now) const;

  NavigationOptions options_;
  AccelerometerSense accelerometer_;
  DvlSense dvl_sense_;
  bool dvl_disagrees_ = false;

  std::optional<Latest<pb::AttitudeTel>> attitude_;
  std::optional<Latest<pb::DepthTel>> depth_;
  std::optional<Latest<pb::DepthTel>> last_depth_;  ///< what the vertical speed is counted from
  std::optional<double> sinking_m_s_;
  std::optional<Latest<pb::CalibratedImuTel>> imu_;
  std::optional<Latest<pb::DvlVelocityTel>> dvl_;
  std::optional<Latest<pb::PositionEstimateTel>> estimate_;

  /// A point of the drone's own plane, or a way in it.
  struct Point {
    double x = 0.0;
    double y = 0.0;
  };
  Point offset_;                   ///< of odom from the drone's own origin
  std::optional<Point> last_raw_;  ///< the drone's own, last valid
  vehicle::SteadyTime last_raw_at_{};
  std::int32_t last_since_reset_s_ = 0;

  std::optional<vehicle::Position> datum_;
  GeographicLib::LocalCartesian plane_;
  std::optional<Point> map_from_odom_;
  bool map_moved_ = false;
  bool map_settled_ = false;  ///< a global position was seen since the last reset
};

}  // namespace frontseat_driver::ros_layer::blueye_layer
