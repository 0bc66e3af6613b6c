#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "command_convert.h"
#include "frontseat_driver/session/nmea_session.h"
#include "frontseat_driver/sim/kingfisher_frontseat.h"
#include "frontseat_driver/sim/random.h"
#include "frontseat_driver/sim/sandshark_frontseat.h"
#include "message_builder.h"
#include "parameters.h"

namespace frontseat_driver::closed_loop {

using Duration = std::chrono::nanoseconds;

/// Any message that commands motion.
using Wanted = std::variant<Behavior, Drive, Helm, Course, geometry_msgs::Twist>;

/// A sentence that the link took, without its line end.
struct Sent {
  Duration at{};  ///< since the beginning
  std::string sentence;
};

void PrintTo(const Sent& sent, std::ostream* out);

/// What became of a request: every answer that came, and when.
struct Asked {
  Duration at{};
  struct Answered {
    Duration at{};
    session::Answer answer;
  };
  std::vector<Answered> answers;
};

/// What the user wants by default, with the stamps that a simulated vehicle's truth can be found
/// by.
ros_layer::Parameters parametersFor(protocol::Dialect dialect);

/// A driver without ROS and sockets and a simulated frontseat, joined by a link that obeys, on one
/// virtual clock. Equal calls give equal bytes.
///
/// The vehicle's clock goes with the loop. The driver's system clock and stamp clock can be stepped
/// or stopped; its steady clock cannot. Every sentence that is sent is recorded.
class ClosedLoop : private session::Output, private sim::Frontseat::Sink {
 public:
  ClosedLoop(const ros_layer::Parameters& parameters, const sim::SandsharkConfig& vehicle);
  ClosedLoop(const ros_layer::Parameters& parameters, const sim::KingfisherConfig& vehicle);

  // Time

  /// Lets time pass, the vehicle ticking and the session stepping when it asks to. Throws
  /// std::logic_error if it asks without end.
  void pass(Duration duration);

  /// Lets time pass until `done`, looked at each 10 ms, or `limit`; false then.
  template <class Condition>
  bool passUntil(Condition done, Duration limit) {
    for (const Duration end = elapsed_ + limit; !done(); pass(std::chrono::milliseconds{10})) {
      if (elapsed_ >= end) return false;
    }
    return true;
  }

  /// Publishes at once and then once a `period`, until `duration` has passed.
  void publishFor(const Wanted& wanted, Duration period, Duration duration);

  Duration elapsed() const { return elapsed_; }
  vehicle::Now now() const;

  /// Steps the driver's system clock and, going with it, the clock of the stamps.
  void stepSystemClock(Duration by) { clock_error_ += by; }
  /// As /use_sim_time without a clock.
  void holdStampsAtZero() { stamps_at_zero_ = true; }

  // The link

  void connect();
  /// Both sides notice; what is under way is lost.
  void disconnect();
  /// The vehicle's side is gone and the driver's does not know: nothing arrives from here on.
  void abandon();
  /// The vehicle is off at once and begins anew, at the same clock; the link is lost.
  template <class Config>
  void powerCycle(Config vehicle) {
    disconnect();
    replaceVehicle(vehicle);
  }
  /// The same, but its host goes without a word: the driver's side of the link stays open.
  template <class Config>
  void crash(const Config& vehicle) {
    abandon();
    replaceVehicle(vehicle);
  }

  struct Link {
    Duration delay{0};       ///< one way
    Duration jitter{0};      ///< and up to so much more; the order stays
    double cut = 0.0;        ///< probability that what is sent at once comes in pieces
    double corrupt = 0.0;    ///< probability that one byte of it changes, either way
    Duration read_every{0};  ///< a slow vehicle takes so long from one sentence to the next
    std::size_t room = 0;    ///< bytes that may be under way to the vehicle; 0: any number
    bool takes = true;       ///< false: full, so that it refuses what is sent
    bool congested = false;  ///< still holds what it took before
    bool delivers = true;    ///< false: half-open, so that all is taken and nothing arrives
    /// Applied to all that the vehicle says; what it returns arrives instead.
    std::function<std::string(std::string_view)> edit;
  };
  Link link;
  /// Begins the link's own random numbers.
  void seedLink(std::uint64_t seed) { link_random_ = sim::Random{seed}; }
  /// The link has not got rid of what it was given before, as driver::Driver has it.
  bool congested() const override;

  // What a user does. Each is followed by a step, as in the driver.

  /// Why it was refused, or nothing. It reached this computer `waited` ago.
  std::string publish(const Wanted& wanted, Duration waited = Duration{0});
  /// The number of the request in asked().
  std::size_t request(session::Request request);
  /// As the service modify_behavior.
  std::size_t modify(const Behavior& behavior);
  /// Why it was refused, or nothing.
  std::string payloadStatus(bool ok, const std::string& message);
  void stop();
  void gate(bool open);
  void leave();
  /// A new driver with the same parameters in place of the one that has left.
  void load();

  // What there is to see

  session::NmeaSession& session() { return *session_; }
  ros_layer::MessageBuilder& builder() { return *builder_; }
  sim::Frontseat& frontseat() { return *frontseat_; }
  sim::SandsharkFrontseat& sandshark() {
    return dynamic_cast<sim::SandsharkFrontseat&>(*frontseat_);
  }
  sim::KingfisherFrontseat& kingfisher() {
    return dynamic_cast<sim::KingfisherFrontseat&>(*frontseat_);
  }
  const sim::VehicleState& state() const { return frontseat_->model().state(); }
  bool connected() const { return connected_; }
  vehicle::UtcTime vehicleTime() const { return start_ + elapsed_; }  ///< true UTC

  /// Without records, sent() stays empty: for runs of hours.
  void keepRecords(bool keep) { keeps_records_ = keep; }
  const std::vector<Sent>& sent() const { return sent_; }
  /// Those whose address is `address`, "PYDIR", sent not before `from`.
  std::vector<Sent> sent(std::string_view address, Duration from = Duration{0}) const;
  const std::vector<Asked>& asked() const { return asked_; }
  const nav_msgs::Odometry& odometry() const { return odometry_; }  ///< the latest
  double yaw() const;                                               ///< of it, rad
  const std::string& reason() const { return reason_; }             ///< as `control` has it
  bool commanding() const { return commanding_; }

  /// Called, if set.
  struct Watch {
    /// Each odometry and the truth at its stamp, each IMU message, the truth at each navigation
    /// instant, each event, each sentence that was sent, each line that was heard before it is
    /// decoded, and after every step.
    std::function<void(const nav_msgs::Odometry&, const sim::Truth&)> odometry;
    std::function<void(const sensor_msgs::Imu&)> imu;
    std::function<void(const sim::Truth&)> truth;
    std::function<void(const vehicle::Now&, const vehicle::Event&)> event;
    std::function<void(const Sent&)> sent;
    std::function<void(std::string_view)> heard;
    std::function<void()> step;
    /// Each event, with the odometry that it made, if it did; then no pairs are made.
    std::function<void(const vehicle::Event&, const nav_msgs::Odometry*)> told;
    std::function<void(std::string_view)> said;     ///< what the vehicle sent, as it arrives
    std::function<void(std::string_view)> arrives;  ///< bytes, before the session has them
    std::function<void()> refused;                  ///< the link did not take a sentence
    std::function<void()> lost;                     ///< the connection, however
    std::function<void()> confirmed;                ///< the session calls the vehicle one
    std::function<void(std::size_t, const session::Answer&)> answered;
  };
  Watch watch;

 private:
  struct Parcel {
    Duration due{};
    std::string bytes;
  };

  // session::Output
  bool send(const vehicle::Now& now, std::string_view sentence) override;
  void heard(const vehicle::Now& now, std::string_view line) override;
  void event(const vehicle::Now& now, const vehicle::Event& event) override;
  void confirmed() override {
    if (watch.confirmed) watch.confirmed();
  }

  // sim::Frontseat::Sink
  void send(sim::ClientId client, std::string_view bytes) override;
  void disconnect(sim::ClientId client) override;
  void navigation(const sim::Truth& truth) override;

  static std::unique_ptr<sim::Frontseat> frontseatFor(const sim::SandsharkConfig& vehicle);
  static std::unique_ptr<sim::Frontseat> frontseatFor(const sim::KingfisherConfig& vehicle);

  session::Output& output() { return *this; }
  template <class Config>
  void replaceVehicle(Config vehicle) {
    vehicle.start_time = vehicleTime();
    frontseat_ = frontseatFor(vehicle);
    next_tick_ = elapsed_;
  }
  void send(std::deque<Parcel>& way, std::string bytes, Duration least_gap);
  Duration nextEvent() const;
  void step();
  void vehicleSteps();
  void deliver();
  void lose();
  bool take(const vehicle::Navigation& navigation, const vehicle::Now& arrival);
  void take(const vehicle::Velocity& velocity, const vehicle::Now& arrival);
  ros_layer::Converted convert(const Wanted& wanted) const;

  const ros_layer::Parameters parameters_;
  const vehicle::UtcTime start_;
  std::unique_ptr<sim::Frontseat> frontseat_;
  std::optional<session::NmeaSession> session_;
  std::optional<ros_layer::MessageBuilder> builder_;

  Duration elapsed_{0};
  Duration next_tick_{0};
  Duration clock_error_{0};
  bool stamps_at_zero_ = false;

  bool connected_ = false;
  bool vehicle_hung_up_ = false;
  sim::ClientId client_ = 0;
  std::deque<Parcel> to_vehicle_;
  std::deque<Parcel> to_driver_;
  std::size_t under_way_ = 0;  ///< bytes to the vehicle
  sim::Random link_random_{1};

  bool keeps_records_ = true;
  std::vector<Sent> sent_;
  std::vector<Asked> asked_;
  std::map<vehicle::UtcTime, sim::Truth> truths_;
  nav_msgs::Odometry odometry_;
  std::string reason_;
  bool commanding_ = false;
};

/// `$body*hh`
std::string sentence(const std::string& body);

/// The fields of a sentence, its address first.
std::vector<std::string> fields(const std::string& sentence);

/// Yaw of an upright orientation, rad.
double yawOf(const geometry_msgs::Quaternion& orientation);

/// The smallest turn from one angle to the other, rad, 0 or more.
double apart(double a_rad, double b_rad);

// --- Messages and vehicles that tests begin with ---

Drive drive(double left, double right);
Helm helm(double thrust, double yaw_rate);
Course course(double yaw, double speed);
Behavior heading(double yaw);

/// No noise; begins its mission one second after the start, and so gives control after the
/// handshake. One long leg on the surface.
sim::SandsharkConfig quietSandshark();

/// No noise and no waves; lies still until it is commanded.
sim::KingfisherConfig quietKingfisher();

}  // namespace frontseat_driver::closed_loop
