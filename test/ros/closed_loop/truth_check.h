#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "closed_loop.h"
#include "supervised.h"

namespace frontseat_driver::closed_loop {

/// How far what a vehicle says may be from what it does.
struct TruthLimits {
  double position_m = 0.05;     ///< decimals of a minute
  bool course_heading = false;  ///< the heading is the course over ground
  bool blank_attitude = false;
  bool zero_depth = false;
};

/// Holds what is published against the simulated vehicle's truth: position, attitude, velocity and
/// stamp of all that arrives unspoilt, worked out by other means than the driver's; and that every
/// navigation is published, and that no topic's stamps go back.
class TruthCheck {
 public:
  TruthCheck(ClosedLoop& loop, Supervised& supervised, const ros_layer::Parameters& parameters,
             protocol::Dialect vehicle, const TruthLimits& limits);

  /// A clock of either side was stepped, or the vehicle began anew.
  void clocksChanged();
  void datumMoved(const vehicle::Position& datum) { datum_ = datum; }
  void driverLoaded();

  struct Seen {
    std::uint64_t positions = 0;
    std::uint64_t velocities = 0;
    std::uint64_t stamps = 0;
    std::uint64_t jumps = 0;
  };
  const Seen& seen() const { return seen_; }

 private:
  struct Moment {
    std::int64_t day_ms = 0;  ///< as the vehicle writes it
    Duration at{};
    sim::Truth truth;
  };
  enum Topic { kOdometry, kTransform, kFix, kDepth, kAltitude, kVelocity, kImu, kRawImu, kTopics };

  bool isBoat() const { return vehicle_ == protocol::Dialect::Kingfisher; }
  void takeTruth(const sim::Truth& truth);
  void said(std::string_view bytes);
  void heard(std::string_view line);
  void told(const vehicle::Event& event, const nav_msgs::Odometry* odometry);
  const Moment* momentOf(std::string_view time) const;

  void checkNavigation(const vehicle::Navigation& navigation, const nav_msgs::Odometry* odometry);
  void checkPosition(const sim::Truth& truth, const nav_msgs::Odometry& odometry);
  void checkAttitude(const sim::Truth& truth, const nav_msgs::Odometry& odometry);
  void checkVelocity(const vehicle::Velocity& velocity);
  void checkStamp(const ros::Time& stamp, const Moment& moment);
  void checkOrder(Topic topic, const ros::Time& stamp);

  ClosedLoop& loop_;
  Supervised& supervised_;
  const ros_layer::StampMode mode_;
  const protocol::Dialect vehicle_;
  const TruthLimits limits_;

  std::deque<Moment> moments_;
  std::deque<std::size_t> said_;  ///< hashes of lines that are under way
  std::string_view line_;         ///< being heard, if it arrived as it was said
  std::optional<vehicle::Position> datum_;
  std::optional<vehicle::Position> last_;  ///< published
  Duration last_at_{};
  int dropped_ = 0;
  std::array<ros::Time, kTopics> stamps_{};
  Duration settled_at_{0};  ///< clocks have been left alone for long since
  Duration slowest_{0};     ///< from measurement to arrival
  Seen seen_;
};

}  // namespace frontseat_driver::closed_loop
