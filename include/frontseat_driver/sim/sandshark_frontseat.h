#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "frontseat_driver/sim/frontseat.h"
#include "frontseat_driver/sim/mission.h"
#include "frontseat_driver/sim/torpedo.h"

namespace frontseat_driver::sim {

/// What a simulated Sandshark can be told besides.
struct SandsharkConfig : FrontseatConfig {
  MissionPlan mission;
  SafeLimits limits;
  bool allow_dynamic_requests = true;  ///< the backseat has control while the mission runs
  double pending_s = 0.0;  ///< BPRMB is acknowledged as pending first, so long; 0: done at once
  double altimeter_range_m = 100.0;  ///< further from the bottom the altitude is sent as 0
};

/// The vehicle's side of the Sandshark Standard Payload Interface 0.1. Runs its mission by itself
/// and lets the payload change it while dynamic requests are allowed (SPI 0.1, section 7.3).
class SandsharkFrontseat : public Frontseat {
 public:
  explicit SandsharkFrontseat(const SandsharkConfig& config);

  /// Allows dynamic requests or not; BFCTL tells the payload when that changes anything.
  void setBackseatControl(bool allowed) { dynamic_requests_ = allowed; }
  void abort(const std::string& details) { mission_.abort(details); }
  void restartMission() { mission_.restart(); }
  /// BFSHT to every client: its power goes in a minute.
  void announceShutdown();

  const Mission& mission() const { return mission_; }
  bool backseatInControl() const { return backseat_in_control_; }
  /// Whether the vehicle follows a BPRMB right now.
  bool backseatSteers() const;
  const VehicleModel& model() const override { return torpedo_; }

 private:
  using Status = vehicle::Acknowledgement::Status;
  using BehaviorChange = protocol::bluefin::BehaviorChange;

  /// The answer to a command.
  struct Answer {
    Status status = Status::Done;
    std::string_view message;
    bool silent = false;  ///< no answer at all, as a real vehicle's to BPLOG,ACK
  };
  struct Change {
    BehaviorChange wanted;
    UtcTime received;
  };
  struct LateAck {
    UtcTime due;
    ClientId client;
    std::string sentence;
  };

  VehicleModel& mutableModel() override { return torpedo_; }
  void welcome(Client& client) override;
  void command(Client& client, const nmea::Sentence& sentence) override;
  void control(double dt_s) override;
  void say() override;
  void sendNavigation(const protocol::NavigationUpdate& navigation) override;
  void adapt(protocol::NavigationUpdate& navigation, const Sensors::Reading& reading) override;

  void scheduleReports();
  void sendDvl();
  void sendCtd();

  Answer obey(Client& client, const protocol::Message& message);
  Answer log(Client& client, const protocol::bluefin::LogRequest& request);
  Answer change(const BehaviorChange& wanted);
  Answer abortMission(const protocol::bluefin::AbortMission& command);
  bool unsafe(const BehaviorChange& wanted) const;
  Setpoint modified(Setpoint setpoint) const;

  void acknowledge(Client& client, std::string_view address,
                   const std::optional<nmea::TimeOfDay>& time, const Answer& answer);
  void acknowledgeAfter(double delay_s, Client& client,
                        protocol::bluefin::Acknowledgement acknowledgement);
  void sendLateAcks();
  void updateControl();
  void sayMission();
  void sayBehavior();
  protocol::bluefin::MissionStatus missionStatus(const std::string& status) const;

  SandsharkConfig settings_;
  Torpedo torpedo_;
  Mission mission_;
  bool dynamic_requests_;
  bool backseat_in_control_ = false;
  std::optional<Change> change_;
  std::deque<LateAck> late_acks_;
  Mission::State said_state_;
  std::size_t said_leg_;
};

}  // namespace frontseat_driver::sim
