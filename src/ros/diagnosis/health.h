#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "frontseat_driver/session/nmea_session.h"
#include "frontseat_driver/vehicle/clock_offset.h"
#include "frontseat_driver/vehicle/event.h"
#include "parameters.h"
#include "sentence_rates.h"

namespace frontseat_driver::ros_layer {

/// A vehicle that has just been connected to may take so long until it says what it was asked for.
constexpr double kStartPatience_s = 5.0;

struct LinkHealth {
  bool connected = false;
  bool failed = false;            ///< since the vehicle was last heard, if it was
  std::string endpoint;           ///< as connected, or host and port as configured
  std::string last_failure;       ///< why there is, or was, no connection
  double connected_s = 0.0;       ///< since the connection was made
  std::size_t losses_lately = 0;  ///< connections that ended in the last minute
  double unreported_s = 0.0;      ///< since the driver's thread last said anything
};

/// What the clocks are like.
struct ClockHealth {
  enum class State { Unsynchronized, Learning, Tracking };
  State state = State::Unsynchronized;
  vehicle::ClockOffset::State offset;
  std::optional<double> vehicle_ahead_s;  ///< of this computer's UTC, leap_seconds taken off
  std::optional<double> step_ago_s;       ///< the last time that one of the clocks stepped
  std::size_t steps_lately = 0;           ///< in the last minute
  double held_back_s = 0.0;               ///< stamps that would have gone back by so much
  bool computer_set_back = false;         ///< and that is what holds the stamps back
  bool ros_clock_stands = false;
  double simulated_behind_s = 0.0;  ///< how far /clock was set back behind the latest stamp
};

/// One bank of cells.
struct BatteryHealth {
  std::optional<std::int64_t> id;
  double stack_v = 0.0;
  std::optional<double> lowest_cell_v;
  std::size_t cells = 0;   ///< in series; 0: not known
  double weakest_v = 0.0;  ///< of a stack all of whose cells were as low as the lowest
  double low_for_s = 0.0;  ///< how long it has been below battery_low_voltage
};

/// How the driver is, once a second: all that a diagnosis goes by.
struct Health {
  LinkHealth link;
  bool replay = false;  ///< a record is played, and may stand still
  double max_data_age_s = 2.0;

  std::string dialect;              ///< empty while not known
  std::string parameter_dialect;    ///< as the user has it: "auto" or one of the two
  bool other_dialect_only = false;  ///< all that a vehicle said is of the other dialect; also of
                                    ///< the last connection, until the next one tells more
  std::vector<session::LogSwitch> log_requests;
  std::vector<SentenceRates::Rate> rates;  ///< on this connection
  session::NmeaCounters counters;          ///< since the start
  session::NmeaCounters connection;        ///< on this connection
  session::NmeaCounters recent;            ///< in the last ten seconds of it
  bool position_known = false;             ///< there was one that could be published
  std::uint64_t jumps = 0;                 ///< positions dropped

  ClockHealth clock;
  StampMode stamp = StampMode::Synced;
  std::chrono::seconds leap_seconds{0};

  session::ControlState control;
  session::ControlHook control_hook = session::ControlHook::Ctl;
  std::string refused_command;  ///< why this driver took none of the last ones, while recent

  std::string commanded;           ///< what is being repeated to the vehicle; empty: nothing is
  std::string effect_complaint;    ///< commanded and measured, if the vehicle does not follow
  std::string vehicle_refusal;     ///< the vehicle's last refusal of a command, while recent
  double held_back_s = 0.0;        ///< how long the link has taken no command that was due
  std::size_t unacknowledged = 0;  ///< sentences sent without an answer so far

  std::vector<BatteryHealth> batteries;
  double battery_low_v = 0.0;  ///< parameter battery_low_voltage; 0: never low
};

inline double inSeconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace frontseat_driver::ros_layer
