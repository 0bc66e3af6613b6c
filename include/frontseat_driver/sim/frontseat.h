#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/protocol/message.h"
#include "frontseat_driver/sim/client.h"
#include "frontseat_driver/sim/faults.h"
#include "frontseat_driver/sim/quirks.h"
#include "frontseat_driver/sim/sensors.h"
#include "frontseat_driver/sim/truth.h"
#include "frontseat_driver/sim/vehicle_model.h"
#include "frontseat_driver/vehicle/clock.h"

namespace frontseat_driver::sim {

using vehicle::UtcTime;

/// What every simulated frontseat can be told.
struct FrontseatConfig {
  Environment environment;
  Start start;
  BatteryType battery;
  bool battery_swap = true;      ///< an almost empty battery is replaced by a full one
  UtcTime start_time{0};         ///< UTC at which the simulation begins
  std::uint64_t seed = 1;        ///< of noise and faults
  bool noise = true;             ///< false: sentences are the truth up to their decimals
  double clock_offset_s = 0.0;   ///< vehicle clock ahead of UTC
  double clock_drift_ppm = 0.0;  ///< and getting further ahead
  std::chrono::milliseconds solution_age{10};  ///< from the navigation solution to its sentence
  double first_fix_s = 0.0;                    ///< no position before
  std::map<std::string, double> rates;         ///< Hz by formatter; 0 turns off
  std::chrono::milliseconds tick{0};           ///< steps the vehicle lives in; 0: by the rates
  Quirks quirks;
  Faults faults;
};

/// A sentence that is sent at a rate, and the rate.
struct Rate {
  std::string_view sentence;  ///< its formatter
  double hz;
};

/// The rates a dialect's vehicle has unless told otherwise: all that can be set.
const std::vector<Rate>& defaultRates(protocol::Dialect dialect);

/// The vehicle's side of one dialect: what it says, and how it obeys. No socket, thread or clock:
/// bytes and time are arguments, time is UTC and may be virtual. Equal calls give equal bytes.
class Frontseat {
 public:
  /// Where step() puts what leaves the vehicle.
  class Sink {
   public:
    virtual ~Sink() = default;
    virtual void send(ClientId client, std::string_view bytes) = 0;
    virtual void disconnect(ClientId client) = 0;
    /// Called at each navigation instant, before the sentence that tells of it.
    virtual void navigation(const Truth& truth) = 0;
  };

  virtual ~Frontseat() = default;
  Frontseat(const Frontseat&) = delete;
  Frontseat& operator=(const Frontseat&) = delete;

  void clientConnected(ClientId client, UtcTime now);
  void clientBytes(ClientId client, std::string_view bytes, UtcTime now);
  void clientDisconnected(ClientId client);

  /// What goes wrong from now on.
  void setFaults(const Faults& faults) { config_.faults = faults; }

  /// Lets the vehicle live up to `now` in fixed steps of tick(), then hands on all that was said.
  void step(UtcTime now, Sink& sink);

  /// Sets the vehicle's clock forward by this much, as its operator or its GPS may.
  void stepClock(std::chrono::nanoseconds by) { clock_steps_ += by; }

  std::chrono::nanoseconds tick() const { return tick_; }
  UtcTime now() const { return now_; }
  virtual const VehicleModel& model() const = 0;

 protected:
  static constexpr std::uint32_t kAll = ~std::uint32_t{0};

  Frontseat(const FrontseatConfig& config, protocol::Dialect dialect,
            std::chrono::seconds clock_ahead_of_utc);

  virtual VehicleModel& mutableModel() = 0;
  virtual void welcome(Client& client) = 0;
  virtual void command(Client& client, const nmea::Sentence& sentence) = 0;
  virtual void control(double dt_s) = 0;  ///< sets the actuators for the next step
  virtual void say() {}                   ///< events, after each step
  virtual void sendNavigation(const protocol::NavigationUpdate& navigation) = 0;
  /// Makes a solution in true headings, with depth and altitude, one of this vehicle.
  virtual void adapt(protocol::NavigationUpdate& navigation, const Sensors::Reading& reading) = 0;

  /// Has `send` called at the rate that the configuration gives `sentence`. In the same instant NVG
  /// comes last, and the others in the order of these calls.
  void schedule(std::string_view sentence, std::function<void()> send);

  /// Queues a sentence for all clients with one of these `bits` in what they asked for.
  template <class T>
  void broadcast(std::uint32_t bits, std::string_view talker, const T& message) {
    nmea::SentenceWriter out = protocol::write(talker, message);
    if (const auto text = out.finish()) broadcast(bits, *text);
  }
  void broadcast(std::uint32_t bits, std::string_view sentence);
  /// Queues a sentence for one client.
  void queue(Client& client, std::string_view sentence);

  protocol::VelocityUpdate velocity();
  const Sensors::Reading& reading();    ///< one for all sentences of the same instant
  bool hasFix();                        ///< GPS: at the surface, and not before the first
  void reboot() { rebooting_ = true; }  ///< ends all connections at the end of the step

  UtcTime clock(UtcTime utc) const;             ///< the vehicle's idea of UTC, whole milliseconds
  nmea::TimeOfDay stamp(UtcTime utc) const;     ///< as the vehicle writes it
  nmea::TimeOfDay utcStamp(UtcTime utc) const;  ///< as its GPS receiver writes it
  double elapsed() const;                       ///< seconds since the start
  const FrontseatConfig& config() const { return config_; }
  Client* find(ClientId client);

 private:
  struct Report {
    std::chrono::nanoseconds period;
    UtcTime due;
    std::function<void()> send;
  };
  struct Solution {
    UtcTime due;
    protocol::NavigationUpdate navigation;
  };
  struct Attitude {
    UtcTime time{};
    double heading_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
  };

  void advance(Sink& sink);
  void navigate(Sink& sink);
  void sendSolutions();
  void take(Client& client, std::string_view bytes);
  void read(Client& client);
  void obey(Client& client, std::string_view line);
  void applyQuirks(protocol::NavigationUpdate& navigation, const VehicleState& state) const;
  void differentiate(protocol::VelocityUpdate& velocity, const VehicleState& state);
  void replaceEmptyBattery();
  bool stalled() const;
  bool disconnectDue();
  void flush(Sink& sink);
  void disconnectAll(Sink& sink);
  void promote();
  Report report(std::string_view sentence, std::function<void()> send) const;

  FrontseatConfig config_;
  const std::vector<Rate>& default_rates_;
  const std::chrono::seconds clock_ahead_of_utc_;
  std::chrono::nanoseconds clock_steps_{0};
  const bool rewrites_;
  std::chrono::nanoseconds tick_;
  UtcTime now_;
  UtcTime next_tick_;
  UtcTime next_read_;
  UtcTime next_disconnect_;
  Sensors sensors_;
  std::optional<Sensors::Reading> reading_;
  UtcTime reading_time_;
  Attitude last_attitude_;
  std::vector<Report> reports_;
  Report navigation_;
  std::deque<Solution> solutions_;
  std::map<ClientId, Client> clients_;
  std::uint64_t connections_ = 0;
  bool rebooting_ = false;
};

}  // namespace frontseat_driver::sim
