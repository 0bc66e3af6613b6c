#pragma once

#include <frontseat_driver/CommandAck.h>
#include <frontseat_driver/ControlStatus.h>
#include <frontseat_driver/InterfaceVersion.h>
#include <frontseat_driver/MissionStatus.h>
#include <frontseat_driver/ShutdownNotice.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/TimeReference.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "arrival_clock.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"
#include "jump_filter.h"
#include "parameters.h"
#include "stamper.h"

namespace frontseat_driver::ros_layer {

/// Turns what the vehicle tells into messages. Knows no publisher: an empty result is published
/// nowhere, and a message that nobody wants need not be asked for.
///
/// What goes into more than one message, or tells the time: take() each of them once when it
/// arrives, whoever listens, then ask for the messages. Not safe for concurrent use.
class MessageBuilder {
 public:
  explicit MessageBuilder(const Parameters& parameters);

  /// What is "by dialect" follows this; from the start as the parameter has it, if it does.
  void setDialect(protocol::Dialect dialect);

  /// Moves the origin of the odometry frame.
  void setDatum(const vehicle::Position& datum);

  /// As given, else the first valid position; empty before that.
  const std::optional<vehicle::Position>& datum() const { return datum_; }

  /// How far the north that the vehicle's headings count from lies clockwise of true north: what a
  /// commanded true heading must be turned back by. Empty while no position is known.
  std::optional<double> northOffset_deg() const;

  /// Positions dropped because the vehicle cannot have got there, and how far the latest was off.
  std::uint64_t jumps() const { return filter_.jumps(); }
  double latestJump_m() const { return filter_.latestJump_m(); }

  /// Whether there was a position that could be published.
  bool positionKnown() const { return filter_.last().has_value(); }

  /// By how much the stamp of a message would have gone back, at most, since the last call.
  std::chrono::nanoseconds takeHeldBack() { return std::exchange(held_back_, {}); }

  /// Forgets stamps and data, not the datum: for a replay that starts again, where time goes back.
  void reset();

  /// Forgets all but the parameters: for a replay of a driver that was restarted.
  void startAfresh();

  void take(const vehicle::ClockSample& clock, const vehicle::Now& arrival);
  void take(const vehicle::GpsFix& fix, const vehicle::Now& arrival);
  void take(const vehicle::GpsVelocity& velocity, const vehicle::Now& arrival);
  void take(const vehicle::Navigation& navigation, const vehicle::Now& heard);
  void take(const vehicle::Velocity& velocity, const vehicle::Now& heard);
  void take(const vehicle::RawImu& imu, const vehicle::Now& heard);

  /// `odom`, from the latest navigation with velocity as far as it is fresh. Nothing without a
  /// position that is usable and not a jump.
  std::optional<nav_msgs::Odometry> odometry();

  /// `tf`: the pose of `odometry`. Nothing if its stamp is not later than the last one's.
  std::optional<geometry_msgs::TransformStamped> transform(const nav_msgs::Odometry& odometry);

  /// `nav/fix`, from the latest navigation. Nothing without a position, as odometry().
  std::optional<sensor_msgs::NavSatFix> navFix();

  /// `depth`, from the latest navigation: z in the odometry frame, all else unknown.
  std::optional<geometry_msgs::PoseWithCovarianceStamped> depth();

  /// `altitude`, from the latest navigation. Nothing when blank or 0, which means no bottom.
  std::optional<sensor_msgs::Range> altitude();

  /// `imu/data`, from the latest velocity, with navigation and raw IMU as far as they are fresh.
  std::optional<sensor_msgs::Imu> imu();

  /// `nav/velocity`, from the latest velocity. Nothing without east or north; z is NaN if only down
  /// is missing.
  std::optional<geometry_msgs::TwistStamped> navVelocity();

  /// `imu/data_raw`, from the latest raw IMU. Nothing if all of it is blank.
  std::optional<sensor_msgs::Imu> rawImu();

  /// `compass/data`. Nothing without a heading.
  std::optional<sensor_msgs::Imu> compass(const vehicle::Compass& compass,
                                          const vehicle::Now& arrival);

  /// `battery`
  sensor_msgs::BatteryState battery(const vehicle::Battery& battery, const vehicle::Now& arrival);

  /// `gps/fix`. Without a fix or a position: NO_FIX and NaN.
  sensor_msgs::NavSatFix gpsFix(const vehicle::GpsFix& fix, const vehicle::Now& arrival);

  /// `gps/velocity`: ENU. Nothing if the receiver calls it void, or without speed or course; a
  /// course may be blank at speed 0.
  std::optional<geometry_msgs::TwistStamped> gpsVelocity(const vehicle::GpsVelocity& velocity,
                                                         const vehicle::Now& arrival);

  /// `gps/time_reference`: the receiver's UTC against arrival on the ROS clock, whatever `stamp`
  /// is. Nothing if the receiver calls it void, or without time or date.
  std::optional<sensor_msgs::TimeReference> gpsTime(const vehicle::GpsVelocity& velocity,
                                                    const vehicle::Now& arrival);

  /// `mission_status`, `control`, `interface_version`, `shutdown`, `ack`
  MissionStatus missionStatus(const vehicle::MissionStatus& status, const vehicle::Now& arrival);
  ControlStatus controlStatus(const vehicle::Control& control, const vehicle::Now& arrival);
  InterfaceVersion interfaceVersion(const vehicle::InterfaceVersion& version,
                                    const vehicle::Now& arrival);
  ShutdownNotice shutdownNotice(const vehicle::Shutdown& shutdown, const vehicle::Now& arrival);
  CommandAck commandAck(const vehicle::Acknowledgement& ack, const vehicle::Now& arrival);

  /// `vehicle_time`: the vehicle's own clock, as it stands in the sentence, against arrival on the
  /// ROS clock.
  sensor_msgs::TimeReference vehicleTime(const vehicle::ClockSample& clock,
                                         const vehicle::Now& arrival);

  /// What is known of the vehicle's clock.
  vehicle::ClockOffset::State clock() const { return stamper_.clock(); }

  /// The static transforms to <base_frame>_frd and <odom_frame>_ned.
  std::array<geometry_msgs::TransformStamped, 2> helperFrames(const vehicle::Now& now) const;

 private:
  template <class Event>
  struct Latest {
    Event event;
    vehicle::Now arrival;
    ros::Time stamp;
  };

  /// One entry for each topic whose stamps must not go backwards.
  enum Topic {
    kOdometry,
    kTransform,
    kNavFix,
    kDepth,
    kAltitude,
    kImu,
    kNavVelocity,
    kRawImu,
    kCompass,
    kBattery,
    kGpsFix,
    kGpsVelocity,
    kGpsTime,
    kVehicleTime,
    kMissionStatus,
    kControlStatus,
    kInterfaceVersion,
    kShutdownNotice,
    kCommandAck,
    kTopicCount
  };

  /// Attitude in the ROS frames, with the variances about x, y and z.
  struct Attitude {
    geometry_msgs::Quaternion orientation;
    std::array<double, 3> variances;
  };

  std_msgs::Header header(Topic topic, const ros::Time& stamp, const std::string& frame);
  ros::Time vehicleStamp(std::optional<vehicle::TimeOfDay> measured_at,
                         const vehicle::Now& arrival) const;
  ros::Time gpsStamp(std::optional<vehicle::TimeOfDay> measured_at,
                     const vehicle::Now& arrival) const;
  /// The event, if it was not too old at `now`.
  template <class Event>
  const Event* fresh(const std::optional<Latest<Event>>& latest, const vehicle::Now& now) const {
    if (!latest || now.steady - latest->arrival.steady > parameters_.max_data_age) return nullptr;
    return &latest->event;
  }

  double positionVariance(const vehicle::Navigation& navigation) const;
  bool headingsAreTrue() const;
  std::optional<double> trueHeading_deg(const vehicle::Navigation& navigation) const;

  /// Empty without a heading, or without the convergence that a grid heading needs.
  std::optional<Attitude> attitudeOf(const vehicle::Navigation& navigation) const;
  Attitude attitudeOf(const std::optional<double>& roll_deg, const std::optional<double>& pitch_deg,
                      double true_heading_deg) const;

  void fillPosition(nav_msgs::Odometry& out) const;
  void fillTwist(geometry_msgs::TwistWithCovariance& out, const vehicle::Velocity& velocity,
                 const geometry_msgs::Quaternion& orientation) const;
  void fillOrientation(sensor_msgs::Imu& out, const std::optional<Attitude>& attitude) const;
  void fillRates(sensor_msgs::Imu& out, std::optional<double> x_deg_s,
                 std::optional<double> y_deg_s, std::optional<double> z_deg_s) const;
  void fillAcceleration(sensor_msgs::Imu& out, const vehicle::RawImu* raw) const;

  Parameters parameters_;
  std::optional<protocol::Dialect> dialect_;
  Stamper stamper_;
  ArrivalClock arrivals_;
  std::array<StampGuard, kTopicCount> guards_;
  std::chrono::nanoseconds held_back_{};
  JumpFilter filter_;
  std::optional<vehicle::Position> datum_;
  GeographicLib::LocalCartesian plane_;
  std::optional<Latest<vehicle::Navigation>> navigation_;
  bool position_accepted_ = false;  ///< the latest navigation has a position to publish
  std::optional<Latest<vehicle::Velocity>> velocity_;
  std::optional<Latest<vehicle::RawImu>> raw_imu_;
};

}  // namespace frontseat_driver::ros_layer
