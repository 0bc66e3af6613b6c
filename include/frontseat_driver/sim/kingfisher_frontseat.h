#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "frontseat_driver/sim/autopilot.h"
#include "frontseat_driver/sim/catamaran.h"
#include "frontseat_driver/sim/frontseat.h"
#include "frontseat_driver/sim/guidance.h"

namespace frontseat_driver::sim {

/// What a simulated Kingfisher can be told besides.
struct KingfisherConfig : FrontseatConfig {
  std::vector<PlanePoint> loop = {{20.0, 12.0}, {20.0, -12.0}, {-20.0, -12.0}, {-20.0, 12.0}};
  double loop_speed_m_s = 1.0;
  double resume_loop_s = 30.0;             ///< after the last command; 0: never again
  double waves_deg = 1.5;                  ///< amplitude of the roll
  bool yaw_rate_in_degrees = false;        ///< PYDEP as Heron firmware reads it
  std::string_view imu_formatter = "IMU";  ///< "IMU" or "RIM"
  int compass_id = 1;
};

/// The vehicle's side of the Kingfisher USV NMEA Interface 0.1. Sends everything to every client,
/// drives a loop by itself until a client commands it, and stops its motors one second after the
/// last command.
class KingfisherFrontseat : public Frontseat {
 public:
  static constexpr std::chrono::seconds kGpsAheadOfUtc{18};  ///< leap seconds since 1980

  explicit KingfisherFrontseat(const KingfisherConfig& config);

  const Catamaran::Thrust& thrust() const { return catamaran_.commanded(); }
  const VehicleModel& model() const override { return catamaran_; }

 private:
  using Command =
      std::variant<std::monostate, protocol::kingfisher::MotorThrust,
                   protocol::kingfisher::ThrustAndYawRate, protocol::kingfisher::HeadingAndSpeed>;

  VehicleModel& mutableModel() override { return catamaran_; }
  void welcome(Client& client) override { client.logged = kAll; }
  void command(Client& client, const nmea::Sentence& sentence) override;
  void control(double dt_s) override;
  void sendNavigation(const protocol::NavigationUpdate& navigation) override;
  void adapt(protocol::NavigationUpdate& navigation, const Sensors::Reading& reading) override;

  void scheduleReports();
  void sendCompass();
  void sendImu();
  void sendBattery();
  void sendMinimumData();
  void sendFix();
  void sendCourseAndSpeed();

  Catamaran::Thrust commandedThrust() const;
  Catamaran::Thrust loopThrust();

  KingfisherConfig settings_;
  Catamaran catamaran_;
  std::string_view gps_talker_;
  Command command_;
  UtcTime command_time_{};
  std::size_t corner_ = 0;
};

}  // namespace frontseat_driver::sim
