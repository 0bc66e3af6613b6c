#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "frontseat_driver/session/nmea_session.h"
#include "frontseat_driver/vehicle/clock_offset.h"
#include "frontseat_driver/vehicle/event.h"
#include "sentence_rates.h"

namespace frontseat_driver::ros_layer {

/// How the driver is, once a second.
struct Health {
  bool connected = false;
  std::string endpoint;      ///< as connected, or host and port as configured
  std::string last_failure;  ///< why there is no connection
  std::string dialect;       ///< empty while not known
  session::NmeaCounters counters;
  session::NmeaCounters counters_before;  ///< a second earlier
  std::vector<SentenceRates::Rate> rates;
  vehicle::SteadyTime taken{};             ///< when all this was true
  bool replay = false;                     ///< a record is played, and may stand still
  std::optional<double> navigation_age_s;  ///< empty: none since the connection was made
  std::optional<double> clock_offset_s;    ///< vehicle's UTC minus this computer's
  vehicle::ClockOffset::State clock;       ///< what synced stamps go by
  std::uint64_t jumps = 0;                 ///< positions dropped
  vehicle::Grant grant = vehicle::Grant::Unknown;
  bool commands_enabled = true;
  std::string control_reason;
  std::string commanded;           ///< what is being repeated to the vehicle; empty when nothing is
  std::string effect_complaint;    ///< commanded and measured, if the vehicle does not follow
  std::string vehicle_refusal;     ///< the vehicle's last refusal of a command, while it is recent
  std::size_t unacknowledged = 0;  ///< sentences sent without an answer so far
  std::optional<double> battery_v;
};

/// Publishes Health on /diagnostics, a status for each layer so that the first bad one is the
/// cause.
class Diagnostics {
 public:
  Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node, const std::string& name,
              double max_data_age_s);

  /// The newest health; from any thread.
  void set(Health health);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void update();
  void link(Status& status) const;
  void data(Status& status) const;
  std::optional<double> velocitySilence_s() const;
  void decoding(Status& status) const;
  void clock(Status& status) const;
  void control(Status& status) const;
  void commands(Status& status) const;
  void battery(Status& status) const;

  const double max_data_age_s_;
  std::mutex mutex_;
  Health newest_;  ///< guarded by mutex_
  Health health_;  ///< what update() works on
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;  ///< ros::Timer would stand still with the simulated clock
};

}  // namespace frontseat_driver::ros_layer
